//! Resamples of the records, and the values of a measure in them.

use rayon::prelude::*;
use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::resampling::{RecordRanks, Subsampling};
use rocking_statistics::{Clusters, Interval, Proportion};

use rocking_common::findings::SuiteSet;
use rocking_common::paper::SuiteKind;

/// Replicates of the bootstrap.
pub const REPLICATES: usize = 2000;

/// Subsamples without replacement.
pub const SUBSAMPLES: usize = 1000;

/// How many times as many are drawn where a verdict would change with the
/// draws.
pub const MORE: usize = 8;

/// Level of a band that is drawn and decides nothing.
const BAND: f64 = 0.95;

/// A cell with fewer records has no bootstrap: a median has its exact
/// interval, other measures have none.
pub const LEAST_DECIDING: usize = 30;

/// How often a replicate holds each record, by suite.
#[derive(Clone, Copy, Debug)]
pub struct Resample<'a>([&'a [u32]; 2]);

impl<'a> Resample<'a> {
    /// The multiplicities of a suite's records.
    #[must_use]
    pub fn of(&self, suite: SuiteKind) -> &'a [u32] {
        self.0[suite as usize]
    }
}

/// Resamples of both suites: by suite, then by replicate, then by record.
#[derive(Debug)]
struct DrawSet([Vec<Vec<u32>>; 2]);

impl DrawSet {
    fn draw(&self, index: usize) -> Resample<'_> {
        Resample(self.0.each_ref().map(|own| own[index].as_slice()))
    }

    fn map(
        &self,
        f: &(impl Fn(Resample<'_>) -> Vec<f64> + Sync),
    ) -> Vec<Vec<f64>> {
        let all = (0..self.0[0].len()).into_par_iter();
        all.map(|index| f(self.draw(index))).collect()
    }
}

/// The draws that all claims share.
#[derive(Debug)]
pub struct Resamples {
    clusters: [Clusters; 2],
    whole: DrawSet,
    bootstrap: DrawSet,
    subsamples: DrawSet,
    halves: DrawSet,
    without_one: [DrawSet; 2],
    rules: [Subsampling; 2],
}

impl Resamples {
    /// The draws for suites of these earthquakes, ordinary and pulse-type;
    /// of the bootstrap `times` as many as are enough for most claims.
    ///
    /// Streams: `study/records/SUITE` (bootstrap), `study/nine-tenths/SUITE`
    /// and `study/halves/SUITE` (subsamples), each of seed 0.
    #[must_use]
    pub fn new(clusters: [Clusters; 2], times: usize) -> Self {
        let ones = |place: usize| vec![1; clusters[place].records()];
        let rule = |name: &str, place: usize, size: fn(usize) -> usize| {
            let suite = SuiteKind::ALL[place];
            let own = &clusters[place];
            let name = format!("study/{name}/{suite}");
            Subsampling::of_clusters(&name, 0, own, size(own.records()))
        };
        let nine_tenths =
            |place| rule("nine-tenths", place, |n| n - n.div_ceil(10));
        let drawn = |rule: Subsampling, count: usize| -> Vec<Vec<u32>> {
            (0..count as u64).map(|i| rule.multiplicities(i)).collect()
        };
        let count = REPLICATES * times;
        let bootstrap = |place: usize| -> Vec<Vec<u32>> {
            let name = format!("study/records/{}", SuiteKind::ALL[place]);
            let own =
                Bootstrap::of_clusters(&name, 0, &clusters[place], count);
            (0..count as u64).map(|i| own.multiplicities(i)).collect()
        };
        let without = |place: usize| {
            let own = &clusters[place];
            let left: Vec<Vec<u32>> =
                (0..own.count()).map(|g| own.without(g)).collect();
            let other = vec![ones(1 - place); own.count()];
            if place == 0 {
                DrawSet([left, other])
            } else {
                DrawSet([other, left])
            }
        };
        let both = [0, 1];
        Self {
            whole: DrawSet(both.map(|place| vec![ones(place)])),
            bootstrap: DrawSet(both.map(bootstrap)),
            subsamples: DrawSet(
                both.map(|place| drawn(nine_tenths(place), SUBSAMPLES)),
            ),
            halves: DrawSet(both.map(|place| {
                let half = rule("halves", place, |n| n / 2);
                drawn(half, SUBSAMPLES / 5)
            })),
            without_one: both.map(without),
            rules: both.map(nine_tenths),
            clusters,
        }
    }

    /// The earthquakes that bound what is known of a suite; of a comparison
    /// those of the suite with fewer.
    pub(super) fn clusters(&self, tested: SuiteSet) -> &Clusters {
        let [ordinary, pulse] = &self.clusters;
        match tested {
            SuiteSet::PulseType => pulse,
            SuiteSet::Both if pulse.count() < ordinary.count() => pulse,
            _ => ordinary,
        }
    }

    pub(super) fn rule(&self, tested: SuiteSet) -> &Subsampling {
        &self.rules[usize::from(tested == SuiteSet::PulseType)]
    }

    /// Every record once.
    #[must_use]
    pub fn whole(&self) -> Resample<'_> {
        self.whole.draw(0)
    }

    /// Numbers that are smooth in the records, over the replicates of the
    /// bootstrap.
    #[must_use]
    pub fn smooth(
        &self,
        tested: SuiteSet,
        f: &(impl Fn(Resample<'_>) -> Vec<f64> + Sync),
    ) -> Replicates {
        let without: &[DrawSet] = match tested {
            SuiteSet::Ordinary => &self.without_one[..1],
            SuiteSet::PulseType => &self.without_one[1..],
            SuiteSet::None | SuiteSet::Both => &[],
        };
        Replicates {
            scheme: Scheme::Bootstrap,
            points: f(self.whole()),
            replicates: self.bootstrap.map(f),
            without_one: without.iter().flat_map(|own| own.map(f)).collect(),
            ..Replicates::default()
        }
    }

    /// Medians of the values of a suite's records, over the replicates of
    /// the bootstrap.
    #[must_use]
    pub fn medians(
        &self,
        suite: SuiteKind,
        samples: Vec<RecordRanks>,
    ) -> Replicates {
        let of = |draw: Resample<'_>| -> Vec<f64> {
            let counts = draw.of(suite);
            samples.iter().map(|s| s.median(counts)).collect()
        };
        let medians = self.smooth(suite.into(), &of);
        Replicates { samples, ..medians }
    }

    /// Numbers that ties spoil, over subsamples without replacement.
    #[must_use]
    pub fn subsampled(
        &self,
        tested: SuiteSet,
        f: &(impl Fn(Resample<'_>) -> Vec<f64> + Sync),
    ) -> Replicates {
        let without: &[DrawSet] = match tested {
            SuiteSet::Ordinary => &self.without_one[..1],
            SuiteSet::PulseType => &self.without_one[1..],
            SuiteSet::None => &[],
            SuiteSet::Both => &self.without_one,
        };
        Replicates {
            scheme: Scheme::Subsampling,
            points: f(self.whole()),
            replicates: self.subsamples.map(f),
            without_one: without.iter().flat_map(|own| own.map(f)).collect(),
            halves: self.halves.map(f),
            ..Replicates::default()
        }
    }
}

/// Where the intervals of a measure's cells come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scheme {
    /// Replicates drawn with replacement.
    #[default]
    Bootstrap,
    /// Replicates drawn without.
    Subsampling,
    /// The cells are counts of records, which have exact intervals: no
    /// replicate is drawn.
    Counted,
}

/// The cells of a measure: of all records, and of every replicate.
#[derive(Clone, Debug, Default)]
pub struct Replicates {
    pub(super) scheme: Scheme,
    pub(super) points: Vec<f64>,
    pub(super) replicates: Vec<Vec<f64>>,
    pub(super) without_one: Vec<Vec<f64>>,
    pub(super) halves: Vec<Vec<f64>>,
    /// The cells where they are counts; empty otherwise.
    pub(super) counts: Vec<Proportion>,
    /// The values that the cells are medians of; empty otherwise.
    pub(super) samples: Vec<RecordRanks>,
}

impl Replicates {
    /// Probabilities from counts of records.
    #[must_use]
    pub fn of_counts(counts: Vec<Proportion>) -> Self {
        Self {
            scheme: Scheme::Counted,
            points: counts.iter().map(|count| count.share()).collect(),
            counts,
            ..Self::default()
        }
    }

    /// Other measures made of this one's cells; of counts they have no
    /// interval, and of medians no exact one.
    #[must_use]
    pub fn map(&self, f: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        let all = |rows: &[Vec<f64>]| rows.iter().map(|row| f(row)).collect();
        Self {
            scheme: self.scheme,
            points: f(&self.points),
            replicates: all(&self.replicates),
            without_one: all(&self.without_one),
            halves: all(&self.halves),
            ..Self::default()
        }
    }

    /// A cell of all records.
    #[must_use]
    pub fn point(&self, k: usize) -> f64 {
        self.points[k]
    }

    /// The cells with other values of all records: what the replicates say
    /// of their own values moves along.
    #[must_use]
    pub fn moved_to(mut self, points: &[f64]) -> Self {
        let by: Vec<f64> =
            points.iter().zip(&self.points).map(|(a, b)| a - b).collect();
        let rows =
            [&mut self.replicates, &mut self.without_one, &mut self.halves];
        for row in rows.into_iter().flatten() {
            for (x, by) in row.iter_mut().zip(&by) {
                *x += by;
            }
        }
        self.points = points.to_vec();
        self
    }

    /// The central share of the replicates of every cell, wider by what few
    /// earthquakes ask; none where a tenth of them or more have no value.
    #[must_use]
    pub fn percentiles(
        &self,
        draws: &Resamples,
        tested: SuiteSet,
    ) -> Vec<Option<(f64, f64)>> {
        let clusters = draws.clusters(tested);
        (0..self.points.len())
            .into_par_iter()
            .map(|k| {
                let values = Self::column(&self.replicates, k);
                let e = clusters.estimate(self.points[k], &values, BAND)?;
                let ends = e.estimate.interval().map(Interval::ends);
                ends.filter(|_| 10 * e.used > 9 * e.replicates)
            })
            .collect()
    }

    pub(super) fn column(rows: &[Vec<f64>], k: usize) -> Vec<f64> {
        rows.iter().map(|row| row[k]).collect()
    }
}
