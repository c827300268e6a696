//! One pair of axes and what is drawn on them, as a chart of plotters.

use std::f64::consts::TAU;

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::cartesian::Cartesian2d;
use plotters::element::Polygon;
use plotters::series::LineSeries;
use plotters::style::TRANSPARENT;
use serde::{Deserialize, Serialize};

use crate::axis::{Axis, UNLABELLED};
use crate::canvas::{Canvas, done, style};
use crate::colour::{Fill, Ink, Pen};
use crate::drawing::{Drawing, px, units};
use crate::geometry::{Point, Rect, clip, from};
use crate::markup;
use crate::text::{Horizontal as Align, TEXT_PX};

const TICK_PX: f64 = 3.5;
const MINOR_PX: f64 = 2.0;
const TITLE_PX: f64 = 12.0;
/// From an axis to the far edge of its label.
const BELOW_PX: f64 = 33.0;
const ABOVE_PX: f64 = 30.0;
/// How far outside the frame a mark may lie, as a share of it.
const SLACK: f64 = 0.002;
const HAIRLINE: Pen = Pen::new(Ink::Text, 0.7);
const GRID: Pen = Pen::new(Ink::Grid, 0.6);

/// A mark at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Marker {
    /// Filled circle.
    Dot,
    /// Diagonal cross.
    Cross,
    /// Upright cross.
    Plus,
    /// Filled square.
    Square,
    /// Open square.
    OpenSquare,
    /// Filled triangle.
    Triangle,
    /// Filled diamond.
    Diamond,
    /// Filled triangle, point down.
    Down,
    /// Arrow head to the right: there is more beyond.
    Beyond,
    /// Arrow head to the left.
    BeyondLeft,
    /// Arrow head upwards.
    BeyondAbove,
    /// Arrow head downwards.
    BeyondBelow,
}

impl Marker {
    /// The mark that goes with a series, for readers without colour.
    pub fn of_series(series: usize) -> Self {
        use Marker::{Cross, Diamond, Dot, Down, Plus, Square, Triangle};
        [Dot, Square, Triangle, Diamond, Down, Plus, Cross][series % 7]
    }

    /// Draws the mark; `r` is its half width in px.
    pub(crate) fn draw(self, on: &Canvas<'_>, at: Point, r: f64, ink: Ink) {
        // Corners of a regular polygon, the first at so many turns from
        // upwards.
        let corners = |count: u8, size: f64, turns: f64| -> Vec<Point> {
            let turn = |k| TAU * (turns + f64::from(k) / f64::from(count));
            (0..count).map(|k| from(at, size * r, turn(k))).collect()
        };
        let area = |count, size, turns, ink| {
            on.area(&corners(count, size, turns), Fill::solid(ink));
        };
        let pen = Pen::new(ink, 0.9);
        let cross = |turns| {
            on.line(&corners(2, 1.1, turns), pen);
            on.line(&corners(2, 1.1, turns + 0.25), pen);
        };
        // Its tip lies 4 px before the point, which is at the edge.
        let head = |turns: f64| {
            let middle = from(at, -4.0 - 1.2 * r, TAU * turns);
            let end = |turn| from(middle, 1.2 * r, TAU * (turns + turn));
            on.line(&[1.0 / 3.0, 0.0, -1.0 / 3.0].map(end), pen);
        };
        match self {
            Self::Dot => on.dot(at, r, ink),
            Self::Cross => cross(0.125),
            Self::Plus => cross(0.0),
            Self::Square => area(4, 1.24, 0.125, ink),
            Self::OpenSquare => {
                area(4, 1.24, 0.125, Ink::Paper);
                on.outline(&corners(4, 1.24, 0.125), pen);
            }
            Self::Triangle => area(3, 1.15, 0.0, ink),
            Self::Diamond => area(4, 1.2, 0.0, ink),
            Self::Down => area(3, 1.15, 0.5, ink),
            Self::Beyond => head(0.25),
            Self::BeyondLeft => head(0.75),
            Self::BeyondAbove => head(0.0),
            Self::BeyondBelow => head(0.5),
        }
    }
}

/// Pens, fills and marks of a series; those it does not have are none.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Look {
    /// The line.
    pub pen: Option<Pen>,
    /// Lines along the ends of the abscissas' intervals.
    pub sides: Option<Pen>,
    /// Bars between the ends of the ordinates' intervals.
    pub bars: Option<Pen>,
    /// The band between these ends.
    pub band: Option<Fill>,
    /// Bars from each abscissa to the next one, which the line goes around.
    pub bins: Option<Fill>,
    /// Mark, half width in px and ink at each point.
    pub marker: Option<(Marker, f64, Ink)>,
}

impl Look {
    /// Nothing but a line.
    pub fn line(pen: Pen) -> Self {
        Self { pen: Some(pen), ..Self::default() }
    }

    /// Nothing but a band.
    pub fn band(fill: Fill) -> Self {
        Self { band: Some(fill), ..Self::default() }
    }

    /// Nothing but marks of this half width in px.
    pub fn marks(marker: Marker, half_px: f64, ink: Ink) -> Self {
        Self { marker: Some((marker, half_px, ink)), ..Self::default() }
    }
}

type AxesChart<'d> =
    ChartContext<'d, &'d mut Drawing, Cartesian2d<Axis, Axis>>;

/// A panel being drawn: [`Panel::new`] draws the grid, [`Panel::finish`] the
/// axes over the data.
pub(crate) struct Panel<'d> {
    pub(crate) canvas: Canvas<'d>,
    chart: AxesChart<'d>,
    pub(crate) frame: Rect,
    second: Option<Axis>,
    pub(crate) empty: bool,
}

/// A chart with this plot area and this room for its axes: left of it, below
/// and above. plotters takes the last unit of a range for itself.
fn chart<'d>(
    canvas: &Canvas<'d>,
    frame: Rect,
    (x, y): (Axis, Axis),
    [left, below, above]: [f64; 3],
) -> AxesChart<'d> {
    let (width, height) = canvas.0.dim_in_pixel();
    let chart = ChartBuilder::on(&canvas.0)
        .margin_left(units(frame.left - left))
        .margin_right(width as i32 - units(frame.right) - 1)
        .margin_top(units(frame.top - above))
        .margin_bottom(height as i32 - units(frame.bottom + below) - 1)
        .y_label_area_size(units(left))
        .x_label_area_size(units(below))
        .top_x_label_area_size(units(above))
        .build_cartesian_2d(x, y);
    done(chart)
}

/// Draws axes with their labels, and first their unlabelled ticks, which are
/// shorter.
fn draw_axes(chart: &mut AxesChart<'_>) {
    let axes = chart.as_coord_spec();
    let names = [axes.x_spec(), axes.y_spec()].map(|a| a.title.clone());
    let words = style(TEXT_PX, Ink::Text, Align::Centre);
    let minor = (UNLABELLED, MINOR_PX, Default::default());
    for (ticks, tick_px, [x, y]) in [minor, (1, TICK_PX, names)] {
        let mut axes = chart.configure_mesh();
        axes.disable_mesh().axis_style(HAIRLINE).label_style(words.clone());
        axes.x_labels(ticks).y_labels(ticks).x_desc(x).y_desc(y);
        done(axes.set_all_tick_mark_size(units(tick_px)).draw());
    }
}

impl<'d> Panel<'d> {
    /// Starts a panel with its grid lines. A second horizontal axis goes over
    /// the same width, at the upper edge.
    pub(crate) fn new(
        canvas: &Canvas<'d>,
        frame: Rect,
        (x, y): (Axis, Axis),
        second: Option<Axis>,
    ) -> Self {
        let widths = y.ticks.iter().map(|t| markup::width(&t.label, TEXT_PX));
        let room = 2.0 * TICK_PX + widths.fold(0.0, f64::max) + 8.0;
        // Up to the upper edge of the label.
        let left = (room.max(28.0) + 0.74 * TEXT_PX).min(frame.left);
        // Without a grid an axis has no unlabelled ticks.
        let [x_lines, y_lines] = [x.grid, y.grid].map(usize::from);
        let mut chart = chart(canvas, frame, (x, y), [left, BELOW_PX, 0.0]);
        let mut grid = chart.configure_mesh();
        grid.bold_line_style(GRID).light_line_style(TRANSPARENT);
        done(grid.disable_axes().x_labels(x_lines).y_labels(y_lines).draw());
        Self { canvas: canvas.clone(), chart, frame, second, empty: true }
    }

    /// The axes.
    pub(crate) fn axes(&self) -> [&Axis; 2] {
        let axes = self.chart.as_coord_spec();
        [axes.x_spec(), axes.y_spec()]
    }

    /// Data to px.
    pub(crate) fn to_px(&self, point: Point) -> Point {
        let (x, y) = self.chart.backend_coord(&point);
        (px(x), px(y))
    }

    /// A polyline, cut at the frame and at values that are not finite.
    pub(crate) fn line(
        &mut self,
        points: impl IntoIterator<Item = Point>,
        pen: Pen,
    ) {
        let [x, y] = self.axes();
        let places = points.into_iter().map(|p| (x.place(p.0), y.place(p.1)));
        let value = |p: &mut Point| *p = (x.value(p.0), y.value(p.1));
        let mut parts = clip(&places.collect::<Vec<_>>());
        parts.iter_mut().flatten().for_each(value);
        self.empty &= parts.is_empty();
        for part in parts {
            done(self.chart.draw_series(LineSeries::new(part, pen)));
        }
    }

    /// Marks; those outside the frame are left out.
    pub(crate) fn marks(
        &mut self,
        points: impl IntoIterator<Item = Point>,
        (marker, half_px, ink): (Marker, f64, Ink),
    ) {
        for point in points {
            if self.is_inside(point) {
                marker.draw(&self.canvas, self.to_px(point), half_px, ink);
                self.empty = false;
            }
        }
    }

    pub(crate) fn is_inside(&self, point: Point) -> bool {
        let [x, y] = self.axes();
        let inside = -SLACK..=1.0 + SLACK;
        [x.place(point.0), y.place(point.1)].iter().all(|p| inside.contains(p))
    }

    /// A filled band between two ordinates along x, where both are finite;
    /// what lies outside the frame goes to its edge.
    pub(crate) fn band(&mut self, rows: &[(f64, f64, f64)], fill: Fill) {
        let whole = |r: &&(f64, f64, f64)| {
            r.0.is_finite() && r.1.is_finite() && r.2.is_finite()
        };
        let rows: Vec<_> = rows.iter().filter(whole).collect();
        let below = rows.iter().map(|r| (r.0, r.1));
        let above = rows.iter().rev().map(|r| (r.0, r.2));
        let corners = below.chain(above).collect::<Vec<_>>();
        let band = Polygon::new(corners, fill);
        done(self.chart.plotting_area().draw(&band));
    }

    /// Small words on a baseline at a point in px.
    pub(crate) fn words(&self, text: &str, at: Point, ink: Ink, to: Align) {
        self.canvas.text(text, at, style(TEXT_PX - 1.0, ink, to));
    }

    /// Draws the axes, the title, and words if there is nothing to see.
    /// Title and subtitle are in [`super::markup`].
    pub(crate) fn finish(mut self, title: &str, subtitle: &str) {
        let f = self.frame;
        let middle = f64::midpoint(f.left, f.right);
        if self.empty {
            let at = (f.right - 5.0, f.bottom - 8.0);
            self.words("no data in this range", at, Ink::Muted, Align::Right);
        }
        draw_axes(&mut self.chart);
        let up = if let Some(second) = self.second.take() {
            let axes = (second, self.axes()[1].clone());
            let room = [0.0, 0.0, ABOVE_PX];
            draw_axes(&mut chart(&self.canvas, f, axes, room));
            40.0
        } else if subtitle.is_empty() {
            9.0
        } else {
            self.words(
                subtitle,
                (middle, f.top - 7.0),
                Ink::Muted,
                Align::Centre,
            );
            20.0
        };
        let words = style(TITLE_PX, Ink::Text, Align::Centre);
        self.canvas.text(title, (middle, f.top - up), words);
    }
}
