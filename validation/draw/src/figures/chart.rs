//! Lines and marks over two axes: the figures that the paper does not have.

use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::iter::repeat;

use super::common;
use super::heading::Heading;
use super::series::{Mark, Series};
use crate::axis::{Axis, AxisScale};
use crate::colour::{Ink, Pen};
use crate::drawing::Drawing;
use crate::geometry::{Point, kept};
use crate::grid::Grid;
use crate::legend::{Entry, Sample};
use crate::panel::{Look, Marker, Panel};
use crate::text::{Horizontal, TEXT_PX};
use rocking_common::table::{Table, digits};
use rocking_common::words::letter;
use serde::{Deserialize, Serialize};

/// Columns of a panel within which a line is its ends and extremes.
const COLUMNS: usize = 1120;
/// How far a thinned line may be from the full one, in px.
const TOLERANCE_PX: f64 = 0.1;
/// Between the baselines of two notes in the corner, in px.
const NOTE_PX: f64 = 13.5;
/// Smallest distance between words at the right-hand edge, in px.
const APART_PX: f64 = 11.5;

/// So many lines show beside one another where they coincide; more of them
/// get thinner from one to the next.
const FEW: usize = 4;
/// Room for words at the right-hand edge, in px.
const EDGE_PX: f64 = 56.0;
/// Room above a panel with a second line of title, in px.
const SUBTITLE_PX: f64 = 38.0;
/// Room above a panel with an axis at its upper edge, in px.
const SECOND_AXIS_PX: f64 = 62.0;

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
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChartPanel {
    /// Title in markup, or nothing; what follows a line break stands below it.
    pub title: String,
    /// Horizontal axis.
    pub x: ChartAxis,
    /// Vertical axis.
    pub y: ChartAxis,
    /// What is drawn, in this order.
    pub series: Vec<Series>,
}

/// One axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChartAxis {
    /// The same in another unit, at the opposite edge, if the axis is
    /// horizontal: how many of it make 1 of the axis, and its label.
    second: Option<(f64, String)>,
    drawn: Axis,
    /// Whether its ends come from the data.
    #[serde(default)]
    fitted: bool,
}

impl From<Axis> for ChartAxis {
    fn from(drawn: Axis) -> Self {
        Self { second: None, drawn, fitted: false }
    }
}

/// Both ends of an axis; none: from the data.
pub type AxisRange = Option<(f64, f64)>;

impl ChartAxis {
    fn new(
        label: impl Into<String>,
        scale: AxisScale,
        range: AxisRange,
    ) -> Self {
        let (low, high) = range.unwrap_or((1.0, 10.0));
        let drawn = match scale {
            AxisScale::Logarithmic => Axis::logarithmic(low, high),
            _ => Axis::linear(low, high, 6),
        };
        Self { fitted: range.is_none(), ..drawn.label(label).into() }
    }

    /// A linear axis with these ends, or with those of the data.
    pub fn linear(
        label: impl Into<String>,
        ends: impl Into<AxisRange>,
    ) -> Self {
        Self::new(label, AxisScale::Linear, ends.into())
    }

    /// A logarithmic axis with these ends, or with those of the data.
    pub fn logarithmic(
        label: impl Into<String>,
        ends: impl Into<AxisRange>,
    ) -> Self {
        Self::new(label, AxisScale::Logarithmic, ends.into())
    }

    /// An axis with these names at 1, 2, 3 and so on.
    pub fn named(categories: Vec<String>) -> Self {
        Axis::named(&categories).into()
    }

    /// The same axis, with these ends if it has none.
    pub fn or_within(self, ends: (f64, f64)) -> Self {
        if !self.fitted {
            return self;
        }
        let axis = self.drawn;
        let axis = Self::new(axis.title, axis.scale, Some(ends));
        Self { second: self.second, ..axis }
    }

    /// The same axis with another unit beside its own.
    pub fn with_second(self, factor: f64, label: impl Into<String>) -> Self {
        Self { second: Some((factor, label.into())), ..self }
    }
}

impl ChartPanel {
    /// A panel.
    pub fn new(
        title: impl Into<String>,
        x: impl Into<ChartAxis>,
        y: impl Into<ChartAxis>,
        series: Vec<Series>,
    ) -> Self {
        Self { title: title.into(), x: x.into(), y: y.into(), series }
    }
}

/// How a chart is laid out and written, where that is not as usual.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Layout {
    /// Sizes; none: by the number of columns.
    pub grid: Option<Grid>,
    /// Entries behind those of the labels.
    pub legend: Vec<Entry>,
    /// Columns of the CSV that name a series.
    pub keys: Vec<String>,
    /// Columns of its numbers.
    pub numbers: Vec<(String, Of)>,
}

impl Layout {
    /// The usual layout, with columns of the CSV that name a series, and
    /// columns of its numbers.
    pub fn of(keys: &[&str], numbers: &[Column]) -> Self {
        let column = |(name, of): &Column| ((*name).into(), *of);
        Self {
            keys: keys.iter().map(|key| (*key).into()).collect(),
            numbers: numbers.iter().map(column).collect(),
            ..Self::default()
        }
    }
}

/// A column of numbers: its name, and what it has of a point.
pub type Column = (&'static str, Of);

/// What a column has of a point, in the order of the CSV.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Of {
    /// Abscissa.
    X,
    /// Ordinate.
    Y,
    /// Lower end of the interval.
    Low,
    /// Upper end of the interval.
    High,
}

/// The usual columns of numbers.
pub(super) const NUMBERS: [Column; 4] =
    [("x", Of::X), ("y", Of::Y), ("y_low", Of::Low), ("y_high", Of::High)];

/// Significant digits of a number that is drawn: more than a drawing shows.
pub const DIGITS: usize = 6;

/// What a chart draws, and how it is laid out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Panels {
    pub(super) panels: Vec<ChartPanel>,
    pub(super) columns: usize,
    pub(super) layout: Layout,
}

impl Chart {
    /// A chart of panels side by side, by its name, title and description.
    pub fn of(heading: [&str; 3], panels: Vec<ChartPanel>) -> Self {
        let [name, title, description] = heading;
        let heading = Heading::new(name, title, description);
        Self { heading, columns: panels.len(), panels }
    }

    /// The chart without the points of its lines that lie within a tenth of
    /// a pixel of what remains, on panels of this size in px. Of the points
    /// behind the first one that is not finite that one alone stays.
    pub fn thinned(mut self, (width, height): (f64, f64)) -> Self {
        for panel in &mut self.panels {
            let (x, y) = axes(panel);
            let lines = panel.series.iter_mut().filter(|s| {
                let look = s.mark.look(Some(0), false);
                s.interval.is_empty() && look.marker.is_none()
            });
            for line in lines {
                extremes(line);
                let px = |(a, b)| (width * x.place(a), height * y.place(b));
                let finite = |p: &Point| p.0.is_finite() && p.1.is_finite();
                let points = line.points().map(px).take_while(finite);
                let mut keep = kept(&points.collect::<Vec<_>>(), TOLERANCE_PX);
                keep.push(true);
                retain(line, &keep);
            }
        }
        self
    }
}

impl Panels {
    /// The numbers of every series that has keys, a row a point.
    pub(super) fn csv(&self) -> String {
        let Layout { keys, numbers, .. } = &self.layout;
        let names = numbers.iter().map(|(name, _)| name.as_str());
        let names = keys.iter().map(String::as_str).chain(names);
        let names: Vec<&str> = ["panel"].into_iter().chain(names).collect();
        let mut table = Table::new(&names);
        for (i, panel) in self.panels.iter().enumerate() {
            let named = panel.series.iter().filter(|s| !s.keys.is_empty());
            for series in named {
                let ends = series.interval.iter().copied();
                let ends = ends.chain(repeat((f64::NAN, f64::NAN)));
                for ((x, y), (low, high)) in series.points().zip(ends) {
                    let cells = numbers.iter().map(|(_, of)| {
                        digits([x, y, low, high][*of as usize], DIGITS)
                    });
                    let first = [letter(i)].into_iter();
                    let keys = series.keys.iter().cloned();
                    table.row(first.chain(keys).chain(cells));
                }
            }
        }
        table.finish()
    }
}

/// Keeps the points of a line that are marked to stay.
fn retain(line: &mut Series, keep: &[bool]) {
    for values in [&mut line.x, &mut line.y] {
        let mut keep = keep.iter();
        values.retain(|_| keep.next() == Some(&true));
    }
}

/// Leaves, of a long line, the first, lowest, highest and last point of every
/// stretch of it that a drawing cannot resolve.
fn extremes(line: &mut Series) {
    let y = &line.y;
    let stretch = y.len() / COLUMNS;
    if stretch < 8 {
        return;
    }
    let mut keep = vec![false; y.len()];
    for start in (0..y.len()).step_by(stretch) {
        let end = y.len().min(start + stretch);
        let by = |a: &usize, b: &usize| {
            y[*a].partial_cmp(&y[*b]).unwrap_or(Ordering::Equal)
        };
        let (low, high) =
            ((start..end).min_by(by), (start..end).rev().max_by(by));
        for i in [start, end - 1].into_iter().chain(low).chain(high) {
            keep[i] = true;
        }
    }
    retain(line, &keep);
}

/// Sizes of the plotting areas for a number of columns.
fn grid_of(panels: usize, columns: usize) -> Grid {
    let grid = Grid::new(panels, columns);
    match grid.columns {
        1 => grid.plot(560.0, 320.0),
        2 => grid.plot(440.0, 200.0),
        _ => grid,
    }
}

pub(super) fn scene(heading: &Heading, figure: &Panels) -> Drawing {
    let all = || figure.panels.iter().flat_map(|p| &p.series);
    // The first series of each label.
    let mut seen = BTreeSet::new();
    let mut labelled: Vec<&Series> = all().collect();
    labelled.retain(|s| s.has_sample() && seen.insert(&s.label));
    let rank =
        |one: &Series| labelled.iter().position(|s| s.label == one.label);
    let nested =
        labelled.len() > FEW && labelled.iter().all(|s| s.interval.is_empty());
    let look = |one: &Series| one.mark.look(rank(one), nested);
    let entry = |one: &&Series| {
        let mut look = look(one);
        if look.pen.is_some() && one.interval.is_empty() {
            look.band = None;
        }
        Entry::new(Sample::Of(look), &*one.label)
    };
    let mut legend: Vec<Entry> = labelled.iter().map(entry).collect();
    let Layout { grid, legend: more, .. } = &figure.layout;
    legend.extend(more.iter().cloned());
    let usual = || grid_of(figure.panels.len(), figure.columns);
    let mut grid = grid.unwrap_or_else(usual);
    if figure.layout.grid.is_none() && all().any(|s| s.mark == Mark::Edge) {
        grid.right = EDGE_PX;
    }
    if figure.panels.iter().any(|p| p.x.second.is_some()) {
        grid.above = SECOND_AXIS_PX;
    }
    if figure.panels.iter().any(|p| p.title.contains('\n')) {
        grid.above = SUBTITLE_PX;
    }
    common::panels(heading, grid, &legend, |canvas, grid| {
        for (i, shown) in figure.panels.iter().enumerate() {
            let (x, y) = axes(shown);
            let second = shown.x.second.as_ref().map(|(factor, label)| {
                let (low, high) = x.range();
                let range = Some((factor * low, factor * high));
                ChartAxis::new(label, x.scale, range).drawn
            });
            let mut panel = Panel::new(canvas, grid.frame(i), (x, y), second);
            for series in &shown.series {
                draw_series(&mut panel, series, look(series));
            }
            outer_words(&panel, &shown.series);
            let (title, subtitle) =
                shown.title.split_once('\n').unwrap_or((&shown.title, ""));
            let title = match figure.panels.len() {
                1 => title.to_owned(),
                _ => format!("({}) {title}", letter(i)),
            };
            panel.finish(&title, subtitle);
        }
    })
}

fn axes(shown: &ChartPanel) -> (Axis, Axis) {
    let xs = shown.series.iter().flat_map(|s| s.x.iter().copied());
    let ys = shown.series.iter().flat_map(|s| {
        let ends = s.interval.iter().flat_map(|(low, high)| [*low, *high]);
        s.y.iter().copied().chain(ends)
    });
    (axis(&shown.x, xs), axis(&shown.y, ys))
}

/// The axis, from the data unless its ends are given.
fn axis(given: &ChartAxis, values: impl Iterator<Item = f64>) -> Axis {
    let logarithmic = given.drawn.scale == AxisScale::Logarithmic;
    let axis = match common::span(values, logarithmic) {
        Some((low, high)) if given.fitted => match logarithmic {
            true => Axis::logarithmic(low / 1.3, high * 1.3),
            false => Axis::around(low, high, 6),
        },
        _ => return given.drawn.clone(),
    };
    axis.label(&*given.drawn.title)
}

fn draw_series(panel: &mut Panel<'_>, series: &Series, look: Look) {
    let at = series.points().next().unwrap_or((f64::NAN, f64::NAN));
    let [(left, right), (bottom, top)] = panel.axes().map(Axis::range);
    let empty = panel.empty;
    match series.mark {
        Mark::Across(pen) => panel.line([(left, at.1), (right, at.1)], pen),
        Mark::Upright(pen) => panel.line([(at.0, bottom), (at.0, top)], pen),
        Mark::Words(align) if panel.is_inside(at) => {
            panel.words(&series.label, panel.to_px(at), Ink::Muted, align);
        }
        _ => {}
    }
    // Reference lines are no data.
    panel.empty = empty;
    let ends = series.x.iter().zip(&series.interval);
    let rows: Vec<_> = ends.map(|(x, (a, b))| (*x, *a, *b)).collect();
    if let Some(bar) = look.bars {
        for (x, low, high) in &rows {
            panel.line([(*x, *low), (*x, *high)], bar);
            // It goes on beyond the frame.
            for (edge, marker) in
                [(bottom, Marker::BeyondBelow), (top, Marker::BeyondAbove)]
            {
                let cut = (*low < edge && edge < *high).then_some((*x, edge));
                panel.marks(cut, (marker, 3.0, bar.ink));
            }
        }
    }
    if let Some(fill) = look.band {
        panel.band(&rows, fill);
    }
    if let Some(fill) = look.bins {
        let ends = series.x.windows(2).zip(&series.y);
        for (left, right, top) in ends.map(|(x, y)| (x[0], x[1], *y)) {
            panel.band(&[(left, 0.0, top), (right, 0.0, top)], fill);
            let around =
                [(left, 0.0), (left, top), (right, top), (right, 0.0)];
            panel.line(around, look.pen.unwrap_or(Pen::new(fill.ink, 0.0)));
        }
        return;
    }
    let (low, high): (Vec<f64>, Vec<f64>) =
        series.interval.iter().copied().unzip();
    for (x, pen) in
        [(&low, look.sides), (&series.x, look.pen), (&high, look.sides)]
    {
        if let Some(pen) = pen {
            panel.line(path(x, &series.y, right), pen);
        }
    }
    if let Some(marker) = look.marker {
        panel.marks(series.points(), marker);
    }
}

/// A line; from the first overturned block on level to the end of the axis.
fn path(x: &[f64], y: &[f64], end: f64) -> Vec<Point> {
    let stands = x.iter().take_while(|x| **x != f64::INFINITY).count();
    let points = x.iter().zip(y).map(|(x, y)| (*x, *y)).take(stands);
    let level = y.get(stands).filter(|_| stands < x.len());
    let level = level.into_iter().flat_map(|y| [(1.0, *y), (end, *y)]);
    points.chain(level).collect()
}

/// Words in the corner and at the right-hand edge, kept apart.
fn outer_words(panel: &Panel<'_>, all: &[Series]) {
    let of = |mark| all.iter().filter(move |s| s.mark == mark);
    let mut y = panel.frame.bottom - 8.0;
    for note in of(Mark::Corner).rev() {
        let at = (panel.frame.right - 5.0, y);
        panel.words(&note.label, at, Ink::Muted, Horizontal::Right);
        y -= NOTE_PX;
    }
    let mut y = f64::INFINITY;
    for words in of(Mark::Edge) {
        let end = panel.to_px((words.x[0], words.y[0]));
        y = end.1.min(y - APART_PX);
        let right = panel.frame.right;
        if end.1 - y > 4.0 && end.0 > right - EDGE_PX {
            let leader = [end, (right + 3.0, y)];
            panel.canvas.line(&leader, Pen::new(Ink::Muted, 0.4));
        }
        let at = (right + 5.0, y + 0.33 * TEXT_PX);
        panel.words(&words.label, at, Ink::Text, Horizontal::Left);
    }
}
