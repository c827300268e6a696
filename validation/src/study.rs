//! The whole study: 15 blocks, two suites, three arms of the intensity grid;
//! figures, their data, and what was found about the paper's claims.

pub mod adjustment;
pub mod analyses;
pub mod capacities;
pub mod certainty;
pub mod choice;
pub mod claims;
pub mod distributions;
pub mod figures;
pub mod findings;
pub mod histories;
pub mod normality;
pub mod overturning;
pub mod questions;
pub mod runs;
pub mod sensitivities;
pub mod stripes;

use rocking::block::BlockError;
use rocking::capacity::CapacityError;
use rocking::ida::IdaError;
use rocking::integrator::SceneError;
use rocking::intensity::IntensityError;
use rocking::record::{AccelerogramError, ProcessingError, SuiteError};
use rocking::statistics::SampleError;
use rocking::statistics::boxplot::BoxplotError;
use rocking::statistics::paired::PairedError;
use rocking::statistics::quantile::QuantileError;
use thiserror::Error;

use crate::draw::DrawError;
use crate::report::evidence::EvidenceError;
use crate::report::ledger::LedgerError;

/// Why a study could not be done.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// A suite that was refused.
    #[error(transparent)]
    Suite(#[from] SuiteError),
    /// A record that cannot be processed as asked.
    #[error(transparent)]
    Processing(#[from] ProcessingError),
    /// A synthetic record that is none.
    #[error(transparent)]
    Accelerogram(#[from] AccelerogramError),
    /// A block outside the model's range.
    #[error(transparent)]
    Block(#[from] BlockError),
    /// A chain that cannot be done.
    #[error(transparent)]
    Ida(#[from] IdaError),
    /// A run that cannot be done.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A record whose intensity cannot be measured.
    #[error(transparent)]
    Intensity(#[from] IntensityError),
    /// A curve that cannot be inverted.
    #[error(transparent)]
    Capacity(#[from] CapacityError),
    /// A sample without values, or with one that is not a number.
    #[error(transparent)]
    Sample(#[from] SampleError),
    /// A quantile that does not exist.
    #[error(transparent)]
    Quantile(#[from] QuantileError),
    /// A box that reaches infinity.
    #[error(transparent)]
    Boxplot(#[from] BoxplotError),
    /// Pairs that cannot be compared.
    #[error(transparent)]
    Paired(#[from] PairedError),
    /// Evidence that cannot be shown.
    #[error(transparent)]
    Evidence(#[from] EvidenceError),
    /// Requirements that cannot be read.
    #[error(transparent)]
    Ledger(#[from] LedgerError),
    /// A drawing that grew too large.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// A table of timings that cannot be read.
    #[error("timings: {0}")]
    Timings(#[from] csv::Error),
    /// At least one arm must be run.
    #[error("no arm of the grid: expected one of A, B, C")]
    NoArm,
}
