//! Simd numbers at once, operation by operation as one.
#![expect(
    clippy::needless_range_loop,
    reason = "comparisons by index become one instruction, by iterator not"
)]

use std::ops::{Add, Div, Index, IndexMut, Mul, Neg, Sub};

use crate::number::Number;

/// Numbers in as many lanes.
pub const WIDTH: usize = 8;

/// Numbers in lanes, on which every operation acts one by one: each has the
/// bits that it would have alone.
pub trait Simd: Number {
    /// A truth in every lane.
    type Mask: Mask<Self>;

    /// From memory.
    fn load(from: &Lanes) -> Self;

    /// From places in memory.
    fn gather(from: [&f64; WIDTH]) -> Self;

    /// The first and the second numbers of pairs in memory.
    fn gather_pairs(from: [&[f64; 2]; WIDTH]) -> (Self, Self);

    /// To memory.
    fn store(self, to: &mut Lanes);

    /// Absolute values.
    fn abs(self) -> Self;

    /// The larger numbers.
    fn max(self, other: Self) -> Self;

    /// The smaller numbers.
    fn min(self, other: Self) -> Self;

    /// Square roots.
    fn sqrt(self) -> Self;

    /// Lanes in which this is less than `other`.
    fn lt(self, other: Self) -> Self::Mask;

    /// Lanes in which this and `other` have different signs, or `third` has a
    /// negative one.
    fn unlike(self, other: Self, third: Self) -> Self::Mask;

    /// Lanes in which this is at most `other`.
    fn le(self, other: Self) -> Self::Mask;

    /// Lanes in which this equals `other`.
    fn eq(self, other: Self) -> Self::Mask;
}

/// A truth in every lane.
pub trait Mask<N>: Copy {
    /// True in the lanes whose bits are set.
    fn of(bits: u8) -> Self;

    /// A bit for each lane.
    fn bits(self) -> u8;

    /// Where it is false.
    fn not(self) -> Self;

    /// Where both are true.
    fn and(self, other: Self) -> Self;

    /// Where either is true.
    fn or(self, other: Self) -> Self;

    /// Where this is true and `other` is not.
    fn but_not(self, other: Self) -> Self;

    /// `yes` where it is true, `no` where it is not.
    fn select(self, yes: N, no: N) -> N;

    /// Counts the lanes in which it is true.
    fn count(self, counts: &mut [u64; WIDTH]);

    /// The same truth in every lane.
    #[inline(always)]
    fn splat(truth: bool) -> Self {
        Self::of(if truth { u8::MAX } else { 0 })
    }

    /// True if any lane's is.
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
}

/// Numbers in lanes where no instruction set is known to have them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(64))]
pub struct Lanes(pub [f64; WIDTH]);

impl Lanes {
    /// The same number in every lane.
    #[inline(always)]
    pub const fn splat(x: f64) -> Self {
        Self([x; WIDTH])
    }
}

impl Simd for Lanes {
    type Mask = LaneMask;

    #[inline(always)]
    fn load(from: &Lanes) -> Self {
        *from
    }

    #[inline(always)]
    fn gather(from: [&f64; WIDTH]) -> Self {
        Self(from.map(|x| *x))
    }

    #[inline(always)]
    fn gather_pairs(from: [&[f64; 2]; WIDTH]) -> (Self, Self) {
        (Self(from.map(|pair| pair[0])), Self(from.map(|pair| pair[1])))
    }

    #[inline(always)]
    fn store(self, to: &mut Lanes) {
        *to = self;
    }

    #[inline(always)]
    fn abs(self) -> Self {
        let mut out = self.0;
        for x in &mut out {
            *x = x.abs();
        }
        Self(out)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        other.lt(self).select(self, other)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.lt(other).select(self, other)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let mut out = self.0;
        for x in &mut out {
            *x = x.sqrt();
        }
        Self(out)
    }

    #[inline(always)]
    fn lt(self, other: Self) -> LaneMask {
        let mut out = [0; WIDTH];
        for lane in 0..WIDTH {
            out[lane] = ones(self.0[lane] < other.0[lane]);
        }
        LaneMask(out)
    }

    #[inline(always)]
    fn unlike(self, other: Self, third: Self) -> LaneMask {
        let mut out = [0; WIDTH];
        for lane in 0..WIDTH {
            let pair = self.0[lane].to_bits() ^ other.0[lane].to_bits();
            let signs = pair | third.0[lane].to_bits();
            out[lane] = ones((signs as i64) < 0);
        }
        LaneMask(out)
    }

    #[inline(always)]
    fn le(self, other: Self) -> LaneMask {
        let mut out = [0; WIDTH];
        for lane in 0..WIDTH {
            out[lane] = ones(self.0[lane] <= other.0[lane]);
        }
        LaneMask(out)
    }

    #[inline(always)]
    fn eq(self, other: Self) -> LaneMask {
        let mut out = [0; WIDTH];
        for lane in 0..WIDTH {
            out[lane] = ones(self.0[lane] == other.0[lane]);
        }
        LaneMask(out)
    }
}

#[inline(always)]
fn ones(truth: bool) -> u64 {
    if truth { u64::MAX } else { 0 }
}

/// A truth in every lane, as all its bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(align(64))]
pub struct LaneMask([u64; WIDTH]);

impl Mask<Lanes> for LaneMask {
    #[inline(always)]
    fn of(bits: u8) -> Self {
        let mut out = [0; WIDTH];
        for lane in 0..WIDTH {
            out[lane] = ones(bits & 1 << lane != 0);
        }
        Self(out)
    }

    #[inline(always)]
    fn bits(self) -> u8 {
        let mut bits = 0;
        for lane in 0..WIDTH {
            bits |= self.0[lane] & 1 << lane;
        }
        bits as u8
    }

    #[inline(always)]
    fn any(self) -> bool {
        let mut any = 0;
        for x in self.0 {
            any |= x;
        }
        any != 0
    }

    #[inline(always)]
    fn not(self) -> Self {
        let mut out = self.0;
        for x in &mut out {
            *x = !*x;
        }
        Self(out)
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        let mut out = self.0;
        for (x, y) in out.iter_mut().zip(other.0) {
            *x &= y;
        }
        Self(out)
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        let mut out = self.0;
        for (x, y) in out.iter_mut().zip(other.0) {
            *x |= y;
        }
        Self(out)
    }

    #[inline(always)]
    fn but_not(self, other: Self) -> Self {
        let mut out = self.0;
        for (x, y) in out.iter_mut().zip(other.0) {
            *x &= !y;
        }
        Self(out)
    }

    #[inline(always)]
    fn select(self, yes: Lanes, no: Lanes) -> Lanes {
        let mut out = no.0;
        for lane in 0..WIDTH {
            let mask = self.0[lane];
            let bits = (yes.0[lane].to_bits() & mask)
                | (no.0[lane].to_bits() & !mask);
            out[lane] = f64::from_bits(bits);
        }
        Lanes(out)
    }

    #[inline(always)]
    fn count(self, counts: &mut [u64; WIDTH]) {
        for (count, x) in counts.iter_mut().zip(self.0) {
            *count += x & 1;
        }
    }
}

impl Index<usize> for Lanes {
    type Output = f64;

    #[inline(always)]
    fn index(&self, lane: usize) -> &f64 {
        &self.0[lane]
    }
}

impl IndexMut<usize> for Lanes {
    #[inline(always)]
    fn index_mut(&mut self, lane: usize) -> &mut f64 {
        &mut self.0[lane]
    }
}

macro_rules! lane_by_lane {
    ($($operation:ident $method:ident $symbol:tt;)*) => {$(
        impl $operation for Lanes {
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

impl Neg for Lanes {
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

impl crate::number::sealed::Sealed for Lanes {}

impl Number for Lanes {
    const WRITTEN_OUT: bool = true;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self::splat(x)
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        let mut out = self.0;
        for ((x, y), z) in out.iter_mut().zip(b.0).zip(c.0) {
            *x = Number::mul_add(*x, y, z);
        }
        Self(out)
    }
}

#[cfg(test)]
mod tests;
