//! The series by which a scene under a record is stepped.

use crate::integrator::Order;
use crate::integrator::driver::tolerance;
use crate::integrator::dynamics::Model;

/// Coefficients of the longest series, order 13. It serves pulses, Eq. 2
/// (whose series is that of the exponential), long steps, and every step at
/// which the truncation error of a shorter series is too large.
pub(crate) const LONGEST: usize = 14;

/// Largest p dt for the series of orders 8, 9 and 10. Below it the truncation
/// error stays under rounding in at least 99 % of the steps (93 % on the
/// sharpest records with few samples, order 10 at p dt = 0.02). The other
/// steps are redone at order 13, at five times the cost.
const LONGEST_STEPS: [f64; 3] = [0.0075, 0.015, 0.045];

/// Tolerance for a p dt that rounding put just above a limit.
const GUARD: f64 = 1.0 + 1e-9;

/// Equation and order of scenes under records.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Class {
    /// Eq. 1 at order 8; at the longest series if the truncation error of a
    /// step is too large.
    Eight,
    /// Likewise, order 9.
    Nine,
    /// Likewise, order 10.
    Ten,
    /// Eq. 1 at the longest series.
    Longest,
    /// Eq. 2.
    Linearized,
    /// Eq. 1 at an order that is kept whatever the truncation error.
    Fixed(Order),
}

/// True if series of `len` coefficients never change to `hard` coefficients:
/// those of [`Class::Fixed`].
pub(crate) const fn is_fixed(len: usize, hard: usize) -> bool {
    len == hard && len < LONGEST
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

    /// Truncation error allowed in a step, as a share of the velocity.
    pub fn tolerance(self) -> f64 {
        match self {
            Self::Fixed(_) => f64::INFINITY,
            _ => tolerance::<f64>(),
        }
    }

    /// Equation of motion of the class.
    pub fn model(self) -> Model {
        match self {
            Self::Linearized => Model::Linearized,
            _ => Model::Nonlinear,
        }
    }
}
