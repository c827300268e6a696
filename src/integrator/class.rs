//! Which series a scene under a record is stepped by.

use crate::integrator::dynamics::Model;

/// Coefficients of the series of order 7.
pub(crate) const SEVEN: usize = 8;
/// Coefficients of the series of order 8.
pub(crate) const EIGHT: usize = 9;
/// Coefficients of the series of order 10.
pub(crate) const TEN: usize = 11;
/// Coefficients of the series of order 13: of pulses, of Eq. 2 (whose series
/// is the exponential's), and of any step that a shorter series leaves too
/// much of.
pub(crate) const SMOOTH: usize = 14;

/// Longest steps (in 1/p) of which orders 7, 8 and 10 leave less than
/// rounding, but for few on records with sharp kinks: taking those again
/// costs less than a higher order for all.
const LONGEST: [(f64, Class); 3] =
    [(0.0105, Class::Seven), (0.0205, Class::Eight), (0.06, Class::Ten)];

/// A step of 0.06 is one although p dt comes out above it.
const GUARD: f64 = 1.0 + 1e-9;

/// What scenes under records have in common: equation and order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Class {
    /// Eq. 1, order 7.
    Seven,
    /// Eq. 1, order 8.
    Eight,
    /// Eq. 1, order 10.
    Ten,
    /// Eq. 1, order 13.
    Thirteen,
    /// Eq. 2, order 13.
    Linearized,
}

impl Class {
    /// The class of scenes of a model at steps of `length` (in 1/p).
    pub fn of(model: Model, length: f64) -> Self {
        match model {
            Model::Linearized => Self::Linearized,
            Model::Nonlinear => LONGEST
                .into_iter()
                .find(|(longest, _)| length <= longest * GUARD)
                .map_or(Self::Thirteen, |(_, class)| class),
        }
    }

    /// Its equation of motion.
    pub fn model(self) -> Model {
        match self {
            Self::Linearized => Model::Linearized,
            Self::Seven | Self::Eight | Self::Ten | Self::Thirteen => {
                Model::Nonlinear
            }
        }
    }
}
