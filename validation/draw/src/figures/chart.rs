//! Lines and marks over two axes: the figures that the paper does not have.

use super::common::{self, largest, thin};
use super::heading::{Figure, Heading};
use crate::axis::Axis;
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::grid::Grid;
use crate::legend::{Entry, Sample};
use crate::markup;
use crate::panel::{Marker, Panel};
use crate::scene::Scene;
use rocking_common::table::{Table, number};
use rocking_common::words::letter;

/// Size of a panel for [`Chart::thinned`], in px.
const WIDTH_PX: f64 = 560.0;
const HEIGHT_PX: f64 = 320.0;
/// Columns of a panel within which a line is its ends and extremes.
const COLUMNS: usize = 1120;

/// A figure of one or more panels with a shared legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// The words.
    pub heading: Heading,
    /// Panels row by row.
    pub panels: Vec<ChartPanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One pair of axes.
#[derive(Debug, Clone, PartialEq)]
pub struct ChartPanel {
    /// Title in markup, or nothing.
    pub title: String,
    /// Horizontal axis.
    pub x: ChartAxis,
    /// Vertical axis.
    pub y: ChartAxis,
    /// What is drawn, in this order.
    pub series: Vec<Series>,
}

/// One axis.
#[derive(Debug, Clone, PartialEq)]
pub struct ChartAxis {
    /// Label with unit, in markup.
    pub label: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Both ends; none: from the data.
    pub range: Ends,
    /// Names of the ticks at 1, 2, 3 and so on; empty: numbers.
    pub categories: Vec<String>,
    /// The same in another unit, at the opposite edge; of a horizontal axis
    /// alone.
    pub second: Option<Second>,
}

/// Both ends of an axis; none: from the data.
pub type Ends = Option<(f64, f64)>;

/// Another unit of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Second {
    /// How many of it make 1 of the axis.
    pub factor: f64,
    /// Label, in markup.
    pub label: String,
}

impl ChartAxis {
    fn new(label: impl Into<String>, scale: Scale, range: Ends) -> Self {
        let label = label.into();
        Self { label, scale, range, categories: Vec::new(), second: None }
    }

    /// A linear axis with these ends, or with those of the data.
    pub fn linear(label: impl Into<String>, ends: impl Into<Ends>) -> Self {
        Self::new(label, Scale::Linear, ends.into())
    }

    /// A logarithmic axis with these ends, or with those of the data.
    pub fn logarithmic(
        label: impl Into<String>,
        ends: impl Into<Ends>,
    ) -> Self {
        Self::new(label, Scale::Logarithmic, ends.into())
    }

    /// An axis with these names at 1, 2, 3 and so on.
    pub fn named(categories: Vec<String>) -> Self {
        Self { categories, ..Self::new("", Scale::Linear, None) }
    }

    /// The same axis with another unit beside its own.
    pub fn with_second(self, factor: f64, label: impl Into<String>) -> Self {
        Self { second: Some(Second { factor, label: label.into() }), ..self }
    }
}

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Linear.
    Linear,
    /// Logarithmic; values that are not positive are gaps.
    Logarithmic,
}

/// One legend entry's data.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Legend in markup; the same label has the same colour in every panel,
    /// an empty one is drawn in grey and has no legend.
    pub label: String,
    /// How it is drawn.
    pub mark: Mark,
    /// Abscissas.
    pub x: Vec<f64>,
    /// Ordinates.
    pub y: Vec<f64>,
    /// Intervals of the ordinates (error bars, or a band with
    /// [`Mark::Line`]); empty: none.
    pub interval: Vec<(f64, f64)>,
}

impl ChartPanel {
    /// A panel.
    pub fn new(
        title: impl Into<String>,
        x: ChartAxis,
        y: ChartAxis,
        series: Vec<Series>,
    ) -> Self {
        Self { title: title.into(), x, y, series }
    }
}

impl Series {
    /// A series without intervals.
    pub fn new(
        label: impl Into<String>,
        mark: Mark,
        x: Vec<f64>,
        y: Vec<f64>,
    ) -> Self {
        Self { label: label.into(), mark, x, y, interval: Vec::new() }
    }

    /// The series with these intervals.
    pub fn with(self, interval: Vec<(f64, f64)>) -> Self {
        Self { interval, ..self }
    }
}

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A line.
    Line,
    /// A dashed line, such as a reference slope or a limit.
    Dashed,
    /// Marks alone.
    Points,
    /// Marks joined by a line.
    LineAndPoints,
    /// Marks joined by a dashed line.
    DashedAndPoints,
}

impl Mark {
    fn has_points(self) -> bool {
        !matches!(self, Self::Line | Self::Dashed)
    }
}

impl Chart {
    /// The chart with no more points in its lines over linear axes than a
    /// drawing shows.
    pub fn thinned(mut self) -> Self {
        let linear = |p: &&mut ChartPanel| {
            p.x.scale == Scale::Linear && p.y.scale == Scale::Linear
        };
        for panel in self.panels.iter_mut().filter(linear) {
            let series = || panel.series.iter();
            let wide = largest(series().flat_map(|s| &s.x));
            let high = largest(series().flat_map(|s| &s.y));
            let px = (WIDTH_PX / wide, HEIGHT_PX / high);
            for series in &mut panel.series {
                if series.interval.is_empty() {
                    extremes(&mut series.x, &mut series.y);
                    thin(&mut series.x, &mut series.y, px);
                }
            }
        }
        self
    }

    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(&self, reading: impl Into<String>) -> Figure {
        Figure::new(&self.heading, scene(self), self.csv(), reading.into())
    }

    /// `panel,series,x,y,y_low,y_high`.
    fn csv(&self) -> String {
        let mut table = Table::headed("panel,series,x,y,y_low,y_high");
        for (i, panel) in self.panels.iter().enumerate() {
            for series in &panel.series {
                for (k, (x, y)) in series.x.iter().zip(&series.y).enumerate() {
                    let ends = series.interval.get(k).copied();
                    let (low, high) = ends.unwrap_or((f64::NAN, f64::NAN));
                    table.row([
                        letter(i),
                        markup::plain(&series.label),
                        number(*x),
                        number(*y),
                        number(low),
                        number(high),
                    ]);
                }
            }
        }
        table.finish()
    }
}

/// Leaves, of a long line, the first, lowest, highest and last point of every
/// stretch of it that a drawing cannot resolve.
fn extremes(x: &mut Vec<f64>, y: &mut Vec<f64>) {
    let stretch = y.len() / COLUMNS;
    if stretch < 8 {
        return;
    }
    let mut keep = vec![false; y.len()];
    for start in (0..y.len()).step_by(stretch) {
        let end = y.len().min(start + stretch);
        let (mut low, mut high) = (start, start);
        for i in start..end {
            if y[i] < y[low] {
                low = i;
            }
            if y[i] > y[high] {
                high = i;
            }
        }
        for i in [start, low, high, end - 1] {
            keep[i] = true;
        }
    }
    for values in [x, y] {
        let mut keep = keep.iter();
        values.retain(|_| keep.next() == Some(&true));
    }
}

/// Sizes of the plotting areas for a number of columns.
fn grid(panels: usize, columns: usize) -> Grid {
    let grid = Grid::new(panels, columns);
    match grid.columns {
        1 => grid.plot(560.0, 320.0),
        2 => grid.plot(440.0, 280.0),
        _ => grid,
    }
}

fn scene(figure: &Chart) -> Scene {
    let mut labels: Vec<&Series> = Vec::new();
    for series in figure.panels.iter().flat_map(|p| &p.series) {
        let known = labels.iter().any(|s| s.label == series.label);
        if !series.label.is_empty() && !known {
            labels.push(series);
        }
    }
    let legend: Vec<Entry> = labels
        .iter()
        .enumerate()
        .map(|(k, s)| Entry::new(sample(s.mark, k), s.label.as_str()))
        .collect();
    let grid = grid(figure.panels.len(), figure.columns);
    let above = figure.panels.iter().any(|p| p.x.second.is_some());
    let grid = if above { grid.with_second_axis() } else { grid };
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    for (i, shown) in figure.panels.iter().enumerate() {
        let (x, y) = axes(shown);
        let second = shown.x.second.as_ref().map(|second| {
            let (low, high) = x.range();
            let range = (second.factor * low, second.factor * high);
            let of = match shown.x.scale {
                Scale::Logarithmic => Axis::logarithmic(range.0, range.1),
                Scale::Linear => Axis::linear(range.0, range.1, 6),
            };
            of.label(second.label.as_str())
        });
        let mut panel = Panel::new(&mut scene, grid.frame(i), x, y);
        if let Some(second) = second {
            panel = panel.with_second(second);
        }
        for series in &shown.series {
            let rank = labels.iter().position(|s| s.label == series.label);
            draw_series(&mut panel, series, rank);
        }
        let title = match figure.panels.len() {
            1 => shown.title.clone(),
            _ => common::panel_title(i, &shown.title),
        };
        panel.finish(&title, "");
    }
    scene
}

fn sample(mark: Mark, rank: usize) -> Sample {
    let pen = pen(mark, Some(rank));
    let marker = Marker::of_series(rank);
    match mark {
        Mark::Line | Mark::Dashed => Sample::Line(pen),
        Mark::Points => Sample::Mark(marker, pen.ink),
        Mark::LineAndPoints | Mark::DashedAndPoints => {
            Sample::LineAndMark(pen, marker)
        }
    }
}

fn pen(mark: Mark, rank: Option<usize>) -> Pen {
    let Some(rank) = rank else {
        return Pen::new(Ink::Muted, 0.9).dash(Dash::Dashed);
    };
    match mark {
        Mark::Dashed | Mark::DashedAndPoints => {
            Pen::new(Ink::Series(rank), 1.1).dash(Dash::Dashed)
        }
        Mark::Line => Pen::of_series(rank),
        Mark::Points | Mark::LineAndPoints => Pen::new(Ink::Series(rank), 1.1),
    }
}

fn axes(shown: &ChartPanel) -> (Axis, Axis) {
    let xs = shown.series.iter().flat_map(|s| s.x.iter().copied());
    let ys = shown.series.iter().flat_map(|s| {
        let ends = s.interval.iter().flat_map(|(low, high)| [*low, *high]);
        s.y.iter().copied().chain(ends)
    });
    (axis(&shown.x, xs), axis(&shown.y, ys))
}

/// The axis asked for, fitted to the data where no range is given.
fn axis(asked: &ChartAxis, values: impl Iterator<Item = f64>) -> Axis {
    if !asked.categories.is_empty() {
        return Axis::named(&asked.categories).label(asked.label.as_str());
    }
    let logarithmic = asked.scale == Scale::Logarithmic;
    let span = asked.range.or_else(|| common::span(values, logarithmic));
    let (low, high) = span.unwrap_or((1.0, 10.0));
    let axis = match (logarithmic, asked.range) {
        (true, Some(_)) => Axis::logarithmic(low, high),
        (true, None) => Axis::logarithmic(low / 1.3, high * 1.3),
        (false, Some(_)) => Axis::linear(low, high, 6),
        (false, None) => Axis::around(low, high, 6),
    };
    axis.label(asked.label.as_str())
}

fn draw_series(panel: &mut Panel<'_>, series: &Series, rank: Option<usize>) {
    let pen = pen(series.mark, rank);
    let points = || series.x.iter().zip(&series.y).map(|(x, y)| (*x, *y));
    let ends = series.x.iter().zip(&series.interval);
    let marked = series.mark.has_points();
    if marked {
        for (x, (low, high)) in ends {
            let bar = Pen { width_px: 0.8, dash: Dash::Solid, ..pen };
            panel.line([(*x, *low), (*x, *high)], bar);
        }
    } else {
        let rows: Vec<_> = ends.map(|(x, (a, b))| (*x, *a, *b)).collect();
        panel.band(&rows, Fill::tint(pen.ink, 16));
    }
    if series.mark != Mark::Points {
        panel.line(points(), pen);
    }
    if marked {
        let marker = Marker::of_series(rank.unwrap_or(0));
        panel.marks(points(), marker, 3.0, pen.ink);
    }
}
