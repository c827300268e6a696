//! Eight numbers at once. Each operation gives every lane the bits of a scalar
//! operation.

use std::ops::{Add, Div, Index, IndexMut, Mul, Neg, Sub};

use crate::number::Number;

/// Number of lanes.
pub const WIDTH: usize = 8;

/// Numbers in lanes. Every operation gives each lane the bits of a scalar
/// operation.
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

    /// The larger numbers.
    fn max(self, other: Self) -> Self;

    /// The smaller numbers.
    fn min(self, other: Self) -> Self;

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

    /// Lanes in which it is false.
    #[inline(always)]
    fn not(self) -> Self {
        Self::splat(true).but_not(self)
    }

    /// Lanes in which both are true.
    fn and(self, other: Self) -> Self;

    /// Lanes in which either is true.
    fn or(self, other: Self) -> Self;

    /// Lanes in which this is true and `other` is not.
    fn but_not(self, other: Self) -> Self;

    /// `yes` in true lanes, `no` in false ones.
    fn select(self, yes: N, no: N) -> N;

    /// Adds one to the counts of true lanes.
    fn count(self, counts: &mut [u64; WIDTH]);

    /// The same truth in every lane.
    #[inline(always)]
    fn splat(truth: bool) -> Self {
        Self::of(if truth { u8::MAX } else { 0 })
    }

    /// True if any lane is true.
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
}

/// Numbers in lanes as an array, for any instruction set.
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
        Self(from_fn(|k| *from[k]))
    }

    #[inline(always)]
    fn gather_pairs(from: [&[f64; 2]; WIDTH]) -> (Self, Self) {
        (Self(from_fn(|k| from[k][0])), Self(from_fn(|k| from[k][1])))
    }

    #[inline(always)]
    fn store(self, to: &mut Lanes) {
        *to = self;
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
    fn lt(self, other: Self) -> LaneMask {
        LaneMask(from_fn(|k| ones(self.0[k] < other.0[k])))
    }

    #[inline(always)]
    fn unlike(self, other: Self, third: Self) -> LaneMask {
        LaneMask(from_fn(|k| {
            let pair = self.0[k].to_bits() ^ other.0[k].to_bits();
            let signs = pair | third.0[k].to_bits();
            ones((signs as i64) < 0)
        }))
    }

    #[inline(always)]
    fn le(self, other: Self) -> LaneMask {
        LaneMask(from_fn(|k| ones(self.0[k] <= other.0[k])))
    }

    #[inline(always)]
    fn eq(self, other: Self) -> LaneMask {
        LaneMask(from_fn(|k| ones(self.0[k] == other.0[k])))
    }
}

/// The value of each lane. A loop, since the functions on arrays of the
/// standard library are compiled as calls.
#[inline(always)]
fn from_fn<T: Copy + Default>(of: impl Fn(usize) -> T) -> [T; WIDTH] {
    let mut all = [T::default(); WIDTH];
    for (lane, value) in all.iter_mut().enumerate() {
        *value = of(lane);
    }
    all
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
        Self(from_fn(|lane| ones(bits & 1 << lane != 0)))
    }

    #[inline(always)]
    fn bits(self) -> u8 {
        let bit = |(lane, x): (usize, &u64)| x & 1 << lane;
        let bits = self.0.iter().enumerate().map(bit);
        bits.fold(0, |all, bit| all | bit) as u8
    }

    #[inline(always)]
    fn any(self) -> bool {
        self.0.iter().fold(0, |any, x| any | x) != 0
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] & other.0[k]))
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] | other.0[k]))
    }

    #[inline(always)]
    fn but_not(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] & !other.0[k]))
    }

    #[inline(always)]
    fn select(self, yes: Lanes, no: Lanes) -> Lanes {
        Lanes(from_fn(|k| {
            let (yes, no) = (yes.0[k].to_bits(), no.0[k].to_bits());
            f64::from_bits((yes & self.0[k]) | (no & !self.0[k]))
        }))
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

operators! { Lanes:
    Add add |a, b| Self(from_fn(|k| a.0[k] + b.0[k]));
    Sub sub |a, b| Self(from_fn(|k| a.0[k] - b.0[k]));
    Mul mul |a, b| Self(from_fn(|k| a.0[k] * b.0[k]));
    Div div |a, b| Self(from_fn(|k| a.0[k] / b.0[k]));
}

impl Neg for Lanes {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(from_fn(|k| -self.0[k]))
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
        Self(from_fn(|k| Number::mul_add(self.0[k], b.0[k], c.0[k])))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(from_fn(|k| self.0[k].abs()))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }
}

#[cfg(test)]
mod tests;
