//! Why a report could not be made.

use rocking::block::BlockError;
use thiserror::Error;

use crate::evidence::EvidenceError;
use crate::ledger::LedgerError;

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
