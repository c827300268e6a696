//! One pair of axes and what is drawn on them.

use crate::axis::Axis;
use crate::colour::{Fill, Ink, Pen};
use crate::geometry::{Point, Rect, clip};
use crate::markup;
use crate::scene::Drawing;
use crate::text::{Horizontal, TEXT_PX, TextLine};
use serde::{Deserialize, Serialize};

const TICK_PX: f64 = 3.5;
const MINOR_PX: f64 = 2.0;
const TITLE_PX: f64 = 12.0;
/// Between the baselines of two notes.
const NOTE_PX: f64 = 13.5;
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
}

impl Marker {
    /// The mark that goes with a series, for readers without colour.
    pub fn of_series(series: usize) -> Self {
        use Marker::{Cross, Diamond, Dot, Down, Plus, Square, Triangle};
        [Dot, Square, Triangle, Diamond, Down, Plus, Cross][series % 7]
    }

    /// Draws the mark; `r` is its half width in px.
    pub fn draw(self, scene: &mut Drawing, at: Point, r: f64, ink: Ink) {
        let (x, y) = at;
        let pen = Pen::new(ink, 0.9);
        let fill = Fill::solid(ink);
        match self {
            Self::Dot => scene.dot(at, r, ink),
            Self::Cross => {
                let s = 0.8 * r;
                scene.line(&[(x - s, y - s), (x + s, y + s)], pen);
                scene.line(&[(x - s, y + s), (x + s, y - s)], pen);
            }
            Self::Beyond | Self::BeyondLeft => {
                let r_x = if self == Self::Beyond { r } else { -r };
                let back = (-0.7_f64).mul_add(r_x, x);
                let head = [(back, y - r), (x + r_x, y), (back, y + r)];
                scene.line(&head, pen);
            }
            Self::Plus => {
                scene.line(&[(x - r, y), (x + r, y)], pen);
                scene.line(&[(x, y - r), (x, y + r)], pen);
            }
            Self::Square | Self::OpenSquare => {
                let s = 0.88 * r;
                let (l, r, t, b) = (x - s, x + s, y - s, y + s);
                let square = [(l, t), (r, t), (r, b), (l, b)];
                if self == Self::Square {
                    scene.area(&square, fill);
                } else {
                    scene.area(&square, Fill::solid(Ink::Paper));
                    scene.outline(&square, pen);
                }
            }
            Self::Triangle | Self::Down => {
                let up = if self == Self::Triangle { r } else { -r };
                let base = 0.6_f64.mul_add(up, y);
                let tip = (x, (-1.15_f64).mul_add(up, y));
                scene.area(&[tip, (x + r, base), (x - r, base)], fill);
            }
            Self::Diamond => {
                let s = 1.2 * r;
                let ends = [(x, y - s), (x + s, y), (x, y + s), (x - s, y)];
                scene.area(&ends, fill);
            }
        }
    }
}

/// A panel being drawn: [`Panel::new`] draws the grid, [`Panel::finish`] the
/// axes over the data.
#[derive(Debug)]
pub struct Panel<'s> {
    scene: &'s mut Drawing,
    frame: Rect,
    x: Axis,
    y: Axis,
    second: Option<Axis>,
    empty: bool,
    reason: &'static str,
}

impl<'s> Panel<'s> {
    /// Starts a panel with its grid lines.
    pub fn new(scene: &'s mut Drawing, frame: Rect, x: Axis, y: Axis) -> Self {
        let (second, empty) = (None, true);
        let reason = "no data in this range";
        let panel = Self { scene, frame, x, y, second, empty, reason };
        for tick in panel.x.ticks.iter().filter(|_| panel.x.grid) {
            let x = panel.to_px((tick.at, 0.0)).0;
            panel.scene.line(&[(x, frame.top), (x, frame.bottom)], GRID);
        }
        for tick in panel.y.ticks.iter().filter(|_| panel.y.grid) {
            let y = panel.to_px((0.0, tick.at)).1;
            panel.scene.line(&[(frame.left, y), (frame.right, y)], GRID);
        }
        panel
    }

    /// Another horizontal axis over the same width, at the upper edge, where
    /// there is one.
    pub fn with_second(self, second: Option<Axis>) -> Self {
        Self { second, ..self }
    }

    /// Says why there may be nothing to see.
    pub fn empty_because(self, reason: &'static str) -> Self {
        Self { reason, ..self }
    }

    /// Both ends of the horizontal axis.
    pub fn horizontal_range(&self) -> Point {
        self.x.range()
    }

    /// The scene, for shapes placed in px.
    pub fn scene(&mut self) -> &mut Drawing {
        self.scene
    }

    /// Data to px.
    pub fn to_px(&self, (x, y): Point) -> Point {
        (
            self.x.place(x).mul_add(self.frame.width(), self.frame.left),
            (-self.y.place(y)).mul_add(self.frame.height(), self.frame.bottom),
        )
    }

    /// Notes that the panel shows something.
    pub fn mark_used(&mut self) {
        self.empty = false;
    }

    /// A polyline, cut at the frame and at values that are not finite.
    pub fn line(&mut self, points: impl IntoIterator<Item = Point>, pen: Pen) {
        let px: Vec<Point> =
            points.into_iter().map(|p| self.to_px(p)).collect();
        for part in clip(&px, self.frame) {
            self.scene.line(&part, pen);
            self.empty = false;
        }
    }

    /// A reference line that does not count as data.
    pub fn reference(&mut self, from: Point, to: Point, pen: Pen) {
        let px = [self.to_px(from), self.to_px(to)];
        for part in clip(&px, self.frame) {
            self.scene.line(&part, pen);
        }
    }

    /// A vertical reference line through the whole frame.
    pub fn vertical(&mut self, x: f64, pen: Pen) {
        let (low, high) = self.y.range();
        self.reference((x, low), (x, high), pen);
    }

    /// A horizontal reference line through the whole frame.
    pub fn horizontal(&mut self, y: f64, pen: Pen) {
        let (low, high) = self.x.range();
        self.reference((low, y), (high, y), pen);
    }

    /// Marks; those outside the frame are left out.
    pub fn marks(
        &mut self,
        points: impl IntoIterator<Item = Point>,
        marker: Marker,
        radius_px: f64,
        ink: Ink,
    ) {
        for point in points {
            let at = self.to_px(point);
            if self.frame.contains(at, 0.5) {
                marker.draw(self.scene, at, radius_px, ink);
                self.empty = false;
            }
        }
    }

    /// Where a point lies in px, or the place in the frame that is nearest.
    fn inside(&self, point: Point) -> Point {
        let ((x, y), f) = (self.to_px(point), self.frame);
        (x.clamp(f.left, f.right), y.clamp(f.top, f.bottom))
    }

    /// A filled rectangle between two points, cut at the frame.
    pub fn bar(&mut self, a: Point, b: Point, fill: Fill) {
        let (a, b) = (self.inside(a), self.inside(b));
        let (left, right) = (a.0.min(b.0), a.0.max(b.0));
        let (top, bottom) = (a.1.min(b.1), a.1.max(b.1));
        let bar = Rect { left, right, top, bottom };
        if bar.width() > 0.0 && bar.height() > 0.0 {
            self.scene.area(&bar.corners(), fill);
            self.empty = false;
        }
    }

    /// A filled band between two ordinates along x, where both are finite.
    pub fn band(&mut self, rows: &[(f64, f64, f64)], fill: Fill) {
        let whole = |r: &&(f64, f64, f64)| {
            r.0.is_finite() && r.1.is_finite() && r.2.is_finite()
        };
        let rows: Vec<_> = rows.iter().filter(whole).collect();
        let below = rows.iter().map(|r| self.inside((r.0, r.1)));
        let above = rows.iter().rev().map(|r| self.inside((r.0, r.2)));
        let corners: Vec<Point> = below.chain(above).collect();
        self.scene.area(&corners, fill);
    }

    /// A note in the lower right-hand corner, so many lines above it.
    pub fn corner(&mut self, text: &str, lines: usize) {
        let up = 8.0 + NOTE_PX * lines as f64;
        let at = (self.frame.right - 5.0, self.frame.bottom - up);
        self.note(text, at, Horizontal::Right);
    }

    /// A note on a baseline at a point in px.
    pub fn note(&mut self, text: &str, at: Point, align: Horizontal) {
        let line = TextLine::new(text, at, align);
        self.scene.text(line.size(TEXT_PX - 1.0).ink(Ink::Muted));
    }

    /// Words outside the right-hand edge, at an ordinate in px.
    pub fn right_of_px(&mut self, y: f64, text: &str) {
        let at = (self.frame.right + 5.0, y + 0.33 * TEXT_PX);
        let line = TextLine::new(text, at, Horizontal::Left);
        self.scene.text(line.size(TEXT_PX - 1.0));
    }

    /// Draws the axes, the title, and words where there is nothing to see.
    /// Both are in [`super::markup`]; [`super::markup::fit`] cuts names.
    pub fn finish(mut self, title: &str, subtitle: &str) {
        let f = self.frame;
        if self.empty {
            let middle = ((f.left + f.right) / 2.0, (f.top + f.bottom) / 2.0);
            let words = TextLine::new(self.reason, middle, Horizontal::Centre);
            let e = words.extent();
            let (left, right) = (e.left - 6.0, e.right + 6.0);
            let (top, bottom) = (e.top - 4.0, e.bottom + 4.0);
            let backing = Rect { left, right, top, bottom };
            self.scene.area(&backing.corners(), Fill::solid(Ink::Paper));
            self.scene.text(words.ink(Ink::Muted));
        }
        self.axis_lines();
        let middle = (f.left + f.right) / 2.0;
        let title_y = if let Some(second) = self.second.take() {
            self.upper_axis(&second);
            f.top - 40.0
        } else if subtitle.is_empty() {
            f.top - 9.0
        } else {
            let at = (middle, f.top - 7.0);
            self.note(subtitle, at, Horizontal::Centre);
            f.top - 20.0
        };
        let line = TextLine::new(title, (middle, title_y), Horizontal::Centre);
        self.scene.text(line.size(TITLE_PX));
    }

    fn upper_axis(&mut self, second: &Axis) {
        let f = self.frame;
        self.hairline((f.left, f.top), (f.right, f.top));
        let px = |at: f64| second.place(at).mul_add(f.width(), f.left);
        for x in second.minor.iter().map(|at| px(*at)) {
            self.hairline((x, f.top - MINOR_PX), (x, f.top));
        }
        for tick in &second.ticks {
            let x = px(tick.at);
            self.hairline((x, f.top - TICK_PX), (x, f.top));
            self.label(&tick.label, (x, f.top - TICK_PX - 4.0));
        }
        let middle = (f.left + f.right) / 2.0;
        self.label(&second.title, (middle, f.top - 22.0));
    }

    fn hairline(&mut self, a: Point, b: Point) {
        self.scene.line(&[a, b], HAIRLINE);
    }

    /// Words centred on a point.
    fn label(&mut self, text: &str, at: Point) {
        self.scene.text(TextLine::new(text, at, Horizontal::Centre));
    }

    fn axis_lines(&mut self) {
        let f = self.frame;
        let spine = [(f.left, f.top), (f.left, f.bottom), (f.right, f.bottom)];
        self.scene.line(&spine, HAIRLINE);
        let (x, y) = (self.x.clone(), self.y.clone());
        for at in &x.minor {
            let x = self.to_px((*at, 0.0)).0;
            self.hairline((x, f.bottom), (x, f.bottom + MINOR_PX));
        }
        for at in &y.minor {
            let y = self.to_px((0.0, *at)).1;
            self.hairline((f.left - MINOR_PX, y), (f.left, y));
        }
        for tick in &x.ticks {
            let x = self.to_px((tick.at, 0.0)).0;
            self.hairline((x, f.bottom), (x, f.bottom + TICK_PX));
            self.label(&tick.label, (x, f.bottom + TICK_PX + TEXT_PX));
        }
        let mut widest = 0.0_f64;
        for tick in &y.ticks {
            let y = self.to_px((0.0, tick.at)).1;
            self.hairline((f.left - TICK_PX, y), (f.left, y));
            let at = (f.left - TICK_PX - 3.0, y + 0.36 * TEXT_PX);
            widest = widest.max(markup::width(&tick.label, TEXT_PX));
            let label = TextLine::new(&tick.label, at, Horizontal::Right);
            self.scene.text(label);
        }
        self.label(&x.title, ((f.left + f.right) / 2.0, f.bottom + 33.0));
        let room = TICK_PX + 3.0 + widest + 8.0;
        let beside = (f.left - room.max(28.0), (f.top + f.bottom) / 2.0);
        let label = TextLine::new(&y.title, beside, Horizontal::Centre);
        self.scene.text(label.upwards());
    }
}
