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
mod heading;
mod histories;
mod ida;
pub mod of_result;
mod quantiles;
mod sketch;
mod tests_along;

pub use accepted::{AcceptedShares, BlockShare, SharePanel};
pub use boxplots::{BoxPanel, Boxplots, Stripe};
pub use capacities::{Capacities, CapacityCurve, CapacityPanel};
pub use chart::{Chart, ChartAxis, ChartPanel, Mark, Scale, Series};
pub use fates::{Fate, FateMap};
pub use fragilities::{
    BandOf, ByConstant, ByConstantPanel, Estimator, Fitted, Fragilities,
    FragilityPanel, Limit,
};
pub use heading::{Figure, Heading, Place};
pub use histories::{Histories, History, HistoryPanel};
pub use ida::{IdaCurve, IdaCurves, IdaPanel};
pub use quantiles::{QuantileGroup, QuantilePanel, Quantiles};
pub use sketch::BlockSketch;
pub use tests_along::{Histogram, TestedBlock, TestsAlongDemand};

#[cfg(test)]
mod tests;
