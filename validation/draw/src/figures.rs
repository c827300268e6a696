//! The report's figures: a [`Chart`] draws lines, marks and bands over two
//! axes, and its CSV has the numbers of what it draws. What is no chart has a
//! file with its data struct, its drawing and its CSV.
//!
//! Nothing here integrates or fits: the numbers arrive computed.
//!
//! Rules that hold for every struct of data: vectors that belong together have
//! the same length; angles are rad, times s, frequencies rad/s; an
//! overturned block has the demand +infinity; a value that does not exist is
//! NaN in a vector (a gap in the line, an empty CSV cell) or `None`.

mod boxplots;
mod chart;
pub mod common;
mod fates;
mod figure;
mod heading;
mod histories;
pub mod of_result;
pub mod of_suite;
mod series;
mod sketch;

pub use crate::panel::Look;
pub use boxplots::{BoxPanel, Boxplots, Stripe};
pub use chart::{Chart, ChartAxis, ChartPanel, Column, DIGITS, Layout, Of};
pub use fates::{FateMap, MapFate};
pub use figure::Figure;
pub use heading::{Heading, Motions, Place};
pub use histories::{History, HistoryPanel, histories};
pub use series::{Mark, Series};
pub use sketch::BlockSketch;

#[cfg(test)]
mod tests;
