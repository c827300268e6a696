//! The report's figures: each a pure function from a typed data struct to an
//! SVG, with the CSV of the same numbers.
//!
//! Nothing here integrates or fits: the structs of [`data`] arrive filled.

mod accepted;
mod boxplots;
mod capacities;
mod chart;
mod common;
pub mod data;
mod fates;
mod fragilities;
mod histories;
mod ida;
mod quantiles;
mod sketch;
mod tests_along;

use super::{DrawError, Scene};

/// What every figure's data can do.
pub trait Figure {
    /// The words that go with it.
    fn heading(&self) -> &data::Heading;

    /// The shapes, before they are written.
    fn scene(&self) -> Scene;

    /// The numbers, one header line, long format.
    fn csv(&self) -> String;

    /// The drawing.
    ///
    /// # Errors
    /// [`DrawError`] when the SVG grows too large.
    fn svg(&self) -> Result<String, DrawError> {
        self.scene().svg()
    }
}

#[cfg(test)]
mod tests;

#[cfg(test)]
pub(crate) use tests::demonstration;
