//! Verdicts over many cells.
//!
//! *All*: confirmed where every cell is shown to lie in the region by its own
//! interval (intersection-union test: Berger, Technometrics 24 (1982) 295),
//! not confirmed where a cell is refuted, all cells considered at once.
//! *Most* and *almost all*: by the interval of the share of the cells that
//! lie in the region.

use super::draws::{LEAST_DECIDING, Scheme};
use super::intervals::{
    CAUTION, CellIntervals, Ends, p_of, p_value, power_of,
};
use super::refutation::refuted_cells;
use rocking_common::findings::{
    CellCounts, ClaimResult, Detail, ERROR, IntervalMethod, LEVEL, Quantifier,
    Region, Unit,
};
use rocking_common::paper::ClaimVerdict;
use rocking_statistics::confidence::Confidence;
use rocking_statistics::{Estimate, Range};

/// Where the cells of a claim have to lie, and how many of them.
#[derive(Clone, Copy, Debug)]
pub struct ClaimRule {
    /// How many of them.
    pub quantifier: Quantifier,
    /// Where they have to lie.
    pub region: Region,
    /// Unit of a cell.
    pub unit: Unit,
    /// The numbers that a cell can have: from 0 to 1 for a share.
    pub range: Range,
}

/// A cell's name, and how many records are in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Where it is: `p = 3, alpha = 0.20`.
    pub at: String,
    /// Records whose values are in it.
    pub records: usize,
}

/// Fills in the verdict, with the value and the interval that decide.
pub(super) fn decide(
    result: &mut ClaimResult,
    value: f64,
    ends: &Ends,
    region: Region,
    verdict: ClaimVerdict,
) {
    result.estimate = ends.beside(value);
    result.monte_carlo_error = ends.deciding_error(region);
    result.interval = Some(ends.way);
    result.by_equivalence = Some(verdict);
}

/// A cell that decides: its place, and its own interval.
struct DecidingCell {
    k: usize,
    ends: Ends,
}

/// Fills in a result over many cells.
pub(super) fn judge_many(
    rule: &ClaimRule,
    cells: &[Cell],
    known: &CellIntervals<'_>,
    caution: f64,
    result: &mut ClaimResult,
) {
    let deciding = deciding(cells, known);
    if deciding.is_empty() {
        result.at = "no cell has an interval".into();
        let (inside, outside, too_few) = (0, 0, cells.len());
        let deciding = 0;
        result.cells = Some(CellCounts { deciding, inside, outside, too_few });
        return;
    }
    let mut shown = vec![false; cells.len()];
    for cell in &deciding {
        shown[cell.k] =
            cell.ends.verdict(rule.region, caution) == ClaimVerdict::Confirmed;
    }
    let among = |k: usize| deciding.iter().any(|cell| cell.k == k);
    let left_out: Vec<bool> =
        (0..cells.len()).map(|k| shown[k] || !among(k)).collect();
    let refuted = refuted_cells(known, rule.region, &left_out, caution);
    let outside = refuted.out.iter().filter(|out| **out).count();
    let mut counts = CellCounts {
        deciding: deciding.len(),
        inside: shown.iter().filter(|shown| **shown).count(),
        outside,
        too_few: cells.len() - deciding.len(),
    };
    if rule.quantifier == Quantifier::All {
        let verdict = match counts {
            _ if outside > 0 => ClaimVerdict::NotConfirmed,
            _ if counts.inside == deciding.len() => ClaimVerdict::Confirmed,
            _ => ClaimVerdict::Inconclusive,
        };
        let bears = |cell: &&DecidingCell| match verdict {
            ClaimVerdict::NotConfirmed => refuted.out[cell.k],
            ClaimVerdict::Confirmed => true,
            ClaimVerdict::Inconclusive => !shown[cell.k],
        };
        let ends_of =
            |cell: &DecidingCell| refuted.ends[cell.k].unwrap_or(cell.ends);
        let Some(worst) =
            worst(deciding.iter().filter(bears), rule.region, &ends_of)
        else {
            return;
        };
        let ends = ends_of(worst);
        let value = known.measured.points[worst.k];
        decide(result, value, &ends, rule.region, verdict);
        result.at = named(&cells[worst.k], known);
        if caution == CAUTION {
            // All cells are shown to lie inside where the last one is.
            let inside = |caution| {
                let each = deciding.iter().map(|cell| {
                    let records = cells[cell.k].records;
                    let ends = |level| known.cell(cell.k, records, level);
                    let wanted = ClaimVerdict::Confirmed;
                    p_value(ends, rule.region, wanted, ERROR, caution)
                });
                each.fold(0.0, |most, p| if p > most { p } else { most })
            };
            result.p = match verdict {
                ClaimVerdict::Confirmed => inside(0.0),
                ClaimVerdict::NotConfirmed => refuted.p,
                ClaimVerdict::Inconclusive => {
                    let p = inside(CAUTION);
                    if p < refuted.p { p } else { refuted.p }
                }
            };
            if verdict == ClaimVerdict::Inconclusive {
                let level = refuted.level[worst.k];
                result.power = known.power(worst.k, &ends, level, rule.region);
            }
        }
    } else {
        counts.inside = discovered(rule.region, cells, known, &deciding);
        let drawn = drawn(&deciding, cells);
        judge_share(rule, &drawn, known, caution, result);
        let ends_of = |cell: &DecidingCell| cell.ends;
        let worst = worst(drawn.into_iter(), rule.region, &ends_of);
        result.deciding_cell = worst.map(|cell| Detail {
            name: named(&cells[cell.k], known),
            estimate: known.shown(cell.k, Some(cell.ends)),
        });
    }
    result.cells = Some(counts);
    if let Region::Within(a, b) = rule.region
        && known.measured.scheme == Scheme::Bootstrap
    {
        let drawn = drawn(&deciding, cells);
        details(&drawn, known, 0.5 * (a + b), result);
    }
}

/// Cells with a value and an interval of their own.
fn deciding(cells: &[Cell], known: &CellIntervals<'_>) -> Vec<DecidingCell> {
    let of = |(k, cell): (usize, &Cell)| {
        let ends = known.cell(k, cell.records, LEVEL)?;
        let there = known.measured.points[k].is_finite();
        there.then_some(DecidingCell { k, ends })
    };
    cells.iter().enumerate().filter_map(of).collect()
}

/// Those whose replicates count. The median of few records wanders in a
/// bootstrap: cells of few are judged by their exact intervals, and do not
/// enter a share or a quantile over cells.
fn drawn<'a>(
    deciding: &'a [DecidingCell],
    cells: &[Cell],
) -> Vec<&'a DecidingCell> {
    let enough =
        |cell: &&DecidingCell| cells[cell.k].records >= LEAST_DECIDING;
    deciding.iter().filter(enough).collect()
}

/// The name of a cell; of few records, whose they are.
fn named(cell: &Cell, known: &CellIntervals<'_>) -> String {
    match known.are_few(cell.records) {
        true => format!("{}, of the {} survivors", cell.at, cell.records),
        false => cell.at.clone(),
    }
}

/// The cell whose interval reaches furthest to the wrong side.
fn worst<'a>(
    cells: impl Iterator<Item = &'a DecidingCell>,
    region: Region,
    ends_of: &impl Fn(&DecidingCell) -> Ends,
) -> Option<&'a DecidingCell> {
    let reach = |cell: &DecidingCell| {
        // As the method gives it: ends that the range limits are equal.
        let (a, b) = ends_of(cell).interval.ends();
        let (a, b) = (region.badness(a), region.badness(b));
        let reach = if a > b { a } else { b };
        // An endless interval has no reach to be compared.
        (reach.is_finite(), reach)
    };
    cells.max_by(|a, b| {
        let ((known_a, a), (known_b, b)) = (reach(a), reach(b));
        known_a.cmp(&known_b).then(a.total_cmp(&b))
    })
}

/// Number of cells shown to lie inside with a false discovery rate of
/// [`ERROR`]: the largest k whose share of that level shows k cells
/// (Benjamini and Hochberg, J. R. Statist. Soc. B 57 (1995) 289).
fn discovered(
    region: Region,
    cells: &[Cell],
    known: &CellIntervals<'_>,
    deciding: &[DecidingCell],
) -> usize {
    let total = deciding.len() as f64;
    let mut count = deciding.len();
    loop {
        let level = 1.0 - 2.0 * ERROR * count as f64 / total;
        let inside = |cell: &&DecidingCell| {
            let ends = known.cell(cell.k, cells[cell.k].records, level);
            ends.is_some_and(|ends| {
                let (low, high) = ends.within().ends();
                region.verdict(low, high) == ClaimVerdict::Confirmed
            })
        };
        let found = deciding.iter().filter(inside).count();
        if found >= count {
            return count;
        }
        count = found;
    }
}

/// The share of the cells in the region, with its interval.
fn judge_share(
    rule: &ClaimRule,
    deciding: &[&DecidingCell],
    known: &CellIntervals<'_>,
    caution: f64,
    result: &mut ClaimResult,
) {
    let total = deciding.len() as f64;
    // A cell without a value in a replicate lies outside.
    let of = |row: &[f64]| {
        let holds = |cell: &&&DecidingCell| rule.region.holds(row[cell.k]);
        deciding.iter().filter(holds).count() as f64 / total
    };
    let value = of(&known.measured.points);
    let values: Vec<f64> =
        known.measured.replicates.iter().map(|row| of(row)).collect();
    result.estimate = Estimate::exact(value);
    result.unit = Unit::Share;
    result.at = "share of the cells of 30 records or more".into();
    let Some(confidence) = Confidence::new(value, &values, &[]) else {
        // No cell of enough records.
        return;
    };
    let ends = |level: f64| {
        let found =
            confidence.interval_of_share(value, known.clusters, level)?;
        Some(Ends {
            interval: found.interval,
            errors: (found.low_error, found.high_error),
            range: Range::Share,
            way: IntervalMethod::ShareOfCells,
        })
    };
    let Some(own) = ends(LEVEL) else { return };
    let region = match rule.quantifier {
        Quantifier::Most => Region::Above(0.5),
        _ => Region::Within(0.9, 1.0),
    };
    let verdict = own.verdict(region, caution);
    decide(result, value, &own, region, verdict);
    if caution == CAUTION {
        result.p = p_of(ends, region, verdict);
        if verdict == ClaimVerdict::Inconclusive {
            let deviations = known.clusters.deviations(value, &values);
            let student = known.clusters.student_over_normal(LEVEL);
            result.power = power_of(value, &own, student, &deviations, region);
        }
    }
}

/// The middle and the 90 % value over the cells of the distance from the
/// region's middle. Scatter only raises such a distance, in a replicate more
/// than in the sample: its percentiles are reflected at the value.
fn details(
    deciding: &[&DecidingCell],
    known: &CellIntervals<'_>,
    middle: f64,
    result: &mut ClaimResult,
) {
    for (name, share) in [("median", 0.5), ("90 %", 0.9)] {
        let over = |row: &[f64]| {
            let mut away: Vec<f64> = deciding
                .iter()
                .map(|cell| (row[cell.k] - middle).abs())
                .filter(|x| x.is_finite())
                .collect();
            away.sort_by(f64::total_cmp);
            let place = (share * away.len() as f64).ceil() as usize;
            away.get(place.saturating_sub(1)).copied().unwrap_or(f64::NAN)
        };
        let rows = &known.measured.replicates;
        let values: Vec<f64> = rows.iter().map(|row| over(row)).collect();
        let value = over(&known.measured.points);
        let confidence = Confidence::new(value, &values, &[]);
        let estimate = confidence.and_then(|own| {
            let plain = own.interval(known.clusters.half_width(LEVEL))?;
            let reflected = plain.interval.map(|x| 2.0 * value - x);
            let range = Range::NotNegative;
            Estimate::beside(value, reflected.within(range), range).ok()
        });
        let words = "over the cells of the distance from";
        result.details.push(Detail {
            name: format!("{name} {words} {middle}"),
            estimate: estimate.unwrap_or(Estimate::exact(value)),
        });
    }
}
