//! Shares of EDP levels at which a distribution is accepted.
//!
//! Levels share records, so the share of accepted ones scatters widely about
//! its expectation even under the null. The Gaussian-score bootstrap gives
//! that scatter for the observed correlation.

use nalgebra::DMatrix;
use rayon::prelude::*;
use thiserror::Error;

use super::lilliefors::fast::{LANES, Scratch};
use super::lilliefors::{LillieforsError, standardised};
use super::sample::{mean, sum_of_squares};
use super::{Interval, QuantileType, Sample};
use crate::streams::{Streams, standard_normal};
use rocking::number::dispatch::{Isa, Kernel};
use rocking::stop;

/// Why a null band cannot be simulated.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AcceptanceError {
    /// Levels with different numbers of records.
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
    /// A level without scores.
    #[error("level {level}: {source}")]
    Scores {
        /// Place of the level, from 1.
        level: usize,
        /// The fault of its values.
        #[source]
        source: LillieforsError,
    },
    /// No level, or a value that is not finite.
    #[error("no level with finite values")]
    Empty,
}

/// Lilliefors' D of the values of each level, all of one size; NaN for a
/// level with a value that is not finite, or whose values do not vary.
///
/// Take logarithms first for a lognormal. The same D as
/// [`Statistic`](super::lilliefors::Statistic) has, to 1e-9, many times as
/// fast: for simulations.
///
/// ```
/// use rocking_statistics::acceptance::distances;
/// let level: Vec<f64> = (0..20).map(f64::from).collect();
/// let found = distances(&[level, vec![f64::INFINITY; 20]]);
/// assert!(found[0] < 0.1 && found[1].is_nan());
/// ```
///
/// # Panics
/// If the levels have different sizes.
pub fn distances(levels: &[Vec<f64>]) -> Vec<f64> {
    let finite = |k: &usize| levels[*k].iter().all(|x| x.is_finite());
    let usable: Vec<usize> = (0..levels.len()).filter(finite).collect();
    let mut out = vec![f64::NAN; levels.len()];
    let Some(first) = usable.first() else { return out };
    let mut scratch = Scratch::new(levels[*first].len());
    for group in usable.chunks(LANES) {
        for lane in 0..LANES {
            // Lanes beyond the last level repeat it.
            let level = group[lane.min(group.len() - 1)];
            scratch.values.copy_from_slice(&levels[level]);
            scratch.put(lane);
        }
        for (level, d) in group.iter().zip(scratch.statistics()) {
            out[*level] = d;
        }
    }
    out
}

/// The null distribution of an accepted share: normal at every level, with
/// the correlation between levels that the data have.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct NullBand {
    /// Accepted share of each replicate, in order.
    pub shares: Vec<f64>,
}

impl NullBand {
    /// Gaussian-score bootstrap. `levels` holds, for each level, the values
    /// tested (logarithms, say) in the same order of records.
    ///
    /// With R = L L^T the correlations between the K levels, a record of a
    /// replicate has the values L z of K independent standard normals z: the
    /// levels are normal with the observed correlations, record by record
    /// independent, exactly N(0, 1) at each level. Replicate i draws its
    /// normals from stream i of the family of that name and seed.
    ///
    /// ```
    /// use rocking_statistics::acceptance::NullBand;
    /// let level: Vec<f64> = (0..20).map(|i| f64::from(i * i)).collect();
    /// // Three copies of one level are accepted or not together.
    /// let levels = [level.clone(), level.clone(), level];
    /// let band = NullBand::simulate(&levels, 0.1919, 200, "doc", 0)?;
    /// assert!(band.shares.iter().all(|&s| s == 0.0 || s == 1.0));
    /// # Ok::<(), rocking_statistics::acceptance::AcceptanceError>(())
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
        let (n, count) = (scores[0].len(), scores.len());
        let root = root(&scores);
        let streams = Streams::new(name, seed);
        let isa = Isa::best();
        let shares: Vec<f64> = (0..replicates)
            .into_par_iter()
            .panic_fuse()
            .map(|index| {
                let mut stream = streams.stream(index);
                let mut own = vec![vec![0.0; n]; count];
                for record in 0..n {
                    stop::point();
                    for z in &mut own {
                        z[record] = standard_normal(&mut stream);
                    }
                }
                let drawn = isa.run(Mixture { root: &root, own: &own });
                let found = distances(&drawn).into_iter();
                let accepted = found.filter(|d| *d <= critical_value);
                accepted.count() as f64 / count as f64
            })
            .collect();
        Ok(Self { shares })
    }

    /// The central part of the shares, of probability `level`.
    pub fn central(&self, level: f64) -> Option<Interval> {
        let sample = Sample::try_new(&self.shares).ok()?;
        let rule = QuantileType::try_new(7).ok()?;
        let at = |p| rule.quantile(&sample, p).ok();
        let ends = (at(0.5 - 0.5 * level)?, at(0.5 + 0.5 * level)?);
        Interval::try_new(ends.0, ends.1).ok()
    }
}

/// The product of L with normals z: `own` has a row a level and a column a
/// record, and so has the product.
struct Mixture<'a> {
    root: &'a [Vec<f64>],
    own: &'a [Vec<f64>],
}

impl Kernel for Mixture<'_> {
    type Output = Vec<Vec<f64>>;

    #[inline(always)]
    fn run(self) -> Vec<Vec<f64>> {
        let mut product = Vec::with_capacity(self.root.len());
        for row in self.root {
            let mut level = vec![0.0; self.own[0].len()];
            for (l, z) in row.iter().zip(self.own) {
                for (sum, z) in level.iter_mut().zip(z) {
                    *sum = f64::mul_add(*l, *z, *sum);
                }
            }
            product.push(level);
        }
        product
    }
}

/// Standardised values: a row a record, a column of length 1 a level, so
/// that G S is standard normal.
fn scores(levels: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, AcceptanceError> {
    let n = levels.first().ok_or(AcceptanceError::Empty)?.len();
    let mut scores = Vec::with_capacity(levels.len());
    for (k, values) in levels.iter().enumerate() {
        let level = k + 1;
        let (found, expected) = (values.len(), n);
        if found != expected {
            return Err(AcceptanceError::Lengths { level, found, expected });
        }
        let sample =
            Sample::try_new(values).map_err(|_| AcceptanceError::Empty)?;
        standardised(&sample, 4)
            .map_err(|source| AcceptanceError::Scores { level, source })?;
        let (centre, norm) = (mean(values), sum_of_squares(values).sqrt());
        scores.push(values.iter().map(|x| (x - centre) / norm).collect());
    }
    Ok(scores)
}

/// The lower triangle L with L L^T the correlations of the levels, row by
/// row: the transpose of R in scores = Q R.
fn root(scores: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let (n, count) = (scores[0].len(), scores.len());
    let r = DMatrix::from_fn(n, count, |i, k| scores[k][i]).qr().unpack_r();
    let used = |k: usize| 0..=k.min(r.nrows() - 1);
    let row = |k: usize| used(k).map(|j| r[(j, k)]).collect();
    (0..count).map(row).collect()
}

#[cfg(test)]
mod tests;
