//! The whole study: 15 blocks, two suites, three arms of the intensity grid;
//! figures, their data, and what was found about the paper's claims.

pub mod analyses;
pub mod capacities;
pub mod choice;
pub mod findings;
pub mod grid;
pub mod histories;
pub mod output;
pub mod runs;
pub mod stripes;
pub mod suites;

use rocking::block::BlockError;
use rocking::capacity::CapacityError;
use rocking::integrator::SceneError;
use rocking::record::{AccelerogramError, SuiteError};
use thiserror::Error;

/// Why a study could not be done.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// A suite that was refused.
    #[error(transparent)]
    Suite(#[from] SuiteError),
    /// A synthetic record that is none.
    #[error(transparent)]
    Accelerogram(#[from] AccelerogramError),
    /// A block outside the model's range.
    #[error(transparent)]
    Block(#[from] BlockError),
    /// A run that cannot be done.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A curve that cannot be inverted.
    #[error(transparent)]
    Capacity(#[from] CapacityError),
    /// At least one arm must be run.
    #[error("no arm of the grid: expected one of A, B, C")]
    NoArm,
}
