//! Figures 4 and 5: single-record IDA curves.

use super::common::{self, Slendernesses, largest, thin};
use super::heading::{Figure, Heading};
use crate::axis::Axis;
use crate::colour::Pen;
use crate::grid::Grid;
use crate::panel::Panel;
use crate::scene::Scene;
use rocking_common::paper::Intensity;
use rocking_common::table::{Table, number, point};
use rocking_common::words::letter;

/// Single-record IDA curves.
#[derive(Debug, Clone, PartialEq)]
pub struct IdaCurves {
    /// The words.
    pub heading: Heading,
    /// Panels row by row: a row a frequency parameter, a column a record.
    pub panels: Vec<IdaPanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One record at one frequency parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct IdaPanel {
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// Record as named in the panel's title.
    pub record: String,
    /// A curve a slenderness.
    pub curves: Vec<IdaCurve>,
}

/// One block's IDA curve up to its first overturning.
#[derive(Debug, Clone, PartialEq)]
pub struct IdaCurve {
    /// Slenderness.
    pub alpha_rad: f64,
    /// Intensities, rising.
    pub im: Vec<f64>,
    /// Peak |theta|/alpha at each intensity; +infinity where overturned.
    pub edp: Vec<f64>,
    /// Intensity of first overturning, if it was reached: the flat line
    /// starts there.
    pub overturning_im: Option<f64>,
}

/// Size of a panel for [`IdaCurves::thinned`].
const PX: f64 = 288.0;

impl IdaCurves {
    /// The same with only the points that a drawing keeps: none that is
    /// left out lies farther than a tenth of a pixel from the line.
    pub fn thinned(mut self) -> Self {
        for panel in &mut self.panels {
            let top = largest(panel.curves.iter().flat_map(|c| &c.im));
            for curve in &mut panel.curves {
                thin(&mut curve.edp, &mut curve.im, (PX, PX / top));
            }
        }
        self
    }

    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(&self, reading: String) -> Figure {
        Figure::new(&self.heading, scene(self), self.csv(), reading)
    }

    /// `panel,p_rad_s,record,im,alpha_rad,intensity,edp`.
    fn csv(&self) -> String {
        let mut table =
            Table::headed("panel,p_rad_s,record,im,alpha_rad,intensity,edp");
        for (i, panel) in self.panels.iter().enumerate() {
            for curve in &panel.curves {
                let mut row = |im: f64, edp: f64| {
                    table.row([
                        letter(i),
                        number(panel.p_rad_s),
                        panel.record.clone(),
                        Intensity::Pga.name().into(),
                        number(curve.alpha_rad),
                        number(im),
                        point(edp),
                    ]);
                };
                for (im, edp) in curve.im.iter().zip(&curve.edp) {
                    row(*im, *edp);
                }
                if let Some(im) = curve.overturning_im
                    && curve.edp.last().is_none_or(|e| e.is_finite())
                {
                    row(im, f64::INFINITY);
                }
            }
        }
        table.finish()
    }
}

/// The end of the demand axis, past 1 so that overturning stays inside.
const END: f64 = 1.08;

fn scene(figure: &IdaCurves) -> Scene {
    let curves = || figure.panels.iter().flat_map(|p| &p.curves);
    let inks = Slendernesses::new(curves().map(|c| c.alpha_rad));
    let grid = Grid::new(figure.panels.len(), figure.columns).with_subtitles();
    let (mut scene, grid) =
        common::scene(&figure.heading, grid, &inks.lines());
    for (i, shown) in figure.panels.iter().enumerate() {
        let overturning = shown.curves.iter().filter_map(|c| c.overturning_im);
        let levels = shown.curves.iter().flat_map(|c| {
            let stands = |(_, e): &(&f64, &f64)| e.is_finite();
            c.im.iter().zip(&c.edp).filter(stands).map(|(im, _)| *im)
        });
        let (low, high) = common::span(levels.chain(overturning), true)
            .unwrap_or((1.0, 2.0));
        let top = 1.12_f64.mul_add(high - low, low).max(1.2);
        let x = Axis::linear(0.0, END, 5).label(common::DEMAND);
        let bottom = if low < 0.99 { 0.0 } else { 1.0 };
        let y = Axis::linear(bottom, top, 5)
            .label(common::intensity(Intensity::Pga));
        let mut panel = Panel::new(&mut scene, grid.frame(i), x, y);
        for curve in &shown.curves {
            let pen = Pen::of_series(inks.series(curve.alpha_rad));
            panel.line(path(curve), pen);
        }
        let title = common::panel_title(i, &common::frequency(shown.p_rad_s));
        panel.finish(&title, &common::record(&shown.record, &grid));
    }
    scene
}

/// The curve, and the flat line from its overturning level to the right.
fn path(curve: &IdaCurve) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = curve
        .edp
        .iter()
        .zip(&curve.im)
        .map(|(edp, im)| (*edp, *im))
        .take_while(|(edp, _)| !edp.is_infinite())
        .collect();
    let first = curve.edp.iter().position(|e| e.is_infinite());
    let level = curve
        .overturning_im
        .or_else(|| first.and_then(|i| curve.im.get(i).copied()));
    if let Some(level) = level {
        points.push((1.0, level));
        points.push((END, level));
    }
    points
}
