//! Run-time choice of the instruction set.
//!
//! Every fused multiply-add in a result path is explicit, so all levels give
//! the same bits and the level changes only the speed (without an instruction
//! for it, a fused operation is a library call). Only detection makes an
//! [`Isa`]; this makes the `unsafe` calls sound: those of the functions of a
//! level, and those of the instructions by which lanes are registers. This
//! file and its two children are the only ones of the crate with `unsafe`.
//!
//! A further instruction set needs its `Level` here (`available`, `name`,
//! `run`, `run_wide`), and a file beside `dispatch/avx2.rs` (two registers) or
//! `avx512.rs` (one) with `Number`, `Simd` and `Mask`.
#![cfg_attr(
    target_arch = "x86_64",
    expect(
        unsafe_code,
        reason = "functions and instructions of a level are unsafe to call; detection makes it sound"
    )
)]

/// Instructions of a level.
#[cfg(target_arch = "x86_64")]
macro_rules! level {
    ($call:expr) => {
        // SAFETY: a register of a level exists only if detection found the
        // level.
        unsafe { $call }
    };
}

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;

/// The function that the compiler calls for a fused operation outside a level.
/// That of MinGW, which would come before Rust's own, rounds twice.
#[cfg(all(windows, target_arch = "x86_64"))]
#[unsafe(no_mangle)]
extern "C" fn fma(a: f64, b: f64, c: f64) -> f64 {
    if Isa::best() == Isa(IsaLevel::Baseline) {
        return crate::number::fused::mul_add(a, b, c);
    }
    // SAFETY: detection found a level with fused operations.
    unsafe { avx2::mul_add(a, b, c) }
}

use crate::number::lanes::Simd;

/// An instruction-set level that this machine was found to have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Isa(IsaLevel);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum IsaLevel {
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
pub trait Kernel {
    /// Result of the work.
    type Output;

    /// Does the work.
    fn run(self) -> Self::Output;
}

/// A piece of work that [`Isa::run_wide`] compiles once for each level, with
/// the level's own numbers in lanes.
pub trait WithSimd {
    /// Result of the work.
    type Output;

    /// Does the work.
    fn run<V: Simd>(self) -> Self::Output;
}

impl Isa {
    /// Levels that this machine has, the baseline first.
    pub fn available() -> Vec<Isa> {
        #[cfg_attr(not(target_arch = "x86_64"), expect(unused_mut))]
        let mut levels = vec![Isa(IsaLevel::Baseline)];
        #[cfg(target_arch = "x86_64")]
        {
            use std::arch::is_x86_feature_detected as has;
            if has!("avx2") && has!("fma") {
                levels.push(Isa(IsaLevel::Avx2));
                if has!("avx512f") && has!("avx512vl") && has!("avx512dq") {
                    levels.push(Isa(IsaLevel::Avx512));
                }
            }
        }
        levels
    }

    /// The best level that this machine has.
    pub fn best() -> Isa {
        use std::sync::OnceLock;
        static BEST: OnceLock<Isa> = OnceLock::new();
        *BEST.get_or_init(|| {
            Self::available().pop().unwrap_or(Isa(IsaLevel::Baseline))
        })
    }

    /// The level's name: `baseline`, `avx2` or `avx512`.
    pub fn name(self) -> &'static str {
        match self.0 {
            IsaLevel::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            IsaLevel::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            IsaLevel::Avx512 => "avx512",
        }
    }

    /// True if lanes are faster than single numbers.
    pub fn is_wide(self) -> bool {
        // Without registers of their own lanes gain nothing.
        self.0 != IsaLevel::Baseline
    }

    /// Runs `work` on one number at a time with this level's instructions.
    #[inline]
    pub fn run<W: Kernel>(self, work: W) -> W::Output {
        match self.0 {
            IsaLevel::Baseline => work.run(),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: an `Isa` of either level exists only if detection found
            // the features. The wider level gains nothing here.
            IsaLevel::Avx2 | IsaLevel::Avx512 => unsafe { avx2::run(work) },
        }
    }

    /// Runs `work` on lanes with this level's instructions; `None` if lanes
    /// are [not faster](Self::is_wide).
    #[inline]
    #[cfg_attr(not(target_arch = "x86_64"), expect(unused_variables))]
    pub fn run_wide<W: WithSimd>(self, work: W) -> Option<W::Output> {
        match self.0 {
            IsaLevel::Baseline => None,
            #[cfg(target_arch = "x86_64")]
            // SAFETY: an `Isa` of this level exists only if detection found
            // the features.
            IsaLevel::Avx2 => Some(unsafe { avx2::run_wide(work) }),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: as above.
            IsaLevel::Avx512 => Some(unsafe { avx512::run_wide(work) }),
        }
    }
}
