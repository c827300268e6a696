//! The SVG of a figure, written in twentieths of a pixel.
//!
//! The style sheet turns inks into colours. Lines that follow one another with
//! the same pen become one path.

use std::fmt::Write as _;

use crate::colour::{Fill, Ink, Pen, STYLE};
use crate::geometry::Point;
use crate::markup;
use crate::text::{Caption, Horizontal, TEXT_PX, TextLine};

/// Coordinate steps in a pixel.
const PER_PX: i32 = 20;
const FONTS: &str =
    "Helvetica,Arial,'Liberation Sans','Nimbus Sans',sans-serif";

/// An SVG under way.
pub(super) struct Svg {
    out: String,
    /// Attributes of the path being written, empty if none is.
    open: String,
    /// Where its pen is, in steps.
    at: (i32, i32),
}

impl Svg {
    /// Starts an SVG of this size.
    pub(super) fn new((width, height): (u32, u32), caption: &Caption) -> Self {
        let Caption { name, title, description } = caption;
        let [id, title, description] =
            [name, title, description].map(|text| markup::escaped(text));
        let out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"fig\" \
             width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-labelledby=\"{id}-title {id}-desc\" \
             font-family=\"{FONTS}\" font-size=\"{TEXT_PX}\">\n\
             <title id=\"{id}-title\">{title}</title>\n\
             <desc id=\"{id}-desc\">{description}</desc>\n\
             <style>{STYLE}</style>\n\
             <rect class=\"p\" width=\"{width}\" height=\"{height}\"/>\n"
        );
        Self { out, open: String::new(), at: (0, 0) }
    }

    /// The whole text.
    pub(super) fn finish(mut self) -> String {
        self.close();
        self.out.push_str("</svg>\n");
        self.out
    }

    /// A polyline; closed if it ends where it starts.
    pub(super) fn line(&mut self, points: &[Point], pen: Pen) {
        let points: Vec<_> = points.iter().map(steps).collect();
        if let [first, rest @ ..] = points.as_slice() {
            self.start(stroke(pen), *first);
            match rest.split_last() {
                Some((last, between))
                    if last == first && !between.is_empty() =>
                {
                    self.lines(between);
                    self.out.push('z');
                }
                _ => self.lines(rest),
            }
        }
    }

    /// A filled polygon.
    pub(super) fn area(&mut self, corners: &[Point], fill: Fill) {
        let corners: Vec<_> = corners.iter().map(steps).collect();
        if let [first, rest @ ..] = corners.as_slice() {
            let mut attributes = format!("class=\"{}\"", fill.ink.class());
            if fill.percent < 100 {
                let opacity = f64::from(fill.percent) / 100.0;
                let _ = write!(attributes, " fill-opacity=\"{opacity}\"");
            }
            self.start(attributes, *first);
            self.lines(rest);
            self.out.push('z');
        }
    }

    /// A filled circle: a point of a thick round pen, so that many make one
    /// path.
    pub(super) fn dot(&mut self, centre: Point, radius_px: f64, ink: Ink) {
        let per_px = f64::from(PER_PX);
        // A whole number of steps.
        let width = 2.0 * ((radius_px * per_px).round() / per_px);
        let ink = ink.class();
        let pen = format!("class=\"l r {ink}\" stroke-width=\"{width}\"");
        self.start(pen, steps(&centre));
        self.out.push_str("h0");
    }

    /// A line of text.
    pub(super) fn text(&mut self, line: &TextLine) {
        self.close();
        let (x, y) = steps(&line.at);
        let (x, y) = (px(x), px(y));
        let place = match line.upwards {
            true => format!("transform=\"translate({x} {y}) rotate(-90)\""),
            false => format!("x=\"{x}\" y=\"{y}\""),
        };
        let align = match line.align {
            Horizontal::Left => "",
            Horizontal::Centre => " text-anchor=\"middle\"",
            Horizontal::Right => " text-anchor=\"end\"",
        };
        let (ink, size) = (line.ink.class(), line.size_px);
        let _ = write!(self.out, "<text class=\"{ink}\" {place}{align}");
        if size != TEXT_PX {
            let _ = write!(self.out, " font-size=\"{size}\"");
        }
        let content = markup::tspans(&line.markup, size);
        if content.contains('<') {
            self.out.push_str(" xml:space=\"preserve\"");
        }
        let _ = writeln!(self.out, ">{content}</text>");
    }

    /// Goes to a point of a path with these attributes, which is opened where
    /// none is.
    fn start(&mut self, attributes: String, at: (i32, i32)) {
        if self.open != attributes {
            self.close();
            let _ = write!(self.out, "<path {attributes} d=\"");
            self.open = attributes;
        }
        self.out.push('M');
        self.next(at.0);
        self.next(at.1);
        self.at = at;
    }

    fn close(&mut self) {
        if !self.open.is_empty() {
            self.out.push_str("\"/>\n");
            self.open.clear();
        }
    }

    fn lines(&mut self, points: &[(i32, i32)]) {
        let mut first = true;
        for p in points {
            let (dx, dy) = (p.0 - self.at.0, p.1 - self.at.1);
            if dx == 0 && dy == 0 {
                continue;
            }
            if first {
                self.out.push('l');
            }
            self.next(dx);
            self.next(dy);
            first = false;
            self.at = *p;
        }
    }

    /// Writes a number after a letter or another number.
    fn next(&mut self, steps: i32) {
        let number = px(steps);
        let is_second = self.out.ends_with(|c: char| c.is_ascii_digit());
        if is_second && !number.starts_with('-') {
            self.out.push(' ');
        }
        self.out.push_str(&number);
    }
}

/// The step at or left of and above a point; the thousandth takes up rounding.
fn steps((x, y): &Point) -> (i32, i32) {
    let step = |px: &f64| f64::from(PER_PX).mul_add(*px, 1e-3).floor() as i32;
    (step(x), step(y))
}

/// Steps as px with the fewest characters.
fn px(steps: i32) -> String {
    let text = format!("{:.2}", f64::from(steps) / f64::from(PER_PX));
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text.starts_with("0.") || text.starts_with("-0.") {
        true => text.replacen("0.", ".", 1),
        false => text.to_owned(),
    }
}

/// Attributes of a line.
fn stroke(pen: Pen) -> String {
    let width = (100.0 * pen.width_px).round().max(1.0) / 100.0;
    let ink = pen.ink.class();
    let array = pen.dash.array();
    let dash = array.map(|array| format!(" stroke-dasharray=\"{array}\""));
    let dash = dash.unwrap_or_default();
    format!("class=\"l {ink}\" stroke-width=\"{width}\"{dash}")
}
