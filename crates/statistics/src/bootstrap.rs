//! The bootstrap: records drawn with replacement, one stream a replicate.

use rayon::prelude::*;

use super::clusters::Clusters;
use super::confidence::Confidence;
use super::{Estimate, Interval, QuantileType, Range, Sample, normal};
use crate::streams::{Streams, below};
use rocking::stop;

/// An estimate with its standard error and replicates.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct BootstrapEstimate {
    /// The value of the sample itself, beside an interval of what the
    /// replicates show.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub estimate: Estimate,
    /// Standard deviation of the replicates.
    pub standard_error: f64,
    /// Level of the interval.
    pub level: f64,
    /// Replicates that gave a finite value.
    pub used: usize,
    /// Replicates drawn.
    pub replicates: usize,
}

/// Draws with replacement, the same for every statistic that uses them:
/// blocks and levels stay paired. G of G clusters are drawn, each with all
/// its records; without clusters n of n records.
///
/// Draw i comes from stream i of the family of that name and seed.
///
/// ```
/// use rocking_statistics::bootstrap::Bootstrap;
/// let bootstrap = Bootstrap::new("doc", 0, 3, 100);
/// let means: Vec<f64> = bootstrap.map(|draw| {
///     draw.iter().map(|&i| i as f64).sum::<f64>() / 3.0
/// });
/// assert_eq!(means.len(), 100);
/// assert_eq!(means, bootstrap.map(|draw| {
///     draw.iter().map(|&i| i as f64).sum::<f64>() / 3.0
/// }));
/// ```
#[derive(Clone, Debug)]
pub struct Bootstrap {
    streams: Streams,
    pub(super) clusters: Clusters,
    replicates: usize,
}

impl Bootstrap {
    /// `replicates` draws out of n records.
    #[must_use]
    pub fn new(name: &str, seed: u64, n: usize, replicates: usize) -> Self {
        Self::of_clusters(name, seed, &Clusters::singletons(n), replicates)
    }

    /// `replicates` draws out of the records of clusters.
    #[must_use]
    pub fn of_clusters(
        name: &str,
        seed: u64,
        clusters: &Clusters,
        replicates: usize,
    ) -> Self {
        let clusters = clusters.clone();
        Self { streams: Streams::new(name, seed), clusters, replicates }
    }

    /// Applies a function to the places of every draw, in parallel; results
    /// in the order of the draws.
    pub fn map<T: Send>(&self, f: impl Fn(&[usize]) -> T + Sync) -> Vec<T> {
        (0..self.replicates as u64)
            .into_par_iter()
            .panic_fuse()
            .map(|index| {
                stop::point();
                f(&self.draw(index))
            })
            .collect()
    }

    /// The places of the records of one draw. Draws of clusters of unequal
    /// sizes hold unequal numbers of records.
    #[must_use]
    pub fn draw(&self, index: u64) -> Vec<usize> {
        let mut stream = self.streams.stream(index);
        let count = self.clusters.count();
        let drawn = (0..count).map(|_| below(&mut stream, count));
        drawn.flat_map(|g| self.clusters.members(g)).copied().collect()
    }
}

/// Estimate from replicates of records: percentile interval of type 7 at
/// `level`. Replicates without a finite value are left out and counted; none
/// if fewer than two are left, or the point is not finite. Replicates of
/// clusters have [`Clusters::estimate`].
#[must_use]
pub fn estimate(
    point: f64,
    replicates: &[f64],
    level: f64,
) -> Option<BootstrapEstimate> {
    let finite: Vec<f64> =
        replicates.iter().copied().filter(|x| x.is_finite()).collect();
    if finite.len() < 2 || !point.is_finite() {
        return None;
    }
    let sample = Sample::try_new(&finite).ok()?;
    let quantile_type = QuantileType::try_new(7).ok()?;
    let at = |p| quantile_type.quantile(&sample, p).ok();
    let spread = sample.sum_of_squares() / (finite.len() as f64 - 1.0);
    let ends = (at(0.5 - 0.5 * level)?, at(0.5 + 0.5 * level)?);
    let interval = Interval::try_new(ends.0, ends.1).ok()?;
    Some(BootstrapEstimate {
        estimate: beside(point, interval)?,
        standard_error: spread.sqrt(),
        level,
        used: finite.len(),
        replicates: replicates.len(),
    })
}

/// Estimate with the bias-corrected and accelerated interval: percentiles at
/// Phi(z0 + (z0 + z)/(1 - a (z0 + z))), with z0 the normal score of the share
/// of replicates below the point (half of those equal) and a = sum d^3/(6 (sum
/// d^2)^1.5), d the mean of the jackknife less its values (Efron, JASA 82
/// (1987) 171).
///
/// `jackknife` holds the statistic without each record in turn. None where
/// [`estimate`] gives none, a value of the jackknife is not finite, or all
/// replicates lie on one side.
///
/// ```
/// use rocking_statistics::bootstrap::{Bootstrap, accelerated};
/// let x = [1.0, 2.0, 4.0, 7.0, 16.0];
/// let mean = |places: &[usize]| {
///     places.iter().map(|&i| x[i]).sum::<f64>() / places.len() as f64
/// };
/// let all = [0, 1, 2, 3, 4];
/// let replicates = Bootstrap::new("doc", 0, 5, 2000).map(mean);
/// // Of the four others.
/// let without = x.map(|left_out| (30.0 - left_out) / 4.0);
/// let estimate = accelerated(mean(&all), &replicates, &without, 0.95);
/// let interval = estimate.unwrap().estimate.interval().unwrap();
/// assert!(interval.low() > 1.0 && interval.high() < 16.0);
/// ```
#[must_use]
pub fn accelerated(
    point: f64,
    replicates: &[f64],
    jackknife: &[f64],
    level: f64,
) -> Option<BootstrapEstimate> {
    let plain = estimate(point, replicates, level)?;
    let finite: Vec<f64> =
        replicates.iter().copied().filter(|x| x.is_finite()).collect();
    let known = Confidence::new(point, &finite, jackknife)?;
    if !known.is_accelerated() {
        return None;
    }
    let found = known.interval(normal::quantile(0.5 + 0.5 * level))?;
    Some(BootstrapEstimate {
        estimate: beside(point, found.interval)?,
        ..plain
    })
}

/// A value beside the quantiles of its replicates, which lie in the range of
/// the quantity as the replicates do.
fn beside(point: f64, interval: Interval) -> Option<Estimate> {
    Estimate::beside(point, interval, Range::Real).ok()
}

impl Clusters {
    /// [`estimate`] from replicates that draw
    /// these clusters. Of few clusters the ends are the percentiles
    /// Phi(-w) and Phi(w) with w of [`Self::half_width`]: the expanded
    /// percentile interval (Hesterberg, American Statistician 69 (2015) 371),
    /// which a monotone transformation does not change.
    #[must_use]
    pub fn estimate(
        &self,
        point: f64,
        replicates: &[f64],
        level: f64,
    ) -> Option<BootstrapEstimate> {
        let nominal = self.nominal(level)?;
        let found = estimate(point, replicates, nominal)?;
        Some(self.corrected(found, level))
    }

    /// [`accelerated`] from replicates that
    /// draw these clusters, with +-w of [`Self::half_width`] for +-z.
    /// `jackknife` holds the statistic without each cluster in turn
    /// ([`Self::without`]).
    #[must_use]
    pub fn accelerated(
        &self,
        point: f64,
        replicates: &[f64],
        jackknife: &[f64],
        level: f64,
    ) -> Option<BootstrapEstimate> {
        let nominal = self.nominal(level)?;
        let found = accelerated(point, replicates, jackknife, nominal)?;
        Some(self.corrected(found, level))
    }

    /// The level whose normal interval has the half width of these clusters.
    fn nominal(&self, level: f64) -> Option<f64> {
        if self.is_singletons() {
            return Some(level);
        }
        let nominal = 2.0 * normal::cdf(self.half_width(level)) - 1.0;
        (nominal > 0.0 && nominal < 1.0).then_some(nominal)
    }

    fn corrected(
        &self,
        found: BootstrapEstimate,
        level: f64,
    ) -> BootstrapEstimate {
        let standard_error = found.standard_error * self.unbiased();
        BootstrapEstimate { standard_error, level, ..found }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ends(of: &BootstrapEstimate) -> (f64, f64) {
        of.estimate.interval().unwrap().ends()
    }

    #[test]
    fn accelerated_intervals_are_those_of_scipy() {
        // The formulas of scipy.stats.bootstrap's BCa in NumPy, with SciPy's
        // normal distribution, for these replicates and this jackknife.
        let replicates: Vec<f64> =
            (0..1000).map(|i| f64::from(i * i) / 1e6).collect();
        let jackknife = [0.30, 0.29, 0.31, 0.33, 0.28, 0.30, 0.20, 0.31];
        let found = accelerated(0.3, &replicates, &jackknife, 0.9).unwrap();
        let (low, high) = ends(&found);
        assert!((low - 0.012_832_971_655_152).abs() < 1e-12, "{found:?}");
        assert!((high - 0.973_585_316_710_996).abs() < 1e-12, "{found:?}");
        assert!(accelerated(-1.0, &replicates, &jackknife, 0.9).is_none());
        assert!(accelerated(0.3, &replicates, &[0.3; 8], 0.9).is_none());
    }

    /// Replicates that equal the point count half: without bias and
    /// acceleration the interval is that of the percentiles.
    #[test]
    fn a_point_among_symmetric_replicates_has_no_bias() {
        let replicates: Vec<f64> = (1..=9).map(f64::from).collect();
        let plain = estimate(5.0, &replicates, 0.9).unwrap();
        let found = accelerated(5.0, &replicates, &[4.0, 6.0], 0.9).unwrap();
        let ((a, b), (c, d)) = (ends(&found), ends(&plain));
        assert!((a - c).abs() < 1e-12, "{found:?} {plain:?}");
        assert!((b - d).abs() < 1e-12, "{found:?} {plain:?}");
    }

    #[test]
    fn standard_error_of_a_mean_is_the_plug_in_one() {
        let values: Vec<f64> = (0..40).map(f64::from).collect();
        let bootstrap = Bootstrap::new("test", 0, 40, 20_000);
        let means = bootstrap.map(|draw| {
            draw.iter().fold(0.0, |sum, &i| sum + values[i]) / 40.0
        });
        let estimate = estimate(19.5, &means, 0.95).unwrap();
        // sqrt((n^2 - 1)/12/n), within 4 standard errors of a deviation.
        let expected = (1599.0_f64 / 12.0 / 40.0).sqrt();
        let error = estimate.standard_error / expected - 1.0;
        assert!(error.abs() < 4.0 / (2.0 * 20_000.0_f64).sqrt());
        let (low, high) = ends(&estimate);
        let half = 0.5 * (high - low);
        assert!((half / (1.96 * expected) - 1.0).abs() < 0.03);
    }

    #[test]
    fn every_place_is_drawn_equally_often() {
        let bootstrap = Bootstrap::new("places", 0, 7, 10_000);
        let mut counts = [0_u32; 7];
        for draw in bootstrap.map(<[usize]>::to_vec) {
            for place in draw {
                counts[place] += 1;
            }
        }
        // Binomial(70000, 1/7): standard deviation 92.6.
        for count in counts {
            assert!(count.abs_diff(10_000) < 5 * 93, "{counts:?}");
        }
    }

    #[test]
    fn replicates_without_a_value_are_counted() {
        let replicates = [1.0, f64::NAN, 2.0, f64::INFINITY, 3.0];
        let estimate = estimate(2.0, &replicates, 0.95).unwrap();
        assert_eq!((estimate.used, estimate.replicates), (3, 5));
        assert!(super::estimate(2.0, &[1.0, f64::NAN], 0.95).is_none());
    }
}
