//! Section 4, Figures 6, 7 and 9, and resurrections: measures on stripes of
//! equal intensity.

use libm::log;

use super::scope::{
    self, CellValues, Criterion, MeasureCells, MeasureResult, Scope, block,
    blocks, compared_blocks, weighted_count,
};
use crate::analyses::{StripeDemands, SuiteResults};
use crate::facts::Facts;
use crate::inference::{Cell, LEAST_DECIDING, Replicates, Resample};
use crate::results::StudyResults;
use crate::stripes::{adjusted_slenderness, is_within};
use rocking_common::findings::SuiteSet;
use rocking_common::paper::{
    Arm, BLOCKS, FREQUENCIES_RAD_S, SLENDERNESSES_RAD, STRIPES, SuiteKind,
    closed_form, position,
};
use rocking_statistics::Proportion;
use rocking_statistics::resampling::RecordRanks;

/// Whether the notch about the median of a replicate covers 1: McGill, Tukey
/// and Larsen, Am. Stat. 32 (1978) 12.
fn notch_covers_1(values: &RecordRanks, counts: &[u32]) -> bool {
    let n = values.drawn(counts).len() as f64;
    let at = |p| values.quantile(counts, p);
    let half = 1.57 * (at(0.75) - at(0.25)) / n.sqrt();
    (at(0.5) - 1.0).abs() <= half
}

/// Cells of Figures 6 and 7 by block and stripe: ratios of demands to the
/// reference, over the closed form if `corrected`.
fn block_ratios(
    stripes: &StripeDemands,
    frequencies: &[usize],
    corrected: bool,
) -> Vec<CellValues> {
    let mut cells = Vec::new();
    let blocks = frequencies
        .iter()
        .flat_map(|own| compared_blocks().filter(move |(f, _)| f == own));
    for (frequency, slenderness) in blocks {
        let scale = match corrected {
            true => 1.0 / closed_form(SLENDERNESSES_RAD[slenderness]),
            false => 1.0,
        };
        let name = block(frequency, slenderness);
        for (im, a, b) in stripes.compared(frequency, Some(slenderness)) {
            let values = RecordRanks::new(&scope::ratios(a, b, scale));
            let at = format!("{name}, intensity {im}");
            cells.push(CellValues { at, values });
        }
    }
    cells
}

/// Cells of Figure 9 by frequency parameter and stripe: adjusted over scaled.
/// `part` changes the demand of a record on a stripe.
fn adjusted_cells(
    suite: &SuiteResults,
    stripes: &StripeDemands,
    part: impl Fn(f64, &Facts, f64) -> f64,
) -> Vec<CellValues> {
    let mut cells = Vec::new();
    for (frequency, p) in FREQUENCIES_RAD_S.iter().enumerate() {
        for (im, a, b) in stripes.compared(frequency, None) {
            let records = a.iter().zip(&suite.records);
            let own: Vec<f64> =
                records.map(|(x, record)| part(*x, record, im)).collect();
            let at = format!("p = {p}, intensity {im}");
            cells.push(CellValues::ratios(at, &own, b));
        }
    }
    cells
}

/// Cells of Figure 9, the closed form divided out record by record: each has
/// an adjusted slenderness of its own.
fn adjusted_without_closed_form(
    suite: &SuiteResults,
    stripes: &StripeDemands,
) -> Vec<CellValues> {
    adjusted_cells(suite, stripes, |x, record, im| {
        x / closed_form(adjusted_slenderness(record, im))
    })
}

/// Medians of cells over all draws, with the share of notches that cover 1.
fn medians(scope: &Scope<'_>, cells: Vec<CellValues>) -> MeasureCells {
    let name = "share of the cells whose notch covers 1";
    let criterion = notches(scope, &cells, name, |_| true);
    MeasureCells { criterion: Some(criterion), ..scope.medians(cells) }
}

/// The share of the deciding cells whose notch covers 1 where it has to, and
/// leaves 1 out where not.
fn notches(
    scope: &Scope<'_>,
    cells: &[CellValues],
    name: &str,
    covers: impl Fn(&CellValues) -> bool + Sync,
) -> Criterion {
    let kind = scope.kind();
    let enough = |r: &&CellValues| r.values.records() >= LEAST_DECIDING;
    let of = |draw: Resample<'_>| {
        let counts = draw.of(kind);
        let deciding = || cells.iter().filter(enough);
        let as_said = deciding()
            .filter(|r| notch_covers_1(&r.values, counts) == covers(r));
        vec![as_said.count() as f64 / deciding().count() as f64]
    };
    let measured = scope.draws.subsampled(scope.tested, &of);
    Criterion { name: name.into(), measured }
}

/// Cells of Figures 6, 7 and 9 by name, with the median ratio once the
/// small-rotation limit of Eq. 1 is divided out.
#[must_use]
pub fn without_closed_form(
    results: &StudyResults,
    tested: SuiteSet,
    arm: Arm,
) -> Vec<(String, f64)> {
    let kind = match tested {
        SuiteSet::Ordinary => SuiteKind::Ordinary,
        SuiteSet::PulseType => SuiteKind::PulseType,
        SuiteSet::None | SuiteSet::Both => return Vec::new(),
    };
    let suite = results.suite(kind);
    let Ok(stripes) = suite.stripes(arm) else { return Vec::new() };
    let mut cells = block_ratios(stripes, &[0, 1, 2], true);
    cells.extend(adjusted_without_closed_form(suite, stripes));
    let every = vec![1; suite.records.len()];
    let median = |r: CellValues| (r.at, r.values.median(&every));
    cells.into_iter().map(median).collect()
}

/// The paper's exception: alpha = 0.25 on the lowest stripe, p = 1.
fn exception() -> String {
    let stocky = SLENDERNESSES_RAD.len() - 1;
    format!("{}, intensity {}", block(0, stocky), STRIPES[0])
}

/// Medians of Figures 6 and 7, without the paper's exception.
pub(super) fn ratios(
    scope: &Scope<'_>,
    frequencies: &[usize],
) -> MeasureResult {
    let exception = exception();
    let mut cells = block_ratios(scope.stripes()?, frequencies, false);
    cells.retain(|r| r.at != exception);
    Ok(medians(scope, cells))
}

/// The median of the paper's exception. By the paper's criterion it is the
/// only one: its notch leaves 1 out, and every other of p = 1 covers 1.
pub(super) fn only_exception(scope: &Scope<'_>) -> MeasureResult {
    let exception = exception();
    let mut cells = block_ratios(scope.stripes()?, &[0], false);
    let name = "share of the cells that come out as this sentence says";
    let criterion = notches(scope, &cells, name, |r| r.at != exception);
    cells.retain(|r| r.at == exception);
    Ok(MeasureCells { criterion: Some(criterion), ..scope.medians(cells) })
}

/// How much more the records of smaller demands deviate than the others,
/// where the paper sees its exception: the median distance of the ratio from
/// 1 of the half with smaller demands over the median of the other half.
pub(super) fn small_amplitudes(scope: &Scope<'_>) -> MeasureResult {
    let stocky = SLENDERNESSES_RAD.len() - 1;
    let lowest = scope.stripes()?.compared(0, Some(stocky)).next();
    let (_, own, reference) = lowest.unwrap_or_default();
    let middle = RecordRanks::new(reference).median(&vec![1; reference.len()]);
    let half = |small: bool| {
        let ratios = scope::ratios(own, reference, 1.0);
        let away = ratios.iter().zip(reference).map(|(ratio, demand)| {
            match (*demand < middle) == small {
                true => (ratio - 1.0).abs(),
                false => f64::NAN,
            }
        });
        RecordRanks::new(&away.collect::<Vec<f64>>())
    };
    let (small, large) = (half(true), half(false));
    let records = small.records() + large.records();
    Ok(scope.value(&exception(), records, |counts| {
        small.median(counts) / large.median(counts)
    }))
}

/// Medians of Figures 6 and 7, the closed form divided out.
pub(super) fn corrected(scope: &Scope<'_>) -> MeasureResult {
    let cells = block_ratios(scope.stripes()?, &[0, 1, 2], true);
    Ok(medians(scope, cells))
}

/// Medians of Figure 9, the closed form divided out record by record.
pub(super) fn adjusted_corrected(scope: &Scope<'_>) -> MeasureResult {
    let stripes = scope.stripes()?;
    let cells = adjusted_without_closed_form(scope.suite(), stripes);
    Ok(medians(scope, cells))
}

/// Medians of Figure 9: all records, or those whose adjusted slenderness is
/// `within` the paper's largest, or those above it.
pub(super) fn adjusted(
    scope: &Scope<'_>,
    within: Option<bool>,
) -> MeasureResult {
    let part = |x, record: &Facts, im| match within {
        Some(within) if within != is_within(record, im) => f64::NAN,
        _ => x,
    };
    let stripes = scope.stripes()?;
    Ok(medians(scope, adjusted_cells(scope.suite(), stripes, part)))
}

/// Share of resurrections, large minus small blocks.
pub(super) fn again_by_size(scope: &Scope<'_>) -> MeasureResult {
    let large = |f: usize, _: usize| Some(f == 0);
    again_apart(scope, "p = 1 minus p = 3 and 4", large)
}

/// Share of resurrections, stocky minus slender blocks.
pub(super) fn again_by_slenderness(scope: &Scope<'_>) -> MeasureResult {
    let at = "alpha = 0.20 and 0.25 minus 0.05 and 0.10";
    again_apart(scope, at, |_, s| (s != 2).then_some(s > 2))
}

/// Share of the ratios of all cells that lie more than 10 % from 1.
pub(super) fn outliers(scope: &Scope<'_>) -> MeasureResult {
    let cells = block_ratios(scope.stripes()?, &[0, 1, 2], false);
    let n = scope.records();
    let (mut far, mut all) = (vec![0_u32; n], vec![0_u32; n]);
    for (x, record) in cells.iter().flat_map(|r| r.values.each()) {
        all[record] += 1;
        far[record] += u32::from((x - 1.0).abs() > 0.10);
    }
    Ok(scope.share("ratios further than 10 % from 1", &far, &all))
}

/// By block and stripe, the share of the records that overturned at or below
/// and stand there again.
pub(super) fn probabilities(scope: &Scope<'_>) -> MeasureResult {
    let stripes = scope.stripes()?;
    let (mut cells, mut counts) = (Vec::new(), Vec::new());
    for (frequency, slenderness) in blocks() {
        let own = &stripes.stands_again[position(frequency, slenderness)];
        let name = block(frequency, slenderness);
        for (im, flags) in STRIPES.iter().zip(own) {
            let records = flags.len();
            let again = flags.iter().filter(|again| **again).count();
            counts.push(Proportion::try_new(again, records)?);
            cells
                .push(Cell { at: format!("{name}, intensity {im}"), records });
        }
    }
    Ok(MeasureCells::new(cells, Replicates::of_counts(counts)))
}

/// By block, the intensity at which half of the records lie overturned, with
/// resurrections over without; by interpolation in the logarithm of the
/// intensity between stripes.
pub(super) fn median_again(scope: &Scope<'_>) -> MeasureResult {
    let stripes = scope.stripes()?;
    let cells = blocks().map(|(f, s)| {
        let own = stripes.stands_again[position(f, s)].first();
        Cell { at: block(f, s), records: own.map_or(0, Vec::len) }
    });
    let half = |counts: &[u32], lies: &dyn Fn(usize, usize) -> bool| -> f64 {
        let n = f64::from(counts.iter().sum::<u32>());
        let mut below: Option<(f64, f64)> = None;
        for (stripe, im) in STRIPES.iter().enumerate() {
            let overturned: u32 = (0..counts.len())
                .filter(|record| lies(stripe, *record))
                .map(|record| counts[record])
                .sum();
            let share = f64::from(overturned) / n;
            if share >= 0.5 {
                let (x0, y0) = below.unwrap_or((0.0, 0.0));
                let (x1, y1) = (log(*im), share);
                return x0 + (x1 - x0) * (0.5 - y0) / (y1 - y0);
            }
            below = Some((log(*im), share));
        }
        f64::NAN
    };
    let measured = scope.smooth(|counts| {
        let ratio = |at: usize| {
            let demands = &stripes.demands[at];
            let again = &stripes.stands_again[at];
            let first = |stripe: usize, record: usize| {
                let own = demands.get(stripe);
                own.is_some_and(|demands| demands[record].is_infinite())
            };
            let lies = |stripe: usize, record: usize| {
                first(stripe, record) && !again[stripe][record]
            };
            libm::exp(half(counts, &lies) - half(counts, &first))
        };
        (0..BLOCKS.len()).map(ratio).collect()
    });
    Ok(MeasureCells::new(cells.collect(), measured))
}

/// Share of the overturned that stand again: its value over the blocks that
/// are `first`, minus its value over those that are not.
fn again_apart(
    scope: &Scope<'_>,
    at: &str,
    first: impl Fn(usize, usize) -> Option<bool>,
) -> MeasureResult {
    let stripes = scope.stripes()?;
    let n = scope.records();
    // By part, by record: overturned, and standing again.
    let mut sums = [[(); 2]; 2].map(|part| part.map(|()| vec![0_u32; n]));
    for (frequency, slenderness) in blocks() {
        let Some(first) = first(frequency, slenderness) else { continue };
        let [overturned, standing] = &mut sums[usize::from(first)];
        let at = position(frequency, slenderness);
        let own = stripes.demands[at].iter().zip(&stripes.stands_again[at]);
        for (demands, again) in own {
            for record in 0..n {
                overturned[record] += u32::from(demands[record].is_infinite());
                standing[record] += u32::from(again[record]);
            }
        }
    }
    Ok(scope.value(at, n, |counts| {
        let share = |[overturned, standing]: &[Vec<u32>; 2]| {
            weighted_count(standing, counts)
                / weighted_count(overturned, counts)
        };
        share(&sums[1]) - share(&sums[0])
    }))
}
