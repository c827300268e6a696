//! Other arithmetic for the generic source of the core: single precision, and
//! double-double with a mistake.

use rocking::number::double::DoubleDouble;
use rocking::number::{Number, Real};

/// The first word of a text as a decimal number, to the last bit or two of a
/// double-double; none if it is no number.
///
/// ```
/// use rocking::number::double::DoubleDouble;
/// use rocking_proof::arithmetic::decimal;
/// let tenth = decimal("1.0e-1").unwrap();
/// assert_eq!((tenth.hi(), tenth.lo()), (0.1, -5.551115123125783e-18));
/// assert!(decimal("-1.5e3x").is_none());
/// ```
pub fn decimal(text: &str) -> Option<DoubleDouble> {
    let word = text.split_whitespace().next()?;
    let (mantissa, exponent) = word.split_once('e').unwrap_or((word, "0"));
    let mut exponent: i32 = exponent.parse().ok()?;
    let digits = mantissa.strip_prefix('-').unwrap_or(mantissa);
    let ten = DoubleDouble::from_f64(10.0);
    let mut value = DoubleDouble::zero();
    let mut fraction = false;
    for digit in digits.chars() {
        if digit == '.' && !fraction {
            fraction = true;
            continue;
        }
        let digit = f64::from(digit.to_digit(10)?);
        value = value * ten + DoubleDouble::from_f64(digit);
        exponent -= i32::from(fraction);
    }
    for _ in 0..exponent.abs() {
        value = if exponent < 0 { value / ten } else { value * ten };
    }
    Some(if mantissa.starts_with('-') { -value } else { value })
}

/// A number of any arithmetic, rounded to the last digit of a double-double.
///
/// ```
/// use rocking_proof::arithmetic::wide;
/// assert_eq!((wide(0.5).hi(), wide(0.5).lo()), (0.5, 0.0));
/// ```
pub fn wide<N: Real>(x: N) -> DoubleDouble {
    let hi = x.to_f64();
    DoubleDouble::sum(hi, (x - N::from_f64(hi)).to_f64())
}

/// Forwards the four operations and the sign to the inner number.
macro_rules! forward {
    ($type:ident: $($trait:ident $name:ident),+) => {
        $(impl std::ops::$trait for $type {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                Self(std::ops::$trait::$name(self.0, other.0))
            }
        })+
        impl std::ops::Neg for $type {
            type Output = Self;
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }
        impl rocking::number::sealed::Sealed for $type {}
    };
}
forward!(RoundedConstants: Add add, Sub sub, Mul mul, Div div);
forward!(Single: Add add, Sub sub, Mul mul, Div div);

/// Functions of the inner number.
macro_rules! functions {
    ($($name:ident $function:path),+) => {
        $(fn $name(self) -> Self {
            Self($function(self.0))
        })+
    };
}

/// Double-double whose coefficients and pi/2 were rounded to one double: a
/// mistake that silently limits the accuracy of such an engine to 1e-17.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct RoundedConstants(DoubleDouble);

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

impl Number for Single {
    fn from_f64(x: f64) -> Self {
        Self(x as f32)
    }

    fn ratio(i: i32, j: i32) -> Self {
        Self(i as f32 / j as f32)
    }

    fn mul_add(self, b: Self, c: Self) -> Self {
        Self(libm::fmaf(self.0, b.0, c.0))
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
