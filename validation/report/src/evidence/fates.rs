//! The map of fates of a block under one-sine pulses.

use libm::{exp, log};
use rayon::prelude::*;

use super::spectrum::{ETA, STOCKY_RAD, fate};
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

/// Ends of `count` cells of equal ratio.
fn edges((low, high): (f64, f64), count: usize) -> Vec<f64> {
    let step = log(high / low) / count as f64;
    (0..=count).map(|k| low * exp(step * k as f64)).collect()
}

/// The map, computed by the integrator in Eq. 1, and the boundaries of Eq. 2
/// in closed form.
pub(super) fn map() -> anyhow::Result<Figure> {
    let frequencies = edges(FREQUENCIES, COLUMNS);
    let amplitudes = edges(AMPLITUDES, ROWS);
    let middle = |pair: &[f64]| (pair[0] * pair[1]).sqrt();
    let cells = frequencies
        .windows(2)
        .collect::<Vec<_>>()
        .par_iter()
        .map(|column| {
            let omega = middle(column);
            amplitudes
                .windows(2)
                .map(|row| {
                    let criterion = Overturning::HalfPi;
                    fate(Model::Nonlinear, criterion, omega, middle(row))
                        .map(MapFate::after)
                })
                .collect::<Result<Vec<MapFate>, EngineError>>()
        })
        .collect::<Result<Vec<_>, EngineError>>()?;
    let (fold, at_fold) = overturning::fold(ETA);
    let along = edges(FREQUENCIES, POINTS);
    let without: Vec<(f64, f64)> = along
        .iter()
        .map(|omega| (*omega, overturning::sine_without_impact(2, *omega)))
        .collect();
    let mut after_one: Vec<(f64, f64)> = along
        .iter()
        .filter(|omega| **omega < fold)
        .filter_map(|omega| {
            Some((*omega, overturning::mode_1_upper(*omega, ETA)?))
        })
        .collect();
    after_one.push((fold, at_fold));
    let apart = apart(&frequencies, &amplitudes, &cells, &without);
    let share = |is: fn(&MapFate) -> bool| {
        let all = cells.iter().flatten();
        let count = all.filter(|f| is(f)).count();
        rocking_common::words::percent(
            count as f64 / (COLUMNS * ROWS) as f64,
            0,
        )
    };
    let height = exp(log(AMPLITUDES.1 / AMPLITUDES.0) / ROWS as f64);
    let last = frequencies
        .windows(2)
        .zip(&cells)
        .rev()
        .find(|(_, column)| column.contains(&MapFate::AfterOne));
    let reading = format!(
        "Without impact the boundary of Eq. 2 lies within {} of that of Eq. 1 \
         at alpha = {STOCKY_RAD}, in amplitude. After one impact Eq. 2 \
         overturns up to omega/p = {fold:.2}, Eq. 1 up to {:.2}. Of the cells \
         {} overturn before an impact, {} after one.",
        rocking_common::words::percent(
            libm::pow(height, apart as f64) - 1.0,
            1
        ),
        last.map_or(f64::NAN, |(pair, _)| middle(pair)),
        share(|f| *f == MapFate::Before),
        share(|f| *f == MapFate::AfterOne),
    );
    Ok(FateMap {
        heading: Heading::numbered(
            21,
            "Map of fates under one-sine pulses",
            "Cells of a plane of pulse frequency over p and amplitude over \
             the uplift threshold, both logarithmic, coloured by the fate of \
             a block in Eq. 1: it stands, or overturns before an impact, \
             after one, or after more. Two lines are closed-form boundaries \
             of Eq. 2.",
            None,
        ),
        frequencies,
        amplitudes,
        cells,
        boundaries: vec![
            ("Eq. 2, without impact".into(), without),
            ("Eq. 2, upper end after one impact".into(), after_one),
        ],
    }
    .figure(reading))
}

/// Largest distance, in cells, from the boundary without impact to the first
/// cell of its column that overturns without one and all above it too.
fn apart(
    frequencies: &[f64],
    amplitudes: &[f64],
    cells: &[Vec<MapFate>],
    boundary: &[(f64, f64)],
) -> usize {
    let mut most = 0;
    for (pair, column) in frequencies.windows(2).zip(cells) {
        let omega = (pair[0] * pair[1]).sqrt();
        let place = boundary.partition_point(|(x, _)| *x < omega);
        let Some((_, amplitude)) = boundary.get(place) else { continue };
        let inside = amplitudes.last().is_some_and(|top| amplitude < top);
        if !inside {
            continue;
        }
        let expected = amplitudes.partition_point(|a| a < amplitude);
        let found = column
            .iter()
            .rposition(|fate| *fate != MapFate::Before)
            .map_or(0, |k| k + 1);
        most = most.max(expected.abs_diff(found));
    }
    most
}
