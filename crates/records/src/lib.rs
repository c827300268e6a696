//! Records of earthquakes: from a file's bytes to samples in multiples of
//! gravity, and their intensity measures.
//!
//! | input | result | function |
//! |---|---|---|
//! | a file of one component | the record | [`read`], [`read_file`] |
//! | a file of several channels | the records | [`read_all`] |
//! | a folder, a zip file or an index of records | a suite | [`Suite::read`] |
//! | a record | its intensity measures | [`intensity`] |
//! | a record and a mode of a building | the motion of a floor | [`Floor::motion`](floor::Floor::motion) |
//!
//! The content determines the format. A file is read completely or refused: a
//! cut number, a changed count, an unknown unit or a missing sampling interval
//! gives a [`RecordError`] with its place, never a repaired record.
//!
//! The feature `serde`, off by default, serialises names and measures.

#![deny(missing_docs)]

mod codes;
mod direction;
mod error;
mod fields;
pub mod floor;
mod format;
pub mod intensity;
mod keys;
mod number;
mod processing;
mod quality;
mod read;
mod record;
pub mod sampling;
mod suite;
mod text;

pub use direction::Direction;
pub use error::{Fault, RecordError};
pub use format::{Format, Header};
pub use processing::{Processing, ProcessingError};
pub use quality::{
    MemberMotion, Profile, Remark, RemarkInput, remarks, remarks_together,
};
pub use read::{file_bytes, read, read_all, read_as, read_file};
pub use record::{Fallback, ReadOptions, Record, sha256_hex};
pub use suite::{
    Aside, AsideCount, AsideReason, PEAK_TOLERANCE, Reading, SetAside,
    StudyRule, Suite, SuiteError, SuiteMember, Survey, is_index,
};

#[cfg(test)]
mod tests;
