//! Input and result of the measures.

use rocking_statistics::resampling::RecordRanks;

use crate::analyses::{StripeDemands, SuiteResults};
use crate::distances::SuiteDistances;
use crate::estimates::mean;
use crate::inference::{Cell, Replicates, Resample, Resamples};
use crate::results::StudyResults;
use rocking_common::findings::{Detail, SuiteSet};
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, Intensity, REFERENCE, SLENDERNESSES_RAD, SuiteKind,
};

/// Input of a measure: results, draws, suite, arm and intensity measure.
#[derive(Clone, Copy)]
pub struct Scope<'a> {
    /// The analyses.
    pub results: &'a StudyResults,
    /// The draws that all claims share.
    pub draws: &'a Resamples,
    /// Distances from a lognormal of all draws, by suite and arm.
    pub distances: &'a [SuiteDistances],
    /// The suite, or both.
    pub tested: SuiteSet,
    /// The arm.
    pub arm: Arm,
    /// The intensity measure: PGA where the claim names none.
    pub intensity: Intensity,
}

/// The cells of a measure and their replicates.
pub struct MeasureCells {
    /// Where the cells are.
    pub cells: Vec<Cell>,
    /// Their values.
    pub measured: Replicates,
    /// The share that meets the paper's own criterion, where it has one.
    pub criterion: Option<Criterion>,
    /// Further numbers for the reader.
    pub details: Vec<Detail>,
}

/// The cells of a measure; an error where a curve cannot be read, or an arm
/// was not run.
pub type MeasureResult = anyhow::Result<MeasureCells>;

/// The share that meets the paper's own criterion.
pub struct Criterion {
    /// Its name.
    pub name: String,
    /// The share.
    pub measured: Replicates,
}

impl MeasureCells {
    /// Cells without a criterion and without details.
    pub(super) fn new(cells: Vec<Cell>, measured: Replicates) -> Self {
        Self { cells, measured, criterion: None, details: Vec::new() }
    }
}

impl<'a> Scope<'a> {
    /// The kind of the suite; the ordinary one of a comparison of both.
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

    /// Demands on the stripes of the suite and arm.
    pub(super) fn stripes(&self) -> anyhow::Result<&'a StripeDemands> {
        self.suite().stripes(self.arm)
    }

    /// Numbers that are smooth in the suite's records, each drawn so often.
    pub(crate) fn smooth(
        &self,
        f: impl Fn(&[u32]) -> Vec<f64> + Sync,
    ) -> Replicates {
        let kind = self.kind();
        let of = |draw: Resample<'_>| f(draw.of(kind));
        self.draws.smooth(self.tested, &of)
    }

    /// One value, smooth in the suite's records.
    pub(super) fn value(
        &self,
        at: &str,
        records: usize,
        f: impl Fn(&[u32]) -> f64 + Sync,
    ) -> MeasureCells {
        let cell = Cell { at: at.into(), records };
        MeasureCells::new(vec![cell], self.smooth(|counts| vec![f(counts)]))
    }

    /// One value, smooth in the ordinary and in the pulse-type records.
    pub(super) fn contrast(
        &self,
        at: &str,
        records: usize,
        f: impl Fn(&[u32], &[u32]) -> f64 + Sync,
    ) -> MeasureCells {
        let cell = Cell { at: at.into(), records };
        let of = |draw: Resample<'_>| {
            let [ordinary, pulse] = SuiteKind::ALL.map(|kind| draw.of(kind));
            vec![f(ordinary, pulse)]
        };
        MeasureCells::new(vec![cell], self.draws.smooth(self.tested, &of))
    }

    /// A share of all records' counts: `found` of `all`, by record.
    pub(super) fn share(
        &self,
        at: &str,
        found: &[u32],
        all: &[u32],
    ) -> MeasureCells {
        self.value(at, all.len(), |counts| {
            weighted_count(found, counts) / weighted_count(all, counts)
        })
    }

    /// Medians of the cells.
    pub(super) fn medians(&self, cells: Vec<CellValues>) -> MeasureCells {
        let (cells, values) =
            cells.into_iter().map(|own| (own.cell(), own.values)).unzip();
        let measured = self.draws.medians(self.kind(), values);
        MeasureCells::new(cells, measured)
    }
}

/// The values of the records in one cell.
pub(super) struct CellValues {
    pub(super) at: String,
    pub(super) values: RecordRanks,
}

impl CellValues {
    /// Paired ratios of demands or capacities.
    pub(super) fn ratios(at: String, a: &[f64], b: &[f64]) -> Self {
        Self { at, values: RecordRanks::new(&ratios(a, b, 1.0)) }
    }

    /// The cell.
    pub(super) fn cell(&self) -> Cell {
        Cell { at: self.at.clone(), records: self.values.records() }
    }
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

/// A block in words: `p = 3, alpha = 0.20`.
pub(super) fn block(frequency: usize, slenderness: usize) -> String {
    format!(
        "p = {}, alpha = {:.2}",
        FREQUENCIES_RAD_S[frequency], SLENDERNESSES_RAD[slenderness]
    )
}

/// Geometric means of paired ratios, cell by cell: the two values of a record
/// are close, so that the mean of the logarithm of their ratio has little
/// scatter. A ratio that is not finite does not count.
pub(super) fn geometric_means(
    scope: &Scope<'_>,
    cells: Vec<(String, Vec<f64>)>,
) -> MeasureCells {
    let logs = cells.into_iter().map(|(at, ratios)| {
        let logs: Vec<f64> = ratios.into_iter().map(libm::log).collect();
        let records = logs.iter().filter(|x| x.is_finite()).count();
        (Cell { at, records }, logs)
    });
    let (cells, logs): (Vec<Cell>, Vec<Vec<f64>>) = logs.unzip();
    let measured = scope.smooth(|counts| {
        logs.iter().map(|x| libm::exp(weighted_mean(x, counts))).collect()
    });
    MeasureCells::new(cells, measured)
}

/// Mean of the finite values of the records, each drawn so often.
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

/// Sum of the records' counts, each record drawn so often.
pub(super) fn weighted_count(of: &[u32], counts: &[u32]) -> f64 {
    f64::from(of.iter().zip(counts).map(|(x, n)| x * n).sum::<u32>())
}

/// Mean over cells of the medians of a draw.
pub(super) fn mean_of_medians(cells: &[CellValues], counts: &[u32]) -> f64 {
    mean(cells.iter().map(|cell| cell.values.median(counts)))
}

/// Paired ratios a/b, by record; NaN where one is infinite or missing.
pub(super) fn ratios(a: &[f64], b: &[f64], scale: f64) -> Vec<f64> {
    let ratio = |(a, b): (&f64, &f64)| {
        if a.is_finite() && b.is_finite() { scale * a / b } else { f64::NAN }
    };
    a.iter().zip(b).map(ratio).collect()
}
