//! Figures 2 and 3: response histories.

use super::common::{self, Slendernesses, largest, thin};
use super::heading::{Figure, Heading};
use crate::axis::Axis;
use crate::colour::{Ink, Pen};
use crate::grid::Grid;
use crate::panel::{Marker, Panel};
use crate::scene::Scene;
use rocking_common::paper::Intensity;
use rocking_common::table::{Table, number, point};
use rocking_common::words::letter;

/// Size of a panel for [`Histories::thinned`].
const WIDTH_PX: f64 = 288.0;
const HALF_PX: f64 = 111.0;

/// Least half range of the rotation axis, in |theta|/alpha.
const FLOOR: f64 = 1e-4;

/// Response histories at equal dimensionless intensity.
#[derive(Debug, Clone, PartialEq)]
pub struct Histories {
    /// The words.
    pub heading: Heading,
    /// Panels row by row: a row a frequency parameter, a column a record.
    pub panels: Vec<HistoryPanel>,
    /// Panels in a row.
    pub columns: usize,
}

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

impl Histories {
    /// The same with only the points that a drawing keeps: none that is
    /// left out lies farther than a tenth of a pixel from the line.
    pub fn thinned(mut self) -> Self {
        for panel in &mut self.panels {
            let curves = || panel.curves.iter();
            let until_s = largest(curves().flat_map(|c| &c.time_s));
            let peak = largest(curves().flat_map(|c| &c.ratio));
            let px = (WIDTH_PX / until_s, HALF_PX / peak);
            for curve in &mut panel.curves {
                thin(&mut curve.time_s, &mut curve.ratio, px);
            }
        }
        self
    }

    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(&self, reading: String) -> Figure {
        Figure::new(&self.heading, scene(self), self.csv(), reading)
    }

    /// `panel,p_rad_s,record,im,intensity,alpha_rad,time_s,theta_over_alpha`.
    fn csv(&self) -> String {
        let mut table = Table::headed(
            "panel,p_rad_s,record,im,intensity,alpha_rad,time_s,theta_over_alpha",
        );
        for (i, panel) in self.panels.iter().enumerate() {
            for curve in &panel.curves {
                for (t, y) in curve.time_s.iter().zip(&curve.ratio) {
                    table.row([
                        letter(i),
                        number(panel.p_rad_s),
                        panel.record.clone(),
                        Intensity::Pga.name().into(),
                        number(panel.im),
                        number(curve.alpha_rad),
                        point(*t),
                        point(*y),
                    ]);
                }
            }
        }
        table.finish()
    }
}

fn scene(figure: &Histories) -> Scene {
    let curves = || figure.panels.iter().flat_map(|p| &p.curves);
    let inks = Slendernesses::new(curves().map(|c| c.alpha_rad));
    // Room for ticks of small rotations.
    let grid = Grid::new(figure.panels.len(), figure.columns);
    let grid = Grid { left: 72.0, width: 272.0, ..grid }.with_subtitles();
    let mut legend = inks.lines();
    if curves().any(|c| c.overturned) {
        legend.push(common::overturned_entry());
    }
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    for (i, shown) in figure.panels.iter().enumerate() {
        let (low, high) = ratios(shown);
        let (start, end) = times(shown);
        let x = Axis::linear(start, end, 5).label("*t* (s)");
        let y = if shown.curves.iter().any(|c| c.overturned) {
            Axis::linear(low.min(-0.5), high.max(0.5), 5)
        } else {
            Axis::around(low, high, 5)
        };
        let y = y.label("*θ* / *α*");
        let mut panel = Panel::new(&mut scene, grid.frame(i), x, y);
        panel.horizontal(0.0, Pen::new(Ink::Muted, 0.6));
        for curve in &shown.curves {
            let series = inks.series(curve.alpha_rad);
            let points = curve.time_s.iter().zip(&curve.ratio);
            let points = points.map(|(t, y)| (*t, *y));
            panel.line(points.clone(), Pen::of_series(series));
            if curve.overturned
                && let Some((t, y)) = points.clone().next_back()
            {
                let at = [(t, y.clamp(low, high))];
                panel.marks(at, Marker::Cross, 4.5, Ink::Series(series));
            }
        }
        let title = format!(
            "{}, {} = {:.2}",
            common::frequency(shown.p_rad_s),
            common::intensity(Intensity::Pga),
            shown.im
        );
        panel.finish(
            &common::panel_title(i, &title),
            &common::record(&shown.record, &grid),
        );
    }
    scene
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
