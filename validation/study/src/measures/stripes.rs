//! Section 4, Figures 6, 7 and 9, and resurrections: measures on stripes of
//! equal intensity.

use libm::log;

use super::scope::{
    self, COINCIDE, MeasureResult, Measured, Scope, Tally, compared_blocks,
    geometric_mean, weighted_count,
};
use crate::analyses::StripeDemands;
use crate::facts::Facts;
use crate::stripes::{adjusted_slenderness, is_within};
use rocking_common::findings::SampleCount;
use rocking_common::paper::{
    BLOCKS, FREQUENCIES_RAD_S, SLENDERNESSES_RAD, STRIPES, closed_form,
};
use rocking_statistics::resampling::RecordRanks;
use rocking_statistics::{Estimate, Range};

/// Position of the stockiest slenderness.
pub(super) const STOCKIEST: usize = SLENDERNESSES_RAD.len() - 1;

/// All slendernesses.
const ALL: [usize; SLENDERNESSES_RAD.len()] = [0, 1, 2, 3, 4];

/// Whether the notch about the median contains 1: McGill, Tukey and Larsen, Am.
/// Stat. 32 (1978) 12.
pub(super) fn notch_holds_1(values: &RecordRanks, counts: &[u32]) -> bool {
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
    slendernesses: &[usize],
    corrected: bool,
) -> Vec<RecordRanks> {
    let mut cells = Vec::new();
    let of = |(f, s): &(usize, usize)| {
        frequencies.contains(f) && slendernesses.contains(s)
    };
    for (frequency, slenderness) in compared_blocks().filter(of) {
        let scale = match corrected {
            true => 1.0 / closed_form(SLENDERNESSES_RAD[slenderness]),
            false => 1.0,
        };
        let levels = stripes.compared(frequency, Some(slenderness));
        cells.extend(levels.map(|(_, a, b)| scope::ranks(a, b, scale)));
    }
    cells
}

/// Cells of Figure 9 by frequency parameter and stripe: adjusted over scaled.
/// `part` changes the demand of a record on a stripe.
fn adjusted_cells(
    scope: &Scope<'_>,
    part: impl Fn(f64, &Facts, f64) -> f64,
) -> anyhow::Result<Vec<RecordRanks>> {
    let stripes = scope.stripes()?;
    let mut cells = Vec::new();
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        for (im, a, b) in stripes.compared(frequency, None) {
            let records = a.iter().zip(&scope.suite().records);
            let own: Vec<f64> =
                records.map(|(x, record)| part(*x, record, im)).collect();
            cells.push(scope::ranks(&own, b, 1.0));
        }
    }
    Ok(cells)
}

/// Cells of Figure 9, the closed form divided out record by record, at the
/// adjusted slenderness of each record.
fn without_closed_form(scope: &Scope<'_>) -> anyhow::Result<Vec<RecordRanks>> {
    adjusted_cells(scope, |x, record, im| {
        x / closed_form(adjusted_slenderness(record, im))
    })
}

/// Number of cells whose notch contains 1.
fn notches(scope: &Scope<'_>, cells: &[RecordRanks]) -> SampleCount {
    SampleCount::among(cells, |cell| notch_holds_1(cell, scope.every()))
}

/// Number of cells whose median lies within this distance of 1.
fn near_1(
    scope: &Scope<'_>,
    cells: &[RecordRanks],
    within: f64,
) -> SampleCount {
    let is_near = |x: f64| (x - 1.0).abs() <= within;
    SampleCount::among(cells, |cell| is_near(cell.median(scope.every())))
}

/// The largest distance of the median of a cell from 1.
fn furthest(scope: &Scope<'_>, cells: &[RecordRanks]) -> Estimate {
    let away = |cell: &RecordRanks| (cell.median(scope.every()) - 1.0).abs();
    let all = cells.iter().map(away).filter(|x| x.is_finite());
    Estimate::exact(all.reduce(f64::max).unwrap_or(f64::NAN))
}

/// Place of a measurement over these cells.
fn place(cells: &[RecordRanks]) -> String {
    format!("{} cells that count", cells.len())
}

const FURTHEST: &str = "largest distance of a median ratio from 1";

/// Median ratios that conform to 1 by their notches, over the cells that
/// count. The effect is the median of the cells in `effect`.
pub(super) fn conforming(
    scope: &Scope<'_>,
    cells: Vec<RecordRanks>,
    effect: Vec<RecordRanks>,
) -> Measured {
    let cells = scope.counted(cells);
    let effect = scope.mean_median(&scope.counted(effect));
    Measured::new([notches(scope, &cells)], effect, place(&cells))
        .and(FURTHEST, furthest(scope, &cells))
}

/// Cell of the paper's exception: alpha = 0.25 on the lowest stripe, p = 1.
fn exception(scope: &Scope<'_>) -> anyhow::Result<Vec<RecordRanks>> {
    let mut own = block_ratios(scope.stripes()?, &[0], &[STOCKIEST], false);
    own.truncate(1);
    Ok(own)
}

/// The cells of p = 1 without the exception.
fn without_exception(stripes: &StripeDemands) -> Vec<RecordRanks> {
    let mut cells = block_ratios(stripes, &[0], &ALL[..STOCKIEST], false);
    let stocky = block_ratios(stripes, &[0], &[STOCKIEST], false);
    cells.extend(stocky.into_iter().skip(1));
    cells
}

/// Medians of Figure 6, without the paper's exception.
pub(super) fn ratios_large(scope: &Scope<'_>) -> MeasureResult {
    let stripes = scope.stripes()?;
    let effect = block_ratios(stripes, &[0], &[STOCKIEST], false);
    Ok(conforming(scope, without_exception(stripes), effect))
}

/// Medians of Figure 7.
pub(super) fn ratios_small(scope: &Scope<'_>) -> MeasureResult {
    let of = |slendernesses: &[usize]| {
        let stripes = scope.stripes()?;
        anyhow::Ok(block_ratios(stripes, &[1, 2], slendernesses, false))
    };
    Ok(conforming(scope, of(&ALL)?, of(&[STOCKIEST])?))
}

const LOWEST: &str = "p = 1, alpha = 0.25, lowest stripe";

/// The paper's exception: its notch leaves 1 out, and every other notch of p = 1
/// contains 1.
pub(super) fn only_exception(scope: &Scope<'_>) -> MeasureResult {
    let own = exception(scope)?;
    let holds = |cell| notch_holds_1(cell, scope.every());
    let leaves_out = SampleCount::among(&own, |cell| !holds(cell));
    let others = scope.counted(without_exception(scope.stripes()?));
    let counts = [leaves_out, notches(scope, &others)];
    Ok(Measured::new(counts, scope.mean_median(&own), LOWEST))
}

/// The median of the paper's exception.
pub(super) fn small_amplitudes(scope: &Scope<'_>) -> MeasureResult {
    let effect = scope.mean_median(&exception(scope)?);
    Ok(Measured::number(effect, LOWEST))
}

/// Largest distance from 1 of a median that conforms once the closed form is divided
/// out.
const CORRECTED: f64 = 0.005;

/// Medians with the closed form divided out, beside the plain medians. The effect
/// is the median of the plain cells in `effect`.
fn corrected_beside(
    scope: &Scope<'_>,
    [corrected, plain]: [Vec<RecordRanks>; 2],
    effect: [Vec<RecordRanks>; 2],
) -> Measured {
    let [corrected, plain] = [corrected, plain].map(|c| scope.counted(c));
    let share =
        |cells: &[RecordRanks]| Estimate::exact(notches(scope, cells).value);
    let counts = [near_1(scope, &corrected, CORRECTED)];
    let [left, effect] =
        effect.map(|own| scope.mean_median(&scope.counted(own)));
    Measured::new(counts, effect, place(&corrected))
        .and(
            "the same ratio of theta/sin(alpha)",
            scope.estimate(Range::NotNegative, &left),
        )
        .and(
            "notches that hold 1, sin(alpha)/alpha divided out",
            share(&corrected),
        )
        .and("notches that hold 1, as they are", share(&plain))
        .and(FURTHEST, furthest(scope, &plain))
        .and(
            "largest distance of a median ratio of theta/sin(alpha) from 1",
            furthest(scope, &corrected),
        )
}

/// Medians of Figures 6 and 7, the closed form divided out.
pub(super) fn corrected(scope: &Scope<'_>) -> MeasureResult {
    let stripes = scope.stripes()?;
    let both = |slendernesses: &[usize]| {
        [true, false].map(|corrected| {
            block_ratios(stripes, &[0, 1, 2], slendernesses, corrected)
        })
    };
    Ok(corrected_beside(scope, both(&ALL), both(&[STOCKIEST])))
}

/// Medians of Figure 9, the closed form divided out record by record.
pub(super) fn adjusted_corrected(scope: &Scope<'_>) -> MeasureResult {
    let cells =
        [without_closed_form(scope)?, adjusted_cells(scope, |x, _, _| x)?];
    Ok(corrected_beside(scope, cells.clone(), cells))
}

/// Largest distance from 1 of a number that rounds to 1.0.
const ROUNDED: f64 = 0.05;

/// Medians of Figure 9. The statement calls them practically identical: they
/// round to 1.0. The notches of the figure are a detail.
pub(super) fn adjusted(scope: &Scope<'_>) -> MeasureResult {
    let cells = scope.counted(adjusted_cells(scope, |x, _, _| x)?);
    let counts = [near_1(scope, &cells, ROUNDED)];
    let notches = Estimate::exact(notches(scope, &cells).value);
    Ok(Measured::new(counts, scope.mean_median(&cells), place(&cells))
        .and("notches that hold 1", notches)
        .and(FURTHEST, furthest(scope, &cells)))
}

/// Medians of Figure 9 over the records whose adjusted slenderness is at most
/// the paper's largest, and over the other records.
pub(super) fn adjusted_scope(scope: &Scope<'_>) -> MeasureResult {
    let part = |within: bool| {
        let cells = adjusted_cells(scope, |x, record, im| {
            if is_within(record, im) == within { x } else { f64::NAN }
        })?;
        anyhow::Ok(scope.counted(cells))
    };
    let (slender, stocky) = (part(true)?, part(false)?);
    let counts = [&slender, &stocky].map(|own| near_1(scope, own, ROUNDED));
    let at =
        format!("{} and {} cells that count", slender.len(), stocky.len());
    Ok(Measured::new(counts, scope.mean_median(&stocky), at))
}

/// Share of the ratios of all cells that lie more than 10 % from 1.
pub(super) fn outliers(scope: &Scope<'_>) -> MeasureResult {
    let cells = block_ratios(scope.stripes()?, &[0, 1, 2], &ALL, false);
    let mut far = Tally::new(scope.records());
    let mut beyond_whiskers = 0;
    for cell in &cells {
        let at = |p| cell.quantile(scope.every(), p);
        let (low, high) = (at(0.25), at(0.75));
        let reach = 1.5 * (high - low);
        for (x, record) in cell.each() {
            let lies = low - reach <= x && x <= high + reach;
            beyond_whiskers += usize::from(!lies);
            far.add(record, (x - 1.0).abs() > 0.10);
        }
    }
    let (beyond, all) = far.totals();
    let counts = [SampleCount::of(all - beyond, all)];
    let share = Estimate::exact(beyond_whiskers as f64 / all as f64);
    Ok(Measured::new(counts, far.share(scope), "all ratios")
        .and("beyond 1.5 times the interquartile range of their cell", share))
}

/// The largest drop of the probability of overturning by resurrections on any
/// stripe, in any block.
fn largest_drop(scope: &Scope<'_>, stripes: &StripeDemands) -> Estimate {
    let count = |flags: &&Vec<bool>| flags.iter().filter(|x| **x).count();
    // The first of equal stripes, from behind.
    let stripes = stripes.stands_again.iter().flatten().rev();
    let worst = stripes.max_by_key(count).into_iter().flatten();
    let stand: Vec<u32> = worst.map(|x| u32::from(*x)).collect();
    let drop = |counts: &[u32]| {
        weighted_count(&stand, counts) / f64::from(counts.iter().sum::<u32>())
    };
    scope.estimate(Range::Share, &scope.one(drop))
}

/// By block, the intensity at which half of the records lie overturned, with
/// resurrections over without. Between stripes the logarithm of the intensity is
/// interpolated.
pub(super) fn resurrections(scope: &Scope<'_>) -> MeasureResult {
    let stripes = scope.stripes()?;
    let ratios = |counts: &[u32]| -> Vec<f64> {
        (0..BLOCKS.len()).map(|at| stripes.median_again(at, counts)).collect()
    };
    let moves = |ratio: &f64| (ratio - 1.0).abs();
    let found: Vec<f64> = ratios(scope.every());
    let known = found.iter().filter(|ratio| ratio.is_finite());
    let counts = [SampleCount::among(known, |r| moves(r) < COINCIDE)];
    let measured = scope.smooth(ratios);
    let part = |from: usize, to: usize| {
        let own = measured.one(|row| geometric_mean(row[from..to].to_vec()));
        scope.estimate(Range::NotNegative, &own)
    };
    let (one, all) = (SLENDERNESSES_RAD.len(), BLOCKS.len());
    let effect = measured.one(|row| geometric_mean(row.to_vec()));
    Ok(Measured::new(counts, effect, "all blocks")
        .and("p = 1", part(0, one))
        .and("p = 3 and 4", part(one, all))
        .and(
            "largest drop of the probability of overturning",
            largest_drop(scope, stripes),
        ))
}

impl StripeDemands {
    /// Median overturning intensity of a block with resurrections over without,
    /// in a draw with these multiplicities.
    fn median_again(&self, block: usize, counts: &[u32]) -> f64 {
        let (demands, again) =
            (&self.demands[block], &self.stands_again[block]);
        let falls = |stripe: usize, record: usize| {
            demands[stripe][record].is_infinite()
        };
        let lies = |stripe: usize, record: usize| {
            falls(stripe, record) && !again[stripe][record]
        };
        libm::exp(
            half(demands.len(), counts, lies)
                - half(demands.len(), counts, falls),
        )
    }
}

/// Logarithm of the intensity at which half of the records lie overturned.
fn half(
    stripes: usize,
    counts: &[u32],
    lies: impl Fn(usize, usize) -> bool,
) -> f64 {
    let n = f64::from(counts.iter().sum::<u32>());
    let mut below = (0.0, 0.0);
    for (stripe, im) in STRIPES.iter().enumerate().take(stripes) {
        let of = |record: &usize| lies(stripe, *record);
        let own = (0..counts.len()).filter(of).map(|record| counts[record]);
        let (x1, y1) = (log(*im), f64::from(own.sum::<u32>()) / n);
        if y1 >= 0.5 {
            let (x0, y0) = below;
            return x0 + (x1 - x0) * (0.5 - y0) / (y1 - y0);
        }
        below = (x1, y1);
    }
    f64::NAN
}
