//! The null distribution of D by simulation.

use rayon::prelude::*;

use super::LillieforsError;
use super::fast::{LANES, Scratch};
use crate::streams::{Stream, Streams, standard_normals};
use crate::{Estimate, Interval, Proportion, normal};
use rocking::stop;

/// Replicates that share one scratch space.
const CHUNK: u64 = 4096;

/// Simulated statistics D of normal samples of one size, ascending.
///
/// Replicate i draws from stream i of the family "lilliefors, n", so the
/// result does not depend on threads. D is within 2e-11 of the statistic.
///
/// ```
/// use rocking_statistics::lilliefors::NullDistribution;
/// let null = NullDistribution::simulate(20, 2000, 0)?;
/// let critical = null.critical_value(0.05)?;
/// let error = critical.estimate.value() - 0.192;
/// assert!(error.abs() < 4.0 * critical.standard_error);
/// # Ok::<(), rocking_statistics::lilliefors::LillieforsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct NullDistribution {
    n: usize,
    sorted: Vec<f64>,
}

/// A critical value with its Monte Carlo error.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct CriticalValue {
    /// The order statistic of rank ceil((1 - level)(N + 1)): a sample's D
    /// exceeds it with probability `level` exactly, over both draws. With its
    /// 95 % interval by order statistics.
    #[serde(flatten, serialize_with = "crate::estimate::keys::value")]
    pub estimate: Estimate,
    /// sqrt(level (1 - level)/N)/f, with the density f by the difference
    /// quotient of the order statistics 0.2 level to either side.
    pub standard_error: f64,
}

impl NullDistribution {
    /// Simulates the statistics of `replicates` samples of n values.
    ///
    /// # Errors
    /// [`LillieforsError`] for n < 4, and for fewer than 100 or more than
    /// 10^8 replicates.
    pub fn simulate(
        n: usize,
        replicates: u64,
        seed: u64,
    ) -> Result<Self, LillieforsError> {
        let streams = Streams::new(&format!("lilliefors, {n}"), seed);
        let draw = |stream: &mut Stream, values: &mut [f64]| {
            standard_normals(stream, values);
            0
        };
        Ok(Self::of_draws(n, replicates, &streams, draw)?.0)
    }

    /// The distribution of D over samples of n values that `draw` fills in
    /// from a stream, and the sum of what it returns.
    pub(super) fn of_draws(
        n: usize,
        replicates: u64,
        streams: &Streams,
        draw: impl Fn(&mut Stream, &mut [f64]) -> u64 + Sync,
    ) -> Result<(Self, u64), LillieforsError> {
        Self::check(n, replicates)?;
        let chunks: Vec<(Vec<f64>, u64)> = (0..replicates.div_ceil(CHUNK))
            .into_par_iter()
            .panic_fuse()
            .map(|chunk| {
                let mut scratch = Scratch::new(n);
                let first = chunk * CHUNK;
                let end = (first + CHUNK).min(replicates);
                let mut counted = 0;
                let mut statistics = Vec::with_capacity(CHUNK as usize);
                for group in (first..end).step_by(LANES) {
                    stop::point();
                    // Lanes beyond the last replicate repeat another.
                    let count = LANES.min((end - group) as usize);
                    for lane in 0..LANES {
                        if lane < count {
                            let index = group + lane as u64;
                            let mut stream = streams.stream(index);
                            let drawn = draw(&mut stream, &mut scratch.values);
                            counted = u64::saturating_add(counted, drawn);
                        }
                        scratch.put(lane);
                    }
                    statistics.extend(&scratch.statistics()[..count]);
                }
                (statistics, counted)
            })
            .collect();
        let mut all = Vec::with_capacity(replicates as usize);
        let counted =
            chunks.into_iter().fold(0, |sum, (statistics, count)| {
                all.extend(statistics);
                u64::saturating_add(sum, count)
            });
        Ok((Self::from_statistics(n, all), counted))
    }

    /// Rejects sizes and numbers of replicates that are too small or too
    /// large.
    pub(crate) fn check(
        n: usize,
        replicates: u64,
    ) -> Result<(), LillieforsError> {
        if n < 4 {
            return Err(LillieforsError::TooFew { found: n, least: 4 });
        }
        if !(100..=100_000_000).contains(&replicates) {
            return Err(LillieforsError::Replicates(replicates));
        }
        Ok(())
    }

    /// The distribution of statistics that were simulated, in any order.
    pub(crate) fn from_statistics(n: usize, mut sorted: Vec<f64>) -> Self {
        sorted.par_sort_unstable_by(|a, b| {
            stop::point();
            a.total_cmp(b)
        });
        Self { n, sorted }
    }

    /// Size of the samples.
    pub fn n(&self) -> usize {
        self.n
    }

    /// The simulated statistics, ascending.
    pub fn sorted(&self) -> &[f64] {
        &self.sorted
    }

    /// The value that D exceeds with probability `level`.
    ///
    /// # Errors
    /// [`LillieforsError::Level`] unless at least ten replicates lie on
    /// either side.
    pub fn critical_value(
        &self,
        level: f64,
    ) -> Result<CriticalValue, LillieforsError> {
        let count = self.sorted.len() as f64;
        let (low, high) = (10.0 / count, 1.0 - 10.0 / count);
        if !(level >= low && level <= high) {
            return Err(LillieforsError::Level { level, low, high });
        }
        // The product's own rounding must not lift a whole number.
        let rank = ((1.0 - level) * (count + 1.0) * (1.0 - 1e-15)).ceil();
        let at = |rank: f64| self.sorted[rank.clamp(1.0, count) as usize - 1];
        let span = (0.2 * level.min(1.0 - level) * count).ceil();
        let spacing = at(rank + span) - at(rank - span);
        let deviation = (level * (1.0 - level) * count).sqrt();
        let half = (normal::quantile(0.975) * deviation).ceil();
        let interval = Interval::rising(at(rank - half), at(rank + half));
        Ok(CriticalValue {
            estimate: Estimate::inside(at(rank), interval),
            standard_error: deviation * spacing / (2.0 * span),
        })
    }

    /// The p-value of a statistic, (b + 1)/(N + 1) with b of N replicates not
    /// below it, and the 95 % Clopper-Pearson interval of b.
    ///
    /// It is the share among the replicates and the sample itself: never 0,
    /// and at most a level with no more than that probability, over both
    /// draws (Davison and Hinkley, Bootstrap Methods and their Application,
    /// 1997, section 4.2).
    pub fn p_value(&self, d: f64) -> Estimate {
        let count = self.sorted.len();
        let as_far = count - self.sorted.partition_point(|&x| x < d);
        let value = (as_far + 1) as f64 / (count + 1) as f64;
        let not_below = Proportion::try_new(as_far, count);
        not_below.and_then(|share| share.interval(0.95)).map_or(
            Estimate::exact(value),
            // Less than 1/N from b/N, which the interval holds with its
            // neighbours.
            |interval| Estimate::inside(value, interval),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_do_not_matter() {
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let simulate = || NullDistribution::simulate(10, 10_000, 1);
            pool.build().unwrap().install(simulate).unwrap().sorted
        };
        assert_eq!(run(1), run(3));
    }

    /// The share b/N would be 0, 1/2 and 1 at the ends and the middle.
    #[test]
    fn a_p_value_counts_the_sample_among_the_replicates() {
        let statistics: Vec<f64> = (1..=200).rev().map(f64::from).collect();
        let null = NullDistribution::from_statistics(20, statistics);
        for (d, expected) in [
            (201.0, 1.0 / 201.0),
            (200.0, 2.0 / 201.0),
            (100.5, 101.0 / 201.0),
            (100.0, 102.0 / 201.0),
            (1.0, 1.0),
            (0.5, 1.0),
        ] {
            let found = null.p_value(d).value();
            assert_eq!(found, expected, "p-value of D = {d}");
        }
    }

    /// What exceeds the critical value has a p-value of at most the level,
    /// and the critical value itself a larger one.
    #[test]
    fn a_critical_value_is_the_one_at_which_p_passes_the_level() {
        for count in [250, 333, 499, 1000] {
            let statistics = (1..=count).map(f64::from).collect();
            let null = NullDistribution::from_statistics(20, statistics);
            for level in [0.2, 0.1, 0.07, 0.05] {
                let d = null.critical_value(level).unwrap().estimate.value();
                let (at, beyond) = (null.p_value(d), null.p_value(d + 0.5));
                assert!(
                    beyond.value() <= level && at.value() > level,
                    "N = {count}, level {level}: D = {d} {at:?} {beyond:?}"
                );
            }
        }
    }
}
