//! Inks, pens and fills.
//!
//! An ink is a name, not a colour: the style sheet gives it one in light,
//! dark and print. Series inks differ in hue, and in lightness by steps of
//! about ten, so they stay apart for colour-blind readers and in grey; each
//! also has a dash of its own.

use serde::{Deserialize, Serialize};

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

    /// Its class in the style sheet.
    pub(super) fn class(self) -> &'static str {
        match self {
            Self::Paper => "p",
            Self::Text => "t",
            Self::Muted => "m",
            Self::Grid => "g",
            Self::Series(k) => {
                ["s1", "s2", "s3", "s4", "s5", "s6"][k % Self::SERIES]
            }
        }
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

    /// SVG's dash array.
    pub(super) fn array(self) -> Option<&'static str> {
        match self {
            Self::Solid => None,
            Self::Dashed => Some("5 2.5"),
            Self::Dotted => Some("1.2 1.8"),
            Self::DashDot => Some("6 2 1.2 2"),
            Self::Long => Some("10 3"),
            Self::Short => Some("2.5 1.5"),
        }
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
pub const STYLE: &str = "svg.fig .p{fill:#fff}svg.fig .t{fill:#1a1a1a}svg.fig \
.m{fill:#595959}svg.fig .g{fill:#e2e2e2}svg.fig .s1{fill:#1f2d78}svg.fig \
.s2{fill:#a3195b}svg.fig .s3{fill:#c2570c}svg.fig .s4{fill:#13877a}svg.fig \
.s5{fill:#7a9a01}svg.fig .s6{fill:#6f6f6f}svg.fig path.l,svg.fig \
circle.l{fill:none;stroke-linejoin:round}svg.fig .l.t{stroke:#1a1a1a}svg.fig \
.l.m{stroke:#6b6b6b}svg.fig .l.g{stroke:#e2e2e2}svg.fig \
.l.p{stroke:#fff}svg.fig .l.s1{stroke:#1f2d78}svg.fig \
.l.s2{stroke:#a3195b}svg.fig .l.s3{stroke:#c2570c}svg.fig \
.l.s4{stroke:#13877a}svg.fig .l.s5{stroke:#7a9a01}svg.fig \
.l.s6{stroke:#6f6f6f}svg.fig .r{stroke-linecap:round}@media screen and \
(prefers-color-scheme:dark){svg.fig .p{fill:#15181c}svg.fig \
.t{fill:#e8e8e8}svg.fig .m{fill:#a8adb3}svg.fig .g{fill:#333a41}svg.fig \
.s1{fill:#8fa2ff}svg.fig .s2{fill:#ff8ac4}svg.fig .s3{fill:#ffa55c}svg.fig \
.s4{fill:#4fd6c3}svg.fig .s5{fill:#d4ee6a}svg.fig .s6{fill:#b0b0b0}svg.fig \
path.l,svg.fig circle.l{fill:none}svg.fig .l.t{stroke:#e8e8e8}svg.fig \
.l.m{stroke:#9aa0a6}svg.fig .l.g{stroke:#333a41}svg.fig \
.l.p{stroke:#15181c}svg.fig .l.s1{stroke:#8fa2ff}svg.fig \
.l.s2{stroke:#ff8ac4}svg.fig .l.s3{stroke:#ffa55c}svg.fig \
.l.s4{stroke:#4fd6c3}svg.fig .l.s5{stroke:#d4ee6a}svg.fig \
.l.s6{stroke:#b0b0b0}}";
