//! Inference of the study: one set of resamples serves all claims.
//!
//! The earthquakes are the sample, each with its records. Blocks, stripes, levels,
//! intensity measures and grids are computed from the same records. A resample
//! takes the same earthquakes everywhere and recomputes the whole measure of a
//! claim. The two suites are resampled independently of each other.

use rayon::prelude::*;
use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::resampling::Resampling;
use rocking_statistics::{Clusters, Estimate, Range};

use rocking_common::findings::SuiteSet;
use rocking_common::paper::SuiteKind;

/// Replicates of the bootstrap. The relative standard error of half the width of
/// an interval is 1/sqrt(2 [`REPLICATES`]), 1.6 %: less than its second digit.
pub const REPLICATES: usize = 2000;

/// Number of records that is always enough for a cell of a share or mean of
/// cells.
const MOST_NEEDED: usize = 30;

/// The least number of records of a cell that counts, in a suite of n records:
/// half of them, at most 30.
pub fn least_counted(n: usize) -> usize {
    n.div_ceil(2).min(MOST_NEEDED)
}

/// Multiplicities of the records in a resample, by suite.
#[derive(Clone, Copy, Debug)]
pub struct Resample<'a>([&'a [u32]; 2]);

impl<'a> Resample<'a> {
    /// The multiplicities of a suite's records.
    pub fn of(&self, suite: SuiteKind) -> &'a [u32] {
        self.0[suite as usize]
    }
}

/// The resamples that all claims share.
#[derive(Debug)]
pub struct Resamples {
    clusters: [Clusters; 2],
    /// Every record once, by suite.
    whole: [Vec<u32>; 2],
    /// Draws with replacement, by suite.
    drawn: [Vec<Vec<u32>>; 2],
    /// Subsets without two earthquakes, by suite.
    without_two: [Vec<Vec<u32>>; 2],
}

impl Resamples {
    /// The resamples of suites of these earthquakes, ordinary and
    /// pulse-type. Streams: `study/records/SUITE`, of seed 0.
    pub fn new(clusters: [Clusters; 2], replicates: usize) -> Self {
        let drawn = |suite: SuiteKind| -> Vec<Vec<u32>> {
            let name = format!("study/records/{suite}");
            let own = &clusters[suite as usize];
            let draws = Bootstrap::of_clusters(&name, 0, own, replicates);
            (0..replicates as u64).map(|i| draws.multiplicities(i)).collect()
        };
        Self {
            whole: clusters.each_ref().map(|own| vec![1; own.records()]),
            drawn: SuiteKind::ALL.map(drawn),
            without_two: clusters.each_ref().map(Clusters::without_two),
            clusters,
        }
    }

    /// The earthquakes that limit the inference on a suite; for a comparison those
    /// of the suite with fewer.
    pub(crate) fn clusters(&self, tested: SuiteSet) -> &Clusters {
        let [ordinary, pulse] = &self.clusters;
        match tested {
            SuiteSet::PulseType => pulse,
            SuiteSet::Both if pulse.count() < ordinary.count() => pulse,
            _ => ordinary,
        }
    }

    /// Every record once.
    pub fn whole(&self) -> Resample<'_> {
        Resample(self.whole.each_ref().map(Vec::as_slice))
    }

    /// Numbers of the resamples `own` of the tested suites; the other suite stays
    /// whole.
    fn rows(
        &self,
        tested: SuiteSet,
        own: &[Vec<Vec<u32>>; 2],
        f: &(impl Fn(Resample<'_>) -> Vec<f64> + Sync),
    ) -> Vec<Vec<f64>> {
        let [a, b] = &self.whole;
        let [ordinary, pulse] = own.each_ref().map(|own| own.par_iter());
        let of = |a: &[u32], b: &[u32]| f(Resample([a, b]));
        match tested {
            SuiteSet::PulseType => pulse.map(|own| of(a, own)).collect(),
            SuiteSet::Both => {
                ordinary.zip(pulse).map(|(a, b)| of(a, b)).collect()
            }
            SuiteSet::None | SuiteSet::Ordinary => {
                ordinary.map(|own| of(own, b)).collect()
            }
        }
    }

    /// Numbers that are smooth in the records, over the bootstrap.
    pub fn smooth(
        &self,
        tested: SuiteSet,
        f: &(impl Fn(Resample<'_>) -> Vec<f64> + Sync),
    ) -> Replicates {
        let rows = self.rows(tested, &self.drawn, f);
        let how = Resampling::Bootstrap;
        Replicates { how, points: f(self.whole()), rows }
    }

    /// Numbers that ties would spoil, over the subsets of a suite without two
    /// earthquakes.
    pub fn untied(
        &self,
        suite: SuiteKind,
        f: &(impl Fn(Resample<'_>) -> Vec<f64> + Sync),
    ) -> Replicates {
        let rows = self.rows(suite.into(), &self.without_two, f);
        let how = Resampling::Without(2);
        Replicates { how, points: f(self.whole()), rows }
    }

    /// Numbers with their intervals at a level; without an interval if the
    /// resamples give none.
    pub fn estimates(
        &self,
        tested: SuiteSet,
        (range, level): (Range, f64),
        of: &Replicates,
    ) -> Vec<Estimate> {
        let clusters = self.clusters(tested);
        let one = |(k, point): (usize, &f64)| {
            let own: Vec<f64> = of.rows.iter().map(|row| row[k]).collect();
            estimate(clusters, *point, &own, (of.how, range, level))
        };
        of.points.par_iter().enumerate().map(one).collect()
    }
}

/// A number with its interval at a level by numbers of resampled earthquakes;
/// without an interval if they give none.
pub(crate) fn estimate(
    clusters: &Clusters,
    point: f64,
    resamples: &[f64],
    (how, range, level): (Resampling, Range, f64),
) -> Estimate {
    let found = clusters.estimate(point, resamples, how, range, level);
    found.map_or(Estimate::exact(point), |found| found.estimate)
}

/// Numbers of a sample, and of its resamples.
#[derive(Clone, Debug, Default)]
pub struct Replicates {
    pub(crate) how: Resampling,
    pub(crate) points: Vec<f64>,
    pub(crate) rows: Vec<Vec<f64>>,
}

impl Replicates {
    /// Other numbers as functions of these.
    pub fn map(&self, f: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        let rows = self.rows.iter().map(|row| f(row)).collect();
        Self { how: self.how, points: f(&self.points), rows }
    }

    /// One number as a function of these.
    pub fn one(&self, f: impl Fn(&[f64]) -> f64) -> Self {
        self.map(|row| vec![f(row)])
    }

    /// The numbers with other values of the sample; the resamples are shifted by
    /// the same amounts.
    pub fn moved_to(mut self, points: &[f64]) -> Self {
        let by: Vec<f64> =
            points.iter().zip(&self.points).map(|(a, b)| a - b).collect();
        for row in &mut self.rows {
            for (x, by) in row.iter_mut().zip(&by) {
                *x += by;
            }
        }
        self.points = points.to_vec();
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share(found: usize, all: usize) -> f64 {
        found as f64 / all as f64
    }

    #[test]
    fn suites_are_drawn_independently_and_records_jointly() {
        let draws = Resamples::new([30, 30].map(Clusters::singletons), 2000);
        let both = |draw: Resample<'_>| {
            let of = |suite| f64::from(draw.of(suite)[0]);
            vec![of(SuiteKind::Ordinary), of(SuiteKind::PulseType)]
        };
        let found = draws.smooth(SuiteSet::Both, &both);
        let equal = found.rows.iter().filter(|row| row[0] == row[1]).count();
        // Two independent Poisson(1) counts agree in 31 % of the draws.
        assert!((0.25..0.37).contains(&share(equal, found.rows.len())));
        let one = draws.smooth(SuiteSet::PulseType, &both);
        assert!(one.rows.iter().all(|row| row[0] == 1.0));
    }

    #[test]
    fn ties_are_avoided_by_leaving_two_earthquakes_out() {
        let draws = Resamples::new([7, 8].map(Clusters::singletons), 100);
        let held = |draw: Resample<'_>| {
            let counts = draw.of(SuiteKind::PulseType);
            vec![f64::from(counts.iter().sum::<u32>())]
        };
        let pairs = draws.untied(SuiteKind::PulseType, &held);
        assert_eq!((pairs.points[0], pairs.rows.len()), (8.0, 28));
        assert!(pairs.rows.iter().all(|row| row[0] == 6.0));
    }

    #[test]
    fn half_of_a_small_suite_counts() {
        assert_eq!(
            [14, 22, 44, 60, 86].map(least_counted),
            [7, 11, 22, 30, 30]
        );
    }
}
