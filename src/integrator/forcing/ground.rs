//! Every kind of ground motion, or none, as one type, for runs in which the
//! compiler need not know the kind of excitation.

use crate::excitation::{Excitation, RecordIndex};
use crate::integrator::Scene;
use crate::integrator::forcing::{
    Exceedance, Forcing, LONGEST_STEP, Moment, PulseForcing, RecordForcing,
    Remainder, RestScan,
};
use crate::number::Real;
use crate::number::dispatch::Isa;

/// A ground motion of any kind. Its series has as many coefficients as a
/// pulse needs; those that a record lacks are zero.
pub(crate) enum Shaking<'a, N> {
    /// A record.
    Record(RecordForcing<'a, N>),
    /// A pulse.
    Pulse(PulseForcing<N>),
    /// No motion.
    Silence(Silence<N>),
}

impl<'a, N: Real> Shaking<'a, N> {
    /// The ground motion of a scene. A record comes with its index.
    pub fn of(
        scene: &Scene<'a>,
        index: Option<&'a RecordIndex>,
        isa: Isa,
    ) -> Self {
        let p = scene.block.frequency_rad_s();
        match (scene.excitation, index) {
            (Excitation::Record(record), Some(index)) => {
                Self::Record(RecordForcing::new(record, index, p))
            }
            (Excitation::Pulse(pulse), _) => {
                Self::Pulse(PulseForcing::new(pulse, p, isa))
            }
            (Excitation::Record(_) | Excitation::Free, _) => Self::nothing(),
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

impl<N: Real, const F: usize> Forcing<N, F> for Shaking<'_, N> {
    fn pieces(&self) -> usize {
        match self {
            Self::Record(record) => record.pieces(),
            Self::Pulse(pulse) => Forcing::<N, F>::pieces(pulse),
            Self::Silence(silence) => silence.pieces,
        }
    }

    fn start_s(&self, piece: usize) -> N {
        match self {
            Self::Record(record) => record.start_s(piece),
            Self::Pulse(pulse) => Forcing::<N, F>::start_s(pulse, piece),
            Self::Silence(Silence { start_s, length, p, .. }) => {
                N::from_f64(piece as f64).mul_add(*length / *p, *start_s)
            }
        }
    }

    fn length(&self, piece: usize) -> N {
        match self {
            Self::Record(record) => record.length(piece),
            Self::Pulse(pulse) => Forcing::<N, F>::length(pulse, piece),
            Self::Silence(silence) => silence.length,
        }
    }

    fn steps(&self) -> usize {
        match self {
            Self::Record(record) => record.steps(),
            Self::Pulse(_) | Self::Silence(_) => 1,
        }
    }

    fn series(&self, place: Moment<N>) -> [N; F] {
        let mut series = [N::zero(); F];
        match self {
            Self::Record(record) => {
                for (to, from) in series.iter_mut().zip(record.series(place)) {
                    *to = from;
                }
            }
            Self::Pulse(pulse) => series = pulse.series(place),
            Self::Silence(_) => {}
        }
        series
    }

    fn exceedance(
        &self,
        from: Moment<N>,
        threshold: N,
    ) -> (Option<Exceedance<N>>, RestScan<N>) {
        match self {
            Self::Record(record) => record.exceedance(from, threshold),
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
            Self::Record(_) | Self::Silence(_) => 0.0,
        }
    }

    fn remainder(&self) -> Option<Remainder<'_, N>> {
        match self {
            Self::Record(record) => record.remainder(),
            Self::Pulse(_) | Self::Silence(_) => None,
        }
    }
}
