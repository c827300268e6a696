//! Figure 11: intensity given demand, original and shifted side by side.

use super::common::{self, thin};
use super::heading::{Figure, Heading};
use crate::axis::Axis;
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::grid::Grid;
use crate::legend::{Entry, Sample};
use crate::panel::{Marker, Panel};
use crate::scene::Scene;
use rocking_common::paper::Intensity;
use rocking_common::table::{Table, number, point};
use rocking_common::words::letter;

/// Width of a panel, and px a factor of e, for [`Capacities::thinned`].
const WIDTH_PX: f64 = 440.0;
const PX_PER_E: f64 = 60.0;

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
    /// Demand level, and the 16, 50 and 84 % quantiles of the records there
    /// (unshifted).
    pub quantiles: Vec<(f64, [f64; 3])>,
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
    pub fn thinned(mut self) -> Self {
        for panel in &mut self.panels {
            // As on a logarithmic axis, where the steepest part is drawn at
            // the lowest capacities.
            let ims = panel.curves.iter().flat_map(|c| c.im.iter().copied());
            let (_, top) = common::span(ims, true).unwrap_or((1.0, 1.0));
            for curve in &mut panel.curves {
                let logs = curve.im.iter().map(|x| libm::log(x / top));
                let mut logs: Vec<f64> = logs.collect();
                let mut edp = curve.edp.clone();
                thin(&mut edp, &mut logs, (WIDTH_PX, PX_PER_E));
                let ims = logs.iter().map(|y| top * libm::exp(*y));
                (curve.edp, curve.im) = (edp, ims.collect());
            }
        }
        self
    }

    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(&self, reading: String) -> Figure {
        Figure::new(&self.heading, scene(self), self.csv(), reading)
    }

    /// `panel,im,shift,record,edp,intensity`; in the place of a record the
    /// quantiles too.
    fn csv(&self) -> String {
        let mut table = Table::headed("panel,im,shift,record,edp,intensity");
        for (i, panel) in self.panels.iter().enumerate() {
            let mut row = |record: &str, edp: f64, im: f64| {
                table.row([
                    letter(i),
                    panel.intensity.name().into(),
                    number(panel.shift),
                    record.into(),
                    number(edp),
                    point(im),
                ]);
            };
            for curve in &panel.curves {
                for (edp, im) in curve.edp.iter().zip(&curve.im) {
                    row(&curve.record, *edp, *im);
                }
            }
            for (edp, of) in &panel.quantiles {
                for (name, im) in ["16 %", "50 %", "84 %"].iter().zip(of) {
                    row(name, *edp, *im);
                }
            }
        }
        table.finish()
    }
}

const CURVE: Pen = Pen::new(Ink::Muted, 0.35);
const SHIFT: Pen = Pen::new(Ink::Text, 0.9).dash(Dash::Dashed);
const ORIGINAL: Ink = Ink::Series(0);
const SHIFTED: Ink = Ink::Series(2);

fn band(ink: Ink) -> Fill {
    Fill::tint(ink, 30)
}

fn scene(figure: &Capacities) -> Scene {
    let grid = Grid::new(2 * figure.panels.len(), 2).plot(440.0, 250.0);
    let line = |ink, width| Sample::Line(Pen::new(ink, width));
    let mut legend = vec![
        Entry::new(Sample::Line(Pen { width_px: 0.7, ..CURVE }), "one record"),
        Entry::new(line(ORIGINAL, 1.8), "median, original"),
        Entry::new(Sample::Band(band(ORIGINAL)), "16 to 84 %"),
        Entry::new(line(SHIFTED, 1.8), "median, IM − IM_{R}"),
        Entry::new(Sample::Band(band(SHIFTED)), "16 to 84 %"),
        Entry::new(Sample::Line(SHIFT), "IM_{R}"),
    ];
    let cut = |c: &CapacityCurve| c.im.iter().any(|x| !x.is_finite());
    if figure.panels.iter().flat_map(|p| &p.curves).any(cut) {
        let mark = Sample::Mark(Marker::Triangle, Ink::Text);
        legend.push(Entry::new(mark, "ends: never overturned"));
    }
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    for (row, shown) in figure.panels.iter().enumerate() {
        let (low, high) = range(shown);
        for (column, (words, ink, less)) in
            [("original", ORIGINAL, 0.0), ("shifted", SHIFTED, shown.shift)]
                .into_iter()
                .enumerate()
        {
            let x = Axis::linear(0.0, 1.0, 5).label(common::DEMAND);
            let less_r = if column == 0 { "" } else { " − IM_{R}" };
            let label = common::intensity(shown.intensity);
            let label = format!("{label}{less_r}");
            let y = Axis::logarithmic(low, high).label(label);
            let i = 2 * row + column;
            let mut panel = Panel::new(&mut scene, grid.frame(i), x, y);
            draw(&mut panel, shown, ink, less);
            if column == 0 {
                panel.horizontal(shown.shift, SHIFT);
            }
            let title = format!(
                "{}, {words}: {}, {}, {} records",
                shown.intensity.name().to_uppercase(),
                common::frequency(figure.p_rad_s),
                common::slenderness(figure.alpha_rad),
                shown.curves.len(),
            );
            panel.finish(&common::panel_title(row, &title), "");
        }
    }
    scene
}

/// Pale curves of the records, over them the band and the median.
fn draw(panel: &mut Panel<'_>, shown: &CapacityPanel, ink: Ink, less: f64) {
    let (low, _) = panel.vertical_range();
    let at = |im: f64| if im - less > low { im - less } else { low };
    for curve in &shown.curves {
        let all = curve.edp.iter().zip(&curve.im);
        let points: Vec<_> = all
            .take_while(|(_, im)| im.is_finite())
            .map(|(edp, im)| (*edp, at(*im)))
            .collect();
        let ends = points.len() < curve.im.len();
        if let Some(last) = points.last().filter(|_| ends) {
            panel.marks([*last], Marker::Triangle, 3.2, Ink::Text);
        }
        panel.line(points, CURVE);
    }
    let rows = shown.quantiles.iter();
    let band_rows: Vec<_> = rows
        .clone()
        .map(|(edp, [low, _, high])| (*edp, at(*low), at(*high)))
        .collect();
    panel.band(&band_rows, band(ink));
    let median = rows.map(|(edp, [_, middle, _])| (*edp, at(*middle)));
    panel.line(median, Pen::new(ink, 1.8));
}

/// The capacities of all records, original and shifted; of the shifted ones
/// a twentieth may leave at the bottom.
fn range(shown: &CapacityPanel) -> (f64, f64) {
    let ims = || shown.curves.iter().flat_map(|c| c.im.iter().copied());
    let (_, high) = common::span(ims(), true).unwrap_or((1.0, 2.0));
    let starts = shown.curves.iter().filter_map(|c| c.im.first());
    let mut above: Vec<f64> = starts
        .map(|im| im - shown.shift)
        .filter(|x| *x > 0.0 && x.is_finite())
        .collect();
    above.sort_by(f64::total_cmp);
    let low = above.get(above.len() / 20).copied().unwrap_or(0.1 * high);
    (0.8 * low, 1.15 * high)
}
