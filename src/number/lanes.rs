//! Several numbers at once, operation by operation as one.

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
