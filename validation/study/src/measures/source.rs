//! What the measures read, and what they give.

use rocking_statistics::resampling::Ranked;

use crate::distances::Distances;
use crate::estimates::mean;
use crate::inference::{Cell, Draw, Draws, Replicated};
use crate::results::Results;
use rocking_common::findings::{Detail, Tested};
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, Intensity, SLENDERNESSES_RAD, SuiteKind,
};

/// The cells of a measure; none where what it needs was not run.
pub type Found = anyhow::Result<Option<Prepared>>;

/// What a measure reads.
#[derive(Clone, Copy)]
pub struct Source<'a> {
    /// The analyses.
    pub results: &'a Results,
    /// The draws that all claims share.
    pub draws: &'a Draws,
    /// Distances from a lognormal of all draws, by suite and arm.
    pub distances: &'a [Distances],
    /// The suite, or both.
    pub tested: Tested,
    /// The arm.
    pub arm: Arm,
    /// The intensity measure: of a claim that names none, PGA.
    pub intensity: Intensity,
}

/// The cells of a measure and their replicates.
pub struct Prepared {
    /// Where the cells are.
    pub cells: Vec<Cell>,
    /// Their values.
    pub measured: Replicated,
    /// What the paper judges by, where it says so.
    pub criterion: Option<Criterion>,
    /// What else is shown.
    pub details: Vec<Detail>,
}

/// The share that meets the paper's own criterion.
pub struct Criterion {
    /// What it is a share of.
    pub name: String,
    /// The share.
    pub measured: Replicated,
}

impl Prepared {
    /// Cells and nothing beside them.
    pub(super) fn new(cells: Vec<Cell>, measured: Replicated) -> Self {
        Self { cells, measured, criterion: None, details: Vec::new() }
    }
}

impl Source<'_> {
    pub(crate) fn kind(&self) -> SuiteKind {
        match self.tested {
            Tested::PulseType => SuiteKind::PulseType,
            _ => SuiteKind::Ordinary,
        }
    }

    /// One value, smooth in the records.
    pub(super) fn value(
        &self,
        at: &str,
        records: usize,
        f: impl Fn(Draw<'_>) -> f64 + Sync,
    ) -> Prepared {
        let cell = Cell { at: at.into(), records };
        let measured = self.draws.smooth(self.tested, &|d| vec![f(d)]);
        Prepared::new(vec![cell], measured)
    }

    /// A share of what the records count together: `found` of `all`, by
    /// record.
    pub(super) fn share(
        &self,
        at: &str,
        found: Vec<u32>,
        all: Vec<u32>,
    ) -> Prepared {
        let kind = self.kind();
        let sum = |of: &[u32], counts: &[u32]| {
            f64::from(of.iter().zip(counts).map(|(x, n)| x * n).sum::<u32>())
        };
        self.value(at, all.len(), move |draw| {
            let counts = draw.of(kind);
            sum(&found, counts) / sum(&all, counts)
        })
    }
}

/// A block in words: `p = 3, alpha = 0.20`.
pub(super) fn block(frequency: usize, slenderness: usize) -> String {
    format!(
        "p = {}, alpha = {:.2}",
        FREQUENCIES_RAD_S[frequency], SLENDERNESSES_RAD[slenderness]
    )
}

/// Mean over cells of the medians of a draw.
pub(super) fn mean_of_medians(ranked: &[Ranked], counts: &[u32]) -> f64 {
    mean(ranked.iter().map(|r| r.median(counts)))
}

/// Geometric means of paired ratios, cell by cell: the records of a pair
/// answer twice, so that the mean of ln of the ratio has little scatter. A
/// ratio that is not finite does not count.
pub(super) fn geometric_means(
    source: &Source<'_>,
    cells: Vec<(String, Vec<f64>)>,
) -> Prepared {
    let kind = source.kind();
    let (at, logs): (Vec<String>, Vec<Vec<f64>>) = cells
        .into_iter()
        .map(|(at, x)| (at, x.into_iter().map(libm::log).collect()))
        .unzip();
    let of = |draw: Draw<'_>| -> Vec<f64> {
        let counts = draw.of(kind);
        logs.iter().map(|x| libm::exp(weighted_mean(x, counts))).collect()
    };
    let measured = source.draws.smooth(source.tested, &of);
    let records =
        logs.iter().map(|x| x.iter().filter(|x| x.is_finite()).count());
    let cells = at
        .into_iter()
        .zip(records)
        .map(|(at, records)| Cell { at, records })
        .collect();
    Prepared::new(cells, measured)
}

/// Mean of the finite ones among the values of records, each drawn so often.
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

/// Paired ratios a/b, by record; NaN where one is infinite or missing.
pub(super) fn ratios(a: &[f64], b: &[f64], scale: f64) -> Vec<f64> {
    let ratio = |(a, b): (&f64, &f64)| {
        if a.is_finite() && b.is_finite() { scale * a / b } else { f64::NAN }
    };
    a.iter().zip(b).map(ratio).collect()
}
