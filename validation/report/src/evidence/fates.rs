//! Figure 21: the map of outcomes of a block under one-sine pulses.

use rayon::prelude::*;

use super::spectrum::{ETA, STOCKY_RAD, fate, spaced};
use rocking_common::words::percent;
use rocking_draw::figures::{FateMap, Figure, Heading, MapFate};
use rocking_proof::oracles::overturning;
use rocking_proof::scene::{EngineError, Model, Overturning};

/// Columns and rows of the map.
const COLUMNS: usize = 120;
const ROWS: usize = 90;
/// Frequency over p, and amplitude over the threshold.
const FREQUENCIES: (f64, f64) = (0.4, 10.0);
const AMPLITUDES: (f64, f64) = (1.0, 30.0);
/// Points of a boundary.
const POINTS: usize = 240;

/// Geometric middles of intervals.
fn middles(ends: &[f64]) -> Vec<f64> {
    ends.windows(2).map(|pair| (pair[0] * pair[1]).sqrt()).collect()
}

/// The map, computed by the integrator in Eq. 1, and the boundaries of Eq. 2
/// in closed form.
pub(super) fn map() -> anyhow::Result<Figure> {
    let frequencies = spaced(FREQUENCIES, COLUMNS);
    let amplitudes = spaced(AMPLITUDES, ROWS);
    let columns = middles(&frequencies);
    let column = |omega: &f64| -> Result<Vec<MapFate>, EngineError> {
        let cell = |amplitude| {
            let criterion = Overturning::HalfPi;
            fate(Model::Nonlinear, criterion, *omega, amplitude)
                .map(MapFate::after)
        };
        middles(&amplitudes).into_iter().map(cell).collect()
    };
    let cells: Result<Vec<_>, _> =
        columns.par_iter().panic_fuse().map(column).collect();
    let cells = cells?;
    let (fold, at_fold) = overturning::fold(ETA);
    let along = spaced(FREQUENCIES, POINTS);
    let without =
        along.iter().map(|x| (*x, overturning::sine_without_impact(2, *x)));
    let after_one = along.iter().filter(|omega| **omega < fold);
    let after_one = after_one.filter_map(|omega| {
        Some((*omega, overturning::mode_1_upper(*omega, ETA)?))
    });
    let boundaries = vec![
        ("Eq. 2, without impact".into(), without.collect()),
        (
            "Eq. 2, upper end after one impact".into(),
            after_one.chain([(fold, at_fold)]).collect(),
        ),
    ];
    let share = |wanted: MapFate| {
        let count = cells.iter().flatten().filter(|f| **f == wanted).count();
        percent(count as f64 / (COLUMNS * ROWS) as f64, 0)
    };
    let height = amplitudes[1] / amplitudes[0];
    let apart = libm::pow(height, apart(&columns, &amplitudes, &cells) as f64);
    let is_mode_1 = |own: &Vec<_>| own.contains(&MapFate::AfterOne);
    let last = cells.iter().rposition(is_mode_1);
    let reading = format!(
        "In amplitude, the boundary of Eq. 2 without impact lies within {} of \
         the boundary of Eq. 1 at alpha = {STOCKY_RAD}. After one impact, a \
         block overturns up to omega/p = {fold:.2} in Eq. 2 and up to {:.2} \
         in Eq. 1. Of the cells, {} overturn before an impact, {} after one.",
        percent(apart - 1.0, 1),
        last.map_or(f64::NAN, |k| columns[k]),
        share(MapFate::Before),
        share(MapFate::AfterOne),
    );
    let heading = Heading::numbered(
        21,
        "Map of outcomes under one-sine pulses",
        "Amplitude divided by the uplift threshold against pulse frequency \
         divided by p, both logarithmic; cells coloured by the outcome of a \
         block in Eq. 1: it stands, or overturns before an impact, after \
         one, or after more. Two lines are closed-form boundaries of Eq. 2.",
        None,
    );
    let map = FateMap { heading, frequencies, amplitudes, cells, boundaries };
    Ok(map.figure(reading))
}

/// Largest distance, in cells, between the boundary of Eq. 2 without impact
/// and the lowest cell of a column above which all cells overturn before an
/// impact.
fn apart(
    columns: &[f64],
    amplitudes: &[f64],
    cells: &[Vec<MapFate>],
) -> usize {
    let distance = |(omega, column): (&f64, &Vec<MapFate>)| {
        let boundary = overturning::sine_without_impact(2, *omega);
        let expected = amplitudes.partition_point(|a| *a < boundary);
        let below = column.iter().rposition(|own| *own != MapFate::Before);
        let found = below.map_or(0, |k| k + 1);
        (expected < amplitudes.len()).then(|| expected.abs_diff(found))
    };
    columns.iter().zip(cells).filter_map(distance).max().unwrap_or_default()
}
