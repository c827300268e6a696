//! Octuple precision: a binary floating-point number with a significand of
//! 256 bits, about 77 digits.
//!
//! Sums, products, quotients and ratios are rounded to the nearest number,
//! ties to even; the elementary functions are good to a few units in the last
//! place. Numbers reach from 2^-(2^30) to 2^(2^30) without subnormal ones; a
//! result outside that range becomes zero or infinite. Infinities and NaN
//! behave as those of a double; there is one zero.

mod division;
mod functions;

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Number, series};

/// Limbs of a significand, the least first.
const LIMBS: usize = 4;

/// Bits of a limb.
const LIMB: u32 = u64::BITS;

/// Exponent of zero, below all others.
const OF_ZERO: i32 = -SPECIAL;

/// Exponent of infinities and NaN, above all others.
const SPECIAL: i32 = 1 << 30;

/// Bit of a limb that says that something lies below it.
const STICKY: u64 = 1;

/// A number with a significand of 256 bits.
///
/// ```
/// use rocking::number::{Number, Real, octuple::Octuple};
/// let third = Octuple::ratio(1, 3);
/// assert_eq!(third.to_f64(), 1.0 / 3.0);
/// // Rounded down: 3 (1/3) = 1 - 2^-256, halfway, goes to the even number.
/// assert_eq!(third * Octuple::from_f64(3.0), Octuple::one());
/// let rest = third - Octuple::from_f64(1.0 / 3.0);
/// assert_eq!(rest.to_f64(), 1.850371707708594e-17);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Octuple {
    negative: bool,
    /// Of the leading bit: the number is 1.xxx times 2 to this power.
    exponent: i32,
    /// The leading bit is set, except in zero and infinities, which have no
    /// bit, and in NaN, which has another one.
    limbs: [u64; LIMBS],
}

/// A significand with a guard limb as the least. The last bit of the guard
/// says whether anything lies below.
type Guarded = [u64; LIMBS + 1];

impl Octuple {
    const ZERO: Self =
        Self { negative: false, exponent: OF_ZERO, limbs: [0; LIMBS] };

    const NAN: Self =
        Self { negative: false, exponent: SPECIAL, limbs: [1; LIMBS] };

    fn infinite(negative: bool) -> Self {
        Self { negative, exponent: SPECIAL, limbs: [0; LIMBS] }
    }

    fn is_zero(self) -> bool {
        self.exponent == OF_ZERO
    }

    fn is_nan(self) -> bool {
        self.exponent == SPECIAL && self.limbs[0] != 0
    }

    fn is_infinite(self) -> bool {
        self.exponent == SPECIAL && self.limbs[0] == 0
    }

    fn is_finite(self) -> bool {
        self.exponent != SPECIAL
    }

    /// The number nearest to a significand with leading bits that may be
    /// zero, and the exponent of its first bit.
    fn nearest(negative: bool, exponent: i64, mut bits: Guarded) -> Self {
        let mut exponent = exponent;
        if bits[LIMBS] == 0 {
            let Some(top) = bits.iter().rposition(|limb| *limb != 0) else {
                return Self::ZERO;
            };
            bits.rotate_right(LIMBS - top);
            exponent -= (LIMBS - top) as i64 * i64::from(LIMB);
        }
        let zeros = bits[LIMBS].leading_zeros();
        if zeros > 0 {
            for k in (1..=LIMBS).rev() {
                bits[k] = bits[k] << zeros | bits[k - 1] >> (LIMB - zeros);
            }
            // If the last bit is set, there are at most two zeros: it stays
            // below the half.
            bits[0] <<= zeros;
            exponent -= i64::from(zeros);
        }
        let [guard, mut limbs @ ..] = bits;
        let half = 1 << (LIMB - 1);
        if guard > half || (guard == half && limbs[0] & 1 == 1) {
            let mut carry = true;
            for limb in &mut limbs {
                (*limb, carry) = limb.overflowing_add(u64::from(carry));
            }
            if carry {
                limbs[LIMBS - 1] = half;
                exponent += 1;
            }
        }
        Self::ranged(negative, exponent, limbs)
    }

    /// The number, or zero or an infinity if its exponent is out of range.
    fn ranged(negative: bool, exponent: i64, limbs: [u64; LIMBS]) -> Self {
        match i32::try_from(exponent) {
            Ok(exponent) if exponent > OF_ZERO && exponent < SPECIAL => {
                Self { negative, exponent, limbs }
            }
            _ if exponent < 0 => Self::ZERO,
            _ => Self::infinite(negative),
        }
    }

    /// Product with a power of two, exactly.
    fn scaled(self, by: i32) -> Self {
        if self.is_zero() || !self.is_finite() {
            return self;
        }
        let exponent = i64::from(self.exponent) + i64::from(by);
        Self::ranged(self.negative, exponent, self.limbs)
    }

    /// Order of the absolute values.
    fn order(self, other: Self) -> Ordering {
        let limbs = || self.limbs.iter().rev().cmp(other.limbs.iter().rev());
        self.exponent.cmp(&other.exponent).then_with(limbs)
    }

    /// Significand with a guard limb, moved down by some bits.
    fn moved_down(self, by: u32) -> Guarded {
        let [a, b, c, d] = self.limbs;
        let mut bits = [0, a, b, c, d];
        let (limbs, by) = ((by / LIMB) as usize, by % LIMB);
        let mut lost = 0;
        if limbs > 0 {
            lost = bits[..limbs].iter().fold(0, |any, limb| any | limb);
            bits.copy_within(limbs.., 0);
            bits[LIMBS + 1 - limbs..].fill(0);
        }
        if by > 0 {
            lost |= bits[0] << (LIMB - by);
            for k in 0..LIMBS {
                bits[k] = bits[k] >> by | bits[k + 1] << (LIMB - by);
            }
            bits[LIMBS] >>= by;
        }
        bits[0] |= u64::from(lost != 0);
        bits
    }

    /// Sum of finite numbers that are not zero, |self| at least |other|.
    fn plus(self, other: Self) -> Self {
        let apart = i64::from(self.exponent) - i64::from(other.exponent);
        // Beyond a guard limb only the last bit of all is left.
        let apart = apart.min(i64::from(LIMB) * LIMBS as i64 + 2) as u32;
        let (mut bits, less) = (self.moved_down(0), other.moved_down(apart));
        let mut carry = false;
        if self.negative == other.negative {
            for (a, b) in bits.iter_mut().zip(less) {
                (*a, carry) = a.carrying_add(b, carry);
            }
        } else {
            for (a, b) in bits.iter_mut().zip(less) {
                (*a, carry) = a.borrowing_sub(b, carry);
            }
        }
        let mut exponent = i64::from(self.exponent);
        if carry {
            let last = bits[0] & STICKY;
            for k in 0..LIMBS {
                bits[k] = bits[k] >> 1 | bits[k + 1] << (LIMB - 1);
            }
            bits[LIMBS] = bits[LIMBS] >> 1 | 1 << (LIMB - 1);
            bits[0] |= last;
            exponent += 1;
        }
        Self::nearest(self.negative, exponent, bits)
    }

    /// Product of finite numbers that are not zero.
    fn times(self, other: Self) -> Self {
        let mut product = [0; 2 * LIMBS];
        for (i, a) in self.limbs.iter().enumerate() {
            let mut carry = 0;
            for (j, b) in other.limbs.iter().enumerate() {
                let place = &mut product[i + j];
                (*place, carry) = a.carrying_mul_add(*b, *place, carry);
            }
            product[i + LIMBS] = carry;
        }
        let [x, y, z, mut bits @ ..] = product;
        bits[0] |= u64::from((x | y | z) != 0);
        let exponent = i64::from(self.exponent) + i64::from(other.exponent);
        Self::nearest(self.negative != other.negative, exponent + 1, bits)
    }
}

impl Default for Octuple {
    fn default() -> Self {
        Self::ZERO
    }
}

impl PartialEq for Octuple {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Octuple {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        if self.is_nan() || other.is_nan() {
            return None;
        }
        Some(match (self.negative, other.negative) {
            (false, false) => self.order(*other),
            (true, true) => other.order(*self),
            (false, true) => Ordering::Greater,
            (true, false) => Ordering::Less,
        })
    }
}

impl Neg for Octuple {
    type Output = Self;

    fn neg(self) -> Self {
        let negative = !self.negative && !self.is_zero();
        Self { negative, ..self }
    }
}

// Sums and products are calls: in place they would make the code of a step
// many times as long.
impl Add for Octuple {
    type Output = Self;

    #[inline(never)]
    fn add(self, other: Self) -> Self {
        if self.is_finite() && other.is_finite() {
            return match self.order(other) {
                _ if other.is_zero() => self,
                _ if self.is_zero() => other,
                Ordering::Less => other.plus(self),
                Ordering::Equal | Ordering::Greater => self.plus(other),
            };
        }
        let opposite =
            self.exponent == other.exponent && self.negative != other.negative;
        if self.is_nan() || other.is_nan() || opposite {
            return Self::NAN;
        }
        if self.is_infinite() { self } else { other }
    }
}

impl Sub for Octuple {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Octuple {
    type Output = Self;

    #[inline(never)]
    fn mul(self, other: Self) -> Self {
        let zero = self.is_zero() || other.is_zero();
        if self.is_finite() && other.is_finite() {
            return if zero { Self::ZERO } else { self.times(other) };
        }
        if self.is_nan() || other.is_nan() || zero {
            return Self::NAN;
        }
        Self::infinite(self.negative != other.negative)
    }
}

impl Div for Octuple {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let both_zero = self.is_zero() && other.is_zero();
        let both_infinite = self.is_infinite() && other.is_infinite();
        if self.is_nan() || other.is_nan() || both_zero || both_infinite {
            return Self::NAN;
        }
        if self.is_zero() || other.is_infinite() {
            return Self::ZERO;
        }
        if other.is_zero() || self.is_infinite() {
            return Self::infinite(self.negative != other.negative);
        }
        self.over(other)
    }
}

impl crate::number::sealed::Sealed for Octuple {}

impl Number for Octuple {
    fn from_f64(x: f64) -> Self {
        let negative = x.is_sign_negative();
        if x == 0.0 {
            return Self::ZERO;
        }
        if x.is_nan() {
            return Self::NAN;
        }
        if x.is_infinite() {
            return Self::infinite(negative);
        }
        let exponent = libm::ilogb(x);
        let leading = libm::scalbn(x.abs(), 63 - exponent);
        let limbs = [0, 0, 0, leading as u64];
        Self { negative, exponent, limbs }
    }

    fn ratio(i: i32, j: i32) -> Self {
        Self::from_f64(f64::from(i)) / Self::from_f64(f64::from(j))
    }

    fn sqrt(self) -> Self {
        self.root()
    }

    fn abs(self) -> Self {
        Self { negative: false, ..self }
    }

    fn sin_cos_small(self) -> (Self, Self) {
        series::sin_cos(self, functions::TERMS)
    }
}

#[cfg(test)]
mod tests;
