//! Fragilities as files that other programs read.
//!
//! A fragility of the statistics is dimensionless. Those programs take one
//! block's own PGA or PGV, each in the unit that it expects: OpenQuake PGA in
//! g and PGV in cm/s, pelicun and PACT in g and m/s.

mod nrml;
mod pelicun;
mod tables;

use std::fmt;
use std::str::FromStr;

use rocking::block::Block;
use rocking::fragility::points::PointsError;
use rocking::integrator::{Model, uplift_threshold};
use rocking::statistics::Lognormal;
use rocking::statistics::lognormal::LognormalError;
use thiserror::Error;

use crate::paper::Intensity;

/// Largest error in probability of a shifted fragility that is written as
/// points: a tenth of what one record in two hundred is worth.
pub const TOLERANCE: f64 = 5e-4;

/// Probability that is cut off at either end of a range of intensities.
const TAIL: f64 = 1e-4;

/// Most characters of a name that OpenQuake takes.
const LONGEST: usize = 75;

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

/// A name that every reader takes: ASCII letters, digits, `_` and `:`, at
/// most 75. OpenQuake takes no dot and no slash in a name, and pelicun splits
/// one at `-`.
///
/// ```
/// use rocking_validation::exchange::Id;
/// assert!("BLOCK_p300_a015".parse::<Id>().is_ok());
/// assert!("BLOCK-p300-a015".parse::<Id>().is_err());
/// assert!("BLOCK/p3.0/a0.15".parse::<Id>().is_err());
/// ```
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Id(String);

impl FromStr for Id {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let taken = |c: char| c.is_ascii_alphanumeric() || "_:".contains(c);
        if text.is_empty() || text.len() > LONGEST || !text.chars().all(taken)
        {
            return Err(format!(
                "found `{text}`: expected a name of at most {LONGEST} ASCII \
                 letters, digits, _ and :"
            ));
        }
        Ok(Self(text.to_owned()))
    }
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.0)
    }
}

impl Id {
    /// The name of a block by its parameters, in all their digits, so that
    /// two blocks never share one.
    #[must_use]
    pub fn of(block: &Block) -> Self {
        let digits = |x: f64| x.to_string().replace('.', "_");
        let alpha = digits(block.slenderness_rad());
        let p = digits(block.frequency_rad_s());
        Self(format!("block_a{alpha}_p{p}"))
    }
}

/// How a fragility of one block is written.
#[derive(Clone, Debug)]
pub struct BlockFragility {
    /// Its name.
    pub id: Id,
    /// The block.
    pub block: Block,
    /// Coefficient of restitution, where it is known.
    pub eta: Option<f64>,
    /// What of the ground motion it is a function of.
    pub intensity: Intensity,
    /// In g for PGA, in m/s for PGV.
    pub fragility: Lognormal,
    /// Where it comes from, in words.
    pub origin: String,
}

/// The number of g (PGA) or of m/s (PGV) that makes a dimensionless
/// intensity of 1: tan alpha, and g tan alpha/p; Eq. 2 has alpha in place of
/// tan alpha.
///
/// ```
/// use rocking::Block;
/// use rocking::integrator::Model;
/// use rocking_validation::exchange::unit_intensity;
/// use rocking_validation::paper::Intensity;
/// let block = Block::try_new(0.15, 3.0)?;
/// let pgv = unit_intensity(Intensity::Pgv, &block, Model::Nonlinear, 9.81);
/// assert!((pgv - 9.81 * 0.151_135_218_058 / 3.0).abs() < 1e-11);
/// # Ok::<(), rocking::block::BlockError>(())
/// ```
#[must_use]
pub fn unit_intensity(
    intensity: Intensity,
    block: &Block,
    model: Model,
    gravity_m_s2: f64,
) -> f64 {
    let threshold_g = uplift_threshold(block, model);
    match intensity {
        Intensity::Pga => threshold_g,
        Intensity::Pgv => threshold_g * gravity_m_s2 / block.frequency_rad_s(),
    }
}

/// Unit of [`BlockFragility::fragility`].
#[must_use]
pub fn unit(intensity: Intensity) -> &'static str {
    match intensity {
        Intensity::Pga => "g",
        Intensity::Pgv => "m/s",
    }
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
