//! Section 5, Figures 12 to 14: measures of the distance from a lognormal.
//!
//! The paper counts the levels that the test accepts. The effect is the mean
//! over demand levels and blocks of Lilliefors' D minus its mean for a lognormal
//! of equal size: the distance of the capacities from a lognormal in probability.

use super::scope::{MeasureResult, Measured, Scope};
use crate::distances::{
    OF_EARLIEST, SLENDER, SuiteDistances, TestSeries, TestedMeasure,
};
use crate::estimates::mean;
use crate::runs::not_run;
use rocking_common::findings::SampleCount;
use rocking_common::paper::{Intensity, SLENDERNESSES_RAD, demands, position};
use rocking_statistics::Estimate;

/// The block that the paper compares with `SLENDER`: p = 3, alpha = 0.20.
const LESS_SLENDER: (usize, usize) = (1, 3);

/// Mean over the blocks.
fn over_blocks(values: &[f64]) -> f64 {
    mean(values.iter().copied())
}

/// Mean of the first minus the second over the blocks that have both.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    mean(a.iter().zip(b).map(|(a, b)| a - b))
}

/// How many blocks have an accepted share above a limit.
fn above(shares: &[f64], limit: f64) -> SampleCount {
    let tested = shares.iter().filter(|x| x.is_finite());
    SampleCount::among(tested, |x| *x > limit)
}

/// The distances of the scope's suite and grid.
fn of_source<'a>(scope: &Scope<'a>) -> anyhow::Result<&'a SuiteDistances> {
    let (kind, arm) = (scope.kind(), scope.arm);
    let is = |d: &&SuiteDistances| d.suite == kind && d.arm == arm;
    scope.distances.iter().find(is).ok_or_else(|| not_run(arm))
}

/// An effect of the excesses, and counts of the accepted shares of the whole
/// sample.
fn found(
    scope: &Scope<'_>,
    counts: impl Fn(&[f64]) -> Vec<SampleCount>,
    effect: impl Fn(&[f64]) -> f64,
) -> MeasureResult {
    let source = of_source(scope)?;
    let all = demands().len();
    let untested = source.levels.iter().filter(|n| **n < all).count();
    let mut at = String::from("all 15 blocks");
    if untested > 0 {
        let least = source.levels.iter().min().unwrap_or(&0);
        at += &format!(
            "; {untested} of them have levels that some record never \
             reaches, and {least} or more of {all} levels are tested"
        );
    }
    let effect = source.replicated.one(effect);
    Ok(Measured::new(counts(&source.replicated.points), effect, at))
}

/// Mean excess of the blocks.
fn mean_excess(tests: TestSeries) -> impl Fn(&[f64]) -> f64 {
    move |row| over_blocks(tests.excesses(row))
}

/// Mean accepted share of the blocks.
fn mean_share(row: &[f64], tests: TestSeries) -> f64 {
    over_blocks(tests.accepted(row))
}

/// Mean excess of the blocks by one series of tests minus the mean by another.
fn reduction(from: TestSeries, to: TestSeries) -> impl Fn(&[f64]) -> f64 {
    move |row| apart(from.excesses(row), to.excesses(row))
}

/// Mean accepted share by one series of tests minus the mean by another.
fn gain_in_share(
    row: &[f64],
    of: TestSeries,
    over: TestSeries,
) -> SampleCount {
    SampleCount::number(apart(of.accepted(row), over.accepted(row)))
}

/// Adds the mean accepted shares of two series of tests as details.
fn beside(
    scope: &Scope<'_>,
    mut found: Measured,
    shares: [(&str, TestSeries); 2],
) -> MeasureResult {
    let points = &of_source(scope)?.replicated.points;
    for (name, tests) in shares {
        let share = Estimate::exact(mean_share(points, tests));
        found = found.and(&format!("mean accepted share, {name}"), share);
    }
    Ok(found)
}

/// Accepted share of the block `SLENDER`.
fn slender_share(row: &[f64], tests: TestSeries) -> f64 {
    tests.accepted(row)[position(SLENDER.0, SLENDER.1)]
}

/// The intensity measure of the claim.
pub(super) fn tested(scope: &Scope<'_>) -> TestedMeasure {
    match scope.intensity {
        Intensity::Pgv => TestedMeasure::Pgv,
        _ => TestedMeasure::Pga,
    }
}

/// Distance of original samples from a lognormal.
pub(super) fn original(
    scope: &Scope<'_>,
    measure: TestedMeasure,
) -> MeasureResult {
    let tests = measure.original();
    let counts = |row: &[f64]| match measure {
        TestedMeasure::Pga => {
            vec![SampleCount::number(mean_share(row, tests))]
        }
        _ => vec![above(tests.accepted(row), 0.7)],
    };
    found(scope, counts, mean_excess(tests))
}

/// Distance of shifted samples from a lognormal.
pub(super) fn shifted(scope: &Scope<'_>) -> MeasureResult {
    let (original, tests) =
        (tested(scope).original(), tested(scope).shifted());
    let counts = |row: &[f64]| {
        let share = mean_share(row, tests);
        vec![
            SampleCount::number(share),
            gain_in_share(row, tests, original),
            SampleCount::number(1.0 - share),
        ]
    };
    found(scope, counts, mean_excess(tests))
}

/// Reduction of the distance by shifting.
pub(super) fn gain(
    scope: &Scope<'_>,
    measure: TestedMeasure,
) -> MeasureResult {
    let (original, shifted) = (measure.original(), measure.shifted());
    let counts = |row: &[f64]| {
        let gain = gain_in_share(row, shifted, original);
        match measure {
            TestedMeasure::Pgv => {
                vec![above(shifted.accepted(row), 0.9), gain]
            }
            _ => vec![gain],
        }
    };
    let found = found(scope, counts, reduction(original, shifted))?;
    beside(scope, found, [("original", original), ("shifted", shifted)])
}

/// Reduction of the distance of original samples by PGV instead of PGA.
pub(super) fn pgv_gain(scope: &Scope<'_>) -> MeasureResult {
    let [pga, pgv] =
        [TestedMeasure::Pga, TestedMeasure::Pgv].map(TestedMeasure::original);
    let counts = |row: &[f64]| vec![gain_in_share(row, pgv, pga)];
    let found = found(scope, counts, reduction(pga, pgv))?;
    beside(scope, found, [("PGA", pga), ("PGV", pgv)])
}

/// Change of the distance by the geometric mean's intensity.
pub(super) fn geometric_mean(scope: &Scope<'_>) -> MeasureResult {
    let own = TestedMeasure::Pga.shifted();
    let mean = TestedMeasure::GeometricMean;
    let (original, mean) = (mean.original(), mean.shifted());
    let counts = |row: &[f64]| vec![gain_in_share(row, mean, original)];
    let found = found(scope, counts, reduction(mean, own))?;
    beside(scope, found, [("component", own), ("geometric mean", mean)])
}

/// Distance of original samples for p = 3 and 4 minus the distance for p = 1.
pub(super) fn small_minus_large(scope: &Scope<'_>) -> MeasureResult {
    let apart = |values: &[f64]| {
        let (large, small) = values.split_at(SLENDERNESSES_RAD.len());
        over_blocks(small) - over_blocks(large)
    };
    let tests = TestedMeasure::Pga.original();
    let counts =
        |row: &[f64]| vec![SampleCount::number(-apart(tests.accepted(row)))];
    found(scope, counts, |row| apart(tests.excesses(row)))
}

/// Distance for alpha = 0.05, p = 3, shifted sample in PGA.
pub(super) fn slender(scope: &Scope<'_>) -> MeasureResult {
    let pga = TestedMeasure::Pga;
    let counts = |row: &[f64]| {
        let number = |tests| SampleCount::number(slender_share(row, tests));
        [pga.original(), pga.shifted()].map(number).into()
    };
    let at = pga.shifted().place(SLENDER);
    found(scope, counts, |row| row[at])
}

/// An effect whose statement rests on the rejection of the shifted sample of
/// the block `SLENDER`: without the rejection the statement is not testable.
fn if_rejected(
    scope: &Scope<'_>,
    number: impl Fn(&[f64]) -> f64,
    effect: impl Fn(&[f64]) -> f64,
) -> MeasureResult {
    let share = |row: &[f64]| slender_share(row, TestedMeasure::Pga.shifted());
    let counts = |row: &[f64]| {
        let rejected = share(row) < 0.1;
        let found = if rejected { number(row) } else { f64::NAN };
        vec![SampleCount::number(found)]
    };
    let accepted = share(&of_source(scope)?.replicated.points);
    let found = found(scope, counts, effect)?;
    let name = "accepted levels, shifted sample of alpha = 0.05";
    Ok(found.and(name, Estimate::exact(accepted)))
}

/// Distance for alpha = 0.05 minus the distance for 0.20, p = 3, shifted
/// samples in PGA.
pub(super) fn less_slender(scope: &Scope<'_>) -> MeasureResult {
    let tests = TestedMeasure::Pga.shifted();
    let gain = |row: &[f64]| {
        let other = position(LESS_SLENDER.0, LESS_SLENDER.1);
        tests.accepted(row)[other] - slender_share(row, tests)
    };
    let places = [SLENDER, LESS_SLENDER].map(|block| tests.place(block));
    if_rejected(scope, gain, |row| row[places[0]] - row[places[1]])
}

/// Reduction of the distance without the three earliest overturnings.
pub(super) fn earliest_removed(scope: &Scope<'_>) -> MeasureResult {
    let gain = |row: &[f64]| row[OF_EARLIEST];
    if_rejected(scope, gain, gain)
}
