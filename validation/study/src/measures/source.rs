//! What the measures read, and what they give.

use rocking::statistics::resampling::Ranked;

use crate::estimates::mean;
use crate::inference::{Cell, Draw, Draws, Replicated};
use crate::results::Results;
use crate::shares::Shares;
use rocking_common::findings::Tested;
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, SLENDERNESSES_RAD, SuiteKind,
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
    /// Accepted shares of all draws, by suite and arm.
    pub shares: &'a [Shares],
    /// The suite, or both.
    pub tested: Tested,
    /// The arm.
    pub arm: Arm,
}

/// The cells of a measure and their replicates; the share of cells that meet
/// the paper's own criterion, where there is one.
pub struct Prepared {
    /// Where the cells are.
    pub cells: Vec<Cell>,
    /// Their values.
    pub measured: Replicated,
    /// Of each replicate, the share of cells whose notch covers 1.
    pub criterion: Option<Replicated>,
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
        Prepared {
            cells: vec![Cell { at: at.into(), records }],
            measured: self.draws.smooth(self.tested, &|d| vec![f(d)]),
            criterion: None,
        }
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

/// Paired ratios a/b, by record; NaN where one is infinite or missing.
pub(super) fn ratios(a: &[f64], b: &[f64], scale: f64) -> Vec<f64> {
    let ratio = |(a, b): (&f64, &f64)| {
        if a.is_finite() && b.is_finite() { scale * a / b } else { f64::NAN }
    };
    a.iter().zip(b).map(ratio).collect()
}
