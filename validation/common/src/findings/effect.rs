//! The smallest effects of interest: a smaller change leads to no other decision
//! of an engineer.

use super::unit::Unit;

/// A smallest effect of interest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Effect {
    /// A part of the number itself.
    Relative(f64),
    /// In the unit of the number.
    Absolute(f64),
}

impl Effect {
    /// The effect of a unit: 10 % of an intensity or a dispersion, 10 points of a
    /// share, 0.05 of a probability or a distance; `None` for a count, by which
    /// nobody decides.
    pub fn of(unit: Unit) -> Option<Self> {
        match unit {
            Unit::One => Some(Self::Relative(0.1)),
            Unit::Share | Unit::Points => Some(Self::Absolute(0.1)),
            Unit::Distance | Unit::Probability => Some(Self::Absolute(0.05)),
            Unit::Count => None,
        }
    }
}
