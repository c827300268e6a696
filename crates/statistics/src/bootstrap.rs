//! The bootstrap: records drawn with replacement, one stream a replicate.

use rayon::prelude::*;

use super::Estimate;
use super::clusters::Clusters;
use crate::streams::{Streams, below};
use rocking::stop;

/// An estimate with its standard error and replicates.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct BootstrapEstimate {
    /// The value of the sample itself, with its interval.
    #[serde(flatten)]
    pub estimate: Estimate,
    /// Standard error on the scale of the interval: of the logarithm, if the
    /// value is positive.
    pub standard_error: f64,
    /// Level of the interval.
    pub level: f64,
    /// Replicates that gave a finite value.
    pub used: usize,
    /// Replicates drawn.
    pub replicates: usize,
}

impl BootstrapEstimate {
    /// A value without an interval, and the number of its resamples.
    pub fn without_interval(
        value: f64,
        level: f64,
        replicates: usize,
    ) -> Self {
        let (estimate, standard_error) = (Estimate::exact(value), f64::NAN);
        Self { estimate, standard_error, level, used: 0, replicates }
    }
}

/// Draws with replacement, the same for every statistic that uses them, so
/// that blocks and levels stay paired. G of G clusters are drawn, each with
/// all its records; without clusters n of n records.
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
    pub fn new(name: &str, seed: u64, n: usize, replicates: usize) -> Self {
        Self::of_clusters(name, seed, &Clusters::singletons(n), replicates)
    }

    /// `replicates` draws out of the records of clusters.
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
    pub fn draw(&self, index: u64) -> Vec<usize> {
        let mut stream = self.streams.stream(index);
        let count = self.clusters.count();
        let drawn = (0..count).map(|_| below(&mut stream, count));
        drawn.flat_map(|g| self.clusters.members(g)).copied().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
