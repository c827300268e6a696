//! Words of a drawing: its caption, and lines of text.

use crate::colour::Ink;
use crate::geometry::{Point, Rect};
use crate::markup;
use serde::{Deserialize, Serialize};

/// Text size that elements have unless they say otherwise, in px.
pub const TEXT_PX: f64 = 11.0;

/// Name and words of a drawing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Caption {
    /// Unique on a page; letters, digits and hyphens.
    pub name: String,
    /// Plain text.
    pub title: String,
    /// Plain text.
    pub description: String,
}

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
#[derive(Debug, Clone, PartialEq)]
pub struct TextLine {
    /// The text, in [`markup`].
    pub markup: String,
    /// A point of the baseline.
    pub at: Point,
    /// How it lies about that point.
    pub align: Horizontal,
    /// Size.
    pub size_px: f64,
    /// Ink.
    pub ink: Ink,
    /// Whether it runs upwards instead of to the right.
    pub upwards: bool,
}

impl TextLine {
    /// Text of the usual size and ink.
    pub fn new(markup: &str, at: Point, align: Horizontal) -> Self {
        Self {
            markup: markup.into(),
            at,
            align,
            size_px: TEXT_PX,
            ink: Ink::Text,
            upwards: false,
        }
    }

    /// The same in another size.
    pub fn size(self, size_px: f64) -> Self {
        Self { size_px, ..self }
    }

    /// The same in another ink.
    pub fn ink(self, ink: Ink) -> Self {
        Self { ink, ..self }
    }

    /// The same running upwards.
    pub fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }

    /// The rectangle it fills, by the table of widths.
    pub fn extent(&self) -> Rect {
        let width = markup::width(&self.markup, self.size_px);
        let before = match self.align {
            Horizontal::Left => 0.0,
            Horizontal::Centre => width / 2.0,
            Horizontal::Right => width,
        };
        let (above, below) = (0.74 * self.size_px, 0.21 * self.size_px);
        let (x, y) = self.at;
        let (left, right, top, bottom) = if self.upwards {
            (x - above, x + below, y + before - width, y + before)
        } else {
            (x - before, x - before + width, y - above, y + below)
        };
        Rect { left, right, top, bottom }
    }
}
