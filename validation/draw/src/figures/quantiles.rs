//! Figures 8 and 10: 16/50/84 % curves of the demand given the intensity.

use super::common;
use super::heading::{Figure, Heading};
use crate::axis::Axis;
use crate::colour::{Ink, Pen};
use crate::grid::Grid;
use crate::legend::{Entry, Sample};
use crate::markup;
use crate::panel::Panel;
use crate::scene::Scene;
use crate::text::Horizontal;
use rocking_common::paper::Intensity;
use rocking_common::table::{Table, number};
use rocking_common::words::letter;

/// 16/50/84 % curves of the demand given the intensity.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantiles {
    /// The words.
    pub heading: Heading,
    /// Panels row by row.
    pub panels: Vec<QuantilePanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One frequency parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct QuantilePanel {
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// More words for the panel's title, or nothing.
    pub note: String,
    /// What is compared: five slendernesses, or two procedures.
    pub groups: Vec<QuantileGroup>,
}

/// Three curves of one colour.
#[derive(Debug, Clone, PartialEq)]
pub struct QuantileGroup {
    /// Legend in markup: `*α* = 0.05 rad`, `scaled records`.
    pub label: String,
    /// Intensities, rising.
    pub im: Vec<f64>,
    /// 16 % quantile of peak |theta|/alpha, median and 84 % quantile;
    /// +infinity once overturned.
    pub quantiles: [Vec<f64>; 3],
}

impl Quantiles {
    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(&self, reading: String) -> Figure {
        Figure::new(&self.heading, scene(self), self.csv(), reading)
    }

    /// `panel,p_rad_s,note,im,group,intensity,q16,q50,q84`.
    fn csv(&self) -> String {
        let mut table =
            Table::headed("panel,p_rad_s,note,im,group,intensity,q16,q50,q84");
        for (i, panel) in self.panels.iter().enumerate() {
            for group in &panel.groups {
                for (k, im) in group.im.iter().enumerate() {
                    let at = |v: &Vec<f64>| {
                        number(v.get(k).copied().unwrap_or(f64::NAN))
                    };
                    let [q16, q50, q84] = group.quantiles.each_ref().map(at);
                    table.row([
                        letter(i),
                        number(panel.p_rad_s),
                        panel.note.clone(),
                        Intensity::Pga.name().into(),
                        markup::plain(&group.label),
                        number(*im),
                        q16,
                        q50,
                        q84,
                    ]);
                }
            }
        }
        table.finish()
    }
}

/// The end of the demand axis, past 1 so that overturning stays inside.
const END: f64 = 1.08;
/// Smallest distance between words at the edge, in px.
const APART_PX: f64 = 11.5;

fn scene(figure: &Quantiles) -> Scene {
    let labels = labels(figure);
    let line = |(k, label): (usize, &String)| {
        Entry::new(Sample::Line(Pen::of_series(k)), label.as_str())
    };
    let mut legend: Vec<Entry> = labels.iter().enumerate().map(line).collect();
    for (width, words) in [(1.8, "median"), (0.9, "16 and 84 %")] {
        let pen = Pen::new(Ink::Text, width);
        legend.push(Entry::new(Sample::Line(pen), words));
    }
    let grid = Grid::new(figure.panels.len(), figure.columns);
    let grid = match grid.columns {
        2 => Grid { right: 40.0, width: 330.0, height: 190.0, ..grid },
        _ => Grid { right: 40.0, width: 264.0, ..grid },
    };
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    for (i, shown) in figure.panels.iter().enumerate() {
        let x = Axis::linear(0.0, END, 5).label(common::DEMAND);
        let same = |p: &&QuantilePanel| p.p_rad_s == shown.p_rad_s;
        let (low, high) = levels(figure.panels.iter().filter(same));
        let y = Axis::linear(low, high, 6)
            .label(common::intensity(Intensity::Pga));
        let mut panel = Panel::new(&mut scene, grid.frame(i), x, y);
        for group in &shown.groups {
            let series =
                labels.iter().position(|l| *l == group.label).unwrap_or(0);
            draw_group(&mut panel, group, series);
        }
        edge_words(&mut panel, shown);
        let mut title = common::frequency(shown.p_rad_s);
        if !shown.note.is_empty() {
            title = format!("{title}, {}", common::words(&shown.note));
        }
        panel.finish(&common::panel_title(i, &title), "");
    }
    scene
}

fn labels(figure: &Quantiles) -> Vec<String> {
    let mut labels: Vec<String> = Vec::new();
    for group in figure.panels.iter().flat_map(|p| &p.groups) {
        if !labels.contains(&group.label) {
            labels.push(group.label.clone());
        }
    }
    labels
}

fn draw_group(panel: &mut Panel<'_>, group: &QuantileGroup, series: usize) {
    let usual = Pen::of_series(series);
    for (curve, width) in group.quantiles.iter().zip([0.55, 1.15, 0.55]) {
        let pen = Pen { width_px: width * usual.width_px, ..usual };
        panel.line(path(&group.im, curve), pen);
    }
}

/// The curve, then along its first infinite level to the right.
fn path(im: &[f64], edp: &[f64]) -> Vec<(f64, f64)> {
    let mut points = Vec::new();
    for (im, edp) in im.iter().zip(edp) {
        if edp.is_infinite() {
            points.push((1.0, *im));
            points.push((END, *im));
            break;
        }
        points.push((*edp, *im));
    }
    points
}

/// Level at which a quantile turns infinite.
fn ends_at(im: &[f64], edp: &[f64]) -> Option<f64> {
    let first = edp.iter().position(|e| e.is_infinite())?;
    im.get(first).copied()
}

/// Ends of the intensity axis of some panels: 1, or the lowest level shown,
/// and a little above the last overturning level.
fn levels<'a>(panels: impl Iterator<Item = &'a QuantilePanel>) -> (f64, f64) {
    let groups: Vec<&QuantileGroup> = panels.flat_map(|p| &p.groups).collect();
    let ends = groups.iter().map(|g| {
        ends_at(&g.im, &g.quantiles[0]).or(g.im.last().copied()).unwrap_or(1.0)
    });
    let starts = groups.iter().filter_map(|g| g.im.first().copied());
    let (_, high) = common::span(ends, true).unwrap_or((1.0, 2.0));
    let (low, _) = common::span(starts, true).unwrap_or((1.0, 2.0));
    let low = if low < 0.99 { 0.0 } else { 1.0 };
    (low, 1.06_f64.mul_add(high - low, low))
}

/// The words at the end of a curve that does not reach overturning.
fn inner_words(
    panel: &mut Panel<'_>,
    shown: &QuantilePanel,
    words: &str,
    curve: usize,
) {
    let finite = |g: &QuantileGroup| {
        let edp = &g.quantiles[curve];
        let last = edp.iter().rposition(|e| e.is_finite())?;
        Some((edp[last], *g.im.get(last)?))
    };
    let ends: Vec<_> = shown.groups.iter().filter_map(finite).collect();
    let right = common::span(ends.iter().map(|e| e.0), false);
    if let (Some((_, x)), Some((_, y))) = (right, ends.first()) {
        panel.words_at((x + 0.02, *y), words, Horizontal::Left);
    }
}

/// `16 %`, `50 %`, `84 %` where the curves leave, kept apart.
fn edge_words(panel: &mut Panel<'_>, shown: &QuantilePanel) {
    let mut last = f64::INFINITY;
    for (curve, words) in [(2, "84 %"), (1, "50 %"), (0, "16 %")] {
        let groups = shown.groups.iter();
        let ends = groups.filter_map(|g| ends_at(&g.im, &g.quantiles[curve]));
        let Some((low, high)) = common::span(ends, true) else {
            inner_words(panel, shown, words, curve);
            continue;
        };
        let y = panel.to_px((0.0, f64::midpoint(low, high))).1;
        let y = y.min(last - APART_PX);
        last = y;
        panel.right_of_px(y, words);
    }
}
