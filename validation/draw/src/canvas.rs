//! The area of plotters that is a whole drawing, with shapes placed in px.

use std::convert::Infallible;

use plotters::coord::Shift;
use plotters::drawing::{
    DrawingArea, DrawingAreaErrorKind, IntoDrawingArea as _,
};
use plotters::element::{Circle, PathElement, Polygon};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontDesc, FontFamily, FontStyle, TextStyle};

use crate::colour::{Fill, Ink, Pen};
use crate::drawing::{Drawing, units};
use crate::geometry::Point;
use crate::text::Horizontal;

/// A drawing that plotters draws on.
#[derive(Clone)]
pub(crate) struct Canvas<'d>(pub DrawingArea<&'d mut Drawing, Shift>);

/// What plotters has drawn, which cannot fail: the shapes go to memory, one
/// after the other.
pub(crate) fn done<T>(
    drawn: Result<T, DrawingAreaErrorKind<Infallible>>,
) -> T {
    drawn.expect("a drawing takes every shape")
}

/// Text of this size in px, on the baseline of its point.
pub(crate) fn style(px: f64, ink: Ink, to: Horizontal) -> TextStyle<'static> {
    let across = match to {
        Horizontal::Left => HPos::Left,
        Horizontal::Centre => HPos::Center,
        Horizontal::Right => HPos::Right,
    };
    let font = FontDesc::new(FontFamily::SansSerif, px, FontStyle::Normal);
    font.color(&ink.colour()).pos(Pos::new(across, VPos::Bottom))
}

impl<'d> Canvas<'d> {
    /// All of a drawing.
    pub(crate) fn on(drawing: &'d mut Drawing) -> Self {
        Self(drawing.into_drawing_area())
    }

    /// A polyline.
    pub(crate) fn line(&self, points: &[Point], pen: Pen) {
        done(self.0.draw(&PathElement::new(all(points), pen)));
    }

    /// A closed outline.
    pub(crate) fn outline(&self, corners: &[Point], pen: Pen) {
        self.line(&[corners, &corners[..1]].concat(), pen);
    }

    /// A filled polygon.
    pub(crate) fn area(&self, corners: &[Point], fill: Fill) {
        done(self.0.draw(&Polygon::new(all(corners), fill)));
    }

    /// A filled circle.
    pub(crate) fn dot(&self, centre: Point, radius_px: f64, ink: Ink) {
        let fill = Fill::solid(ink);
        done(self.0.draw(&Circle::new(at(centre), units(radius_px), fill)));
    }

    /// Marked-up text.
    pub(crate) fn text(&self, markup: &str, place: Point, of: TextStyle<'_>) {
        done(self.0.draw_text(markup, &of, at(place)));
    }
}

fn at((x, y): Point) -> (i32, i32) {
    (units(x), units(y))
}

fn all(points: &[Point]) -> Vec<(i32, i32)> {
    points.iter().copied().map(at).collect()
}
