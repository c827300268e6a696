//! Lines of text on a drawing.

use std::fmt::Write as _;

use plotters::style::text_anchor::HPos;
use serde::{Deserialize, Serialize};

use crate::geometry::Point;
use crate::markup;

/// Text size that elements have unless they say otherwise, in px.
pub const TEXT_PX: f64 = 11.0;

/// Horizontal alignment of a line of text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Horizontal {
    /// Starts at the point.
    Left,
    /// Centred on the point.
    Centre,
    /// Ends at the point.
    Right,
}

/// A line of marked-up text on a baseline.
pub(crate) struct TextLine {
    /// The text, in [`markup`].
    pub markup: String,
    /// A point of the baseline, in px.
    pub at: Point,
    /// How it lies about that point.
    pub align: HPos,
    /// Size.
    pub size_px: f64,
    /// Class of its ink.
    pub class: &'static str,
    /// Whether it runs upwards instead of to the right.
    pub upwards: bool,
}

impl TextLine {
    /// Writes its element of an SVG.
    pub(crate) fn write(&self, out: &mut String) {
        let Self { at: (x, y), size_px, class, .. } = self;
        let place = match self.upwards {
            true => format!("transform=\"translate({x} {y}) rotate(-90)\""),
            false => format!("x=\"{x}\" y=\"{y}\""),
        };
        let align = match self.align {
            HPos::Left => "",
            HPos::Center => " text-anchor=\"middle\"",
            HPos::Right => " text-anchor=\"end\"",
        };
        let _ = write!(out, "<text class=\"{class}\" {place}{align}");
        if *size_px != TEXT_PX {
            let _ = write!(out, " font-size=\"{size_px}\"");
        }
        let content = markup::tspans(&self.markup, *size_px);
        if content.contains('<') {
            out.push_str(" xml:space=\"preserve\"");
        }
        let _ = writeln!(out, ">{content}</text>");
    }
}
