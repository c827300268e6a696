//! Bounds of a shape over a time, without an expansion.
//!
//! # Proof P8
//!
//! A block at rest skips the pieces of a pulse whose bound lies below the
//! uplift threshold. The bounds are those of these shapes; `GAUSS_SLOPE`
//! belongs to two polynomials.

use super::{PulseShape, gauss};
use crate::number::Real;

/// Largest |d/dx| of (1 - x^2) exp(-x^2/2) and of (x^2 - 3) x exp(-x^2/2).
const GAUSS_SLOPE: f64 = 3.0;

/// x^k exp(-x^2/2) falls from here on for k up to 3.
const TAIL: f64 = 1.8;

impl<N: Real> PulseShape<N> {
    /// Largest |a/g| at any time, if rounding cannot exceed it: that of one
    /// sine or of a constant.
    pub(crate) fn summit(&self) -> Option<N> {
        match self {
            Self::Sines([only, others @ ..]) => others
                .iter()
                .all(|sine| sine.amplitude == N::zero())
                .then_some(only.amplitude.abs()),
            Self::Line { at_zero, slope } => {
                (*slope == N::zero()).then_some(at_zero.abs())
            }
            Self::Gauss { .. } => None,
        }
    }
}

impl PulseShape<f64> {
    /// Bound on |a/g| at all times within `half_s` of `middle_s`, but for
    /// rounding.
    pub(crate) fn bound(&self, middle_s: f64, half_s: f64) -> f64 {
        let at = |t_s: f64| self.at(t_s).abs();
        match self {
            Self::Sines(sines) => {
                // Relative to the phase of the first sine, the others turn
                // slowly if the rates are close together.
                let carrier = sines[0].rate_rad_s;
                let (mut fast, mut slow) = (0.0, 0.0);
                let (mut real, mut imaginary) = (0.0, 0.0);
                for sine in sines {
                    let size = sine.amplitude.abs();
                    let own = sine.rate_rad_s - carrier;
                    fast += size * sine.rate_rad_s.abs();
                    slow += size * own.abs();
                    let angle = own.mul_add(middle_s, sine.phase_rad);
                    real += sine.amplitude * libm::cos(angle);
                    imaginary += sine.amplitude * libm::sin(angle);
                }
                let envelope = libm::hypot(real, imaginary);
                let by_value = fast.mul_add(half_s, at(middle_s));
                by_value.min(slow.mul_add(half_s, envelope))
            }
            Self::Line { .. } => {
                at(middle_s - half_s).max(at(middle_s + half_s))
            }
            Self::Gauss { scale, polynomial, rate, centre_s } => {
                let half = rate * half_s;
                let by_value =
                    (scale.abs() * GAUSS_SLOPE).mul_add(half, at(middle_s));
                let nearest = (rate * (middle_s - centre_s)).abs() - half;
                if !(nearest > TAIL) {
                    return by_value;
                }
                let sum = polynomial
                    .iter()
                    .rev()
                    .fold(0.0, |sum: f64, q| sum.mul_add(nearest, q.abs()));
                by_value.min(scale.abs() * sum * gauss(nearest))
            }
        }
    }
}
