//! Figure 11: intensity given demand, original and shifted.

use super::Figure;
use super::common;
use super::data::{Capacities, CapacityPanel, Heading};
use crate::draw::{Axis, Dash, Entry, Grid, Ink, Panel, Pen, Sample, Scene};
use crate::paper::Intensity;

impl Figure for Capacities {
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

const ORIGINAL: Pen = Pen::new(Ink::Series(0), 0.45);
const SHIFTED: Pen = Pen::new(Ink::Series(2), 0.45);
const SHIFT: Pen = Pen::new(Ink::Text, 0.9).dash(Dash::Dashed);

pub(super) fn scene(figure: &Capacities) -> Scene {
    let grid =
        Grid::new(figure.panels.len(), 2).plot(440.0, 300.0).with_subtitles();
    let legend = [
        Entry::new(
            Sample::Line(Pen { width_px: 1.2, ..ORIGINAL }),
            "original sample",
        ),
        Entry::new(
            Sample::Line(Pen { width_px: 1.2, ..SHIFTED }),
            "shifted sample (IM − IM_{R})",
        ),
        Entry::new(Sample::Line(SHIFT), "IM_{R}"),
    ];
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    for (i, shown) in figure.panels.iter().enumerate() {
        let x = Axis::linear(0.0, 1.0, 5).label(common::DEMAND);
        let y =
            Axis::around(0.0, top(shown), 6).label(match shown.intensity {
                Intensity::Pga => {
                    "PGA / (*g* tan *α*), less IM_{R} if shifted"
                }
                Intensity::Pgv => {
                    "*p* PGV / (*g* tan *α*), less IM_{R} if shifted"
                }
            });
        let mut panel = Panel::new(&mut scene, grid.frame(i), x, y);
        for (pen, less) in [(SHIFTED, shown.shift), (ORIGINAL, 0.0)] {
            for curve in &shown.curves {
                let points = curve.edp.iter().zip(&curve.im);
                panel.line(points.map(|(e, im)| (*e, im - less)), pen);
            }
        }
        panel.horizontal(shown.shift, SHIFT);
        let title = format!(
            "{}, {}, {}",
            match shown.intensity {
                Intensity::Pga => "PGA",
                Intensity::Pgv => "PGV",
            },
            common::frequency(figure.p_rad_s),
            common::slenderness(figure.alpha_rad),
        );
        let records = format!(
            "{} records, IM_{{R}} = {}",
            shown.curves.len(),
            common::short(shown.shift)
        );
        panel.finish(&common::panel_title(i, &title), &records);
    }
    scene
}

/// The largest capacity, but at most 1.4 times the level that nine in ten
/// records stay below: one sturdy record must not flatten the others.
fn top(shown: &CapacityPanel) -> f64 {
    let largest = |c: &super::data::CapacityCurve| {
        common::span(c.im.iter().copied(), true).map(|(_, high)| high)
    };
    let mut ends: Vec<f64> = shown.curves.iter().filter_map(largest).collect();
    ends.sort_by(f64::total_cmp);
    let (Some(last), Some(most)) =
        (ends.last(), ends.get(ends.len() * 9 / 10))
    else {
        return 2.0;
    };
    last.min(1.4 * most)
}
