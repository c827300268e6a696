//! Section 5, Figures 12 to 14: measures of the distance from a lognormal.
//!
//! A cell is the mean over demand levels and blocks of Lilliefors' D less its
//! mean for a lognormal of as many records: how far in probability capacities
//! are from a lognormal. The accepted share, which the paper gives, stands
//! beside it.

use super::source::{Criterion, Prepared, Source, block};
use crate::distances::{
    Distances, SLENDER, Tests, WITHOUT_EARLIEST, accepted, excesses, place,
};
use crate::estimates::mean;
use crate::inference::Cell;
use crate::runs::not_run;
use rocking_common::findings::{Detail, Measured};
use rocking_common::paper::{Intensity, SLENDERNESSES_RAD, position};

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
type Named<'a> = (&'a str, &'a dyn Fn(&[f64]) -> f64);

/// Numbers of the excesses, by cell, with numbers of the accepted shares: the
/// details, and the one by which the paper judges.
fn of_cells(
    source: &Source<'_>,
    cells: &[String],
    f: impl Fn(&[f64]) -> Vec<f64>,
    details: &[Named<'_>],
    criterion: Option<Named<'_>>,
) -> anyhow::Result<Prepared> {
    let replicated = &of_source(source)?.replicated;
    let records = source.records();
    let cell = |at: &String| Cell { at: at.clone(), records };
    let one = |of: &dyn Fn(&[f64]) -> f64| replicated.map(|row| vec![of(row)]);
    let detail = |(name, of): &Named<'_>| Detail {
        name: (*name).into(),
        measured: Measured::exact(one(of).point(0)),
    };
    Ok(Prepared {
        cells: cells.iter().map(cell).collect(),
        measured: replicated.map(f),
        criterion: criterion.map(|(name, of)| Criterion {
            name: name.into(),
            measured: one(of),
        }),
        details: details.iter().map(detail).collect(),
    })
}

/// The distances of the source's suite and arm.
fn of_source<'a>(source: &Source<'a>) -> anyhow::Result<&'a Distances> {
    let (kind, arm) = (source.kind(), source.arm);
    let is = |d: &&Distances| d.suite == kind && d.arm == arm;
    source.distances.iter().find(is).ok_or_else(|| not_run(arm))
}

/// One number of all blocks.
fn of_blocks(
    source: &Source<'_>,
    f: impl Fn(&[f64]) -> f64,
    details: &[Named<'_>],
    criterion: Option<Named<'_>>,
) -> anyhow::Result<Prepared> {
    let levels = &of_source(source)?.levels;
    let untested = levels.iter().filter(|(a, b)| a < b).count();
    let mut at = String::from("all 15 blocks");
    if untested > 0 {
        let least = levels.iter().map(|(a, _)| *a).min().unwrap_or(0);
        at += &format!(
            "; {untested} of them have levels that some record never \
             reaches, and {least} or more of 200 levels are tested"
        );
    }
    of_cells(source, &[at], |row| vec![f(row)], details, criterion)
}

/// Mean accepted share of the blocks.
fn mean_share(tests: Tests) -> impl Fn(&[f64]) -> f64 {
    move |row| over_blocks(accepted(row, tests))
}

/// Mean excess of the blocks by one set of tests less the mean by another.
fn reduction(from: Tests, to: Tests) -> impl Fn(&[f64]) -> f64 {
    move |row| apart(excesses(row, from), excesses(row, to))
}

/// Accepted share of the block `SLENDER`.
fn slender_share(tests: Tests) -> impl Fn(&[f64]) -> f64 {
    move |row| accepted(row, tests)[position(SLENDER.0, SLENDER.1)]
}

fn tests_of(intensity: Intensity) -> anyhow::Result<(Tests, Tests)> {
    match intensity {
        Intensity::Pga => Ok((Tests::OriginalPga, Tests::ShiftedPga)),
        Intensity::Pgv => Ok((Tests::OriginalPgv, Tests::ShiftedPgv)),
        other => anyhow::bail!("{other}: expected pga or pgv"),
    }
}

const ORIGINAL: &str = "mean accepted share, original";
const SHIFTED: &str = "mean accepted share, shifted";

/// The excess of one set of tests, with the mean accepted share as a detail
/// or, by the limit that the paper names for PGV, the share of the blocks
/// above it as the criterion.
fn excess(
    source: &Source<'_>,
    tests: Tests,
    details: &[Named<'_>],
    limit: f64,
) -> anyhow::Result<Prepared> {
    let mean = |row: &[f64]| over_blocks(excesses(row, tests));
    let name =
        format!("share of the blocks whose accepted share is above {limit}");
    let share = |row: &[f64]| above(accepted(row, tests), limit);
    let is_judged = source.intensity == Intensity::Pgv;
    let criterion = is_judged.then_some((name.as_str(), &share as &_));
    of_blocks(source, mean, details, criterion)
}

/// Distance of original samples from a lognormal.
pub(super) fn original(source: &Source<'_>) -> anyhow::Result<Prepared> {
    let (tests, _) = tests_of(source.intensity)?;
    let share = mean_share(tests);
    match source.intensity {
        Intensity::Pga => {
            let mean = |row: &[f64]| over_blocks(excesses(row, tests));
            of_blocks(source, mean, &[], Some((ORIGINAL, &share)))
        }
        _ => excess(source, tests, &[(ORIGINAL, &share)], 0.7),
    }
}

/// Distance of shifted samples from a lognormal.
pub(super) fn shifted(source: &Source<'_>) -> anyhow::Result<Prepared> {
    let (_, tests) = tests_of(source.intensity)?;
    excess(source, tests, &[(SHIFTED, &mean_share(tests))], 0.9)
}

/// Reduction of the distance by shifting.
pub(super) fn gain(source: &Source<'_>) -> anyhow::Result<Prepared> {
    let (original, shifted) = tests_of(source.intensity)?;
    let gain =
        |row: &[f64]| apart(accepted(row, shifted), accepted(row, original));
    of_blocks(
        source,
        reduction(original, shifted),
        &[(ORIGINAL, &mean_share(original)), (SHIFTED, &mean_share(shifted))],
        Some(("gain of the accepted share", &gain)),
    )
}

/// Reduction of the distance of original samples by PGV instead of PGA.
pub(super) fn pgv_gain(source: &Source<'_>) -> anyhow::Result<Prepared> {
    let (pga, pgv) = (Tests::OriginalPga, Tests::OriginalPgv);
    let details: [Named<'_>; 2] = [
        ("mean accepted share, PGA", &mean_share(pga)),
        ("mean accepted share, PGV", &mean_share(pgv)),
    ];
    of_blocks(source, reduction(pga, pgv), &details, None)
}

/// Change of the distance by the geometric mean's intensity.
pub(super) fn geometric_mean(source: &Source<'_>) -> anyhow::Result<Prepared> {
    let (own, mean) = (Tests::ShiftedPga, Tests::ShiftedGeometricMean);
    let details: [Named<'_>; 2] = [
        ("mean accepted share, component", &mean_share(own)),
        ("mean accepted share, geometric mean", &mean_share(mean)),
    ];
    of_blocks(source, reduction(mean, own), &details, None)
}

/// Distance of original samples for p = 3 and 4 minus the distance for p = 1.
pub(super) fn small_minus_large(
    source: &Source<'_>,
) -> anyhow::Result<Prepared> {
    let apart = |values: &[f64]| {
        let (large, small) = values.split_at(SLENDERNESSES_RAD.len());
        over_blocks(small) - over_blocks(large)
    };
    let share = |row: &[f64]| -apart(accepted(row, Tests::OriginalPga));
    of_blocks(
        source,
        |row| apart(excesses(row, Tests::OriginalPga)),
        &[],
        Some(("accepted share, large minus small blocks", &share)),
    )
}

/// Distance for alpha = 0.05, p = 3, original and shifted samples in PGA.
pub(super) fn slender(source: &Source<'_>) -> anyhow::Result<Prepared> {
    let name = block(SLENDER.0, SLENDER.1);
    let cells = ["original", "shifted"].map(|of| format!("{name}, {of}"));
    let tests = [Tests::OriginalPga, Tests::ShiftedPga];
    let [original, shifted] = tests.map(slender_share);
    let larger = |row: &[f64]| {
        let (a, b) = (original(row), shifted(row));
        if a > b { a } else { b }
    };
    of_cells(
        source,
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
pub(super) fn less_slender(source: &Source<'_>) -> anyhow::Result<Prepared> {
    let at = "p = 3, alpha = 0.05 minus 0.20".into();
    let of = |block| place(Tests::ShiftedPga, block);
    let share = |row: &[f64]| {
        let shares = accepted(row, Tests::ShiftedPga);
        shares[position(SLENDER.0, SLENDER.1)]
            - shares[position(LESS_SLENDER.0, LESS_SLENDER.1)]
    };
    of_cells(
        source,
        &[at],
        |row| vec![row[of(SLENDER)] - row[of(LESS_SLENDER)]],
        &[("accepted share, alpha = 0.05 minus 0.20", &share)],
        None,
    )
}

/// Reduction of the distance without the three earliest overturnings.
pub(super) fn earliest_removed(
    source: &Source<'_>,
) -> anyhow::Result<Prepared> {
    let whole = place(Tests::ShiftedPga, SLENDER);
    of_cells(
        source,
        &[block(SLENDER.0, SLENDER.1)],
        |row| vec![row[whole] - row[WITHOUT_EARLIEST]],
        &[],
        None,
    )
}
