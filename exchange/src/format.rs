//! Fragilities as files of other programs.

mod nrml;
mod pelicun;
mod tables;

pub use tables::Pact;

use rocking::fragility::points::PointsError;
use rocking::statistics::lognormal::LognormalError;
use thiserror::Error;

use crate::fragility::{BlockFragility, Id};

/// Largest error in probability of a shifted fragility that is written as
/// points: a tenth of what one record in two hundred is worth.
pub const TOLERANCE: f64 = 5e-4;

/// Probability that is cut off at either end of a range of intensities.
const TAIL: f64 = 1e-4;

/// Why fragilities cannot be written in a format.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExchangeError {
    /// PACT's fragilities have no shift.
    #[error(
        "{id}: PACT has no shifted lognormal: expected no shift; the \
         unshifted fit is what FEMA P-58 takes"
    )]
    Shifted {
        /// The fragility.
        id: Id,
    },
    /// Points that pelicun takes for one.
    #[error(
        "{id}: points closer than 1e-8 {unit}, which pelicun takes for one: \
         expected a larger dispersion"
    )]
    Narrow {
        /// The fragility.
        id: Id,
        /// Unit of the intensity.
        unit: &'static str,
    },
    /// Points that are none.
    #[error(transparent)]
    Points(#[from] PointsError),
    /// Parameters that a change of unit makes none.
    #[error(transparent)]
    Lognormal(#[from] LognormalError),
}

/// A format of another program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// OpenQuake's NRML 0.5.
    Nrml,
    /// pelicun's library: a CSV and a JSON.
    Pelicun,
    /// Medians and dispersions for FEMA P-58's PACT.
    Pact,
    /// All parameters, as CSV.
    Csv,
}

/// Texts of a format: the main file, and one beside it with its extension.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Texts {
    /// The main file.
    pub main: String,
    /// Extension and text of a second file.
    pub beside: Option<(&'static str, String)>,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::Nrml, Self::Pelicun, Self::Pact, Self::Csv];

    /// The name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Nrml => "nrml",
            Self::Pelicun => "pelicun",
            Self::Pact => "pact",
            Self::Csv => "csv",
        }
    }

    /// Extension of a second file beside the main one.
    #[must_use]
    pub fn beside(self) -> Option<&'static str> {
        (self == Self::Pelicun).then_some("json")
    }

    /// The fragilities in this format; `limit_state` names the damage.
    ///
    /// # Errors
    /// [`ExchangeError`] for a fragility that the format cannot hold.
    pub fn texts(
        self,
        fragilities: &[BlockFragility],
        limit_state: &Id,
    ) -> Result<Texts, ExchangeError> {
        let alone = |main| Texts { main, beside: None };
        match self {
            Self::Nrml => Ok(alone(nrml::text(fragilities, limit_state)?)),
            Self::Pelicun => {
                let main = pelicun::csv(fragilities)?;
                let json = pelicun::json(fragilities, limit_state);
                Ok(Texts { main, beside: Some(("json", json)) })
            }
            Self::Pact => Ok(alone(tables::pact(fragilities, limit_state)?)),
            Self::Csv => Ok(alone(tables::csv(fragilities, limit_state))),
        }
    }
}

#[cfg(test)]
mod tests;
