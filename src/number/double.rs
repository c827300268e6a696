//! Double-double arithmetic: an unevaluated sum of two doubles, about 31
//! digits.
//!
//! Error-free transformations with fused operations; sums, products and
//! quotients as in Joldes, Muller and Popescu, "Tight and rigorous error
//! bounds for basic building blocks of double-word arithmetic" (ACM TOMS 44,
//! 2017): a few times 2^-106 each. Constants are given to three doubles,
//! coefficients are quotients of integers: nothing here is rounded to one
//! double. The range is that of a double; below 1e-290 the second part
//! underflows and precision falls to a double's.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Number, Real, series};

/// A number hi + lo with |lo| at most half a unit in the last place of hi.
///
/// ```
/// use rocking::number::{Number, double::DoubleDouble};
/// let third = DoubleDouble::ratio(1, 3);
/// assert_eq!(third.hi(), 1.0 / 3.0);
/// assert_eq!(third.lo(), 1.850371707708594e-17);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    // The order of the fields is the order of comparison.
    hi: f64,
    lo: f64,
}

/// pi/2 = 1.57079632679489661923132169163975144209858469968755...
const RIGHT_ANGLE: [f64; 3] = [
    std::f64::consts::FRAC_PI_2,
    6.123_233_995_736_766e-17,
    -1.497_384_904_859_169_8e-33,
];

/// ln 2 = 0.69314718055994530941723212145817656807550013436025...
const LN_2: [f64; 3] = [
    std::f64::consts::LN_2,
    2.319_046_813_846_299_6e-17,
    5.707_708_438_416_212e-34,
];

/// Terms of the series on [-pi/4, pi/4] and [-ln 2/2, ln 2/2]: the next is
/// below 1e-34 of the sum.
const TERMS: i32 = 30;

/// [`DoubleDouble::sum`] if |a| is at least |b| or a is zero.
#[inline]
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    if !hi.is_finite() {
        return DoubleDouble { hi, lo: 0.0 };
    }
    DoubleDouble { hi, lo: b - (hi - a) }
}

/// The product of two doubles and its rounding error.
#[inline]
fn two_product(a: f64, b: f64) -> DoubleDouble {
    let hi = a * b;
    if !hi.is_finite() {
        return DoubleDouble { hi, lo: 0.0 };
    }
    DoubleDouble { hi, lo: Number::mul_add(a, b, -hi) }
}

impl DoubleDouble {
    /// The double nearest to the number.
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// The number less the nearest double.
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// The sum of two doubles, exactly.
    ///
    /// ```
    /// use rocking::number::double::DoubleDouble;
    /// let sum = DoubleDouble::sum(1.0, 1e-20);
    /// assert_eq!((sum.hi(), sum.lo()), (1.0, 1e-20));
    /// ```
    #[inline]
    pub fn sum(a: f64, b: f64) -> Self {
        let hi = a + b;
        if !hi.is_finite() {
            return Self { hi, lo: 0.0 };
        }
        let part = hi - a;
        Self { hi, lo: (a - (hi - part)) + (b - part) }
    }

    /// Product with a power of two, exactly.
    fn scaled(self, exponent: i32) -> Self {
        let times = |x| libm::scalbn(x, exponent);
        Self { hi: times(self.hi), lo: times(self.lo) }
    }

    /// Remainder after subtracting `count` times a constant of three parts.
    fn less(self, count: f64, parts: [f64; 3]) -> Self {
        parts.iter().fold(self, |rest, x| rest - two_product(count, *x))
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let s = Self::sum(self.hi, other.hi);
        let t = Self::sum(self.lo, other.lo);
        let v = quick_two_sum(s.hi, s.lo + t.hi);
        quick_two_sum(v.hi, t.lo + v.lo)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let p = two_product(self.hi, other.hi);
        if !p.hi.is_finite() {
            return p;
        }
        let low = self.lo * other.lo;
        let cross = Number::mul_add(self.hi, other.lo, low);
        let cross = Number::mul_add(self.lo, other.hi, cross);
        quick_two_sum(p.hi, p.lo + cross)
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        if !first.is_finite() || other.hi.is_infinite() {
            return Self { hi: first, lo: 0.0 };
        }
        // Long division: three quotients.
        let rest = self - other * Self::from_f64(first);
        let second = rest.hi / other.hi;
        let rest = rest - other * Self::from_f64(second);
        let third = rest.hi / other.hi;
        quick_two_sum(first, second) + Self::from_f64(third)
    }
}

impl crate::number::sealed::Sealed for DoubleDouble {}

impl Number for DoubleDouble {
    const IS_GRADED: bool = true;

    #[inline]
    fn from_f64(x: f64) -> Self {
        Self { hi: x, lo: 0.0 }
    }

    /// The remainder of the quotient of two doubles is a double.
    #[inline]
    fn ratio(i: i32, j: i32) -> Self {
        let (i, j) = (f64::from(i), f64::from(j));
        let hi = i / j;
        Self { hi, lo: Number::mul_add(-hi, j, i) / j }
    }

    /// One step of a dot product as Dot2 of Ogita, Rump and Oishi, "Accurate
    /// sum and dot product" (SIAM J. Sci. Comput. 26, 2005): its error is a
    /// few times 2^-106 of the sum of the sizes of the products.
    #[inline(always)]
    fn add_product(self, b: Self, sum: Self) -> Self {
        let product = self.hi * b.hi;
        let rest = Number::mul_add(self.hi, b.hi, -product);
        let rest = Number::mul_add(self.lo, b.hi, rest);
        let rest = Number::mul_add(self.hi, b.lo, rest);
        let hi = sum.hi + product;
        let part = hi - sum.hi;
        let lost = (sum.hi - (hi - part)) + (product - part);
        Self { hi, lo: sum.lo + (lost + rest) }
    }

    #[inline(always)]
    fn rough_product(self, b: Self, sum: Self) -> Self {
        Self::from_f64(Number::mul_add(self.hi, b.hi, sum.hi))
    }

    #[inline(always)]
    fn ordered(self) -> Self {
        quick_two_sum(self.hi, self.lo)
    }

    /// Sums of powers of y = -x^2. Below 0.3, terms from y^6/13! and y^7/14!
    /// on need only the digits of a double.
    #[inline(always)]
    fn sin_cos_small(self) -> (Self, Self) {
        if !(self.hi.abs() < 0.3) {
            return series::sin_cos(self, TERMS);
        }
        let y = -(self * self);
        let (y2, y3) = (y * y, y * y * y);
        let (y4, y6) = (y2 * y2, y3 * y3);
        let powers = [y, y2, y3, y4, y2 * y3, y6];
        // 1 + y/((n + 1)(n + 2)) (1 + y/((n + 3)(n + 4)) (...)).
        let tail = |n: f64| {
            [7.0, 5.0, 3.0, 1.0].into_iter().fold(1.0, |sum, k| {
                Number::mul_add(
                    y.hi * sum,
                    1.0 / ((n + k) * (n + k + 1.0)),
                    1.0,
                )
            })
        };
        let sum = |divisors: &[i32], rest: f64| {
            let terms = divisors.iter().zip(powers).rev();
            terms.fold(Self::from_f64(rest), |sum, (divisor, power)| {
                power.add_product(Self::ratio(1, *divisor), sum)
            })
        };
        let rest = y6.hi / 6_227_020_800.0 * tail(13.0);
        let sine = sum(&[6, 120, 5040, 362_880, 39_916_800], rest);
        let rest = y6.hi * y.hi / 87_178_291_200.0 * tail(14.0);
        let divisors = [2, 24, 720, 40_320, 3_628_800, 479_001_600];
        let fall = sum(&divisors, rest);
        (self.mul_add(sine.ordered(), self), Self::one() + fall.ordered())
    }

    fn sqrt(self) -> Self {
        let root = self.hi.sqrt();
        if !(root > 0.0 && root.is_finite()) {
            return Self { hi: root, lo: 0.0 };
        }
        // Two corrections (a - x^2)/(2 x), the first by an exact square.
        let rest = self - two_product(root, root);
        let near = quick_two_sum(root, 0.5 * rest.hi / root);
        let rest = self - near * near;
        near + Self::from_f64(0.5 * rest.hi / root)
    }

    #[inline]
    fn abs(self) -> Self {
        if self.hi < 0.0 { -self } else { self }
    }
}

impl Real for DoubleDouble {
    const ROUNDOFF: f64 = 0.5 * f64::EPSILON * f64::EPSILON;
    // Its square is far below the roundoff, so that a root close to another
    // one, at which Newton's iteration squares with a large factor, converges.
    const NEWTON_STEP: f64 = 1e-20;

    #[inline]
    fn to_f64(self) -> f64 {
        self.hi
    }

    fn sin_cos(self) -> (Self, Self) {
        if !self.hi.is_finite() {
            return (Self::from_f64(f64::NAN), Self::from_f64(f64::NAN));
        }
        let turns = (self.hi / RIGHT_ANGLE[0]).round();
        // The angles of the model are a few turns at most.
        let rest = self.less(turns, RIGHT_ANGLE);
        series::turned(rest.sin_cos_small(), turns)
    }

    fn exp(self) -> Self {
        if !(self.hi.abs() < 800.0) {
            return Self::from_f64(libm::exp(self.hi));
        }
        let count = (self.hi / LN_2[0]).round();
        let rest = self.less(count, LN_2);
        (Self::one() + series::exp_m1(rest, TERMS)).scaled(count as i32)
    }

    /// Newton's iteration on exp(y) - 1 = x from a double, to second order.
    fn ln_1p(self) -> Self {
        let y = libm::log1p(self.hi);
        if !y.is_finite() || y == 0.0 {
            return Self::from_f64(y);
        }
        let start = Self::from_f64(y);
        let value = if y.abs() < 0.35 {
            series::exp_m1(start, TERMS)
        } else {
            start.exp() - Self::one()
        };
        let step = (self - value) / (Self::one() + value);
        start + step - step * step * Self::from_f64(0.5)
    }

    fn asin(self) -> Self {
        series::asin(self, 1)
    }

    fn right_angle() -> Self {
        Self { hi: RIGHT_ANGLE[0], lo: RIGHT_ANGLE[1] }
    }
}

#[cfg(test)]
mod tests;
