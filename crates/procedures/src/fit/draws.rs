//! Draws of a bootstrap, and the number of values that they need.

use rocking_statistics::Clusters;
use rocking_statistics::bootstrap::Bootstrap;

use super::ProcedureError;

/// Draws of a bootstrap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Draws {
    /// Number of samples drawn, 2 to 1,000,000.
    pub replicates: usize,
    /// Seed of the draws.
    pub seed: u64,
}

impl Draws {
    /// Checks the number of draws.
    ///
    /// # Errors
    /// [`ProcedureError::Replicates`] unless it lies from 2 to 1,000,000.
    pub fn check(&self) -> Result<(), ProcedureError> {
        if (2..=1_000_000).contains(&self.replicates) {
            return Ok(());
        }
        Err(ProcedureError::Replicates(self.replicates))
    }

    /// The draws of these clusters from the streams of `name`.
    pub(crate) fn of(self, name: &str, clusters: &Clusters) -> Bootstrap {
        Bootstrap::of_clusters(name, self.seed, clusters, self.replicates)
    }
}

/// Checks that there is one value per record.
pub(crate) fn check_length(
    name: &str,
    found: usize,
    expected: usize,
) -> Result<(), ProcedureError> {
    if found == expected {
        return Ok(());
    }
    let name = name.to_owned();
    Err(ProcedureError::Length { name, found, expected })
}
