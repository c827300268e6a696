//! Inference of the study: one set of replicates serves all claims.
//!
//! The earthquakes are the sample, each with its records; blocks, stripes,
//! levels, intensity measures and arms are computed from the same records. A
//! replicate takes the same earthquakes everywhere and recomputes the whole
//! measure of a claim. The two suites are resampled independently of each other.

mod draws;
mod intervals;
mod many;
mod refutation;

use rocking_common::findings::{
    ClaimResult, Detail, LEVEL, Quantifier, Region, SuiteSet,
};
use rocking_common::paper::{Arm, ClaimVerdict};
use rocking_statistics::{Estimate, Range};

pub use draws::{
    LEAST_DECIDING, MORE, REPLICATES, Replicates, Resample, Resamples,
    SUBSAMPLES, Scheme,
};
pub use intervals::by_cell;
use intervals::{CAUTION, CellIntervals, p_of};
use many::decide;
pub use many::{Cell, ClaimRule};

/// A result. Where an end that decides lies within four errors of the draws
/// from its limit, the verdict is inconclusive.
pub struct Ruling {
    /// The result.
    pub result: ClaimResult,
    /// Whether [`MORE`] draws may decide what these do not.
    pub more: bool,
}

/// The result of a claim on a suite and arm.
#[must_use]
pub fn judge(
    draws: &Resamples,
    tested: SuiteSet,
    arm: Option<Arm>,
    rule: &ClaimRule,
    cells: &[Cell],
    measured: &Replicates,
) -> Ruling {
    let known = CellIntervals::new(draws, tested, rule.range, measured);
    let by = |caution: f64| {
        let mut result = ClaimResult {
            suite: tested,
            arm,
            estimate: Estimate::exact(f64::NAN),
            monte_carlo_error: f64::NAN,
            unit: rule.unit,
            by_criterion: None,
            by_equivalence: Some(ClaimVerdict::Inconclusive),
            p: f64::NAN,
            at: String::new(),
            interval: None,
            cells: None,
            deciding_cell: None,
            details: Vec::new(),
            power: None,
        };
        match rule.quantifier {
            Quantifier::One => {
                judge_one(rule, cells, &known, caution, &mut result)
            }
            _ => many::judge_many(rule, cells, &known, caution, &mut result),
        }
        if result.interval.is_none() {
            // No interval, no verdict.
            result.by_equivalence = None;
        }
        result
    };
    let result = by(CAUTION);
    let settled = |caution: f64| {
        let verdict = |caution| by(caution).by_equivalence;
        verdict(caution) == verdict(-caution)
    };
    // More subsamples are not drawn: they cost too much.
    let more = measured.scheme == Scheme::Bootstrap
        && !settled(CAUTION)
        && settled(CAUTION / (MORE as f64).sqrt());
    Ruling { result, more }
}

/// A share of cells with its interval, and on which side of a region it is.
pub fn judged_share(
    draws: &Resamples,
    tested: SuiteSet,
    measured: &Replicates,
    region: Region,
) -> (Estimate, ClaimVerdict) {
    let known = CellIntervals::new(draws, tested, Range::Share, measured);
    let ends = known.drawn(0, LEVEL);
    let verdict = ends.map_or(ClaimVerdict::Inconclusive, |ends| {
        ends.verdict(region, CAUTION)
    });
    (known.shown(0, ends), verdict)
}

/// Fills in a result of one value.
fn judge_one(
    rule: &ClaimRule,
    cells: &[Cell],
    known: &CellIntervals<'_>,
    caution: f64,
    result: &mut ClaimResult,
) {
    let measured = known.measured;
    let (Some(value), Some(cell)) = (measured.points.first(), cells.first())
    else {
        return;
    };
    result.estimate = Estimate::exact(*value);
    result.at.clone_from(&cell.at);
    let of = |level| known.drawn(0, level);
    if let Some(ends) = of(LEVEL) {
        let verdict = ends.verdict(rule.region, caution);
        decide(result, *value, &ends, rule.region, verdict);
        if caution == CAUTION {
            result.p = p_of(of, rule.region, verdict);
            if verdict == ClaimVerdict::Inconclusive {
                result.power = known.power(0, &ends, LEVEL, rule.region);
            }
        }
    }
    if !measured.halves.is_empty() {
        let halves = Replicates::column(&measured.halves, 0);
        let finite: Vec<f64> =
            halves.into_iter().filter(|x| x.is_finite()).collect();
        let sum = finite.iter().fold(0.0, |sum, x| sum + x);
        let mean = sum / finite.len() as f64;
        result.details.push(Detail {
            name: "mean over halves of the records".into(),
            estimate: Estimate::exact(mean),
        });
    }
}

#[cfg(test)]
mod tests;
