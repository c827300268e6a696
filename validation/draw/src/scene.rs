//! A list of shapes in pixels.

use crate::colour::{Fill, Ink, Pen};
use crate::geometry::{Point, Rect, simplify};
use crate::svg::Svg;
use crate::text::{Caption, TextLine};

/// Bytes of an SVG above which its lines are drawn more coarsely. With many
/// records it may be larger even so.
pub const WANTED_BYTES: usize = 150_000;
/// How far a simplified line may be from the full one, in px: the first, and
/// the next ones, with points on multiples of them, only where the SVG would
/// be too large.
pub const TOLERANCES_PX: [f64; 6] = [0.05, 0.1, 0.2, 0.5, 1.0, 2.0];

#[derive(Debug, Clone)]
enum VectorShape {
    Line(Vec<Point>, Pen),
    Area(Vec<Point>, Fill),
    Dot(Point, f64, Ink),
    Text(TextLine),
}

/// A drawing under way.
#[derive(Debug, Clone)]
pub struct Drawing {
    caption: Caption,
    size_px: (u32, u32),
    shapes: Vec<VectorShape>,
}

impl Drawing {
    /// An empty drawing.
    pub fn new(caption: Caption, width_px: f64, height_px: f64) -> Self {
        let whole = |x: f64| x.ceil().max(1.0) as u32;
        let size_px = (whole(width_px), whole(height_px));
        Self { caption, size_px, shapes: Vec::new() }
    }

    /// Everything there is room for.
    pub fn extent(&self) -> Rect {
        let (width, height) = self.size_px;
        let [right, bottom] = [width, height].map(f64::from);
        Rect { left: 0.0, top: 0.0, right, bottom }
    }

    /// A polyline; nothing if a point is not finite.
    pub fn line(&mut self, points: &[Point], pen: Pen) {
        if points.len() > 1 && finite(points) {
            self.shapes.push(VectorShape::Line(points.to_vec(), pen));
        }
    }

    /// A closed outline.
    pub fn outline(&mut self, corners: &[Point], pen: Pen) {
        let closed = corners.iter().chain(corners.first()).copied();
        self.line(&closed.collect::<Vec<_>>(), pen);
    }

    /// A filled polygon.
    pub fn area(&mut self, corners: &[Point], fill: Fill) {
        if corners.len() > 2 && finite(corners) {
            self.shapes.push(VectorShape::Area(corners.to_vec(), fill));
        }
    }

    /// A filled circle.
    pub fn dot(&mut self, at: Point, radius_px: f64, ink: Ink) {
        if finite(&[at]) {
            self.shapes.push(VectorShape::Dot(at, radius_px, ink));
        }
    }

    /// A line of text.
    pub fn text(&mut self, text: TextLine) {
        if finite(&[text.at]) && !text.markup.is_empty() {
            self.shapes.push(VectorShape::Text(text));
        }
    }

    /// All lines of text, for tests of the layout.
    pub fn texts(&self) -> impl Iterator<Item = &TextLine> {
        self.shapes.iter().filter_map(|s| match s {
            VectorShape::Text(text) => Some(text),
            _ => None,
        })
    }

    /// The SVG.
    pub fn svg(&self) -> String {
        let mut out = String::new();
        for tolerance_px in TOLERANCES_PX {
            out = self.with_tolerance(tolerance_px);
            if out.len() <= WANTED_BYTES {
                break;
            }
        }
        out
    }

    fn with_tolerance(&self, tolerance_px: f64) -> String {
        let mut svg = Svg::new(self.size_px, &self.caption);
        for shape in &self.shapes {
            match shape {
                VectorShape::Line(points, pen) => {
                    let points = simplify(points, tolerance_px);
                    svg.line(&snap(points, tolerance_px), *pen);
                }
                VectorShape::Area(corners, fill) => svg.area(corners, *fill),
                VectorShape::Dot(at, px, ink) => svg.dot(*at, *px, *ink),
                VectorShape::Text(text) => svg.text(text),
            }
        }
        svg.finish()
    }
}

/// Coarse lines on round coordinates, which take fewer characters.
fn snap(points: Vec<Point>, tolerance_px: f64) -> Vec<Point> {
    if tolerance_px <= TOLERANCES_PX[0] {
        return points;
    }
    let round = |x: f64| (x / tolerance_px).round() * tolerance_px;
    points.into_iter().map(|(x, y)| (round(x), round(y))).collect()
}

fn finite(points: &[Point]) -> bool {
    points.iter().all(|(x, y)| x.is_finite() && y.is_finite())
}
