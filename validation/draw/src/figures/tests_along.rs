//! Figure 13: the test along the demand, and histograms at one level.

use super::common;
use super::heading::{Figure, Heading};
use crate::axis::Axis;
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::geometry::Rect;
use crate::grid::Grid;
use crate::legend::{Entry, Sample};
use crate::panel::{Marker, Panel};
use crate::scene::Scene;
use rocking::statistics::normal;
use rocking_common::paper::Intensity;
use rocking_common::table::{Table, number};

/// The test along the demand, with histograms at one level: a row a block.
#[derive(Debug, Clone, PartialEq)]
pub struct TestsAlongDemand {
    /// The words.
    pub heading: Heading,
    /// Demand level of the histograms.
    pub edp: f64,
    /// The blocks.
    pub blocks: Vec<TestedBlock>,
}

/// One block: three panels.
#[derive(Debug, Clone, PartialEq)]
pub struct TestedBlock {
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// Slenderness.
    pub alpha_rad: f64,
    /// Demand levels, rising.
    pub edp: Vec<f64>,
    /// Lilliefors' D over its 5 % critical value, original sample: accepted
    /// up to 1.
    pub original: Vec<f64>,
    /// The same for the shifted sample.
    pub shifted: Vec<f64>,
    /// The 5 % critical value, over the table's, of shifted overturnings on
    /// the grid of 0.01 g; none in other arms.
    pub grid_critical: Option<f64>,
    /// Histogram of ln IM.
    pub original_histogram: Histogram,
    /// Histogram of ln(IM - IM_R).
    pub shifted_histogram: Histogram,
}

/// A histogram with the normal fitted to the same sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Histogram {
    /// Bin edges, rising; one more than the counts.
    pub edges: Vec<f64>,
    /// Data in each bin.
    pub counts: Vec<usize>,
    /// Mean of the fitted normal.
    pub mean: f64,
    /// Standard deviation of the fitted normal.
    pub deviation: f64,
}

impl Histogram {
    /// Bins of the width 2 IQR/n^(1/3) (Freedman and Diaconis, Zeitschrift
    /// fuer Wahrscheinlichkeitstheorie 57, 1981, 453-476), starting at the
    /// smallest datum; at most 100. Data that are not finite are left out.
    ///
    /// `quartiles` are the sample's lower and upper quartile, `mean` and
    /// `deviation` those of the normal to be drawn. A sample without spread
    /// gets one bin.
    pub fn freedman_diaconis(
        sample: &[f64],
        quartiles: (f64, f64),
        mean: f64,
        deviation: f64,
    ) -> Self {
        let mut data: Vec<f64> =
            sample.iter().copied().filter(|x| x.is_finite()).collect();
        data.sort_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (data.first(), data.last()) else {
            let (edges, counts) = (Vec::new(), Vec::new());
            return Self { edges, counts, mean, deviation };
        };
        let n = data.len() as f64;
        let width = 2.0 * (quartiles.1 - quartiles.0) / libm::cbrt(n);
        let bins = if width > 0.0 && high > low {
            ((high - low) / width).ceil().clamp(1.0, 100.0)
        } else {
            1.0
        };
        let (width, low) = if high > low {
            ((high - low) / bins, low)
        } else {
            (1.0, low - 0.5)
        };
        let bins = bins as usize;
        let edges: Vec<f64> =
            (0..=bins).map(|i| width.mul_add(i as f64, low)).collect();
        let mut counts = vec![0; bins];
        for x in data {
            let bin = edges[1..bins].partition_point(|e| *e <= x);
            counts[bin] += 1;
        }
        Self { edges, counts, mean, deviation }
    }
}

impl TestsAlongDemand {
    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(&self, reading: String) -> Figure {
        Figure::new(&self.heading, scene(self), self.csv(), reading)
    }

    /// `alpha_rad,p_rad_s,im,sample,quantity,at,value`, where `at` is
    /// the demand, or the bin's lower edge.
    fn csv(&self) -> String {
        let mut table =
            Table::headed("alpha_rad,p_rad_s,im,sample,quantity,at,value");
        for block in &self.blocks {
            let mut row = |sample: &str, quantity: &str, at, value| {
                table.row([
                    number(block.alpha_rad),
                    number(block.p_rad_s),
                    Intensity::Pga.name().into(),
                    sample.into(),
                    quantity.into(),
                    number(at),
                    number(value),
                ]);
            };
            for (sample, ratios, histogram) in [
                ("original", &block.original, &block.original_histogram),
                ("shifted", &block.shifted, &block.shifted_histogram),
            ] {
                for (edp, ratio) in block.edp.iter().zip(ratios) {
                    row(sample, "d_over_critical", *edp, *ratio);
                }
                for (edge, n) in histogram.edges.iter().zip(&histogram.counts)
                {
                    row(sample, "count_from", *edge, *n as f64);
                }
                if let Some(end) = histogram.edges.last() {
                    row(sample, "last_edge", *end, f64::NAN);
                }
                if sample == "shifted"
                    && let Some(ratio) = block.grid_critical
                {
                    row(sample, "grid_critical_over_critical", 1.0, ratio);
                }
                row(sample, "normal_mean", self.edp, histogram.mean);
                row(sample, "normal_sd", self.edp, histogram.deviation);
            }
        }
        table.finish()
    }
}

const ORIGINAL: Ink = Ink::Series(0);
const SHIFTED: Ink = Ink::Series(2);
const GRID: Ink = Ink::Series(1);
const LIMIT: Pen = Pen::new(Ink::Text, 0.8).dash(Dash::Dashed);

fn scene(figure: &TestsAlongDemand) -> Scene {
    let line = |ink, marker| Sample::LineAndMark(Pen::new(ink, 1.1), marker);
    let mut legend = vec![
        Entry::new(line(ORIGINAL, Marker::Dot), "original sample"),
        Entry::new(line(SHIFTED, Marker::Square), "shifted sample"),
        Entry::new(Sample::Line(LIMIT), "5 % critical value"),
        Entry::new(Sample::Line(Pen::new(Ink::Text, 1.1)), "fitted normal"),
    ];
    if figure.blocks.iter().any(|b| b.grid_critical.is_some()) {
        let mark = Sample::Mark(Marker::Diamond, GRID);
        let words = "shifted, 5 % on the 0.01 *g* grid at overturning";
        legend.push(Entry::new(mark, words));
    }
    let grid = Grid::new(3 * figure.blocks.len(), 3).with_subtitles();
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    let im = format!("IM = {}", common::intensity(Intensity::Pga));
    // The same scale for all blocks: they are compared.
    let ratios = figure.blocks.iter().flat_map(|b| {
        b.original.iter().chain(&b.shifted).chain(&b.grid_critical)
    });
    let histograms = figure
        .blocks
        .iter()
        .flat_map(|b| [&b.original_histogram, &b.shifted_histogram]);
    let top = histograms.map(top).fold(1.0, f64::max);
    let (_, high) = common::span(ratios.copied(), true).unwrap_or((0.0, 1.5));
    for (row, block) in figure.blocks.iter().enumerate() {
        let first = 3 * row;
        let x = Axis::linear(0.0, 1.0, 5).label(common::DEMAND);
        let y = Axis::around(0.0, (1.05 * high).clamp(1.4, 12.0), 6)
            .label("*D* / *D*_{5 %}");
        let mut panel = Panel::new(&mut scene, grid.frame(first), x, y);
        panel.horizontal(1.0, LIMIT);
        for (values, ink, marker) in [
            (&block.original, ORIGINAL, Marker::Dot),
            (&block.shifted, SHIFTED, Marker::Square),
        ] {
            let points =
                || block.edp.iter().zip(values).map(|(e, d)| (*e, *d));
            panel.line(points(), Pen::new(ink, 0.9));
            let few = points().step_by((block.edp.len() / 40).max(1));
            panel.marks(few, marker, 1.7, ink);
        }
        let critical = block.grid_critical.map(|ratio| (1.0, ratio));
        panel.marks(critical, Marker::Diamond, 4.0, GRID);
        let title = format!(
            "{}, {}",
            common::frequency(block.p_rad_s),
            common::slenderness(block.alpha_rad)
        );
        panel.finish(&common::panel_title(first, &title), &im);
        let level = common::short(figure.edp);
        for (k, histogram, ink, words) in [
            (1, &block.original_histogram, ORIGINAL, "ln IM"),
            (2, &block.shifted_histogram, SHIFTED, "ln(IM − IM_{R})"),
        ] {
            let title = format!("{words} at *θ̃* = {level}");
            let title = common::panel_title(first + k, &title);
            let frame = grid.frame(first + k);
            let words = (words, title.as_str());
            draw_histogram(&mut scene, frame, histogram, ink, words, top);
        }
    }
    scene
}

/// Width of a bin.
fn bin(histogram: &Histogram) -> f64 {
    match histogram.edges.as_slice() {
        [first, second, ..] => second - first,
        _ => 1.0,
    }
}

/// Records a bin that the fitted normal gives.
fn density(histogram: &Histogram, x: f64) -> f64 {
    let n: usize = histogram.counts.iter().sum();
    let z = (x - histogram.mean) / histogram.deviation;
    normal::pdf(z) / histogram.deviation * (n as f64 * bin(histogram))
}

/// What a histogram and its normal reach.
fn top(histogram: &Histogram) -> f64 {
    let most = histogram.counts.iter().max().copied().unwrap_or(0);
    let peak = density(histogram, histogram.mean);
    let peak = if peak.is_finite() { peak } else { 0.0 };
    (most as f64).max(peak.min(2.0 * most as f64)).max(1.0)
}

fn draw_histogram(
    scene: &mut Scene,
    frame: Rect,
    histogram: &Histogram,
    ink: Ink,
    (label, title): (&str, &str),
    top: f64,
) {
    let n: usize = histogram.counts.iter().sum();
    let (low, high) = common::span(histogram.edges.iter().copied(), false)
        .unwrap_or((0.0, 1.0));
    let margin = 0.08 * (high - low);
    let x = Axis::around(low - margin, high + margin, 6).label(label);
    let range = x.range();
    let y = Axis::around(0.0, 1.05 * top, 5).label("records");
    let mut panel = Panel::new(scene, frame, x, y);
    for (edges, count) in histogram.edges.windows(2).zip(&histogram.counts) {
        let (a, b) = ((edges[0], 0.0), (edges[1], *count as f64));
        panel.bar(a, b, Fill::tint(ink, 30));
        let [left, right, up] = [a.0, b.0, b.1];
        let outline = [(left, 0.0), (left, up), (right, up), (right, 0.0)];
        panel.line(outline, Pen::new(ink, 0.8));
    }
    if histogram.deviation > 0.0 {
        let step = (range.1 - range.0) / 160.0;
        let curve = (0..=160).map(|i| step.mul_add(f64::from(i), range.0));
        let curve = curve.map(|x| (x, density(histogram, x)));
        panel.line(curve, Pen::new(Ink::Text, 1.1));
    }
    panel.finish(title, &format!("{n} records"));
}
