//! Input and result of the measures.

use rocking_statistics::resampling::RecordRanks;
use rocking_statistics::{Estimate, Range};

use crate::analyses::{StripeDemands, SuiteResults};
use crate::distances::SuiteDistances;
use crate::estimates::mean;
use crate::inference::{Replicates, Resample, Resamples, least_counted};
use crate::results::StudyResults;
use rocking_common::findings::{Detail, LEVEL, SampleCount, SuiteSet};
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, Intensity, REFERENCE, SLENDERNESSES_RAD, SuiteKind,
};

/// Input of a measure: results, draws, suite, grid and intensity measure.
#[derive(Clone, Copy)]
pub struct Scope<'a> {
    /// The analyses.
    pub results: &'a StudyResults,
    /// The draws that all claims share.
    pub draws: &'a Resamples,
    /// Distances from a lognormal of all draws, by suite and grid.
    pub distances: &'a [SuiteDistances],
    /// The suite, or both.
    pub tested: SuiteSet,
    /// The grid.
    pub arm: Arm,
    /// The intensity measure: PGA by default.
    pub intensity: Intensity,
}

/// Largest distance of curves that coincide. The paper prints no tolerance.
pub(super) const COINCIDE: f64 = 0.1;

/// Result of a measure in a suite.
pub struct Measured {
    /// The numbers of the sample, one for each yardstick of the claim.
    pub counts: Vec<SampleCount>,
    /// The effect, one number.
    pub effect: Replicates,
    /// Place of the measurement, in words.
    pub at: String,
    /// Further numbers for the reader.
    pub details: Vec<Detail>,
}

/// Result of a measure, or the error of a curve that cannot be read or of a grid
/// that was not run.
pub type MeasureResult = anyhow::Result<Measured>;

impl Measured {
    /// An effect with its counts, without details.
    pub(super) fn new(
        counts: impl Into<Vec<SampleCount>>,
        effect: Replicates,
        at: impl Into<String>,
    ) -> Self {
        let (counts, at) = (counts.into(), at.into());
        Self { counts, effect, at, details: Vec::new() }
    }

    /// An effect that is itself the number of the only yardstick.
    pub(super) fn number(effect: Replicates, at: impl Into<String>) -> Self {
        let value = effect.points.first().copied().unwrap_or(f64::NAN);
        Self::new([SampleCount::number(value)], effect, at)
    }

    /// Adds a detail.
    pub(super) fn and(mut self, name: &str, estimate: Estimate) -> Self {
        self.details.push(Detail { name: name.into(), estimate });
        self
    }
}

impl<'a> Scope<'a> {
    /// The kind of the suite; ordinary for a comparison of both.
    pub(crate) fn kind(&self) -> SuiteKind {
        match self.tested {
            SuiteSet::PulseType => SuiteKind::PulseType,
            _ => SuiteKind::Ordinary,
        }
    }

    /// The suite of that kind.
    pub(crate) fn suite(&self) -> &'a SuiteResults {
        self.results.suite(self.kind())
    }

    /// Number of the suite's records.
    pub(super) fn records(&self) -> usize {
        self.suite().records.len()
    }

    /// Demands on the stripes of the suite and grid.
    pub(super) fn stripes(&self) -> anyhow::Result<&'a StripeDemands> {
        self.suite().stripes(self.arm)
    }

    /// Numbers that are smooth in the multiplicities of the suite's records.
    pub(crate) fn smooth(
        &self,
        f: impl Fn(&[u32]) -> Vec<f64> + Sync,
    ) -> Replicates {
        let kind = self.kind();
        let of = |draw: Resample<'_>| f(draw.of(kind));
        self.draws.smooth(self.tested, &of)
    }

    /// One number, smooth in the multiplicities of the suite's records.
    pub(super) fn one(&self, f: impl Fn(&[u32]) -> f64 + Sync) -> Replicates {
        self.smooth(|counts| vec![f(counts)])
    }

    /// The first number with its interval, for values of a range.
    pub(crate) fn estimate(&self, range: Range, of: &Replicates) -> Estimate {
        let found = self.draws.estimates(self.tested, (range, LEVEL), of);
        found.first().copied().unwrap_or(Estimate::exact(f64::NAN))
    }

    /// Geometric mean of the medians of cells.
    pub(super) fn mean_median(&self, cells: &[RecordRanks]) -> Replicates {
        self.one(|counts| {
            let medians = cells.iter().map(|cell| cell.median(counts));
            geometric_mean(medians)
        })
    }

    /// The cells that count: those with enough of the suite's records.
    pub(super) fn counted(
        &self,
        mut cells: Vec<RecordRanks>,
    ) -> Vec<RecordRanks> {
        let least = least_counted(self.records());
        cells.retain(|cell| cell.records() >= least);
        cells
    }

    /// The multiplicities of the whole suite: every record once.
    pub(super) fn every(&self) -> &'a [u32] {
        self.draws.whole().of(self.kind())
    }
}

/// Counts by record: things of a kind, and all things.
pub(super) struct Tally {
    found: Vec<u32>,
    all: Vec<u32>,
}

impl Tally {
    /// Nothing counted yet.
    pub(super) fn new(records: usize) -> Self {
        Self { found: vec![0; records], all: vec![0; records] }
    }

    /// Counts a thing of a record, and whether it is of the kind.
    pub(super) fn add(&mut self, record: usize, is: bool) {
        self.all[record] += 1;
        self.found[record] += u32::from(is);
    }

    /// The numbers of things of the kind, and of all things.
    pub(super) fn totals(&self) -> (usize, usize) {
        let sum = |of: &[u32]| of.iter().sum::<u32>() as usize;
        (sum(&self.found), sum(&self.all))
    }

    /// The count of the sample.
    pub(super) fn count(&self) -> SampleCount {
        let (found, all) = self.totals();
        SampleCount::of(found, all)
    }

    /// The share over the draws.
    pub(super) fn share(&self, scope: &Scope<'_>) -> Replicates {
        scope.one(|counts| {
            weighted_count(&self.found, counts)
                / weighted_count(&self.all, counts)
        })
    }
}

/// Geometric mean of the finite values among some positive numbers.
pub(super) fn geometric_mean(values: impl IntoIterator<Item = f64>) -> f64 {
    libm::exp(mean(values.into_iter().map(libm::log)))
}

/// The 15 blocks by the positions of frequency parameter and slenderness.
pub(super) fn blocks() -> impl Iterator<Item = (usize, usize)> {
    (0..FREQUENCIES_RAD_S.len())
        .flat_map(|f| (0..SLENDERNESSES_RAD.len()).map(move |s| (f, s)))
}

/// The blocks that are compared with the reference slenderness.
pub(super) fn compared_blocks() -> impl Iterator<Item = (usize, usize)> {
    blocks().filter(|(_, slenderness)| *slenderness != REFERENCE)
}

/// Geometric mean of paired ratios over the cells. The two values of a record
/// are close, so that the mean logarithm of their ratio has little scatter. A
/// ratio that is not finite does not count.
pub(super) fn mean_ratio(
    scope: &Scope<'_>,
    cells: impl IntoIterator<Item = Vec<f64>>,
) -> Replicates {
    let logs = |ratios: Vec<f64>| ratios.into_iter().map(libm::log).collect();
    let logs: Vec<Vec<f64>> = cells.into_iter().map(logs).collect();
    scope.one(|counts| {
        libm::exp(mean(logs.iter().map(|x| weighted_mean(x, counts))))
    })
}

/// Mean of the finite values, weighted by the multiplicities of the records.
pub(super) fn weighted_mean(values: &[f64], counts: &[u32]) -> f64 {
    let (mut sum, mut drawn) = (0.0, 0.0);
    for (x, count) in values.iter().zip(counts) {
        if x.is_finite() {
            sum = f64::mul_add(f64::from(*count), *x, sum);
            drawn += f64::from(*count);
        }
    }
    sum / drawn
}

/// Sum of the records' counts, weighted by their multiplicities.
pub(super) fn weighted_count(of: &[u32], counts: &[u32]) -> f64 {
    f64::from(of.iter().zip(counts).map(|(x, n)| x * n).sum::<u32>())
}

/// Ranks of paired ratios a/b times a scale.
pub(crate) fn ranks(a: &[f64], b: &[f64], scale: f64) -> RecordRanks {
    RecordRanks::new(&ratios(a, b, scale))
}

/// Paired ratios a/b by record; NaN if one value is infinite or missing.
pub(super) fn ratios(a: &[f64], b: &[f64], scale: f64) -> Vec<f64> {
    let ratio = |(a, b): (&f64, &f64)| {
        if a.is_finite() && b.is_finite() { scale * a / b } else { f64::NAN }
    };
    a.iter().zip(b).map(ratio).collect()
}
