//! Inference of the study: one set of replicates serves all claims.
//!
//! The records are the sample; blocks, stripes, levels, intensity measures
//! and arms are computed from the same records. A replicate takes the same
//! records everywhere and recomputes the whole measure of a claim. The two
//! suites are resampled independently of each other.

mod counted;
mod drawn;
mod draws;
mod needed;

use rocking::statistics::bootstrap::estimate;
use rocking::statistics::resampling::share_inside;

use rocking_common::findings::{
    CellCounts, ClaimResult, Detail, Interval, Measured, Quantifier, Region,
    Tested, Unit,
};
use rocking_common::paper::{Arm, Verdict};

pub use drawn::by_cell;
use drawn::{band, clipped};
pub use draws::{
    Draw, Draws, LEAST_DECIDING, LEVEL, Measure, REPLICATES, Replicated,
    SUBSAMPLES, Scheme,
};
pub use needed::Rule;
use needed::needed;

/// A cell's name, and how many records are in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Where it is: `p = 3, alpha = 0.20`.
    pub at: String,
    /// Records whose values are in it.
    pub records: usize,
}

/// The result of a claim on a suite and arm.
#[must_use]
pub fn judge(
    draws: &Draws,
    tested: Tested,
    arm: Option<Arm>,
    rule: &Rule,
    cells: &[Cell],
    measured: &Replicated,
) -> ClaimResult {
    let mut result = ClaimResult {
        suite: tested,
        arm,
        value: f64::NAN,
        low: f64::NAN,
        high: f64::NAN,
        unit: rule.unit,
        by_criterion: None,
        by_equivalence: Some(Verdict::Inconclusive),
        at: String::new(),
        interval: None,
        cells: None,
        deciding_cell: None,
        details: Vec::new(),
        records_needed: None,
    };
    match rule.quantifier {
        Quantifier::One => one(draws, rule, cells, measured, &mut result),
        _ => many(draws, rule, cells, measured, &mut result),
    }
    if result.interval.is_none() {
        // No interval, no verdict.
        result.by_equivalence = None;
    }
    // Exact ends do not shrink by the root of the number of records.
    let scales = measured.scheme != Scheme::Counted;
    if scales && result.by_equivalence == Some(Verdict::Inconclusive) {
        let n = draws.size(tested);
        result.records_needed = needed(n, rule, &result);
    }
    result
}

/// A share of cells with its interval, and on which side of a region it is.
#[must_use]
pub fn share(
    draws: &Draws,
    tested: Tested,
    measured: &Replicated,
    region: Region,
) -> (Measured, Verdict) {
    let value = measured.points[0];
    let Some((low, high, _)) =
        measured.interval(0, &draws.rules, tested, LEVEL)
    else {
        return (Measured::exact(value), Verdict::Inconclusive);
    };
    let (low, high) = (clipped(low, (0.0, 1.0)), clipped(high, (0.0, 1.0)));
    let measured = Measured { value, interval: Some((low, high)) };
    (measured, region.verdict(low, high))
}

fn one(
    draws: &Draws,
    rule: &Rule,
    cells: &[Cell],
    measured: &Replicated,
    result: &mut ClaimResult,
) {
    let (Some(value), Some(cell)) = (measured.points.first(), cells.first())
    else {
        return;
    };
    result.value = *value;
    result.at.clone_from(&cell.at);
    let ends = measured.interval(0, &draws.rules, result.suite, LEVEL);
    if let Some((low, high, interval)) = ends {
        result.low = clipped(low, rule.range);
        result.high = clipped(high, rule.range);
        result.interval = Some(interval);
        result.by_equivalence =
            Some(rule.region.verdict(result.low, result.high));
    }
    if !measured.halves.is_empty() {
        let halves = Replicated::column(&measured.halves, 0);
        let finite: Vec<f64> =
            halves.into_iter().filter(|x| x.is_finite()).collect();
        let sum = finite.iter().fold(0.0, |sum, x| sum + x);
        result.details.push(Detail {
            name: "mean over halves of the records".into(),
            measured: Measured::exact(sum / finite.len() as f64),
        });
    }
}

/// Cells with enough records to decide.
fn deciding(cells: &[Cell], measured: &Replicated) -> Vec<usize> {
    let decides = |k: &usize| {
        cells[*k].records >= LEAST_DECIDING && measured.points[*k].is_finite()
    };
    (0..cells.len()).filter(decides).collect()
}

/// Verdict over many cells, by the band that holds all of them at once: the
/// share of cells in the region lies between the share whose whole interval
/// is inside and the share whose interval is not wholly outside, with the
/// band's probability.
fn many(
    draws: &Draws,
    rule: &Rule,
    cells: &[Cell],
    measured: &Replicated,
    result: &mut ClaimResult,
) {
    let deciding = deciding(cells, measured);
    let own = measured.select(&deciding);
    result.interval = Some(match own.scheme {
        Scheme::Bootstrap => Interval::Simultaneous,
        Scheme::Subsampling => Interval::Subsampling,
        Scheme::Counted => Interval::ExactSimultaneous,
    });
    let band = band(draws, result.suite, rule.range, &own);
    let verdicts: Vec<Verdict> =
        band.iter().map(|(a, b)| rule.region.verdict(*a, *b)).collect();
    let count = |verdict| verdicts.iter().filter(|v| **v == verdict).count();
    let (inside, outside) =
        (count(Verdict::Confirmed), count(Verdict::NotConfirmed));
    result.cells = Some(CellCounts {
        deciding: deciding.len(),
        inside,
        outside,
        too_few: cells.len() - deciding.len(),
    });
    if deciding.is_empty() {
        result.interval = None;
        result.at = format!("no cell has {LEAST_DECIDING} records or more");
        return;
    }
    // The cell that decides: the worst among those that bear the verdict.
    let verdict_of_all = if outside > 0 {
        Verdict::NotConfirmed
    } else if inside == deciding.len() {
        Verdict::Confirmed
    } else {
        Verdict::Inconclusive
    };
    let reach = |k: usize| {
        let (a, b) = band[k];
        let (a, b) = (rule.region.badness(a), rule.region.badness(b));
        if a > b { a } else { b }
    };
    let worst = (0..deciding.len())
        .filter(|k| verdicts[*k] == verdict_of_all)
        .max_by(|a, b| {
            // A cell without an interval has no reach to be compared.
            let known = |k: usize| (reach(k).is_finite(), reach(k));
            let ((a, of_a), (b, of_b)) = (known(*a), known(*b));
            a.cmp(&b).then(of_a.total_cmp(&of_b))
        })
        .unwrap_or(0);
    let total = deciding.len() as f64;
    if rule.quantifier == Quantifier::All {
        result.value = own.points[worst];
        (result.low, result.high) = band[worst];
        result.at.clone_from(&cells[deciding[worst]].at);
        result.by_equivalence = Some(verdict_of_all);
    } else {
        let holding =
            own.points.iter().filter(|x| rule.region.holds(**x)).count();
        result.value = holding as f64 / total;
        let known: Vec<_> = band.iter().copied().map(Some).collect();
        let is = |verdict| {
            move |low, high| rule.region.verdict(low, high) == verdict
        };
        (result.low, result.high) = share_inside(
            &known,
            is(Verdict::Confirmed),
            is(Verdict::NotConfirmed),
        );
        result.unit = Unit::Share;
        result.at = "share of the cells".into();
        let region = match rule.quantifier {
            Quantifier::Most => Region::Above(0.5),
            _ => Region::Within(0.9, 1.0),
        };
        result.by_equivalence = Some(region.verdict(result.low, result.high));
        result.deciding_cell = Some(Detail {
            name: cells[deciding[worst]].at.clone(),
            measured: Measured {
                value: own.points[worst],
                interval: Some(band[worst]),
            },
        });
    }
    if let Region::Within(a, b) = rule.region {
        let middle = 0.5 * (a + b);
        details(&own, middle, result);
    }
}

/// The middle and the 90 % value over the cells of the distance from the
/// region's middle, with percentile intervals.
fn details(own: &Replicated, middle: f64, result: &mut ClaimResult) {
    for (name, share) in [("median", 0.5), ("90 %", 0.9)] {
        let over = |row: &[f64]| {
            let mut away: Vec<f64> = row
                .iter()
                .map(|x| (x - middle).abs())
                .filter(|x| x.is_finite())
                .collect();
            away.sort_by(f64::total_cmp);
            let place = (share * away.len() as f64).ceil() as usize;
            away.get(place.saturating_sub(1)).copied().unwrap_or(f64::NAN)
        };
        let values: Vec<f64> =
            own.replicates.iter().map(|row| over(row)).collect();
        let point = over(&own.points);
        let interval =
            estimate(point, &values, LEVEL).map(|e| (e.low, e.high));
        result.details.push(Detail {
            name: format!(
                "{name} over the cells of the distance from {middle}"
            ),
            measured: Measured { value: point, interval },
        });
    }
}

#[cfg(test)]
mod tests;
