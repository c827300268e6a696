use rocking::number::double::DoubleDouble;
use rocking::number::{Number, Real};

use super::wide::{forward, functions};

/// Double-double whose coefficients and pi/2 were rounded to one double: the
/// mistake that caps such an engine at 1e-17 without a word.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct RoundedConstants(DoubleDouble);

forward!(RoundedConstants: Add add, Sub sub, Mul mul, Div div);

impl rocking::number::sealed::Sealed for RoundedConstants {}

impl Number for RoundedConstants {
    fn from_f64(x: f64) -> Self {
        Self(DoubleDouble::from_f64(x))
    }

    fn mul_add(self, b: Self, c: Self) -> Self {
        Self(self.0.mul_add(b.0, c.0))
    }

    functions!(sqrt Number::sqrt, abs Number::abs);

    fn sin_cos_small(self) -> (Self, Self) {
        self.sin_cos()
    }
}

impl Real for RoundedConstants {
    const ROUNDOFF: f64 = DoubleDouble::ROUNDOFF;
    const NEWTON_STEP: f64 = DoubleDouble::NEWTON_STEP;

    fn to_f64(self) -> f64 {
        self.0.to_f64()
    }

    functions!(exp Real::exp, ln_1p Real::ln_1p, asin Real::asin);

    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.0.sin_cos();
        (Self(s), Self(c))
    }

    fn right_angle() -> Self {
        Self::from_f64(std::f64::consts::FRAC_PI_2)
    }
}
