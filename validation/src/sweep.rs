//! Many blocks over one suite, in tiles that any number of tasks work off:
//! plan once, run anywhere, merge.
//!
//! A *tile* is some blocks with all records of the suite, since every
//! statistic is over the records of one block: a tile ends in fragilities,
//! and merging puts tiles in the plan's order. The bytes do not depend on
//! the number of tasks, their order, or what was interrupted: a tile is
//! written whole or not at all, and names the plan and its own sum.

mod content;
mod cost;
mod export;
mod merge;
mod plan;
mod tile;

use std::io;
use std::path::PathBuf;

use rocking::block::BlockError;
use rocking::ida::IdaError;
use rocking::record::SuiteError;
use rocking::statistics::lognormal::LognormalError;
use rocking_exchange::Id;
use thiserror::Error;

pub use content::{Content, Kind};
pub use cost::Tile;
pub use export::fragilities;
pub use merge::merge;
use plan::MOST_ANALYSES;
pub use plan::{Given, Levels, Plan, Planned, Wanted};
pub use tile::{State, left, run, state};

use rocking_common::files::WriteError;
use rocking_common::suites::export::ExportError;

/// Why a sweep cannot be planned, run or merged.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SweepError {
    /// A file that cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        #[source]
        source: io::Error,
    },
    /// A file that cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A block that comes again under another name.
    #[error(
        "{second} is the same block as {first}: expected each block, by its \
         parameters and eta, once"
    )]
    Twice {
        /// The first of them.
        first: Id,
        /// The second.
        second: Id,
    },
    /// A demand at which the plan has no capacities.
    #[error("demand {found}: expected some of {expected}, as planned")]
    Demand {
        /// The demand.
        found: f64,
        /// The plan's.
        expected: String,
    },
    /// A block without a fragility.
    #[error(
        "{id}: {reached} of {records} records reach the demand {demand}: \
         expected all, or a demand that all of them reach"
    )]
    Censored {
        /// The block.
        id: Id,
        /// Records that reach the demand.
        reached: usize,
        /// All records.
        records: usize,
        /// The demand.
        demand: f64,
    },
    /// A fragility that is no distribution.
    #[error(transparent)]
    Lognormal(#[from] LognormalError),
    /// A plan of another form or of another program.
    #[error("{}: {found}; expected a plan of `rocking sweep plan`", path.display())]
    Plan {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        found: String,
    },
    /// A folder that holds a plan already.
    #[error(
        "{}: holds another plan; expected an empty folder, or the same plan",
        path.display()
    )]
    OtherPlan {
        /// The folder.
        path: PathBuf,
    },
    /// More work than any cluster does.
    #[error(
        "about {found:e} analyses: expected at most {MOST_ANALYSES:e}; a \
         larger step of the levels makes fewer"
    )]
    Work {
        /// Analyses of the plan.
        found: f64,
    },
    /// Records of the folder that are not those of the plan.
    #[error("{record}: found hash {found}; expected {expected}, as planned")]
    Record {
        /// The record.
        record: String,
        /// Its hash.
        found: String,
        /// The plan's.
        expected: String,
    },
    /// A tile that is not there, of another plan, or damaged.
    #[error("{}: {state}; run the sweep again", path.display())]
    Tile {
        /// The tile's file.
        path: PathBuf,
        /// What is wrong with it.
        state: State,
    },
    /// Parquet from a program without it.
    #[error(
        "{}: this program writes no Parquet; expected another ending for CSV, or a program built by `cargo install --path validation --features parquet`",
        path.display()
    )]
    NoParquet {
        /// The file asked for.
        path: PathBuf,
    },
    /// A suite that was refused.
    #[error(transparent)]
    Suite(#[from] SuiteError),
    /// A record that cannot be packed.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// A block out of range.
    #[error(transparent)]
    Block(#[from] BlockError),
    /// An analysis that cannot be done.
    #[error(transparent)]
    Ida(#[from] IdaError),
    /// A statistic that cannot be computed.
    #[error("{0}")]
    Statistics(String),
}

#[cfg(test)]
mod tests;
