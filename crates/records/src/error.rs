//! Why a file was refused: the file, the place, the found and the expected
//! content.

use thiserror::Error;

use super::codes::coded;
use super::sampling::Uneven;
use rocking::accelerogram::{AccelerogramError, EscapedName, NameError};
use rocking::units::AccelerationUnit;

/// A record that was refused.
///
/// ```
/// use rocking_records::ReadOptions;
/// let cut = b"PEER NGA STRONG MOTION DATABASE RECORD\n\
///     Nowhere, 1/1/2000, Station, 0\n\
///     ACCELERATION TIME SERIES IN UNITS OF G\n\
///     NPTS=      4, DT=   .0100 SEC\n\
///     \x20  .1000000E-02   .2000000E-02  -.3000000E-02\n";
/// let error = rocking_records::read("cut.AT2", cut, &ReadOptions::default());
/// assert_eq!(
///     error.unwrap_err().to_string(),
///     "cut.AT2:5: 3 samples: expected 4, as in the file"
/// );
/// ```
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
#[error("{file}{place}: {fault}", file = EscapedName(file), place = place(*line, *column))]
pub struct RecordError {
    /// Name of the file, as it was given.
    pub file: String,
    /// Line of the fault, counted from 1.
    pub line: Option<usize>,
    /// Character of the line, counted from 1.
    pub column: Option<usize>,
    /// The fault.
    pub fault: Fault,
}

/// A result of reading a file.
pub(crate) type Result<T, E = RecordError> = std::result::Result<T, E>;

/// Line and column, each after a colon.
fn place(line: Option<usize>, column: Option<usize>) -> String {
    let known = line.into_iter().chain(column);
    known.map(|number| format!(":{number}")).collect()
}

coded! {
    /// The fault of a record.
    #[derive(Clone, Debug, PartialEq, Error)]
    #[non_exhaustive]
    pub enum Fault {
        /// The file could not be read.
        #[error("cannot be read: {0}")]
        Unreadable(String) = "unreadable",
        /// An empty file.
        #[error("empty file: expected a record")]
        Empty = "empty",
        /// A byte that no text contains.
        #[error("byte {byte:#04x} at offset {offset}: expected text")]
        NotText {
            /// The byte.
            byte: u8,
            /// Its place, from 0.
            offset: usize,
        } = "not-text",
        /// A text in UTF-16 that cannot be read.
        #[error("text in UTF-16 with {0}: expected UTF-8")]
        Utf16(&'static str) = "utf-16",
        /// No reader knows the content.
        #[error(
            "begins with {found:?}: expected a record in one of the formats {expected}"
        )]
        UnknownFormat {
            /// Beginning of the first line that is not blank.
            found: String,
            /// Formats that can be read.
            expected: String,
        } = "unknown-format",
        /// A header with another content than the expected one.
        #[error("{found:?}: expected {expected}")]
        Header {
            /// The content found.
            found: String,
            /// The content expected.
            expected: &'static str,
        } = "header",
        /// A file that ends before a required part.
        #[error("the file ends: expected {0}")]
        Ends(&'static str) = "ends",
        /// Velocity, displacement or a spectrum.
        #[error("{0:?}: expected an acceleration history")]
        Quantity(String) = "quantity",
        /// A vertical component instead of a horizontal one.
        #[error("{0:?} is a vertical component: expected a horizontal one")]
        Vertical(String) = "vertical",
        /// A name, of the file or in it, that results cannot contain.
        #[error(transparent)]
        Name(#[from] NameError) = "name",
        /// A folder in a folder of records.
        #[error("a folder in the folder of records: expected a file")]
        Folder = "folder",
        /// A link in a folder of records.
        #[error("a link to nothing: expected a file")]
        DeadLink = "dead-link",
        /// A device, pipe or socket in a folder of records, which may never
        /// end.
        #[error("a device, a pipe or a socket: expected a file")]
        Device = "device",
        /// One of two files of an archive.
        #[error(
            "repeated name in the archive: expected each name once; the last file is read"
        )]
        Doubled = "doubled",
        /// A file of an archive whose name leads out of it.
        #[error("name with `..` in the archive: expected a path inside it")]
        Outside = "outside",
        /// A file that is not in the index of its folder.
        #[error(
            "not in the index of the folder: expected a row for each record of the suite"
        )]
        Unlisted = "unlisted",
        /// A record from a borehole instead of the surface.
        #[error("{0:?} is a borehole record: expected a surface record")]
        Borehole(String) = "borehole",
        /// An unknown unit of acceleration.
        #[error("unit {0:?}: expected g, m/s2 or cm/s2")]
        Unit(String) = "unit",
        /// Neither the file nor the caller states a unit.
        #[error(
            "no unit in the file: expected --units g|m/s2|cm/s2 or a column `units` in an index"
        )]
        UnitMissing = "unit-missing",
        /// The caller's unit and the file's differ.
        #[error("given unit {given}: expected {stated}, as in the file")]
        UnitConflict {
            /// Unit in the file.
            stated: AccelerationUnit,
            /// Unit of the caller.
            given: AccelerationUnit,
        } = "unit-conflict",
        /// Gravity must be positive and finite.
        #[error("gravity {0} m/s2: expected a positive number")]
        Gravity(f64) = "gravity",
        /// Neither the file nor the caller states a sampling interval.
        #[error(
            "no sampling interval in the file: expected --dt in s or a column `dt_s` in an index"
        )]
        IntervalMissing = "interval-missing",
        /// A sampling interval that is not positive and finite.
        #[error("sampling interval {0:?}: expected a positive number of seconds")]
        Interval(String) = "interval",
        /// A sampling interval (s) that no record has.
        #[error(
            "sampling interval {0:?} s: expected 1e-6 to 10 s; is it an interval, and in s?"
        )]
        IntervalRange(f64) = "interval-range",
        /// The caller's sampling interval and the file's differ.
        #[error(
            "given sampling interval {given_s} s: expected {stated_s} s, as in the file"
        )]
        IntervalConflict {
            /// Interval in the file in s.
            stated_s: f64,
            /// Interval of the caller in s.
            given_s: f64,
        } = "interval-conflict",
        /// A number of samples that differs from the number in the file.
        #[error("{found} samples: expected {expected}, as in the file")]
        Count {
            /// Number of samples found.
            found: usize,
            /// Number of samples in the header.
            expected: usize,
        } = "count",
        /// Count and interval contradict the duration in the header.
        #[error(
            "samples for {found_s} s: expected {expected_s} s, the duration in the file"
        )]
        Duration {
            /// Number of samples times the interval, in s.
            found_s: f64,
            /// Duration in the header in s.
            expected_s: f64,
        } = "duration",
        /// A text instead of the expected number.
        #[error("{found:?}: expected {expected}")]
        Number {
            /// The text found.
            found: String,
            /// The text expected.
            expected: String,
        } = "number",
        /// NaN, an infinity, or a number beyond the range of a double.
        #[error("{0:?}: expected a finite number")]
        NotFinite(String) = "not-finite",
        /// Times without a constant step.
        #[error(transparent)]
        Step(#[from] Uneven) = "step",
        /// The samples contradict the peak in the header.
        #[error(
            "largest absolute sample {found} {unit}: expected {expected} {unit}, the peak in the file"
        )]
        Peak {
            /// Largest absolute sample.
            found: f64,
            /// Peak in the header.
            expected: f64,
            /// Unit of both.
            unit: AccelerationUnit,
        } = "peak",
        /// Several components instead of one.
        #[error("{0} acceleration channels: expected one")]
        SeveralChannels(usize) = "several-channels",
        /// Samples that are not a valid accelerogram.
        #[error(transparent)]
        Samples(#[from] AccelerogramError) = "samples",
    }
}
