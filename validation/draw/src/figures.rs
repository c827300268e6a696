//! The report's figures, a file each: its data struct, its drawing as a pure
//! function of that, and the CSV of the same numbers.
//!
//! Nothing here integrates or fits: the structs arrive filled.
//!
//! Rules that hold for every struct of data: vectors that belong together have
//! the same length; angles are rad, times s, frequencies rad/s; an
//! overturned block has the demand +infinity; a value that does not exist is
//! NaN in a vector (a gap in the line, an empty CSV cell) or `None`.

mod accepted;
mod boxplots;
mod capacities;
mod chart;
mod common;
mod fates;
mod fragilities;
mod histories;
mod ida;
pub mod of_result;
mod quantiles;
mod sketch;
mod tests_along;

pub use accepted::{AcceptedShares, BlockShare, SharePanel};
pub use boxplots::{BoxPanel, Boxplots, Stripe, StripeKind};
pub use capacities::{Capacities, CapacityCurve, CapacityPanel};
pub use chart::{Chart, ChartAxis, ChartPanel, Mark, Scale, Series};
pub use fates::{Fate, FateMap};
pub use fragilities::{
    BandOf, ByConstant, ByConstantPanel, ConstantCurve, Estimator, Fitted,
    Fragilities, FragilityPanel, Limit,
};
pub use histories::{Histories, History, HistoryPanel};
pub use ida::{IdaCurve, IdaCurves, IdaPanel};
pub use quantiles::{QuantileGroup, QuantilePanel, Quantiles};
pub use sketch::BlockSketch;
pub use tests_along::{Histogram, TestedBlock, TestsAlongDemand};

use crate::Scene;
use rocking_common::paper::Arm;

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

impl Heading {
    /// The words of a figure.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        description: impl Into<String>,
        arm: Option<Arm>,
    ) -> Self {
        let (name, title) = (name.into(), title.into());
        Self { name, title, description: description.into(), arm }
    }
}

/// A figure: its words, its shapes and its numbers.
pub struct Figure {
    /// The words that go with it.
    pub heading: Heading,
    /// The shapes, before they are written.
    pub scene: Scene,
    /// The numbers, one header line, long format.
    pub csv: String,
    /// What one sees, in one sentence made from the numbers.
    pub reading: String,
}

impl Figure {
    fn new(
        heading: &Heading,
        scene: Scene,
        csv: String,
        reading: String,
    ) -> Self {
        Self { heading: heading.clone(), scene, csv, reading }
    }

    /// The drawing.
    #[must_use]
    pub fn svg(&self) -> String {
        self.scene.svg()
    }
}

#[cfg(test)]
mod tests;
