//! Section 5, Figures 12 to 14: measures of the distance from a lognormal.
//!
//! A cell is the mean over demand levels and blocks of Lilliefors' D less its
//! mean for a lognormal of as many records: how far in probability capacities
//! are from a lognormal. The accepted share, which the paper gives, stands
//! beside it.

use super::source::{Criterion, Found, Prepared, Source, block};
use crate::distances::{
    Distances, SLENDER, Tests, WITHOUT_EARLIEST, accepted, excesses, place,
};
use crate::estimates::mean;
use crate::inference::Cell;
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

/// The distances of the source's suite and arm; none if it was not run.
fn of_source<'a>(source: &Source<'a>) -> Option<&'a Distances> {
    let kind = source.kind();
    let is = |d: &&Distances| d.suite == kind && d.arm == source.arm;
    source.distances.iter().find(is)
}

/// What is shown beside a measure: its name, and a number of a draw.
type Beside<'a> = (&'a str, &'a dyn Fn(&[f64]) -> f64);

/// Some numbers of the excesses, by cell; of the accepted shares, what is
/// shown beside them, by name.
fn of_cells(
    source: &Source<'_>,
    cells: &[String],
    f: impl Fn(&[f64]) -> Vec<f64>,
    beside: &[Beside<'_>],
) -> Found {
    let Some(own) = of_source(source) else { return Ok(None) };
    let records = source.results.suite(source.kind()).records.len();
    let cell = |at: &String| Cell { at: at.clone(), records };
    let detail = |(name, of): &Beside<'_>| Detail {
        name: (*name).into(),
        measured: Measured::exact(own.found.map(|row| vec![of(row)]).point(0)),
    };
    Ok(Some(Prepared {
        details: beside.iter().map(detail).collect(),
        ..Prepared::new(cells.iter().map(cell).collect(), own.found.map(f))
    }))
}

/// One number of all blocks.
fn of_blocks(
    source: &Source<'_>,
    f: impl Fn(&[f64]) -> f64,
    beside: &[Beside<'_>],
) -> Found {
    let Some(own) = of_source(source) else { return Ok(None) };
    let untested = own.levels.iter().filter(|(a, b)| a < b).count();
    let mut at = String::from("all 15 blocks");
    if untested > 0 {
        let least = own.levels.iter().map(|(a, _)| *a).min().unwrap_or(0);
        at += &format!(
            "; {untested} of them have levels that some record never \
             reaches, and {least} or more of 200 levels are tested"
        );
    }
    of_cells(source, &[at], |row| vec![f(row)], beside)
}

/// The same, with what the paper judges by: a number of the accepted shares.
fn with_criterion(
    source: &Source<'_>,
    found: Found,
    name: &str,
    of: impl Fn(&[f64]) -> f64,
) -> Found {
    let (Some(own), Some(mut prepared)) = (of_source(source), found?) else {
        return Ok(None);
    };
    let measured = own.found.map(|row| vec![of(row)]);
    prepared.criterion = Some(Criterion { name: name.into(), measured });
    Ok(Some(prepared))
}

/// The share of the blocks whose accepted share is above a limit.
fn with_blocks_above(
    source: &Source<'_>,
    found: Found,
    tests: Tests,
    limit: f64,
) -> Found {
    let name =
        format!("share of the blocks whose accepted share is above {limit}");
    let of = |row: &[f64]| above(accepted(row, tests), limit);
    with_criterion(source, found, &name, of)
}

fn tests_of(intensity: Intensity) -> (Tests, Tests) {
    match intensity {
        Intensity::Pga => (Tests::OriginalPga, Tests::ShiftedPga),
        Intensity::Pgv => (Tests::OriginalPgv, Tests::ShiftedPgv),
    }
}

const ORIGINAL: &str = "mean accepted share, original";
const SHIFTED: &str = "mean accepted share, shifted";

/// The excess of one set of tests.
fn excess(source: &Source<'_>, tests: Tests, beside: &[Beside<'_>]) -> Found {
    of_blocks(source, |row| over_blocks(excesses(row, tests)), beside)
}

pub(super) fn original(source: &Source<'_>) -> Found {
    let (tests, _) = tests_of(source.intensity);
    let share = |row: &[f64]| over_blocks(accepted(row, tests));
    match source.intensity {
        Intensity::Pga => {
            let found = excess(source, tests, &[]);
            with_criterion(source, found, ORIGINAL, share)
        }
        Intensity::Pgv => {
            let found = excess(source, tests, &[(ORIGINAL, &share)]);
            with_blocks_above(source, found, tests, 0.7)
        }
    }
}

pub(super) fn shifted(source: &Source<'_>) -> Found {
    let (_, tests) = tests_of(source.intensity);
    let share = |row: &[f64]| over_blocks(accepted(row, tests));
    let found = excess(source, tests, &[(SHIFTED, &share)]);
    match source.intensity {
        Intensity::Pga => found,
        Intensity::Pgv => with_blocks_above(source, found, tests, 0.9),
    }
}

/// What shifting takes off the distance.
pub(super) fn gain(source: &Source<'_>) -> Found {
    let (original, shifted) = tests_of(source.intensity);
    let found = of_blocks(
        source,
        |row| apart(excesses(row, original), excesses(row, shifted)),
        &[
            (ORIGINAL, &|row| over_blocks(accepted(row, original))),
            (SHIFTED, &|row| over_blocks(accepted(row, shifted))),
        ],
    );
    with_criterion(source, found, "gain of the accepted share", |row| {
        apart(accepted(row, shifted), accepted(row, original))
    })
}

/// What PGV instead of PGA takes off the distance of original samples.
pub(super) fn pgv_gain(source: &Source<'_>) -> Found {
    let (pga, pgv) = (Tests::OriginalPga, Tests::OriginalPgv);
    of_blocks(
        source,
        |row| apart(excesses(row, pga), excesses(row, pgv)),
        &[
            ("mean accepted share, PGA", &|row| {
                over_blocks(accepted(row, pga))
            }),
            ("mean accepted share, PGV", &|row| {
                over_blocks(accepted(row, pgv))
            }),
        ],
    )
}

pub(super) fn geometric_mean(source: &Source<'_>) -> Found {
    let (own, mean) = (Tests::ShiftedPga, Tests::ShiftedGeometricMean);
    of_blocks(
        source,
        |row| apart(excesses(row, mean), excesses(row, own)),
        &[
            ("mean accepted share, component", &|row| {
                over_blocks(accepted(row, own))
            }),
            ("mean accepted share, geometric mean", &|row| {
                over_blocks(accepted(row, mean))
            }),
        ],
    )
}

pub(super) fn small_minus_large(source: &Source<'_>) -> Found {
    let apart = |values: &[f64]| {
        let (large, small) = values.split_at(SLENDERNESSES_RAD.len());
        over_blocks(small) - over_blocks(large)
    };
    let of = |row: &[f64]| apart(excesses(row, Tests::OriginalPga));
    let found = of_blocks(source, of, &[]);
    let name = "accepted share, large minus small blocks";
    with_criterion(source, found, name, |row| {
        -apart(accepted(row, Tests::OriginalPga))
    })
}

pub(super) fn slender(source: &Source<'_>) -> Found {
    let name = block(SLENDER.0, SLENDER.1);
    let cells = ["original", "shifted"].map(|of| format!("{name}, {of}"));
    let tests = [Tests::OriginalPga, Tests::ShiftedPga];
    let share = |row: &[f64], tests| {
        accepted(row, tests)[position(SLENDER.0, SLENDER.1)]
    };
    let found = of_cells(
        source,
        &cells,
        |row| tests.map(|tests| row[place(tests, SLENDER)]).into(),
        &[
            ("accepted share, original", &|row| share(row, tests[0])),
            ("accepted share, shifted", &|row| share(row, tests[1])),
        ],
    );
    with_criterion(source, found, "the larger of the two", |row| {
        let [a, b] = tests.map(|tests| share(row, tests));
        if a > b { a } else { b }
    })
}

pub(super) fn less_slender(source: &Source<'_>) -> Found {
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
    )
}

/// What leaving out the earliest overturnings takes off the distance.
pub(super) fn earliest_removed(source: &Source<'_>) -> Found {
    let whole = place(Tests::ShiftedPga, SLENDER);
    of_cells(
        source,
        &[block(SLENDER.0, SLENDER.1)],
        |row| vec![row[whole] - row[WITHOUT_EARLIEST]],
        &[],
    )
}
