//! The equation of motion in the form that the integrator steps.
//!
//! With u = |theta|, time in units of 1/p, the ground acceleration over
//! gravity f = s a/g seen from the pivot s = sgn(theta), both models read
//!
//! ```text
//! u'' = A S(u) - B C(u)
//! Eq. 1:  S = sin u, C = cos u, A = cos alpha - f sin alpha,
//!         B = cos alpha (tan alpha + f)
//! Eq. 2:  S = u,     C = 1,     A = 1,   B = alpha + f
//! ```
//!
//! B vanishes exactly at the uplift threshold and u is small near the base,
//! so grazing uplifts and the last hops before rest keep their relative
//! precision, which the variable alpha - |theta| would lose. Its derivatives
//! lose nothing in the shorter form u'' = sin(u - alpha) - f cos(u - alpha).
//!
//! A further overturning criterion is a variant of [`Overturning`] and its
//! `limit`. The compiler does not find `for_extent`, `see_peak`, `Beyond` and
//! `coast`, which compare criteria with `==`.

use crate::block::{Block, Restitution};
use crate::names::named;
use crate::number::{Number, Real};

named! {
    /// Equation of motion.
    pub enum Model: "model" {
        /// Eq. 1, valid for large rotations; uplift when |a| > g tan alpha.
        Nonlinear = "nonlinear",
        /// Eq. 2, linearised; uplift when |a| > g alpha.
        Linearized = "linearized",
    }
}

named! {
    /// When a block counts as overturned.
    pub enum Overturning: "overturning criterion" {
        /// |theta| reaches alpha (the paper's first sign of overturning).
        Alpha = "alpha",
        /// |theta| exceeds pi/2.
        HalfPi = "half-pi",
    }
}

/// Constants of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dynamics<N> {
    pub model: Model,
    pub overturning: Overturning,
    pub alpha: N,
    /// Uplift threshold over gravity.
    pub threshold: N,
    /// Rotation that counts as overturned.
    pub limit: N,
    pub p: N,
    pub eta: N,
    /// Sine and cosine of alpha.
    pub sine: N,
    pub cosine: N,
}

/// Threshold of uplift over gravity: tan(alpha) for Eq. 1, alpha for Eq. 2.
///
/// The divisor of the dimensionless intensity PGA/(g tan alpha) is this
/// number, so that an intensity of 1 is the threshold to the last bit.
pub fn uplift_threshold(block: &Block, model: Model) -> f64 {
    match model {
        Model::Nonlinear => libm::tan(block.slenderness_rad()),
        Model::Linearized => block.slenderness_rad(),
    }
}

/// Drive of a step.
#[derive(Clone, Copy)]
pub(crate) struct Drive<N, const F: usize> {
    /// A and B at its start.
    pub a: N,
    pub b: N,
    /// Series of f.
    pub f: [N; F],
    /// Sine and cosine of alpha.
    pub sine: N,
    pub cosine: N,
    /// Sine and cosine of the rotation at its start.
    pub start: (N, N),
}

impl<N: Number, const F: usize> Drive<N, F> {
    /// The drive from the uplift threshold, sine and cosine of alpha, the
    /// series of f, and sine and cosine of the rotation at the start.
    #[inline(always)]
    pub fn new(
        model: Model,
        (threshold, sine, cosine): (N, N, N),
        f: [N; F],
        start: (N, N),
    ) -> Self {
        let (a, b) = match model {
            Model::Nonlinear => {
                ((-f[0]).mul_add(sine, cosine), (threshold + f[0]) * cosine)
            }
            Model::Linearized => (N::one(), threshold + f[0]),
        };
        Self { a, b, f, sine, cosine, start }
    }
}

/// Sine and cosine of a rotation up to pi/4, in the approximation of the
/// model.
#[inline(always)]
pub(crate) fn sine_cosine<N: Number>(model: Model, u: N) -> (N, N) {
    match model {
        Model::Nonlinear => u.sin_cos_small(),
        Model::Linearized => (u, N::one()),
    }
}

/// Derivative of u'' by u at the start of a step.
#[inline(always)]
pub(crate) fn curvature<N: Number, const F: usize>(
    model: Model,
    drive: &Drive<N, F>,
) -> N {
    let (sine, cosine) = drive.start;
    match model {
        Model::Nonlinear => drive.a.mul_add(cosine, drive.b * sine),
        Model::Linearized => N::one(),
    }
}

/// Downward acceleration at the base under forcing f: B at u = 0.
#[inline(always)]
pub(crate) fn restoring<N: Number>(
    model: Model,
    threshold: N,
    cosine: N,
    f: N,
) -> N {
    match model {
        Model::Nonlinear => (threshold + f) * cosine,
        Model::Linearized => threshold + f,
    }
}

impl<N: Real> Dynamics<N> {
    pub fn new(
        block: &Block,
        restitution: Restitution,
        model: Model,
        overturning: Overturning,
    ) -> Self {
        let alpha = N::from_f64(block.slenderness_rad());
        let (sine, cosine) = alpha.sin_cos();
        let threshold = match model {
            Model::Nonlinear if N::ROUNDOFF < f64::ROUNDOFF => sine / cosine,
            _ => N::from_f64(uplift_threshold(block, model)),
        };
        Self {
            model,
            overturning,
            alpha,
            threshold,
            limit: match overturning {
                Overturning::Alpha => alpha,
                Overturning::HalfPi => N::right_angle(),
            },
            p: N::from_f64(block.frequency_rad_s()),
            eta: N::from_f64(restitution.velocity_ratio()),
            sine,
            cosine,
        }
    }

    /// Downward acceleration at the base under forcing f: B at u = 0.
    pub fn restoring(&self, f: N) -> N {
        restoring(self.model, self.threshold, self.cosine, f)
    }

    /// The saddle's energy above the base:
    /// 1 - cos alpha (Eq. 1), alpha^2/2 (Eq. 2).
    pub fn saddle_energy(&self) -> N {
        self.potential(self.alpha)
    }

    /// Potential energy without ground motion, zero at the base:
    /// cos(alpha - u) - cos(alpha) (Eq. 1), u (alpha - u/2) (Eq. 2), in
    /// product form.
    pub fn potential(&self, u: N) -> N {
        let half = u * N::ratio(1, 2);
        match self.model {
            Model::Nonlinear => {
                let (s, _) = half.sin_cos();
                let (other, _) = (self.alpha - half).sin_cos();
                N::from_f64(2.0) * s * other
            }
            Model::Linearized => u * (self.alpha - half),
        }
    }

    /// Energy below the saddle: positive when the block cannot pass it.
    /// 2 sin^2((alpha - u)/2) - w^2/2, or (alpha - u)^2/2 - w^2/2.
    pub fn depth(&self, u: N, w: N) -> N {
        let half = N::ratio(1, 2);
        let y = self.alpha - u;
        let hill = match self.model {
            Model::Nonlinear => {
                let (s, _) = (y * half).sin_cos();
                N::from_f64(2.0) * s * s
            }
            Model::Linearized => half * y * y,
        };
        // (hill - w^2/2) as a product of sums: no cancellation of squares.
        let speed = w.abs();
        let root = (hill + hill).sqrt();
        half * (root - speed) * (root + speed)
    }
}
