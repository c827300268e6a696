//! Section 5, Figures 12 to 14: measures of accepted shares.

use super::source::{Found, Prepared, Source, block};
use crate::estimates::mean;
use crate::inference::Cell;
use crate::shares::{SLENDER, Shares, Tests, WITHOUT_EARLIEST, blocks, place};
use rocking_common::paper::{Intensity, SLENDERNESSES_RAD};

/// The block that the paper compares its badly performing one with: p = 3,
/// alpha = 0.20.
const LESS_SLENDER: (usize, usize) = (1, 3);

/// Share of the blocks whose accepted share is above a limit.
fn above(shares: &[f64], limit: f64) -> f64 {
    let tested = shares.iter().filter(|x| x.is_finite()).count();
    let found = shares.iter().filter(|x| **x > limit).count();
    found as f64 / tested as f64
}

fn apart(row: &[f64], a: Tests, b: Tests) -> f64 {
    let pairs = blocks(row, a).iter().zip(blocks(row, b));
    mean(pairs.map(|(a, b)| a - b))
}

/// The shares of the source's suite and arm; none if it was not run.
fn shares_of<'a>(source: &Source<'a>) -> Option<&'a Shares> {
    let kind = source.kind();
    let is = |s: &&Shares| s.suite == kind && s.arm == source.arm;
    source.shares.iter().find(is)
}

/// One number of the shares of all blocks.
fn of_blocks(source: &Source<'_>, f: impl Fn(&[f64]) -> f64) -> Found {
    let Some(found) = shares_of(source) else { return Ok(None) };
    let untested = found.levels.iter().filter(|(a, b)| a < b).count();
    let mut at = String::from("all 15 blocks");
    if untested > 0 {
        let least = found.levels.iter().map(|(a, _)| *a).min().unwrap_or(0);
        at += &format!(
            "; {untested} of them have levels that some record never \
             reaches, and {least} or more of 200 levels are tested"
        );
    }
    of_cells(source, &[at], |row| vec![f(row)])
}

/// Some numbers of the shares, by cell.
fn of_cells(
    source: &Source<'_>,
    cells: &[String],
    f: impl Fn(&[f64]) -> Vec<f64>,
) -> Found {
    let Some(found) = shares_of(source) else { return Ok(None) };
    let records = source.results.suite(source.kind()).records.len();
    let cell = |at: &String| Cell { at: at.clone(), records };
    Ok(Some(Prepared {
        cells: cells.iter().map(cell).collect(),
        measured: found.shares.map(f),
        criterion: None,
    }))
}

pub(super) fn geometric_mean(source: &Source<'_>) -> Found {
    let tests = [Tests::ShiftedGeometricMean, Tests::ShiftedPga];
    of_blocks(source, |row| apart(row, tests[0], tests[1]))
}

pub(super) fn original_pga(source: &Source<'_>) -> Found {
    of_blocks(source, |row| {
        mean(blocks(row, Tests::OriginalPga).iter().copied())
    })
}

pub(super) fn large_minus_small(source: &Source<'_>) -> Found {
    of_blocks(source, |row| {
        let shares = blocks(row, Tests::OriginalPga);
        let (large, small) = shares.split_at(SLENDERNESSES_RAD.len());
        mean(large.iter().copied()) - mean(small.iter().copied())
    })
}

/// What shifting adds to the share.
pub(super) fn gain(source: &Source<'_>, intensity: Intensity) -> Found {
    let (shifted, original) = match intensity {
        Intensity::Pga => (Tests::ShiftedPga, Tests::OriginalPga),
        Intensity::Pgv => (Tests::ShiftedPgv, Tests::OriginalPgv),
    };
    of_blocks(source, |row| apart(row, shifted, original))
}

pub(super) fn above_70(source: &Source<'_>) -> Found {
    of_blocks(source, |row| above(blocks(row, Tests::OriginalPgv), 0.7))
}

pub(super) fn above_90(source: &Source<'_>) -> Found {
    of_blocks(source, |row| above(blocks(row, Tests::ShiftedPgv), 0.9))
}

pub(super) fn slender(source: &Source<'_>) -> Found {
    let name = block(SLENDER.0, SLENDER.1);
    let cells = ["original", "shifted"].map(|of| format!("{name}, {of}"));
    let tests = [Tests::OriginalPga, Tests::ShiftedPga];
    of_cells(source, &cells, |row| {
        tests.map(|tests| row[place(tests, SLENDER)]).into()
    })
}

pub(super) fn less_slender(source: &Source<'_>) -> Found {
    let at = "p = 3, alpha = 0.20 minus 0.05".into();
    let of = |block| place(Tests::ShiftedPga, block);
    of_cells(source, &[at], |row| {
        vec![row[of(LESS_SLENDER)] - row[of(SLENDER)]]
    })
}

pub(super) fn earliest_removed(source: &Source<'_>) -> Found {
    let whole = place(Tests::ShiftedPga, SLENDER);
    of_cells(source, &[block(SLENDER.0, SLENDER.1)], |row| {
        vec![row[WITHOUT_EARLIEST] - row[whole]]
    })
}
