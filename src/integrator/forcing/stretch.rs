//! A smooth stretch of a pulse, cut into equal pieces that are not stored.

use crate::excitation::{Pulse, PulseShape};
use crate::integrator::forcing::{LONGEST_PHASE, LONGEST_STEP};
use crate::number::Real;

/// Relative distance from the uplift threshold within which a bound is
/// useless.
const NEAR: f64 = 1e-12;

/// A large bound on the relative rounding of a time and of a phase.
const ROUNDING: f64 = 1e-14;

/// A smooth stretch of a pulse.
pub(super) struct Stretch<N> {
    /// Number of its first piece, and of the one after its last.
    pub first: usize,
    pub end: usize,
    start_s: N,
    pub end_s: f64,
    /// Length of a piece in s.
    share: N,
    pub shape: PulseShape<N>,
    /// The same in double precision, for bounds.
    rough: PulseShape<f64>,
}

/// Number of pieces of a stretch of some seconds.
fn count<N: Real>(
    shape: &PulseShape<N>,
    seconds: f64,
    frequency_rad_s: f64,
) -> f64 {
    let rate = match shape {
        PulseShape::Sines(sines) => sines
            .iter()
            .fold(0.0_f64, |most, s| most.max(s.rate_rad_s.to_f64().abs())),
        PulseShape::Line { .. } => 0.0,
        // The Gaussian's series converges more slowly.
        PulseShape::Gauss { rate, .. } => 2.0 * rate.to_f64(),
    };
    let by_block = seconds * frequency_rad_s / LONGEST_STEP;
    let by_phase = seconds * rate / LONGEST_PHASE;
    libm::ceil(by_block.max(by_phase)).max(1.0)
}

/// Number of pieces of a pulse.
pub(crate) fn pieces_of(pulse: &Pulse, frequency_rad_s: f64) -> f64 {
    let mut start = 0.0;
    let stretches = pulse.stretches::<f64>();
    stretches.iter().fold(0.0, |sum, (end, shape)| {
        let own = count(shape, end - start, frequency_rad_s);
        start = *end;
        sum + own
    })
}

impl<N: Real> Stretch<N> {
    /// The stretches of a pulse.
    pub fn all(pulse: &Pulse, frequency_rad_s: f64) -> Vec<Self> {
        let (mut start, mut first) = (N::zero(), 0);
        let shapes = pulse.stretches::<N>().into_iter();
        shapes
            .zip(pulse.stretches::<f64>())
            .map(|((end, shape), (end_s, rough))| {
                let duration: N = end - start;
                let count = count(&shape, duration.to_f64(), frequency_rad_s);
                let share = duration / N::from_f64(count);
                let begin = (first, start);
                first += count as usize;
                start = end;
                Self {
                    first: begin.0,
                    end: first,
                    start_s: begin.1,
                    end_s,
                    share,
                    shape,
                    rough,
                }
            })
            .collect()
    }

    /// Start of a piece in s.
    pub fn start_s(&self, piece: usize) -> N {
        let k = N::from_f64((piece - self.first) as f64);
        self.share.mul_add(k, self.start_s)
    }

    /// The lesser of a gap and the distance of the summit, if it is known,
    /// from the threshold.
    pub fn room(&self, threshold: N, gap: N) -> N {
        let own = self.shape.summit().map_or(gap, |most| threshold - most);
        if own < gap { own.abs() } else { gap }
    }

    /// Length of a piece in units of 1/p.
    pub fn length(&self, p: N) -> N {
        self.share * p
    }

    /// First piece from `piece` on in which |a/g| may reach the threshold, and
    /// the number of blocks of pieces scanned. Blocks double while they stay
    /// below the threshold and are halved if they may not.
    pub fn quiet(&self, piece: usize, threshold: N) -> (usize, u64) {
        if self.shape.summit().is_some_and(|most| !(most > threshold)) {
            return (self.end, 1);
        }
        let below = threshold.to_f64() * (1.0 - NEAR);
        let (mut next, mut size, mut looked) = (piece, 1, 0);
        while size > 0 && next < self.end {
            let last = (next + size).min(self.end);
            looked += 1;
            let from_s = self.start_s(next).to_f64();
            let to_s = self.start_s(last).to_f64();
            let half_s = 0.5f64.mul_add(to_s - from_s, ROUNDING * self.end_s);
            let middle_s = 0.5 * (from_s + to_s);
            if self.rough.bound(middle_s, half_s) < below {
                next = last;
                size *= 2;
            } else {
                size /= 2;
            }
        }
        (next, looked)
    }
}
