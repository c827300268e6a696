//! A pulse, or no ground motion, as one type.

use crate::excitation::Excitation;
use crate::integrator::Scene;
use crate::integrator::forcing::{
    Exceedance, Forcing, LONGEST_STEP, Moment, PulseForcing, RestScan,
};
use crate::number::Real;
use crate::number::dispatch::Isa;

/// A ground motion that is no record.
pub(crate) enum Shaking<N> {
    /// A pulse.
    Pulse(PulseForcing<N>),
    /// No motion.
    Silence(Silence<N>),
}

impl<N: Real> Shaking<N> {
    /// The pulse of a scene, or no motion.
    pub fn of(scene: &Scene<'_>, isa: Isa) -> Self {
        let p = scene.block.frequency_rad_s();
        match scene.excitation {
            Excitation::Pulse(pulse) => {
                Self::Pulse(PulseForcing::new(pulse, p, isa))
            }
            Excitation::Record(_) | Excitation::Free => Self::nothing(),
        }
    }

    /// No piece: free motion is left to the closed form.
    pub fn nothing() -> Self {
        let (start_s, one) = (N::zero(), N::one());
        Self::Silence(Silence { pieces: 0, start_s, length: one, p: one })
    }

    /// Silence for stepping through the free motion from `start_s` on.
    pub fn endless(start_s: N, p: N) -> Self {
        let length = N::from_f64(LONGEST_STEP);
        let pieces = usize::MAX;
        Self::Silence(Silence { pieces, start_s, length, p })
    }
}

/// No ground motion: equal pieces of silence.
pub(crate) struct Silence<N> {
    pieces: usize,
    start_s: N,
    length: N,
    p: N,
}

impl<N: Real, const F: usize> Forcing<N, F> for Shaking<N> {
    fn pieces(&self) -> usize {
        match self {
            Self::Pulse(pulse) => Forcing::<N, F>::pieces(pulse),
            Self::Silence(silence) => silence.pieces,
        }
    }

    fn start_s(&self, piece: usize) -> N {
        match self {
            Self::Pulse(pulse) => Forcing::<N, F>::start_s(pulse, piece),
            Self::Silence(Silence { start_s, length, p, .. }) => {
                N::from_f64(piece as f64).mul_add(*length / *p, *start_s)
            }
        }
    }

    fn length(&self, piece: usize) -> N {
        match self {
            Self::Pulse(pulse) => Forcing::<N, F>::length(pulse, piece),
            Self::Silence(silence) => silence.length,
        }
    }

    fn series(&self, place: Moment<N>) -> [N; F] {
        match self {
            Self::Pulse(pulse) => pulse.series(place),
            Self::Silence(_) => [N::zero(); F],
        }
    }

    fn exceedance(
        &self,
        from: Moment<N>,
        threshold: N,
    ) -> (Option<Exceedance<N>>, RestScan<N>) {
        match self {
            Self::Pulse(pulse) => {
                Forcing::<N, F>::exceedance(pulse, from, threshold)
            }
            Self::Silence(_) => {
                (None, RestScan { pieces: 0, nearest: N::one() })
            }
        }
    }

    fn span(&self) -> f64 {
        match self {
            Self::Pulse(pulse) => Forcing::<N, F>::span(pulse),
            Self::Silence(_) => 0.0,
        }
    }
}
