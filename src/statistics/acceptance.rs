//! Shares of EDP levels at which a distribution is accepted.
//!
//! Levels share records, so the share of accepted ones scatters widely about
//! its expectation even under the null. The Gaussian-score bootstrap gives
//! that scatter for the correlation at hand.

use nalgebra::DMatrix;
use rayon::prelude::*;
use thiserror::Error;

use super::Sample;
use super::bootstrap::{Estimate, estimate};
use super::lilliefors::fast::{LANES, Scratch};
use super::lilliefors::{Assessment, LillieforsError, standardised};
use super::sample::{mean, sum_of_squares};
use crate::streams::{Streams, standard_normal};

/// Why a null band was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AcceptanceError {
    /// Every level has the same records.
    #[error(
        "level {level} has {found} values: expected {expected}, as the first"
    )]
    Lengths {
        /// Place of the level, from 1.
        level: usize,
        /// Its number of values.
        found: usize,
        /// The first level's.
        expected: usize,
    },
    /// A level's values make no scores.
    #[error("level {level}: {source}")]
    Scores {
        /// Place of the level, from 1.
        level: usize,
        /// What is wrong with its values.
        #[source]
        source: LillieforsError,
    },
    /// No level, or a value that is not finite.
    #[error("no level with finite values")]
    Empty,
}

/// How many levels accept a distribution, by the plain decision D <= critical
/// value at each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct AcceptedShare {
    /// Levels tested.
    pub tested: usize,
    /// Of those, accepted.
    pub accepted: usize,
    /// Levels that could not be tested.
    pub not_applicable: usize,
}

impl AcceptedShare {
    /// Counts the decisions of a list of tests.
    #[must_use]
    pub fn of(assessments: &[Assessment]) -> Self {
        let decisions = || assessments.iter().map(Assessment::exceeds);
        Self {
            tested: decisions().flatten().count(),
            accepted: decisions().filter(|d| *d == Some(false)).count(),
            not_applicable: decisions().filter(Option::is_none).count(),
        }
    }

    /// Accepted over tested; none if no level was tested.
    #[must_use]
    pub fn share(&self) -> Option<f64> {
        (self.tested > 0).then(|| self.accepted as f64 / self.tested as f64)
    }
}

/// The null distribution of an accepted share: normal at every level, with
/// the correlation between levels that the data have.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct NullBand {
    /// Accepted share of each replicate, in order.
    pub shares: Vec<f64>,
    /// Mean over the levels of D/critical value, of each replicate.
    pub mean_ratios: Vec<f64>,
    /// How many independent levels would scatter as much: K^2/sum r_jk^2,
    /// with r the correlations between the K levels.
    pub effective_levels: f64,
}

impl NullBand {
    /// Gaussian-score bootstrap. `levels` holds, for each level, the values
    /// tested (logarithms, say) in the same order of records.
    ///
    /// With S the n x K matrix of standardised values and G an n x n matrix
    /// of independent N(0, 1), the rows of G S/sqrt(n - 1) are independent
    /// and normal with the levels' observed correlation, exactly N(0, 1) at
    /// each level. Replicate i draws G from stream i of the family of that
    /// name and seed.
    ///
    /// ```
    /// use rocking::statistics::acceptance::NullBand;
    /// let level: Vec<f64> = (0..20).map(|i| f64::from(i * i)).collect();
    /// // Three copies of one level are accepted or not together.
    /// let levels = [level.clone(), level.clone(), level];
    /// let band = NullBand::simulate(&levels, 0.1919, 200, "doc", 0)?;
    /// assert!(band.shares.iter().all(|&s| s == 0.0 || s == 1.0));
    /// # Ok::<(), rocking::statistics::acceptance::AcceptanceError>(())
    /// ```
    ///
    /// # Errors
    /// [`AcceptanceError`] for levels of different sizes or without
    /// variation.
    pub fn simulate(
        levels: &[Vec<f64>],
        critical_value: f64,
        replicates: u64,
        name: &str,
        seed: u64,
    ) -> Result<Self, AcceptanceError> {
        let scores = scores(levels)?;
        let (n, count) = (scores.nrows(), scores.ncols());
        let correlations = scores.tr_mul(&scores);
        let effective_levels =
            (count * count) as f64 / correlations.norm_squared();
        let streams = Streams::new(name, seed);
        let rows: Vec<(f64, f64)> = (0..replicates)
            .into_par_iter()
            .map(|index| {
                let mut stream = streams.stream(index);
                let weights = DMatrix::from_row_iterator(
                    n,
                    n,
                    (0..n * n).map(|_| standard_normal(&mut stream)),
                );
                let drawn = weights * &scores;
                let mut scratch = Scratch::new(n);
                let (mut accepted, mut ratios) = (0.0, 0.0);
                for first in (0..count).step_by(LANES) {
                    let used = LANES.min(count - first);
                    for lane in 0..LANES {
                        // Lanes beyond the last level repeat it.
                        let level = first + lane.min(used - 1);
                        let level = drawn.column(level);
                        scratch.values.copy_from_slice(level.as_slice());
                        scratch.put(lane);
                    }
                    for d in &scratch.statistics()[..used] {
                        accepted += f64::from(u8::from(*d <= critical_value));
                        ratios += d / critical_value;
                    }
                }
                (accepted / count as f64, ratios / count as f64)
            })
            .collect();
        let (shares, mean_ratios) = rows.into_iter().unzip();
        Ok(Self { shares, mean_ratios, effective_levels })
    }

    /// The band of the share at a level, about an observed one.
    #[must_use]
    pub fn band(&self, observed: f64, level: f64) -> Option<Estimate> {
        estimate(observed, &self.shares, level)
    }

    /// One-sided p-value of an observed share: how often the null accepts
    /// as few levels, (b + 1)/(N + 1).
    #[must_use]
    pub fn p_value(&self, observed: f64) -> f64 {
        let b = self.shares.iter().filter(|&&s| s <= observed).count();
        (b + 1) as f64 / (self.shares.len() + 1) as f64
    }

    /// One-sided p-value of an observed mean of D/critical value: how often
    /// the null's is as large.
    #[must_use]
    pub fn p_value_of_mean_ratio(&self, observed: f64) -> f64 {
        let b = self.mean_ratios.iter().filter(|&&r| r >= observed).count();
        (b + 1) as f64 / (self.mean_ratios.len() + 1) as f64
    }
}

/// Standardised values: a row a record, a column of length 1 a level, so
/// that G S is standard normal.
fn scores(levels: &[Vec<f64>]) -> Result<DMatrix<f64>, AcceptanceError> {
    let n = levels.first().ok_or(AcceptanceError::Empty)?.len();
    let mut scores = DMatrix::zeros(n, levels.len());
    for (k, values) in levels.iter().enumerate() {
        let level = k + 1;
        if values.len() != n {
            let found = values.len();
            let expected = n;
            return Err(AcceptanceError::Lengths { level, found, expected });
        }
        let sample =
            Sample::try_new(values).map_err(|_| AcceptanceError::Empty)?;
        standardised(&sample)
            .map_err(|source| AcceptanceError::Scores { level, source })?;
        let (centre, norm) = (mean(values), sum_of_squares(values).sqrt());
        for (i, value) in values.iter().enumerate() {
            scores[(i, k)] = (value - centre) / norm;
        }
    }
    Ok(scores)
}

#[cfg(test)]
mod tests;
