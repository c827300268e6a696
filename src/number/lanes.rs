//! Several numbers at once, operation by operation as one.
#![expect(
    clippy::needless_range_loop,
    reason = "comparisons by index become one instruction, by iterator not"
)]

use std::ops::{Add, Div, Index, IndexMut, Mul, Neg, Sub};

use crate::number::{Number, sin_cos_polynomials};

/// `W` doubles on which every operation acts one by one: each has the bits
/// that it would have alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(crate) struct Lanes<const W: usize>(pub [f64; W]);

impl<const W: usize> Lanes<W> {
    /// The same number in every lane.
    #[inline(always)]
    pub fn splat(x: f64) -> Self {
        Self([x; W])
    }

    /// Absolute values.
    #[inline(always)]
    pub fn abs(self) -> Self {
        let mut out = self.0;
        for x in &mut out {
            *x = x.abs();
        }
        Self(out)
    }

    /// The larger numbers.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        other.below(self).select(self, other)
    }

    /// The smaller numbers.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        self.below(other).select(self, other)
    }

    /// Square roots.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        let mut out = self.0;
        for x in &mut out {
            *x = x.sqrt();
        }
        Self(out)
    }

    /// Lanes in which this is less than `other`.
    #[inline(always)]
    pub fn below(self, other: Self) -> Mask<W> {
        let mut out = [0; W];
        for lane in 0..W {
            out[lane] = ones(self.0[lane] < other.0[lane]);
        }
        Mask(out)
    }

    /// Lanes in which this is at most `other`.
    #[inline(always)]
    pub fn at_most(self, other: Self) -> Mask<W> {
        let mut out = [0; W];
        for lane in 0..W {
            out[lane] = ones(self.0[lane] <= other.0[lane]);
        }
        Mask(out)
    }

    /// Lanes in which this equals `other`.
    #[inline(always)]
    pub fn equals(self, other: Self) -> Mask<W> {
        let mut out = [0; W];
        for lane in 0..W {
            out[lane] = ones(self.0[lane] == other.0[lane]);
        }
        Mask(out)
    }
}

#[inline(always)]
fn ones(truth: bool) -> u64 {
    if truth { u64::MAX } else { 0 }
}

/// A truth in every lane, as all its bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(align(64))]
pub(crate) struct Mask<const W: usize>([u64; W]);

impl<const W: usize> Mask<W> {
    /// The same truth in every lane.
    #[inline(always)]
    pub fn splat(truth: bool) -> Self {
        Self([ones(truth); W])
    }

    /// Sets the truth of a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, truth: bool) {
        self.0[lane] = ones(truth);
    }

    /// The truth of a lane.
    #[inline(always)]
    pub fn at(self, lane: usize) -> bool {
        self.0[lane] != 0
    }

    /// True if any lane's is.
    #[inline(always)]
    pub fn any(self) -> bool {
        let mut any = 0;
        for x in self.0 {
            any |= x;
        }
        any != 0
    }

    /// Bit k set where lane k is true, and bit W + k where that of `other`
    /// is, too.
    #[inline(always)]
    pub fn bits_with(self, other: Self) -> u64 {
        let mut bits = 0;
        for (lane, (x, y)) in self.0.iter().zip(other.0).enumerate() {
            bits |= x & (1 << lane | y & 1 << (W + lane));
        }
        bits
    }

    /// Where it is false.
    #[inline(always)]
    pub fn not(self) -> Self {
        let mut out = self.0;
        for x in &mut out {
            *x = !*x;
        }
        Self(out)
    }

    /// Where both are true.
    #[inline(always)]
    pub fn and(self, other: Self) -> Self {
        let mut out = self.0;
        for (x, y) in out.iter_mut().zip(other.0) {
            *x &= y;
        }
        Self(out)
    }

    /// Where either is true.
    #[inline(always)]
    pub fn or(self, other: Self) -> Self {
        let mut out = self.0;
        for (x, y) in out.iter_mut().zip(other.0) {
            *x |= y;
        }
        Self(out)
    }

    /// Where this is true and `other` is not.
    #[inline(always)]
    pub fn but_not(self, other: Self) -> Self {
        let mut out = self.0;
        for (x, y) in out.iter_mut().zip(other.0) {
            *x &= !y;
        }
        Self(out)
    }

    /// One where it is true, zero where it is not.
    #[inline(always)]
    pub fn count(self) -> [u64; W] {
        let mut out = self.0;
        for x in &mut out {
            *x &= 1;
        }
        out
    }

    /// `yes` where it is true, `no` where it is not.
    #[inline(always)]
    pub fn select(self, yes: Lanes<W>, no: Lanes<W>) -> Lanes<W> {
        let mut out = no.0;
        for lane in 0..W {
            let mask = self.0[lane];
            let bits = (yes.0[lane].to_bits() & mask)
                | (no.0[lane].to_bits() & !mask);
            out[lane] = f64::from_bits(bits);
        }
        Lanes(out)
    }
}

impl<const W: usize> Index<usize> for Lanes<W> {
    type Output = f64;

    #[inline(always)]
    fn index(&self, lane: usize) -> &f64 {
        &self.0[lane]
    }
}

impl<const W: usize> IndexMut<usize> for Lanes<W> {
    #[inline(always)]
    fn index_mut(&mut self, lane: usize) -> &mut f64 {
        &mut self.0[lane]
    }
}

macro_rules! lane_by_lane {
    ($($operation:ident $method:ident $symbol:tt;)*) => {$(
        impl<const W: usize> $operation for Lanes<W> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let mut out = self.0;
                for (x, y) in out.iter_mut().zip(other.0) {
                    *x $symbol y;
                }
                Self(out)
            }
        }
    )*};
}

lane_by_lane! {
    Add add +=;
    Sub sub -=;
    Mul mul *=;
    Div div /=;
}

impl<const W: usize> Neg for Lanes<W> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        let mut out = self.0;
        for x in &mut out {
            *x = -*x;
        }
        Self(out)
    }
}

impl<const W: usize> Number for Lanes<W> {
    const LANES: bool = true;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self::splat(x)
    }

    #[inline(always)]
    fn ratio(i: i32, j: i32) -> Self {
        Self::splat(f64::ratio(i, j))
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        let mut out = self.0;
        for ((x, y), z) in out.iter_mut().zip(b.0).zip(c.0) {
            *x = x.mul_add(y, z);
        }
        Self(out)
    }

    #[inline(always)]
    fn sin_cos_small(self) -> (Self, Self) {
        sin_cos_polynomials(self)
    }
}
