//! Figure 11: intensity given demand, original and shifted.

use super::common::{self, largest, thin};
use super::{Figure, Heading};
use crate::draw::{Axis, Dash, Entry, Grid, Ink, Panel, Pen, Sample, Scene};
use crate::paper::Intensity;
use crate::table::{Table, number, point};
use crate::words::letter;

/// Size of a panel for [`Capacities::thinned`].
const PX: f64 = 440.0;

/// Capacity curves, intensity given demand, as inverted and shifted.
#[derive(Debug, Clone, PartialEq)]
pub struct Capacities {
    /// The words.
    pub heading: Heading,
    /// Slenderness of the block.
    pub alpha_rad: f64,
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// One panel an intensity measure: (a) PGA, (b) PGV.
    pub panels: Vec<CapacityPanel>,
}

/// One intensity measure.
#[derive(Debug, Clone, PartialEq)]
pub struct CapacityPanel {
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// The shift IM_R.
    pub shift: f64,
    /// A curve a record.
    pub curves: Vec<CapacityCurve>,
}

/// One record's capacities; the shifted curve is drawn from `im - shift`.
#[derive(Debug, Clone, PartialEq)]
pub struct CapacityCurve {
    /// Record.
    pub record: String,
    /// Demand levels, rising, 0 to 1.
    pub edp: Vec<f64>,
    /// Intensity that reaches each level (unshifted).
    pub im: Vec<f64>,
}

impl Capacities {
    /// The same with only the points that a drawing keeps: none that is
    /// left out lies farther than a tenth of a pixel from the line. Of
    /// a curve's levels without a capacity the first one stays.
    #[must_use]
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
    #[must_use]
    pub fn figure(&self, reading: String) -> Figure {
        Figure::new(&self.heading, scene(self), self.csv(), reading)
    }

    /// `panel,im_kind,shift,record,edp,im`.
    fn csv(&self) -> String {
        let mut table =
            Table::new(&["panel", "im_kind", "shift", "record", "edp", "im"]);
        for (i, panel) in self.panels.iter().enumerate() {
            for curve in &panel.curves {
                for (edp, im) in curve.edp.iter().zip(&curve.im) {
                    table.row([
                        letter(i),
                        panel.intensity.name().into(),
                        number(panel.shift),
                        curve.record.clone(),
                        number(*edp),
                        point(*im),
                    ]);
                }
            }
        }
        table.finish()
    }
}

const ORIGINAL: Pen = Pen::new(Ink::Series(0), 0.45);
const SHIFTED: Pen = Pen::new(Ink::Series(2), 0.45);
const SHIFT: Pen = Pen::new(Ink::Text, 0.9).dash(Dash::Dashed);

fn scene(figure: &Capacities) -> Scene {
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
    let largest = |c: &CapacityCurve| {
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
