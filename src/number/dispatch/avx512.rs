//! Eight numbers in one register of AVX-512.
//!
//! Compilers also make such code of loops over arrays, but another version may
//! not.

use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::number::Number;
use crate::number::dispatch::WithSimd;
use crate::number::dispatch::avx2::RegisterPair;
use crate::number::lanes::{Lanes, Mask, Simd, WIDTH};

/// Does work on lanes.
#[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq")]
pub(super) fn run_wide<W: WithSimd>(work: W) -> W::Output {
    work.run::<Eight>()
}

/// Made only in [`run_wide`]; nothing outside `super` can name it.
#[derive(Clone, Copy)]
pub(super) struct Eight(__m512d);

/// A bit for each lane.
#[derive(Clone, Copy)]
pub(super) struct EightMask(__mmask8);

impl Eight {
    /// Both halves in one register.
    #[inline(always)]
    fn of(RegisterPair(low, high): RegisterPair) -> Self {
        let low = level!(_mm512_castpd256_pd512(low));
        Self(level!(_mm512_insertf64x4::<1>(low, high)))
    }
}

operators! { Eight:
    Add add |a, b| Self(level!(_mm512_add_pd(a.0, b.0)));
    Sub sub |a, b| Self(level!(_mm512_sub_pd(a.0, b.0)));
    Mul mul |a, b| Self(level!(_mm512_mul_pd(a.0, b.0)));
    Div div |a, b| Self(level!(_mm512_div_pd(a.0, b.0)));
}

impl Neg for Eight {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(level!(_mm512_xor_pd(self.0, _mm512_set1_pd(-0.0))))
    }
}

impl crate::number::sealed::Sealed for Eight {}

impl Number for Eight {
    const WRITTEN_OUT: bool = true;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self(level!(_mm512_set1_pd(x)))
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        Self(level!(_mm512_fmadd_pd(self.0, b.0, c.0)))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(level!(_mm512_abs_pd(self.0)))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(level!(_mm512_sqrt_pd(self.0)))
    }
}

impl Simd for Eight {
    type Mask = EightMask;

    #[inline(always)]
    fn load(from: &Lanes) -> Self {
        Self(level!(_mm512_loadu_pd(from.0.as_ptr())))
    }

    #[inline(always)]
    fn gather(from: [&f64; WIDTH]) -> Self {
        // Fewer steps than compilers make of single numbers.
        Self::of(RegisterPair::gather(from))
    }

    #[inline(always)]
    fn gather_pairs(from: [&[f64; 2]; WIDTH]) -> (Self, Self) {
        let [even, odd] = RegisterPair::even_and_odd(from);
        let (even, odd) = (Self::of(even), Self::of(odd));
        level!((
            Self(_mm512_unpacklo_pd(even.0, odd.0)),
            Self(_mm512_unpackhi_pd(even.0, odd.0)),
        ))
    }

    #[inline(always)]
    fn store(self, to: &mut Lanes) {
        level!(_mm512_storeu_pd(to.0.as_mut_ptr(), self.0));
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(level!(_mm512_max_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(level!(_mm512_min_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn lt(self, other: Self) -> EightMask {
        EightMask(level!(_mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0)))
    }

    #[inline(always)]
    fn unlike(self, other: Self, third: Self) -> EightMask {
        EightMask(level!({
            let pair = _mm512_xor_pd(self.0, other.0);
            let signs = _mm512_or_pd(pair, third.0);
            _mm512_movepi64_mask(_mm512_castpd_si512(signs))
        }))
    }

    #[inline(always)]
    fn le(self, other: Self) -> EightMask {
        EightMask(level!(_mm512_cmp_pd_mask::<_CMP_LE_OQ>(self.0, other.0)))
    }

    #[inline(always)]
    fn eq(self, other: Self) -> EightMask {
        EightMask(level!(_mm512_cmp_pd_mask::<_CMP_EQ_OQ>(self.0, other.0)))
    }
}

impl Mask<Eight> for EightMask {
    #[inline(always)]
    fn of(bits: u8) -> Self {
        Self(bits)
    }

    #[inline(always)]
    fn bits(self) -> u8 {
        self.0
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    #[inline(always)]
    fn but_not(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    #[inline(always)]
    fn select(self, yes: Eight, no: Eight) -> Eight {
        Eight(level!(_mm512_mask_blend_pd(self.0, no.0, yes.0)))
    }

    #[inline(always)]
    fn count(self, counts: &mut [u64; WIDTH]) {
        level!({
            let place = counts.as_mut_ptr().cast();
            let before = _mm512_loadu_epi64(place);
            let one = _mm512_set1_epi64(1);
            let after = _mm512_mask_add_epi64(before, self.0, before, one);
            _mm512_storeu_epi64(place, after);
        });
    }
}
