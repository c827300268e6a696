//! Run-time choice of the instruction set.
//!
//! Every fused multiply-add in a result path is explicit, so all levels give
//! the same bits; the level decides the speed alone (a fused operation is a
//! library call where the instruction set has none). An [`Isa`] is made by
//! detection only, which is what makes the `unsafe` calls here sound: of the
//! levels' functions, and of the instructions by which lanes are registers.
//! This is the only file of the crate with `unsafe`.
#![expect(
    unsafe_code,
    reason = "functions and instructions of a level are unsafe to call; detection makes it sound"
)]

use crate::number::lanes::{Lanes, Several};

/// An instruction-set level that this machine was found to have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Isa(Level);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Baseline,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// A piece of work that [`Isa::run`] compiles once for each level.
///
/// Everything that `run` calls on its hot path must be `#[inline(always)]`:
/// code that is not inlined keeps the baseline instruction set.
pub trait Work {
    /// What the work gives.
    type Output;

    /// Does the work.
    fn run(self) -> Self::Output;
}

/// A piece of work that [`Isa::run_wide`] compiles once for each level, with
/// the level's own numbers in lanes.
pub(crate) trait WideWork {
    /// What the work gives.
    type Output;

    /// Does the work.
    fn run<V: Several>(self) -> Self::Output;
}

impl Isa {
    /// Levels that this machine has, the baseline first.
    #[must_use]
    pub fn available() -> Vec<Isa> {
        #[cfg_attr(not(target_arch = "x86_64"), expect(unused_mut))]
        let mut levels = vec![Isa(Level::Baseline)];
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = std::arch::is_x86_feature_detected!("avx2")
                && std::arch::is_x86_feature_detected!("fma");
            if avx2 {
                levels.push(Isa(Level::Avx2));
            }
            if avx2
                && std::arch::is_x86_feature_detected!("avx512f")
                && std::arch::is_x86_feature_detected!("avx512vl")
                && std::arch::is_x86_feature_detected!("avx512dq")
            {
                levels.push(Isa(Level::Avx512));
            }
        }
        levels
    }

    /// The best level that this machine has.
    #[must_use]
    pub fn best() -> Isa {
        use std::sync::OnceLock;
        static BEST: OnceLock<Isa> = OnceLock::new();
        *BEST.get_or_init(|| {
            Self::available().pop().unwrap_or(Isa(Level::Baseline))
        })
    }

    /// The level's name: `baseline`, `avx2` or `avx512`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self.0 {
            Level::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => "avx512",
        }
    }

    /// True where several numbers at once are faster than one by one.
    #[must_use]
    pub fn is_wide(self) -> bool {
        // Without fused operations nothing is gained by lanes.
        cfg!(not(target_arch = "x86_64")) || self.0 != Level::Baseline
    }

    /// Runs `work` on one number at a time with this level's instructions.
    #[inline]
    pub fn run<W: Work>(self, work: W) -> W::Output {
        match self.0 {
            Level::Baseline => work.run(),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: an `Isa` of either level exists only where detection
            // found the features. The wider one gains nothing here.
            Level::Avx2 | Level::Avx512 => unsafe { avx2(work) },
        }
    }

    /// Runs `work` on several numbers at once with this level's
    /// instructions; none where that [is not faster](Self::is_wide).
    #[inline]
    pub(crate) fn run_wide<W: WideWork>(self, work: W) -> Option<W::Output> {
        match self.0 {
            #[cfg(not(target_arch = "x86_64"))]
            Level::Baseline => Some(work.run::<Lanes>()),
            #[cfg(target_arch = "x86_64")]
            Level::Baseline => None,
            #[cfg(target_arch = "x86_64")]
            // SAFETY: an `Isa` of this level exists only where detection
            // found the features.
            Level::Avx2 => Some(unsafe { avx2_wide(work) }),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: as above.
            Level::Avx512 => Some(unsafe { avx512(work) }),
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn avx2<W: Work>(work: W) -> W::Output {
    work.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn avx2_wide<W: WideWork>(work: W) -> W::Output {
    work.run::<Lanes>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq")]
fn avx512<W: WideWork>(work: W) -> W::Output {
    work.run::<vectors::Eight>()
}

/// Eight numbers in one register.
///
/// Compilers make such code of loops over arrays, too, but may take them
/// apart again with the next change.
#[cfg(target_arch = "x86_64")]
mod vectors {
    use std::arch::x86_64::*;
    use std::ops::{Add, Div, Mul, Neg, Sub};

    use crate::number::lanes::{Lanes, Several, Truths, WIDTH};
    use crate::number::{Number, sin_cos_polynomials};

    /// Made only in work that runs at the level [`avx512`](super::avx512):
    /// nothing outside `super` can name it.
    #[derive(Clone, Copy)]
    pub(super) struct Eight(__m512d);

    /// A bit for each lane.
    #[derive(Clone, Copy)]
    pub(super) struct Bits(__mmask8);

    /// An instruction of the level.
    macro_rules! level {
        ($call:expr) => {
            // SAFETY: `Eight` exists only where the level was found.
            unsafe { $call }
        };
    }

    macro_rules! operators {
        ($($operation:ident $method:ident $instruction:ident;)*) => {$(
            impl $operation for Eight {
                type Output = Self;

                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    Self(level!($instruction(self.0, other.0)))
                }
            }
        )*};
    }

    operators! {
        Add add _mm512_add_pd;
        Sub sub _mm512_sub_pd;
        Mul mul _mm512_mul_pd;
        Div div _mm512_div_pd;
    }

    impl Neg for Eight {
        type Output = Self;

        #[inline(always)]
        fn neg(self) -> Self {
            Self(level!(_mm512_xor_pd(self.0, _mm512_set1_pd(-0.0))))
        }
    }

    impl Number for Eight {
        const LANES: bool = true;

        #[inline(always)]
        fn from_f64(x: f64) -> Self {
            Self(level!(_mm512_set1_pd(x)))
        }

        #[inline(always)]
        fn ratio(i: i32, j: i32) -> Self {
            Self::from_f64(f64::ratio(i, j))
        }

        #[inline(always)]
        fn mul_add(self, b: Self, c: Self) -> Self {
            Self(level!(_mm512_fmadd_pd(self.0, b.0, c.0)))
        }

        #[inline(always)]
        fn sin_cos_small(self) -> (Self, Self) {
            sin_cos_polynomials(self)
        }
    }

    impl Several for Eight {
        type Truths = Bits;

        #[inline(always)]
        fn load(from: &Lanes) -> Self {
            Self(level!(_mm512_loadu_pd(from.0.as_ptr())))
        }

        #[inline(always)]
        fn gather(from: [&f64; WIDTH]) -> Self {
            let [a, b, c, d, e, f, g, h] = from;
            // Fewer steps than what compilers make of single numbers.
            level!({
                let pair = |low, high| _mm_loadh_pd(_mm_load_sd(low), high);
                let four = |a, b, c, d| {
                    let low = _mm256_castpd128_pd256(pair(a, b));
                    _mm256_insertf128_pd::<1>(low, pair(c, d))
                };
                let low = _mm512_castpd256_pd512(four(a, b, c, d));
                Self(_mm512_insertf64x4::<1>(low, four(e, f, g, h)))
            })
        }

        #[inline(always)]
        fn store(self, to: &mut Lanes) {
            level!(_mm512_storeu_pd(to.0.as_mut_ptr(), self.0));
        }

        #[inline(always)]
        fn abs(self) -> Self {
            Self(level!(_mm512_abs_pd(self.0)))
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
        fn sqrt(self) -> Self {
            Self(level!(_mm512_sqrt_pd(self.0)))
        }

        #[inline(always)]
        fn below(self, other: Self) -> Bits {
            Bits(level!(_mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0)))
        }

        #[inline(always)]
        fn unlike(self, other: Self, third: Self) -> Bits {
            Bits(level!({
                let pair = _mm512_xor_pd(self.0, other.0);
                let signs = _mm512_or_pd(pair, third.0);
                _mm512_movepi64_mask(_mm512_castpd_si512(signs))
            }))
        }

        #[inline(always)]
        fn at_most(self, other: Self) -> Bits {
            Bits(level!(_mm512_cmp_pd_mask::<_CMP_LE_OQ>(self.0, other.0)))
        }

        #[inline(always)]
        fn equals(self, other: Self) -> Bits {
            Bits(level!(_mm512_cmp_pd_mask::<_CMP_EQ_OQ>(self.0, other.0)))
        }
    }

    impl Truths<Eight> for Bits {
        #[inline(always)]
        fn of(bits: u8) -> Self {
            Self(bits)
        }

        #[inline(always)]
        fn bits(self) -> u8 {
            self.0
        }

        #[inline(always)]
        fn not(self) -> Self {
            Self(!self.0)
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
}
