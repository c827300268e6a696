//! Which series a scene under a record is stepped by.

use crate::integrator::Order;
use crate::integrator::dynamics::Model;

/// Coefficients of the short series: order 9. Order 8 leaves too much of one
/// step in fourteen on records with sharp kinks, and taking those again costs
/// more than it saves.
pub(crate) const SHORT: usize = 10;
/// Coefficients of pulses, of Eq. 2 (whose series is the exponential's), and
/// of any step that a shorter series leaves too much of: order 13.
pub(crate) const SMOOTH: usize = 14;

/// Longest step (in 1/p) of which the short series leaves less than rounding,
/// most of the time.
const SHORT_STEP: f64 = 0.045;

/// A step of that length is one although p dt comes out above it.
const GUARD: f64 = 1.0 + 1e-9;

/// What scenes under records have in common: equation and order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Class {
    /// Eq. 1, the short series.
    Short,
    /// Eq. 1, the long one.
    Smooth,
    /// Eq. 2.
    Linearized,
    /// Eq. 1 at an order that is kept whatever a step leaves.
    Fixed(Order),
}

impl Class {
    /// The class of scenes of a model at steps of `length` (in 1/p), Eq. 1 at
    /// a fixed order if one is given.
    pub fn of(model: Model, length: f64, order: Option<Order>) -> Self {
        match (model, order) {
            (Model::Linearized, _) => Self::Linearized,
            (Model::Nonlinear, Some(order)) => Self::Fixed(order),
            (Model::Nonlinear, None) if length <= SHORT_STEP * GUARD => {
                Self::Short
            }
            (Model::Nonlinear, None) => Self::Smooth,
        }
    }

    /// Its equation of motion.
    pub fn model(self) -> Model {
        match self {
            Self::Linearized => Model::Linearized,
            Self::Short | Self::Smooth | Self::Fixed(_) => Model::Nonlinear,
        }
    }
}
