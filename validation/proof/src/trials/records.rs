//! Shapes of random records, each with peak 1.

use std::f64::consts::TAU;

use super::draw::Draw;
use rocking::names::named;

named! {
    /// Kind of a random record.
    pub(super) enum RecordKind: "kind" {
        /// White noise through an oscillator, under an envelope.
        Filtered = "filtered noise",
        /// White noise.
        White = "white noise",
        /// A clear shock, a quiet time, then a chaotic shock.
        TwoShocks = "two shocks",
        /// Random levels, each held for a while.
        Plateaus = "plateaus",
        /// Noise with long stretches of zeros.
        Zeros = "zeros",
        /// Few samples that are not zero.
        Spikes = "spikes",
        /// Ramps that jump back.
        SawTeeth = "saw teeth",
        /// Each sample of noise several times.
        Repeated = "repeated samples",
    }
}

impl RecordKind {
    /// `n` samples at an interval (s), with peak 1.
    pub fn samples(self, draw: &mut Draw, n: usize, dt_s: f64) -> Vec<f64> {
        normalised(match self {
            Self::Filtered => filtered(draw, n, dt_s),
            Self::White => (0..n).map(|_| draw.normal()).collect(),
            Self::TwoShocks => two_shocks(draw, n, dt_s),
            Self::Plateaus => runs(draw, n, 4, |draw, length| {
                vec![draw.uniform(-1.0, 1.0); length]
            }),
            Self::Zeros => runs(draw, n, 3, |draw, length| {
                if draw.chance(0.5) {
                    return vec![0.0; length];
                }
                (0..length).map(|_| draw.normal()).collect()
            }),
            Self::Spikes => {
                let share = draw.log(1.0 / n as f64, 0.3);
                let mut spike =
                    || if draw.chance(share) { draw.normal() } else { 0.0 };
                (0..n).map(|_| spike()).collect()
            }
            Self::SawTeeth => {
                let alternating = draw.chance(0.5);
                let mut sign = 1.0;
                runs(draw, n, 4, |draw, length| {
                    let height = draw.uniform(0.3, 1.0);
                    sign = if alternating { -sign } else { draw.sign() };
                    let slope = sign * height / length as f64;
                    (0..length).map(|k| slope * (k + 1) as f64).collect()
                })
            }
            Self::Repeated => {
                let times = draw.count(2, 8);
                let values = (0..n.div_ceil(times)).map(|_| draw.normal());
                let all = values.flat_map(|x| std::iter::repeat_n(x, times));
                all.take(n).collect()
            }
        })
    }
}

/// Samples over their peak; if all are zero the middle one becomes 1.
pub(super) fn normalised(mut samples: Vec<f64>) -> Vec<f64> {
    let peak = samples.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    if peak > 0.0 {
        samples.iter_mut().for_each(|x| *x /= peak);
    } else {
        let middle = samples.len() / 2;
        samples[middle] = 1.0;
    }
    samples
}

/// White noise through a damped oscillator, under a random envelope.
pub(super) fn filtered(draw: &mut Draw, n: usize, dt_s: f64) -> Vec<f64> {
    let omega_rad_s = TAU * draw.log(0.2, 8.0).min(0.2 / dt_s);
    let mut samples = noise(draw, n, omega_rad_s * dt_s);
    let envelope = draw.below(4);
    let (rise, fall) = (draw.uniform(0.5, 3.0), draw.uniform(3.0, 12.0));
    for (k, x) in samples.iter_mut().enumerate() {
        let s = (k as f64 + 0.5) / n as f64;
        *x *= match envelope {
            0 => libm::pow(s, rise) * libm::exp(-fall * s),
            1 => s * (1.0 - s),
            2 => (s / 0.15).min((1.0 - s) / 0.4).min(1.0),
            _ => 1.0,
        };
    }
    samples
}

/// White noise through a damped oscillator in discrete time, which turns by
/// `angle` from sample to sample.
pub(super) fn noise(draw: &mut Draw, n: usize, angle: f64) -> Vec<f64> {
    let damping = draw.uniform(0.1, 0.8);
    let decay = libm::exp(-damping * angle);
    let turn = angle * (1.0 - damping * damping).sqrt();
    let (first, second) = (2.0 * decay * libm::cos(turn), decay * decay);
    let (mut last, mut before) = (0.0, 0.0);
    let next = |_| {
        (before, last) =
            (last, first * last - second * before + draw.normal());
        last
    };
    (0..n).map(next).collect()
}

/// Half a sine or noise, then zeros or much weaker noise, then noise.
fn two_shocks(draw: &mut Draw, n: usize, dt_s: f64) -> Vec<f64> {
    let first = (n / draw.count(4, 16)).max(1);
    let quiet = n / draw.count(2, 4);
    let last = n.saturating_sub(first + quiet).max(2);
    let size = draw.log(0.2, 1.0) * draw.sign();
    let mut samples = if draw.chance(0.5) {
        let half = std::f64::consts::PI / first as f64;
        (0..first).map(|k| size * libm::sin(half * k as f64)).collect()
    } else {
        let mut noise = normalised(filtered(draw, first, dt_s));
        noise.iter_mut().for_each(|x| *x *= size);
        noise
    };
    let below = if draw.chance(0.5) { 0.0 } else { 0.02 };
    samples.extend((0..quiet).map(|_| below * draw.uniform(-1.0, 1.0)));
    samples.extend(normalised(filtered(draw, last, dt_s)));
    samples
}

/// Runs of random lengths up to a share of the samples, each made by `next`
/// from its length.
fn runs(
    draw: &mut Draw,
    n: usize,
    share: usize,
    mut next: impl FnMut(&mut Draw, usize) -> Vec<f64>,
) -> Vec<f64> {
    let longest = (n / share).max(2);
    let mut samples = Vec::with_capacity(n);
    while samples.len() < n {
        let length = draw.count(1, longest).min(n - samples.len());
        samples.extend(next(draw, length));
    }
    samples
}
