//! The smallest effects of interest: a change that is smaller leads to no
//! other decision of an engineer.

use super::claims::Region;
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
    /// The effect of a unit: 10 % of an intensity or a dispersion, 10 points
    /// of a share, 0.05 of a probability or of a distance; none of a count,
    /// by which nobody decides.
    #[must_use]
    pub fn of(unit: Unit) -> Option<Self> {
        match unit {
            Unit::One => Some(Self::Relative(0.1)),
            Unit::Share | Unit::Points => Some(Self::Absolute(0.1)),
            Unit::Distance | Unit::Probability => Some(Self::Absolute(0.05)),
            Unit::Count => None,
        }
    }

    /// The effect of the value of a claim: of a ratio the half width of the
    /// claim's region, 10 % at most; of a small difference the region's end.
    ///
    /// ```
    /// use rocking_common::findings::{Effect, Region, Unit};
    /// let third = Some(Region::Within(0.75, 1.25));
    /// let ratio = Effect::of_claim(third, Unit::One);
    /// assert_eq!(ratio, Some(Effect::Relative(0.1)));
    /// let small = Effect::of_claim(Some(Region::Below(0.05)), Unit::One);
    /// assert_eq!(small, Some(Effect::Absolute(0.05)));
    /// ```
    #[must_use]
    pub fn of_claim(region: Option<Region>, unit: Unit) -> Option<Self> {
        match (unit, region) {
            (Unit::One, Some(Region::Within(low, high))) => {
                Some(Self::Relative((0.5 * (high - low)).min(0.1)))
            }
            (Unit::One, Some(Region::Below(x) | Region::Above(x)))
                if x < 0.5 =>
            {
                Some(Self::Absolute(x))
            }
            _ => Self::of(unit),
        }
    }
}
