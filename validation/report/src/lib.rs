//! The report of a study: its page, and the files beside it.

mod answers;
pub mod credibility;
pub mod diff;
pub mod evidence;
pub mod findings;
pub mod head;
pub mod input;
pub mod ledger;
mod method;
pub mod output;
pub mod page;
pub mod quantity;
pub mod readme;
pub mod speed;
pub mod stale;
pub mod timings;

use rocking::block::BlockError;
use thiserror::Error;

use evidence::EvidenceError;
use ledger::LedgerError;

/// Why a report could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A block outside the model's range.
    #[error(transparent)]
    Block(#[from] BlockError),
    /// Evidence that cannot be shown.
    #[error(transparent)]
    Evidence(#[from] EvidenceError),
    /// Requirements that cannot be read.
    #[error(transparent)]
    Ledger(#[from] LedgerError),
    /// The committed findings of the recorded suites cannot be read.
    #[error("{0}")]
    Recorded(String),
    /// A table of timings that cannot be read.
    #[error("timings: {0}")]
    Timings(#[from] csv::Error),
}

#[cfg(test)]
mod tests;
