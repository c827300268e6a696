//! Section 5, Figures 12 to 14: measures of the distance from a lognormal.
//!
//! A cell is the mean over demand levels and blocks of Lilliefors' D less its
//! mean for a lognormal of as many records: how far in probability capacities
//! are from a lognormal. The accepted share, which the paper gives, stands
//! beside it.

use super::scope::{Criterion, MeasureCells, MeasureResult, Scope, block};
use crate::distances::{
    SLENDER, SuiteDistances, TestSeries, WITHOUT_EARLIEST, accepted, excesses,
    place,
};
use crate::estimates::mean;
use crate::inference::Cell;
use crate::runs::not_run;
use rocking_common::findings::Detail;
use rocking_common::paper::{Intensity, SLENDERNESSES_RAD, position};
use rocking_statistics::Estimate;

/// The block that the paper compares its badly performing one with: p = 3,
/// alpha = 0.20.
const LESS_SLENDER: (usize, usize) = (1, 3);

/// Mean over the blocks.
fn over_blocks(values: &[f64]) -> f64 {
    mean(values.iter().copied())
}

/// Mean over the blocks that have both of the first less the second.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    mean(a.iter().zip(b).map(|(a, b)| a - b))
}

/// Share of the blocks whose accepted share is above a limit.
fn above(shares: &[f64], limit: f64) -> f64 {
    let tested = shares.iter().filter(|x| x.is_finite()).count();
    let found = shares.iter().filter(|x| **x > limit).count();
    found as f64 / tested as f64
}

/// A number of a draw with its name.
type NamedNumber<'a> = (&'a str, &'a dyn Fn(&[f64]) -> f64);

/// Numbers of the excesses, by cell, with numbers of the accepted shares: the
/// details, and the one by which the paper judges.
fn of_cells(
    scope: &Scope<'_>,
    cells: &[String],
    f: impl Fn(&[f64]) -> Vec<f64>,
    details: &[NamedNumber<'_>],
    criterion: Option<NamedNumber<'_>>,
) -> MeasureResult {
    let replicated = &of_source(scope)?.replicated;
    let records = scope.records();
    let cell = |at: &String| Cell { at: at.clone(), records };
    let one = |of: &dyn Fn(&[f64]) -> f64| replicated.map(|row| vec![of(row)]);
    let detail = |(name, of): &NamedNumber<'_>| Detail {
        name: (*name).into(),
        estimate: Estimate::exact(one(of).point(0)),
    };
    Ok(MeasureCells {
        cells: cells.iter().map(cell).collect(),
        measured: replicated.map(f),
        criterion: criterion.map(|(name, of)| Criterion {
            name: name.into(),
            measured: one(of),
        }),
        details: details.iter().map(detail).collect(),
    })
}

/// The distances of the scope's suite and arm.
fn of_source<'a>(scope: &Scope<'a>) -> anyhow::Result<&'a SuiteDistances> {
    let (kind, arm) = (scope.kind(), scope.arm);
    let is = |d: &&SuiteDistances| d.suite == kind && d.arm == arm;
    scope.distances.iter().find(is).ok_or_else(|| not_run(arm))
}

/// One number of all blocks.
fn of_blocks(
    scope: &Scope<'_>,
    f: impl Fn(&[f64]) -> f64,
    details: &[NamedNumber<'_>],
    criterion: Option<NamedNumber<'_>>,
) -> MeasureResult {
    let levels = &of_source(scope)?.levels;
    let untested = levels.iter().filter(|(a, b)| a < b).count();
    let mut at = String::from("all 15 blocks");
    if untested > 0 {
        let least = levels.iter().map(|(a, _)| *a).min().unwrap_or(0);
        at += &format!(
            "; {untested} of them have levels that some record never \
             reaches, and {least} or more of 200 levels are tested"
        );
    }
    of_cells(scope, &[at], |row| vec![f(row)], details, criterion)
}

/// Mean accepted share of the blocks.
fn mean_share(tests: TestSeries) -> impl Fn(&[f64]) -> f64 {
    move |row| over_blocks(accepted(row, tests))
}

/// Mean excess of the blocks by one set of tests less the mean by another.
fn reduction(from: TestSeries, to: TestSeries) -> impl Fn(&[f64]) -> f64 {
    move |row| apart(excesses(row, from), excesses(row, to))
}

/// Accepted share of the block `SLENDER`.
fn slender_share(tests: TestSeries) -> impl Fn(&[f64]) -> f64 {
    move |row| accepted(row, tests)[position(SLENDER.0, SLENDER.1)]
}

fn tests_of(intensity: Intensity) -> anyhow::Result<(TestSeries, TestSeries)> {
    match intensity {
        Intensity::Pga => {
            Ok((TestSeries::OriginalPga, TestSeries::ShiftedPga))
        }
        Intensity::Pgv => {
            Ok((TestSeries::OriginalPgv, TestSeries::ShiftedPgv))
        }
        other => anyhow::bail!("{other}: expected pga or pgv"),
    }
}

const ORIGINAL: &str = "mean accepted share, original";
const SHIFTED: &str = "mean accepted share, shifted";

/// The excess of one set of tests, with the mean accepted share as a detail
/// or, by the limit that the paper names for PGV, the share of the blocks
/// above it as the criterion.
fn excess(
    scope: &Scope<'_>,
    tests: TestSeries,
    details: &[NamedNumber<'_>],
    limit: f64,
) -> MeasureResult {
    let mean = |row: &[f64]| over_blocks(excesses(row, tests));
    let name =
        format!("share of the blocks whose accepted share is above {limit}");
    let share = |row: &[f64]| above(accepted(row, tests), limit);
    let is_judged = scope.intensity == Intensity::Pgv;
    let criterion = is_judged.then_some((name.as_str(), &share as &_));
    of_blocks(scope, mean, details, criterion)
}

/// Distance of original samples from a lognormal.
pub(super) fn original(scope: &Scope<'_>) -> MeasureResult {
    let (tests, _) = tests_of(scope.intensity)?;
    let share = mean_share(tests);
    match scope.intensity {
        Intensity::Pga => {
            let mean = |row: &[f64]| over_blocks(excesses(row, tests));
            of_blocks(scope, mean, &[], Some((ORIGINAL, &share)))
        }
        _ => excess(scope, tests, &[(ORIGINAL, &share)], 0.7),
    }
}

/// Distance of shifted samples from a lognormal.
pub(super) fn shifted(scope: &Scope<'_>) -> MeasureResult {
    let (_, tests) = tests_of(scope.intensity)?;
    excess(scope, tests, &[(SHIFTED, &mean_share(tests))], 0.9)
}

/// Reduction of the distance by shifting.
pub(super) fn gain(scope: &Scope<'_>) -> MeasureResult {
    let (original, shifted) = tests_of(scope.intensity)?;
    let gain =
        |row: &[f64]| apart(accepted(row, shifted), accepted(row, original));
    of_blocks(
        scope,
        reduction(original, shifted),
        &[(ORIGINAL, &mean_share(original)), (SHIFTED, &mean_share(shifted))],
        Some(("gain of the accepted share", &gain)),
    )
}

/// Reduction of the distance of original samples by PGV instead of PGA.
pub(super) fn pgv_gain(scope: &Scope<'_>) -> MeasureResult {
    let (pga, pgv) = (TestSeries::OriginalPga, TestSeries::OriginalPgv);
    let details: [NamedNumber<'_>; 2] = [
        ("mean accepted share, PGA", &mean_share(pga)),
        ("mean accepted share, PGV", &mean_share(pgv)),
    ];
    of_blocks(scope, reduction(pga, pgv), &details, None)
}

/// Change of the distance by the geometric mean's intensity.
pub(super) fn geometric_mean(scope: &Scope<'_>) -> MeasureResult {
    let (own, mean) =
        (TestSeries::ShiftedPga, TestSeries::ShiftedGeometricMean);
    let details: [NamedNumber<'_>; 2] = [
        ("mean accepted share, component", &mean_share(own)),
        ("mean accepted share, geometric mean", &mean_share(mean)),
    ];
    of_blocks(scope, reduction(mean, own), &details, None)
}

/// Distance of original samples for p = 3 and 4 minus the distance for p = 1.
pub(super) fn small_minus_large(scope: &Scope<'_>) -> MeasureResult {
    let apart = |values: &[f64]| {
        let (large, small) = values.split_at(SLENDERNESSES_RAD.len());
        over_blocks(small) - over_blocks(large)
    };
    let share = |row: &[f64]| -apart(accepted(row, TestSeries::OriginalPga));
    of_blocks(
        scope,
        |row| apart(excesses(row, TestSeries::OriginalPga)),
        &[],
        Some(("accepted share, large minus small blocks", &share)),
    )
}

/// Distance for alpha = 0.05, p = 3, original and shifted samples in PGA.
pub(super) fn slender(scope: &Scope<'_>) -> MeasureResult {
    let name = block(SLENDER.0, SLENDER.1);
    let cells = ["original", "shifted"].map(|of| format!("{name}, {of}"));
    let tests = [TestSeries::OriginalPga, TestSeries::ShiftedPga];
    let [original, shifted] = tests.map(slender_share);
    let larger = |row: &[f64]| {
        let (a, b) = (original(row), shifted(row));
        if a > b { a } else { b }
    };
    of_cells(
        scope,
        &cells,
        |row| tests.map(|tests| row[place(tests, SLENDER)]).into(),
        &[
            ("accepted share, original", &original),
            ("accepted share, shifted", &shifted),
        ],
        Some(("the larger of the two", &larger)),
    )
}

/// Distance for alpha = 0.05 minus the distance for 0.20, p = 3, shifted
/// samples in PGA.
pub(super) fn less_slender(scope: &Scope<'_>) -> MeasureResult {
    let at = "p = 3, alpha = 0.05 minus 0.20".into();
    let of = |block| place(TestSeries::ShiftedPga, block);
    let share = |row: &[f64]| {
        let shares = accepted(row, TestSeries::ShiftedPga);
        shares[position(SLENDER.0, SLENDER.1)]
            - shares[position(LESS_SLENDER.0, LESS_SLENDER.1)]
    };
    of_cells(
        scope,
        &[at],
        |row| vec![row[of(SLENDER)] - row[of(LESS_SLENDER)]],
        &[("accepted share, alpha = 0.05 minus 0.20", &share)],
        None,
    )
}

/// Reduction of the distance without the three earliest overturnings.
pub(super) fn earliest_removed(scope: &Scope<'_>) -> MeasureResult {
    let whole = place(TestSeries::ShiftedPga, SLENDER);
    of_cells(
        scope,
        &[block(SLENDER.0, SLENDER.1)],
        |row| vec![row[whole] - row[WITHOUT_EARLIEST]],
        &[],
        None,
    )
}
