//! Which series a scene under a record is stepped by.

use crate::integrator::Order;
use crate::integrator::driver::tolerance;
use crate::integrator::dynamics::Model;

/// Coefficients of the longest series, order 13: that of pulses, of Eq. 2
/// (whose series is the exponential's), of long steps, and of any step that a
/// shorter series leaves too much of.
pub(crate) const LONGEST: usize = 14;

/// Longest steps (in 1/p) of which the series of orders 8, 9 and 10 leave
/// less than rounding most of the time: of one step in a hundred or fewer they
/// do not, of one in fifteen on the sharpest records with few samples (order
/// 10 at a length of 0.02). Those are taken again, which costs as much as five
/// others.
const LONGEST_STEPS: [f64; 3] = [0.0075, 0.015, 0.045];

/// A step of that length is one although p dt comes out above it.
const GUARD: f64 = 1.0 + 1e-9;

/// What scenes under records have in common: equation and order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Class {
    /// Eq. 1 at order 8, at the longest where that leaves too much of a step.
    Eight,
    /// Likewise, order 9.
    Nine,
    /// Likewise, order 10.
    Ten,
    /// Eq. 1 at the longest series.
    Longest,
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
            (Model::Nonlinear, None) => {
                let fits = |longest: &f64| length <= longest * GUARD;
                match LONGEST_STEPS.iter().position(fits) {
                    Some(0) => Self::Eight,
                    Some(1) => Self::Nine,
                    Some(_) => Self::Ten,
                    None => Self::Longest,
                }
            }
        }
    }

    /// Truncation allowed in a step, as a share of the velocity.
    pub fn tolerance(self) -> f64 {
        match self {
            Self::Fixed(_) => f64::INFINITY,
            _ => tolerance::<f64>(),
        }
    }

    /// Its equation of motion.
    pub fn model(self) -> Model {
        match self {
            Self::Linearized => Model::Linearized,
            _ => Model::Nonlinear,
        }
    }
}
