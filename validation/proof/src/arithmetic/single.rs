use rocking::number::{Number, Real};

use super::wide::{forward, functions};

/// Single precision: every input and every operation rounded to 24 bits.
///
/// ```
/// use rocking::number::Number;
/// use rocking_proof::arithmetic::{Single, wide};
/// let third = wide(Single::ratio(1, 3));
/// assert_eq!(third.hi(), f64::from(1.0_f32 / 3.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Single(f32);

forward!(Single: Add add, Sub sub, Mul mul, Div div);

impl rocking::number::sealed::Sealed for Single {}

impl Number for Single {
    fn from_f64(x: f64) -> Self {
        Self(x as f32)
    }

    fn ratio(i: i32, j: i32) -> Self {
        Self(i as f32 / j as f32)
    }

    fn mul_add(self, b: Self, c: Self) -> Self {
        Self(self.0.mul_add(b.0, c.0))
    }

    functions!(sqrt f32::sqrt, abs f32::abs);

    fn sin_cos_small(self) -> (Self, Self) {
        self.sin_cos()
    }
}

impl Real for Single {
    const ROUNDOFF: f64 = 0.5 * f32::EPSILON as f64;
    const NEWTON_STEP: f64 = 1e-4;

    fn to_f64(self) -> f64 {
        f64::from(self.0)
    }

    functions!(exp libm::expf, ln_1p libm::log1pf, asin libm::asinf);

    fn sin_cos(self) -> (Self, Self) {
        (Self(libm::sinf(self.0)), Self(libm::cosf(self.0)))
    }

    fn right_angle() -> Self {
        Self(std::f32::consts::FRAC_PI_2)
    }
}
