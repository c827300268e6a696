//! Fragilities as files of other programs, a module for each format. The row
//! of a format in [`ExchangeFormat::ALL`] has everything that commands and
//! Python need.

mod csv;
mod nrml;
mod pact;
mod pelicun;

pub use pact::Pact;

use rocking::names::{self, UnknownName};
use rocking_procedures::fragility::points::PointsError;
use rocking_statistics::lognormal::LognormalError;
use thiserror::Error;

use crate::fragility::{BlockFragility, Id, crossed_by};
use crate::table::number;

/// Largest error in probability of a shifted fragility that is written as
/// points: a tenth of the share of one record in two hundred.
pub const TOLERANCE: f64 = 5e-4;

/// Probability that is cut off at either end of a range of intensities.
const TAIL: f64 = 1e-4;

/// Largest excess of the probability of a limit state over the probability of
/// the state before it. OpenQuake stops if a damage, which is their
/// difference, is below minus this; pelicun draws all limit states from one
/// number and takes the last state that is reached.
const CROSSING: f64 = 1e-6;

/// Why fragilities cannot be written in a format.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExchangeError {
    /// PACT's fragilities have no shift.
    #[error(
        "{0}: PACT has no shifted lognormal: expected no shift; FEMA P-58 \
         uses the unshifted fit"
    )]
    Shifted(Id),
    /// A measure that the other program lacks.
    #[error("{id}: {format} has no measure {im}: expected {expected}")]
    Measure {
        /// The fragility.
        id: Id,
        /// The format.
        format: &'static str,
        /// The measure.
        im: String,
        /// Measures of the program.
        expected: &'static str,
    },
    /// A block without a limit state.
    #[error("{0}: no limit state: expected at least one")]
    NoState(Id),
    /// Blocks with different limit states in a format that has one list.
    #[error(
        "{id}: limit states {found}: expected {expected}, as in the first \
         block, because NRML has one list for all"
    )]
    Mixed {
        /// The fragility.
        id: Id,
        /// Its limit states.
        found: String,
        /// Limit states of the first block.
        expected: String,
    },
    /// Limit states whose curves cross.
    #[error(
        "{id}: near {im} the limit state {next} is more probable than {name} \
         before it, which the reader would misinterpret: expected curves that \
         do not cross, for example with equal dispersions"
    )]
    Crossing {
        /// The fragility.
        id: Id,
        /// The limit state.
        name: Id,
        /// The limit state of greater damage.
        next: Id,
        /// The intensity with its unit.
        im: String,
    },
    /// Points that pelicun cannot distinguish.
    #[error(
        "{id}: points closer than 1e-8 {unit}, which pelicun cannot \
         distinguish: expected a larger dispersion"
    )]
    Narrow {
        /// The fragility.
        id: Id,
        /// Unit of the intensity.
        unit: &'static str,
    },
    /// Invalid points.
    #[error(transparent)]
    Points(#[from] PointsError),
    /// Parameters that are invalid after a change of unit.
    #[error(transparent)]
    Lognormal(#[from] LognormalError),
}

/// A result of writing a format.
type Result<T, E = ExchangeError> = std::result::Result<T, E>;

/// Texts of a format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Texts {
    /// The main file.
    pub main: String,
    /// The file beside it, if the format has one.
    pub beside: Option<String>,
}

/// A format of another program.
#[derive(Debug)]
#[non_exhaustive]
pub struct ExchangeFormat {
    /// Name, as commands and Python spell it.
    pub name: &'static str,
    /// Contents of its files, for the help.
    pub help: &'static str,
    /// Cells of its row in `docs/exchange.md`: the program that reads its
    /// files, intensity measures, and treatment of a shift.
    pub cells: &'static str,
    /// Extension of the main file.
    pub extension: &'static str,
    /// Extension of a second file beside it.
    pub beside: Option<&'static str>,
    /// Whether an assessment writes its files.
    pub in_assessment: bool,
    /// Whether the curves of limit states may cross.
    may_cross: bool,
    /// Writes fragilities that have limit states.
    texts: fn(&[BlockFragility]) -> Result<Texts>,
}

impl BlockFragility {
    /// The refusal of a format that lacks the measure.
    fn unknown(
        &self,
        format: &'static str,
        expected: &'static str,
    ) -> ExchangeError {
        let (id, im) = (self.id.clone(), self.im.to_string());
        ExchangeError::Measure { id, format, im, expected }
    }
}

impl ExchangeFormat {
    /// All formats.
    pub const ALL: &[&Self] =
        &[&nrml::FORMAT, &pelicun::FORMAT, &pact::FORMAT, &csv::FORMAT];

    /// Common values of most formats.
    const BASE: Self = Self {
        name: "",
        help: "",
        cells: "",
        extension: "csv",
        beside: None,
        in_assessment: false,
        may_cross: false,
        texts: |_| Ok(Texts { main: String::new(), beside: None }),
    };

    /// The format of this name, in upper or lower case.
    ///
    /// # Errors
    /// [`UnknownName`] with the names of all formats.
    pub fn named(name: &str) -> Result<&'static Self, UnknownName> {
        names::find("format", name, Self::ALL, |format| format.name)
    }

    /// The fragilities in this format.
    ///
    /// # Errors
    /// [`ExchangeError`] for a fragility that the format cannot express and,
    /// except in CSV, for limit states whose curves cross.
    pub fn texts(
        &self,
        fragilities: &[BlockFragility],
    ) -> Result<Texts, ExchangeError> {
        for one in fragilities {
            self.check(one)?;
        }
        (self.texts)(fragilities)
    }

    /// Refuses a block without limit states, and curves that cross.
    fn check(&self, one: &BlockFragility) -> Result<()> {
        let id = one.id.clone();
        if one.limit_states.is_empty() {
            return Err(ExchangeError::NoState(id));
        }
        let totals = one.totals(1.0)?;
        let pairs = totals.iter().zip(totals.iter().skip(1));
        for ((own, law), (next, after)) in pairs.filter(|_| !self.may_cross) {
            if let Some(im) = crossed_by(law, after, CROSSING) {
                let im = format!("{} {}", number(im), one.im.unit());
                let (name, next) = (own.name.clone(), next.name.clone());
                return Err(ExchangeError::Crossing { id, name, next, im });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
