//! Largest values of a motion and of its effects.

use std::f64::consts::PI;

use crate::attenuation::{PERIODS_S, PGV};
use crate::noise::DT_S;
use crate::pair::GRAVITY_M_S2;

/// Damping ratio of the response spectrum.
const DAMPING: f64 = 0.05;

/// A quantity of the target as the largest value of a response to the samples.
pub(super) enum Peak {
    Acceleration,
    Velocity,
    Resonator(Resonator),
}

/// The largest value of a response.
pub(super) struct SamplePeak {
    pub(super) size: f64,
    /// 1 or -1.
    pub(super) sign: f64,
    /// Sample at which it is.
    pub(super) at: usize,
}

impl Peak {
    /// The peak that is quantity `k` of a target.
    pub(super) fn of(k: usize) -> Self {
        match k {
            0 => Self::Acceleration,
            PGV => Self::Velocity,
            _ => Self::Resonator(Resonator::new(PERIODS_S[k])),
        }
    }

    /// Waves above this frequency hardly move it.
    pub(super) fn highest_hz(&self) -> f64 {
        match self {
            Self::Acceleration | Self::Velocity => f64::INFINITY,
            Self::Resonator(oscillator) => 8.0 / oscillator.period_s,
        }
    }

    pub(super) fn found(&self, samples: &[f64]) -> SamplePeak {
        match self {
            Self::Acceleration => largest(samples.iter().copied()),
            Self::Velocity => {
                let mut velocity = 0.0;
                let mut before = samples.first().copied().unwrap_or(0.0);
                largest(samples.iter().map(|a| {
                    velocity += HALF_STEP * (before + a);
                    before = *a;
                    velocity
                }))
            }
            Self::Resonator(oscillator) => {
                let mut state = [0.0; 4];
                let step = |x: &f64| oscillator.step(&mut state, *x);
                largest(samples.iter().map(step))
            }
        }
    }

    /// Factors of the samples up to the instant found, whose products sum to
    /// the value there; factors that are missing at the front are zero.
    pub(super) fn weights(&self, found: &SamplePeak) -> Vec<f64> {
        match self {
            Self::Acceleration => vec![found.sign],
            Self::Velocity => {
                let mut weights =
                    vec![2.0 * HALF_STEP * found.sign; found.at + 1];
                weights[found.at] *= 0.5;
                weights
            }
            Self::Resonator(oscillator) => {
                let mut state = [0.0; 4];
                let last = oscillator.memory.min(found.at);
                let mut weights = vec![0.0; last + 1];
                weights[last] = found.sign;
                for weight in weights.iter_mut().rev() {
                    *weight = oscillator.step(&mut state, *weight);
                }
                weights
            }
        }
    }
}

/// Half a sampling interval times gravity: trapezoids give m/s.
const HALF_STEP: f64 = 0.5 * DT_S * GRAVITY_M_S2;

#[inline(always)]
fn largest(values: impl Iterator<Item = f64>) -> SamplePeak {
    let mut found = SamplePeak { size: 0.0, sign: 1.0, at: 0 };
    for (at, value) in values.enumerate() {
        if value.abs() > found.size {
            found = SamplePeak { size: value.abs(), sign: value.signum(), at };
        }
    }
    found
}

/// A damped oscillator under samples joined by straight lines, exact at the
/// samples (Nigam and Jennings 1969). The largest value at a sample is below
/// the true peak by at most 5 % at 0.1 s, and less at longer periods. That is
/// accurate enough for corrections and faster than the measures of records.
pub(super) struct Resonator {
    period_s: f64,
    back: [f64; 2],
    push: [f64; 3],
    /// Number of samples after which a response has decayed to a hundredth.
    memory: usize,
}

impl Resonator {
    fn new(period_s: f64) -> Self {
        let w = 2.0 * PI / period_s;
        let ratio = (1.0 - DAMPING * DAMPING).sqrt();
        let e = libm::exp(-DAMPING * w * DT_S);
        let (sin, cos) = libm::sincos(w * ratio * DT_S);
        let (c, s) = (e * cos, e * sin);
        let g = 2.0 * DAMPING / (w * DT_S);
        let f = (2.0 * DAMPING * DAMPING - 1.0) / (w * ratio * DT_S);
        let b0 = 1.0 - g + s * f + c * g;
        let b2 = e * e * (1.0 + g) + s * f - c * g;
        // The response to a constant push of 1 is 1.
        let b1 = 1.0 - 2.0 * c + e * e - b0 - b2;
        let memory = (4.6 / (DAMPING * w * DT_S)).ceil() as usize;
        let back = [2.0 * c, e * e];
        Self { period_s, back, push: [b0, b1, b2], memory }
    }

    /// Response to the next sample; the state has the last two samples and
    /// responses.
    #[inline(always)]
    fn step(&self, state: &mut [f64; 4], x: f64) -> f64 {
        let ([a1, a2], [b0, b1, b2]) = (self.back, self.push);
        let [x1, x2, y1, y2] = *state;
        let y = b0 * x + b1 * x1 + b2 * x2 + a1 * y1 - a2 * y2;
        *state = [x, x1, y, y1];
        y
    }
}
