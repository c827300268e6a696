//! Figure 13: the test along the demand, and histograms at one level.

use rocking::statistics::normal;

use super::Figure;
use super::common;
use super::data::{Heading, Histogram, TestsAlongDemand};
use crate::draw::geometry::Rect;
use crate::draw::{
    Axis, Dash, Entry, Fill, Grid, Ink, Marker, Panel, Pen, Sample, Scene,
};
use crate::paper::Intensity;

impl Figure for TestsAlongDemand {
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

const ORIGINAL: Ink = Ink::Series(0);
const SHIFTED: Ink = Ink::Series(2);
const LIMIT: Pen = Pen::new(Ink::Text, 0.8).dash(Dash::Dashed);

pub(super) fn scene(figure: &TestsAlongDemand) -> Scene {
    let line = |ink, marker| Sample::LineAndMark(Pen::new(ink, 1.1), marker);
    let legend = [
        Entry::new(line(ORIGINAL, Marker::Dot), "original sample"),
        Entry::new(line(SHIFTED, Marker::Square), "shifted sample"),
        Entry::new(Sample::Line(LIMIT), "5 % critical value"),
        Entry::new(Sample::Line(Pen::new(Ink::Text, 1.1)), "fitted normal"),
    ];
    let grid = Grid::new(3 * figure.blocks.len(), 3).with_subtitles();
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    let im = match figure.intensity {
        Intensity::Pga => "IM = PGA / (*g* tan *α*)",
        Intensity::Pgv => "IM = *p* PGV / (*g* tan *α*)",
    };
    for (row, block) in figure.blocks.iter().enumerate() {
        let first = 3 * row;
        let ratios = block.original.iter().chain(&block.shifted);
        let (_, high) =
            common::span(ratios.copied(), true).unwrap_or((0.0, 1.5));
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
        let title = format!(
            "{}, {}",
            common::frequency(block.p_rad_s),
            common::slenderness(block.alpha_rad)
        );
        panel.finish(&common::panel_title(first, &title), im);
        let level = common::short(figure.edp);
        for (k, histogram, ink, words) in [
            (1, &block.original_histogram, ORIGINAL, "ln IM"),
            (2, &block.shifted_histogram, SHIFTED, "ln(IM − IM_{R})"),
        ] {
            let title = format!("{words} at *θ̃* = {level}");
            let title = common::panel_title(first + k, &title);
            let frame = grid.frame(first + k);
            draw_histogram(&mut scene, frame, histogram, ink, words, &title);
        }
    }
    scene
}

fn draw_histogram(
    scene: &mut Scene,
    frame: Rect,
    histogram: &Histogram,
    ink: Ink,
    label: &str,
    title: &str,
) {
    let n: usize = histogram.counts.iter().sum();
    let most = histogram.counts.iter().max().copied().unwrap_or(0);
    let (low, high) = common::span(histogram.edges.iter().copied(), false)
        .unwrap_or((0.0, 1.0));
    let width = match histogram.edges.as_slice() {
        [first, second, ..] => second - first,
        _ => 1.0,
    };
    let density = |x: f64| {
        let z = (x - histogram.mean) / histogram.deviation;
        normal::pdf(z) / histogram.deviation * (n as f64 * width)
    };
    let peak = density(histogram.mean);
    let peak = if peak.is_finite() { peak } else { 0.0 };
    let top = (most as f64).max(peak.min(2.0 * most as f64)).max(1.0);
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
        let curve = curve.map(|x| (x, density(x)));
        panel.line(curve, Pen::new(Ink::Text, 1.1));
    }
    panel.finish(title, &format!("{n} records"));
}
