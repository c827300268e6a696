//! Arithmetic that has the same bits everywhere.
//!
//! One trait has the few operations that the model needs, so that the same
//! source runs in double and in other precisions. There is no constructor from
//! a rounded constant: [`Number::from_f64`] takes inputs exactly, and
//! [`Number::ratio`] rounds coefficients in the precision of the type.

/// Implements operators of two numbers of one type.
macro_rules! operators {
    ($type:ident: $(
        $operation:ident $method:ident |$a:ident, $b:ident| $result:expr;
    )*) => {$(
        impl $operation for $type {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let ($a, $b) = (self, other);
                $result
            }
        }
    )*};
}

pub mod dispatch;
pub mod double;
mod fused;
pub mod lanes;
pub mod octuple;
mod series;

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Seals the traits of numbers, to which any release may add methods.
pub mod sealed {
    /// An implementation outside this crate may not compile with the next
    /// release.
    pub trait Sealed {}
}

/// Arithmetic of the step kernels: no comparison, no branch. It is sealed.
pub trait Number:
    sealed::Sealed
    + Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Whether loops over the coefficients of a step are unrolled by hand, so
    /// that the coefficients stay in registers. This pays if an operation is
    /// one instruction.
    const WRITTEN_OUT: bool = false;

    /// `x`, exactly.
    fn from_f64(x: f64) -> Self;

    /// The quotient `i / j`, rounded in this type's precision; as given here,
    /// in double precision.
    #[inline(always)]
    fn ratio(i: i32, j: i32) -> Self {
        Self::from_f64(f64::from(i) / f64::from(j))
    }

    /// `self * b + c`, with one rounding in double precision and in lanes; as
    /// given here, with two.
    #[inline]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    /// Whether a rough product has fewer digits than another.
    const IS_GRADED: bool = false;

    /// `self * b + sum`, as [`Self::mul_add`]. Wider arithmetic may leave the
    /// digits of the sum unordered; [`Self::ordered`] orders them.
    #[inline(always)]
    fn add_product(self, b: Self, sum: Self) -> Self {
        self.mul_add(b, sum)
    }

    /// `self * b + sum`, as [`Self::mul_add`]; in double-double arithmetic to
    /// the digits of a double, for small terms of a sum.
    #[inline(always)]
    fn rough_product(self, b: Self, sum: Self) -> Self {
        self.mul_add(b, sum)
    }

    /// The number itself, its digits in order after [`Self::add_product`].
    #[inline(always)]
    fn ordered(self) -> Self {
        self
    }

    /// Square root.
    fn sqrt(self) -> Self;

    /// Absolute value.
    fn abs(self) -> Self;

    /// Sine and cosine of an angle in [0, pi/4] or a little beyond; as given
    /// here, in double precision.
    #[inline(always)]
    fn sin_cos_small(self) -> (Self, Self) {
        sin_cos_polynomials(self)
    }

    /// Zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::from_f64(0.0)
    }

    /// One.
    #[inline(always)]
    fn one() -> Self {
        Self::from_f64(1.0)
    }
}

/// Work with Taylor series of some lengths. It is sealed.
pub trait SeriesWork: sealed::Sealed {
    /// Result of the work.
    type Output;

    /// Does the work with series of `SHORT` coefficients for short steps and
    /// of `LONG` ones for others.
    fn run<const SHORT: usize, const LONG: usize>(self) -> Self::Output;
}

/// A scalar: comparison and the elementary functions on top of arithmetic.
pub trait Real: Number + PartialOrd + Default + std::fmt::Debug {
    /// Half the distance from 1 to the next number: the unit roundoff.
    const ROUNDOFF: f64;

    /// Relative step at which Newton's iteration, which squares it, ends.
    const NEWTON_STEP: f64;

    /// Nearest double.
    fn to_f64(self) -> f64;

    /// The number itself if it is positive, otherwise zero.
    #[inline(always)]
    fn positive_part(self) -> Self {
        if self > Self::zero() { self } else { Self::zero() }
    }

    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);

    /// Exponential.
    fn exp(self) -> Self;

    /// Natural logarithm of 1 + x.
    fn ln_1p(self) -> Self;

    /// Arc sine.
    fn asin(self) -> Self;

    /// pi/2.
    fn right_angle() -> Self;

    /// Does some work with series as long as this precision needs. The next
    /// coefficient of the longer series is below the roundoff at steps of a
    /// tenth of 1/p.
    fn with_lengths<W: SeriesWork>(work: W) -> W::Output {
        work.run::<16, 28>()
    }
}

impl crate::number::sealed::Sealed for f64 {}

impl Number for f64 {
    const WRITTEN_OUT: bool = true;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        if cfg!(target_family = "wasm") {
            fused::mul_add(self, b, c)
        } else {
            f64::mul_add(self, b, c)
        }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
}

/// Sine and cosine on [-pi/4, pi/4] by minimax polynomials (coefficients of
/// FreeBSD's `k_sin` and `k_cos`), explicit fused operations, no branch:
/// below one unit in the last place.
#[inline(always)]
fn sin_cos_polynomials<N: Number>(x: N) -> (N, N) {
    const SINE: [f64; 6] = [
        -1.666_666_666_666_663_2e-1,
        8.333_333_333_322_49e-3,
        -1.984_126_982_985_795e-4,
        2.755_731_370_707_006_8e-6,
        -2.505_076_025_340_686_3e-8,
        1.589_690_995_211_55e-10,
    ];
    const COSINE: [f64; 6] = [
        4.166_666_666_666_66e-2,
        -1.388_888_888_887_411e-3,
        2.480_158_728_947_673e-5,
        -2.755_731_435_139_066_3e-7,
        2.087_572_321_298_175e-9,
        -1.135_964_755_778_819_5e-11,
    ];
    let z = x * x;
    let mut s = N::from_f64(SINE[5]);
    let mut c = N::from_f64(COSINE[5]);
    for k in (0..5).rev() {
        s = s.mul_add(z, N::from_f64(SINE[k]));
        c = c.mul_add(z, N::from_f64(COSINE[k]));
    }
    let sine = (s * z).mul_add(x, x);
    let half = z.mul_add(N::from_f64(-0.5), N::one());
    let cosine = (c * z).mul_add(z, half);
    (sine, cosine)
}

impl Real for f64 {
    const ROUNDOFF: f64 = 0.5 * f64::EPSILON;
    const NEWTON_STEP: f64 = 1e-8;

    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }

    fn sin_cos(self) -> (Self, Self) {
        (libm::sin(self), libm::cos(self))
    }

    fn exp(self) -> Self {
        libm::exp(self)
    }

    fn ln_1p(self) -> Self {
        libm::log1p(self)
    }

    fn asin(self) -> Self {
        libm::asin(self)
    }

    fn right_angle() -> Self {
        std::f64::consts::FRAC_PI_2
    }
}

#[cfg(test)]
mod tests {
    use super::Number;

    #[test]
    fn short_sine_and_cosine_are_good_to_an_ulp() {
        for k in 0..=10_000 {
            let x = f64::from(k) * 0.8e-4;
            let (s, c) = x.sin_cos_small();
            assert!((s - libm::sin(x)).abs() <= f64::EPSILON * x.max(1e-300));
            assert!((c - libm::cos(x)).abs() <= f64::EPSILON);
        }
    }
}
