//! Figures 4 and 5: single-record IDA curves.

use super::Figure;
use super::common;
use super::common::Slendernesses;
use super::data::{Heading, IdaCurve, IdaCurves};
use crate::draw::{Axis, Grid, Panel, Pen, Scene};

impl Figure for IdaCurves {
    fn heading(&self) -> &Heading {
        &self.heading
    }

    fn scene(&self) -> Scene {
        scene(self)
    }

    fn csv(&self) -> String {
        self.csv()
    }
}

/// The end of the demand axis, past 1 so that overturning stays inside.
const END: f64 = 1.08;

pub(super) fn scene(figure: &IdaCurves) -> Scene {
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
            .label(common::intensity(figure.intensity));
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
