//! Conversion factors: the only place in the crate that has any.

use std::fmt;

/// Standard gravity in m/s2 (CGPM 1901).
///
/// The paper's Table 1 and the reference values use 9.81. A caller who needs
/// that value passes it.
///
/// ```
/// assert_eq!(rocking::units::STANDARD_GRAVITY_M_S2, 9.80665);
/// ```
pub const STANDARD_GRAVITY_M_S2: f64 = 9.80665;

/// Unit of acceleration in which a record is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AccelerationUnit {
    /// Multiples of gravity.
    Gravity,
    /// Metres per second squared.
    MetrePerSecondSquared,
    /// Centimetres per second squared (gal).
    CentimetrePerSecondSquared,
}

impl AccelerationUnit {
    /// Reads a unit in a usual spelling: `g`, `m/s2`, `cm/s2`, `gal`.
    ///
    /// ```
    /// use rocking::units::AccelerationUnit;
    /// assert_eq!(
    ///     AccelerationUnit::parse("CM/S/S"),
    ///     Some(AccelerationUnit::CentimetrePerSecondSquared)
    /// );
    /// assert_eq!(AccelerationUnit::parse("furlong"), None);
    /// ```
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim().to_ascii_lowercase().replace('²', "2");
        let text = text.replace("sec", "s").replace("cms/", "cm/");
        match text.as_str() {
            "g" => Some(Self::Gravity),
            "m/s2" | "m/s^2" | "m/s**2" | "m/s/s" | "m.s-2" | "m s-2" => {
                Some(Self::MetrePerSecondSquared)
            }
            "cm/s2" | "cm/s^2" | "cm/s**2" | "cm/s/s" | "cm.s-2"
            | "cm s-2" | "gal" | "gals" => {
                Some(Self::CentimetrePerSecondSquared)
            }
            _ => None,
        }
    }

    /// Number in this unit that makes one `gravity_m_s2`: a reading divided
    /// by it is a multiple of gravity.
    ///
    /// ```
    /// use rocking::units::AccelerationUnit;
    /// let unit = AccelerationUnit::CentimetrePerSecondSquared;
    /// assert_eq!(unit.per_gravity(9.81), 981.0);
    /// ```
    pub fn per_gravity(self, gravity_m_s2: f64) -> f64 {
        match self {
            Self::Gravity => 1.0,
            Self::MetrePerSecondSquared => gravity_m_s2,
            Self::CentimetrePerSecondSquared => gravity_m_s2 * 100.0,
        }
    }
}

impl fmt::Display for AccelerationUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Gravity => "g",
            Self::MetrePerSecondSquared => "m/s2",
            Self::CentimetrePerSecondSquared => "cm/s2",
        })
    }
}
