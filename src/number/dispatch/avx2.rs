//! Eight numbers in two registers of AVX2.
//!
//! The compiler would split plain arrays into single numbers. A sweep would
//! then cost twice as much and take a hundred times as long to compile.

use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::number::Number;
use crate::number::dispatch::{Kernel, WithSimd};
use crate::number::lanes::{Lanes, Mask, Simd, WIDTH};

/// `a * b + c` with one rounding.
#[cfg(windows)]
#[target_feature(enable = "avx2,fma")]
pub(super) fn mul_add(a: f64, b: f64, c: f64) -> f64 {
    a.mul_add(b, c)
}

/// Does work on one number at a time.
#[target_feature(enable = "avx2,fma")]
pub(super) fn run<W: Kernel>(work: W) -> W::Output {
    work.run()
}

/// Does work on lanes.
#[target_feature(enable = "avx2,fma")]
pub(super) fn run_wide<W: WithSimd>(work: W) -> W::Output {
    work.run::<RegisterPair>()
}

/// Made only in [`run_wide`]; nothing outside `super` can name it. The lower
/// four lanes come first.
#[derive(Clone, Copy)]
pub(super) struct RegisterPair(pub __m256d, pub __m256d);

/// All bits of a true lane are set, no bit of a false one.
#[derive(Clone, Copy)]
pub(super) struct PairMask(__m256d, __m256d);

/// One instruction on both halves.
macro_rules! both {
    ($out:ident, |$x:ident| $call:expr, $a:expr) => {{
        let $x = $a.0;
        let low = level!($call);
        let $x = $a.1;
        $out(low, level!($call))
    }};
    ($out:ident, |$x:ident, $y:ident| $call:expr, $a:expr, $b:expr) => {{
        let ($x, $y) = ($a.0, $b.0);
        let low = level!($call);
        let ($x, $y) = ($a.1, $b.1);
        $out(low, level!($call))
    }};
}

operators! { RegisterPair:
    Add add |a, b| both!(RegisterPair, |x, y| _mm256_add_pd(x, y), a, b);
    Sub sub |a, b| both!(RegisterPair, |x, y| _mm256_sub_pd(x, y), a, b);
    Mul mul |a, b| both!(RegisterPair, |x, y| _mm256_mul_pd(x, y), a, b);
    Div div |a, b| both!(RegisterPair, |x, y| _mm256_div_pd(x, y), a, b);
}

impl RegisterPair {
    /// The pairs of even places, and those of odd ones.
    #[inline(always)]
    pub fn even_and_odd(from: [&[f64; 2]; WIDTH]) -> [Self; 2] {
        let [a, b, c, d, e, f, g, h] = from.map(|pair| pair.as_ptr());
        level!({
            let two = |low, high| {
                let low = _mm256_castpd128_pd256(_mm_loadu_pd(low));
                _mm256_insertf128_pd::<1>(low, _mm_loadu_pd(high))
            };
            [Self(two(a, c), two(e, g)), Self(two(b, d), two(f, h))]
        })
    }
}

impl Neg for RegisterPair {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        both!(RegisterPair, |x| _mm256_xor_pd(x, _mm256_set1_pd(-0.0)), self)
    }
}

impl crate::number::sealed::Sealed for RegisterPair {}

impl Number for RegisterPair {
    const WRITTEN_OUT: bool = true;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        let half = level!(_mm256_set1_pd(x));
        Self(half, half)
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        level!(Self(
            _mm256_fmadd_pd(self.0, b.0, c.0),
            _mm256_fmadd_pd(self.1, b.1, c.1),
        ))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        both!(
            RegisterPair,
            |x| _mm256_andnot_pd(_mm256_set1_pd(-0.0), x),
            self
        )
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        both!(RegisterPair, |x| _mm256_sqrt_pd(x), self)
    }
}

impl Simd for RegisterPair {
    type Mask = PairMask;

    #[inline(always)]
    fn load(from: &Lanes) -> Self {
        let place = from.0.as_ptr();
        level!(Self(_mm256_loadu_pd(place), _mm256_loadu_pd(place.add(4)),))
    }

    #[inline(always)]
    fn gather(from: [&f64; WIDTH]) -> Self {
        let [a, b, c, d, e, f, g, h] = from;
        level!({
            let pair = |low, high| _mm_loadh_pd(_mm_load_sd(low), high);
            let four = |a, b, c, d| {
                let low = _mm256_castpd128_pd256(pair(a, b));
                _mm256_insertf128_pd::<1>(low, pair(c, d))
            };
            Self(four(a, b, c, d), four(e, f, g, h))
        })
    }

    #[inline(always)]
    fn gather_pairs(from: [&[f64; 2]; WIDTH]) -> (Self, Self) {
        let [even, odd] = Self::even_and_odd(from);
        let first = both!(Self, |x, y| _mm256_unpacklo_pd(x, y), even, odd);
        (first, both!(Self, |x, y| _mm256_unpackhi_pd(x, y), even, odd))
    }

    #[inline(always)]
    fn store(self, to: &mut Lanes) {
        // Volatile: a selection stored at the place of its load would become a
        // masked store, which takes many cycles on some processors.
        let place: *mut __m256d = to.0.as_mut_ptr().cast();
        level!({
            place.write_volatile(self.0);
            place.add(1).write_volatile(self.1);
        });
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        both!(RegisterPair, |x, y| _mm256_max_pd(x, y), self, other)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        both!(RegisterPair, |x, y| _mm256_min_pd(x, y), self, other)
    }

    #[inline(always)]
    fn lt(self, other: Self) -> PairMask {
        both!(PairMask, |x, y| _mm256_cmp_pd::<_CMP_LT_OQ>(x, y), self, other)
    }

    #[inline(always)]
    fn unlike(self, other: Self, third: Self) -> PairMask {
        let pair =
            both!(RegisterPair, |x, y| _mm256_xor_pd(x, y), self, other);
        let signs =
            both!(RegisterPair, |x, y| _mm256_or_pd(x, y), pair, third);
        both!(
            PairMask,
            |x| {
                let (zero, signs) =
                    (_mm256_setzero_si256(), _mm256_castpd_si256(x));
                _mm256_castsi256_pd(_mm256_cmpgt_epi64(zero, signs))
            },
            signs
        )
    }

    #[inline(always)]
    fn le(self, other: Self) -> PairMask {
        both!(PairMask, |x, y| _mm256_cmp_pd::<_CMP_LE_OQ>(x, y), self, other)
    }

    #[inline(always)]
    fn eq(self, other: Self) -> PairMask {
        both!(PairMask, |x, y| _mm256_cmp_pd::<_CMP_EQ_OQ>(x, y), self, other)
    }
}

impl Mask<RegisterPair> for PairMask {
    #[inline(always)]
    fn of(bits: u8) -> Self {
        level!({
            let all = _mm256_set1_epi64x(i64::from(bits));
            let half = |own| {
                let set = _mm256_cmpeq_epi64(_mm256_and_si256(all, own), own);
                _mm256_castsi256_pd(set)
            };
            Self(
                half(_mm256_setr_epi64x(1, 2, 4, 8)),
                half(_mm256_setr_epi64x(16, 32, 64, 128)),
            )
        })
    }

    #[inline(always)]
    fn bits(self) -> u8 {
        let [low, high] =
            level!([_mm256_movemask_pd(self.0), _mm256_movemask_pd(self.1)]);
        (low | high << 4) as u8
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        both!(PairMask, |x, y| _mm256_and_pd(x, y), self, other)
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        both!(PairMask, |x, y| _mm256_or_pd(x, y), self, other)
    }

    #[inline(always)]
    fn but_not(self, other: Self) -> Self {
        both!(PairMask, |x, y| _mm256_andnot_pd(y, x), self, other)
    }

    #[inline(always)]
    fn select(self, yes: RegisterPair, no: RegisterPair) -> RegisterPair {
        level!(RegisterPair(
            _mm256_blendv_pd(no.0, yes.0, self.0),
            _mm256_blendv_pd(no.1, yes.1, self.1),
        ))
    }

    #[inline(always)]
    fn count(self, counts: &mut [u64; WIDTH]) {
        let place: *mut __m256i = counts.as_mut_ptr().cast();
        level!({
            for (half, mask) in [self.0, self.1].into_iter().enumerate() {
                let place = place.add(half);
                let before = _mm256_loadu_si256(place);
                // A true lane is -1.
                let mask = _mm256_castpd_si256(mask);
                let after = _mm256_sub_epi64(before, mask);
                _mm256_storeu_si256(place, after);
            }
        });
    }
}
