//! Figures 2 and 3: response histories.

use super::chart::{Chart, ChartPanel, Column, Layout, Of};
use super::common;
use super::figure::Figure;
use super::heading::Heading;
use super::series::{Mark, Series};
use crate::axis::Axis;
use crate::colour::{Ink, Pen};
use crate::grid::Grid;
use crate::panel::{Look, Marker};
use rocking_common::paper::Intensity;
use rocking_common::table::number;

const WIDTH_PX: f64 = 272.0;

/// Least half range of the rotation axis, in |theta|/alpha.
const FLOOR: f64 = 1e-4;

const KEYS: [&str; 5] = ["p_rad_s", "record", "im", "intensity", "alpha_rad"];
const NUMBERS: [Column; 2] = [("time_s", Of::X), ("theta_over_alpha", Of::Y)];

/// One record at one frequency parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct HistoryPanel {
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// Record as named in the panel's title.
    pub record: String,
    /// PGA/(g tan alpha), the same for all slendernesses.
    pub im: f64,
    /// A history a slenderness.
    pub curves: Vec<History>,
}

/// One block's history; times after overturning are left out.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Slenderness.
    pub alpha_rad: f64,
    /// Times, rising.
    pub time_s: Vec<f64>,
    /// Rotation over slenderness, theta/alpha.
    pub ratio: Vec<f64>,
    /// Whether it ends in overturning (marked on the drawing).
    pub overturned: bool,
}

/// Response histories at equal dimensionless intensity, panels row by row,
/// with a sentence that says what one sees.
pub fn histories(
    heading: Heading,
    shown: &[HistoryPanel],
    columns: usize,
    reading: String,
) -> Figure {
    // Room for ticks of small rotations.
    let grid = Grid::new(shown.len(), columns);
    let grid = Grid { left: 72.0, width: WIDTH_PX, ..grid };
    let panels = shown.iter().map(panel).collect();
    let chart = Chart { heading, panels, columns };
    let layout = Layout { grid: Some(grid), ..Layout::of(&KEYS, &NUMBERS) };
    chart.thinned((WIDTH_PX, grid.height)).laid_out(&layout, reading)
}

fn panel(shown: &HistoryPanel) -> ChartPanel {
    let (low, high) = ratios(shown);
    let (start, end) = times(shown);
    let y = if shown.curves.iter().any(|c| c.overturned) {
        Axis::linear(low.min(-0.5), high.max(0.5), 5)
    } else {
        Axis::around(low, high, 5)
    };
    let zero = Pen::new(Ink::Muted, 0.6);
    let mut series = vec![Series::note(Mark::Across(zero), "", (0.0, 0.0))];
    for (k, curve) in shown.curves.iter().enumerate() {
        let (t, y) = (curve.time_s.clone(), curve.ratio.clone());
        let end = t.last().copied().zip(y.last().copied());
        let label = common::slenderness(curve.alpha_rad);
        series.push(Series::new(label, Mark::Line, t, y).keyed([
            number(shown.p_rad_s),
            shown.record.clone(),
            Intensity::Pga.name().into(),
            number(shown.im),
            number(curve.alpha_rad),
        ]));
        if let Some((t, y)) = end.filter(|_| curve.overturned) {
            let cross = Look::marks(Marker::Cross, 4.5, Ink::Series(k));
            let cross = Series::of(cross, vec![t], vec![y.clamp(low, high)]);
            series.push(cross.keyed([]).labelled("overturned"));
        }
    }
    let title = format!(
        "{}, {} = {:.2}\n{}",
        common::frequency(shown.p_rad_s),
        Intensity::Pga.row().label,
        shown.im,
        common::record(&shown.record, WIDTH_PX)
    );
    let x = Axis::linear(start, end, 5).label("*t* (s)");
    ChartPanel::new(title, x, y.label("*θ* / *α*"), series)
}

/// Ends of the time axis: the motion, with a little rest before and after.
fn times(shown: &HistoryPanel) -> (f64, f64) {
    let points = || {
        let curves = shown.curves.iter();
        curves.flat_map(|c| c.time_s.iter().zip(&c.ratio))
    };
    let sizes = points().map(|(_, y)| y.abs());
    let most = common::span(sizes, true).map_or(1.0, |(_, most)| most);
    let moving = points().filter(|(_, y)| y.abs() > 0.002 * most);
    let (first, last) =
        common::span(moving.map(|(t, _)| *t), false).unwrap_or((0.0, 1.0));
    let rest = 0.04 * (last - first);
    let first = (first - rest).max(0.0);
    let start = if first < 0.15 * last { 0.0 } else { first };
    (start, last + rest)
}

/// The panel's range: what the histories reach, and never less than 1e-4
/// either way, below which there is nothing to compare. An overturning block
/// leaves at 1.
fn ratios(shown: &HistoryPanel) -> (f64, f64) {
    let values = shown.curves.iter().flat_map(|c| &c.ratio);
    let (low, high) =
        common::span(values.copied(), false).unwrap_or((-1.0, 1.0));
    let overturned = shown.curves.iter().any(|c| c.overturned);
    let most = if overturned { 1.08 } else { 1.0 };
    let grow = |x: f64| if x.abs() > 0.97 { x.signum() * most } else { x };
    (grow(low.clamp(-1.0, -FLOOR)), grow(high.clamp(FLOOR, 1.0)))
}
