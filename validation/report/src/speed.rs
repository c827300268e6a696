//! Speed against error: single analyses with a reference, throughput, and
//! the timings kept in `fixtures/speed`.
//!
//! Nothing here is a result of the study: times differ from run to run, and
//! no test looks at them.

pub mod answers;
pub mod cases;
pub mod clock;
pub mod export;
pub mod many;
pub mod measured;
pub mod rest;
pub mod singles;
pub mod throughput;

use rayon::ThreadPoolBuildError;
use rocking::block::BlockError;
use rocking::ida::IdaError;
use rocking::integrator::SceneError;
use rocking::record::AccelerogramError;
use rocking::statistics::lilliefors::LillieforsError;
use thiserror::Error;

use rocking_common::suites::StudySuiteError;

/// Why something could not be measured.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SpeedError {
    /// A block outside the model's range.
    #[error(transparent)]
    Block(#[from] BlockError),
    /// A record that is none.
    #[error(transparent)]
    Accelerogram(#[from] AccelerogramError),
    /// A chain that cannot be done.
    #[error(transparent)]
    Ida(#[from] IdaError),
    /// A run that cannot be done.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A simulation that cannot be done.
    #[error(transparent)]
    Lilliefors(#[from] LillieforsError),
    /// A suite that cannot be made.
    #[error(transparent)]
    Suite(#[from] StudySuiteError),
    /// Threads that cannot be started.
    #[error(transparent)]
    Threads(#[from] ThreadPoolBuildError),
}

#[cfg(test)]
mod tests;
