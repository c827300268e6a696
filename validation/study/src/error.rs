//! Why a study could not be done.

use rocking::block::BlockError;
use rocking::capacity::CapacityError;
use rocking::ida::IdaError;
use rocking::integrator::SceneError;
use rocking::intensity::IntensityError;
use rocking::statistics::SampleError;
use rocking::statistics::boxplot::BoxplotError;
use rocking::statistics::lognormal::LognormalError;
use rocking::statistics::paired::PairedError;
use rocking::statistics::proportion::ProportionError;
use rocking::statistics::quantile::QuantileError;
use thiserror::Error;

use rocking_common::suites::StudySuiteError;
use rocking_surrogate::SurrogateError;

/// Why a study could not be done.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// A suite that was refused.
    #[error(transparent)]
    Suite(#[from] StudySuiteError),
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
    /// A fragility that a change of unit makes none.
    #[error(transparent)]
    Lognormal(#[from] LognormalError),
    /// A count of nothing.
    #[error(transparent)]
    Proportion(#[from] ProportionError),
    /// Pairs that cannot be compared.
    #[error(transparent)]
    Paired(#[from] PairedError),
    /// A surrogate that cannot be asked.
    #[error(transparent)]
    Surrogate(#[from] SurrogateError),
    /// At least one arm must be run.
    #[error("no arm of the grid: expected one of A, B, C")]
    NoArm,
}
