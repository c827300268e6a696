//! What the figures show, as plain numbers: filled by the analyses, drawn by
//! [`crate::draw::figures`], written as CSV beside each drawing.
//!
//! Rules that hold for every struct here: vectors that belong together have
//! the same length; angles are rad, times s, frequencies rad/s; an
//! overturned block has the demand +infinity; a value that does not exist is
//! NaN in a vector (a gap in the line, an empty CSV cell) or `None`.

mod accepted;
mod boxplots;
mod capacities;
mod chart;
mod fates;
mod fragilities;
mod histories;
mod ida;
mod quantiles;
mod sketch;
mod tests_along;
mod thin;

pub use accepted::{AcceptedShares, BlockShare, SharePanel};
pub use boxplots::{BoxPanel, Boxplots, NotchedBox, Stripe, StripeKind};
pub use capacities::{Capacities, CapacityCurve, CapacityPanel};
pub use chart::{Axis, Chart, ChartPanel, Mark, Scale, Series};
pub use fates::{Fate, FateMap, FatePanel};
pub use fragilities::{
    ByConstant, ByConstantPanel, ConstantCurve, Estimator, Fitted,
    Fragilities, FragilityPanel, Lognormal, Threshold,
};
pub use histories::{Histories, History, HistoryPanel};
pub use ida::{IdaCurve, IdaCurves, IdaPanel};
pub use quantiles::{QuantileGroup, QuantilePanel, Quantiles};
pub use sketch::BlockSketch;
pub use tests_along::{Histogram, TestedBlock, TestsAlongDemand};

use crate::paper::Arm;

/// The words that go with a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Heading {
    /// File stem, unique in a report: `figure-06-c`.
    pub name: String,
    /// Short plain-text title, as a list of figures would have it; also the
    /// SVG's `<title>`.
    pub title: String,
    /// What can be seen, in a sentence or two of plain text, for those who
    /// cannot see it: the SVG's `<desc>`.
    pub description: String,
    /// Arm of the grid that the numbers come from, where there is one.
    pub arm: Option<Arm>,
}

/// The letter of a panel: a, b, c and so on.
pub(super) fn letter(panel: usize) -> String {
    let letter = u8::try_from(panel).ok().and_then(|i| b'a'.checked_add(i));
    match letter {
        Some(c) if c.is_ascii_lowercase() => char::from(c).to_string(),
        _ => (panel + 1).to_string(),
    }
}

/// Marked-up text without its marks.
fn plain(markup: &str) -> String {
    markup.replace(['*', '{', '}'], "").replace(['_', '^'], "")
}
