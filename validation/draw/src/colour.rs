//! Inks, pens and fills.
//!
//! An ink is a name, not a colour: the style sheet gives it one in light,
//! dark and print. Series inks differ in hue, and in lightness by steps of
//! about ten, so they stay apart for colour-blind readers and in grey; each
//! also has a dash of its own.

use plotters::style::{Color as _, RGBColor, ShapeStyle};
use plotters_backend::BackendColor;
use serde::{Deserialize, Serialize};

/// Classes of the inks in the style sheet, by their number.
const CLASSES: [&str; 10] =
    ["p", "t", "m", "g", "s1", "s2", "s3", "s4", "s5", "s6"];
/// Attributes of the dashes, by their number.
const DASHES: [&str; 6] = [
    "",
    " stroke-dasharray=\"5 2.5\"",
    " stroke-dasharray=\"1.2 1.8\"",
    " stroke-dasharray=\"6 2 1.2 2\"",
    " stroke-dasharray=\"10 3\"",
    " stroke-dasharray=\"2.5 1.5\"",
];

/// Class of the ink that a colour is the number of.
pub(crate) fn class(colour: BackendColor) -> &'static str {
    CLASSES[usize::from(colour.rgb.0)]
}

/// Attribute of the dash that a colour is the number of.
pub(crate) fn dash_array(colour: BackendColor) -> &'static str {
    DASHES[usize::from(colour.rgb.1)]
}

/// What a shape is drawn with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Ink {
    /// The page behind everything.
    Paper,
    /// Text and axes.
    Text,
    /// Secondary text, reference lines.
    Muted,
    /// Grid lines.
    Grid,
    /// Colour of a series; there are [`Ink::SERIES`], then they repeat.
    Series(usize),
}

impl Ink {
    /// Number of different series inks.
    pub const SERIES: usize = 6;

    /// The colour that is its number.
    pub(crate) fn colour(self) -> RGBColor {
        let number = match self {
            Self::Paper => 0,
            Self::Text => 1,
            Self::Muted => 2,
            Self::Grid => 3,
            Self::Series(k) => 4 + (k % Self::SERIES) as u8,
        };
        RGBColor(number, 0, 0)
    }
}

/// Pattern of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Dash {
    /// Unbroken.
    Solid,
    /// Medium dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// Dash and dot.
    DashDot,
    /// Long dashes.
    Long,
    /// Short dashes.
    Short,
}

impl Dash {
    /// The dash that goes with a series, for readers without colour.
    pub fn of_series(series: usize) -> Self {
        use Dash::{DashDot, Dashed, Dotted, Long, Short, Solid};
        [Solid, Dashed, Dotted, DashDot, Long, Short][series % 6]
    }
}

/// A line's ink, width and pattern.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pen {
    /// Ink.
    pub ink: Ink,
    /// Width in px, in steps of a hundredth.
    pub width_px: f64,
    /// Pattern.
    pub dash: Dash,
}

impl Pen {
    /// An unbroken line.
    pub const fn new(ink: Ink, width_px: f64) -> Self {
        Self { ink, width_px, dash: Dash::Solid }
    }

    /// The same with another pattern.
    pub const fn dash(self, dash: Dash) -> Self {
        Self { dash, ..self }
    }

    /// Line of series `k` of those that are drawn over one another in this
    /// order: the first is unbroken and widest, so that where curves
    /// coincide each still shows.
    pub fn of_series(k: usize) -> Self {
        let thinner = 0.12 * (k % Ink::SERIES) as f64;
        Self::new(Ink::Series(k), 1.6 - thinner).dash(Dash::of_series(k))
    }
}

impl From<Pen> for ShapeStyle {
    /// The width is in hundredths of a pixel.
    fn from(pen: Pen) -> Self {
        let width = (100.0 * pen.width_px).round().max(1.0);
        let RGBColor(ink, ..) = pen.ink.colour();
        RGBColor(ink, pen.dash as u8, 0).stroke_width(width as u32)
    }
}

impl From<Fill> for ShapeStyle {
    fn from(fill: Fill) -> Self {
        let opacity = f64::from(fill.percent) / 100.0;
        fill.ink.colour().mix(opacity).filled()
    }
}

/// An area's ink and opacity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fill {
    /// Ink.
    pub ink: Ink,
    /// Opacity in percent.
    pub percent: u8,
}

impl Fill {
    /// Opaque.
    pub const fn solid(ink: Ink) -> Self {
        Self { ink, percent: 100 }
    }

    /// See-through.
    pub const fn tint(ink: Ink, percent: u8) -> Self {
        Self { ink, percent }
    }
}

/// The style sheet of every figure. A page that holds several puts it in its
/// head once.
pub const STYLE: &str = include_str!("figure.css");
