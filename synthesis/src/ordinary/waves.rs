//! Motions that meet a target spectrum.

use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::RangeInclusive;

use rocking::stop;

use super::attenuation::{DURATION, PERIODS_S, PGV, QUANTITIES};
use crate::draws::Stream;
use crate::noise::{DT_S, corner_hz, high_pass};
use crate::pair::{GRAVITY_M_S2, Role};
use crate::special::gamma_quantile;

/// Bands of noise, and the centre frequencies of the lowest and the highest,
/// in Hz; the others lie between them at equal ratios.
const BANDS: usize = 24;
const BAND_ENDS_HZ: [f64; 2] = [0.12, 25.0];

/// Damping ratio of a band's filter, which is passed twice, up to 1 Hz and
/// from 4 Hz on; between them it is linear in the logarithm of the frequency.
/// Long waves of recorded motions ring less.
const BAND_DAMPING: [f64; 2] = [0.5, 0.25];

/// Shape of the envelope's gamma density: median, standard deviation of the
/// logarithm, and its ends. The median gives the recorded ratio of D5-95 to
/// D5-75.
const SHAPE: [f64; 4] = [2.0, 0.3, 1.15, 6.0];

/// Standard deviation of the logarithm of the amplitude's fluctuation that
/// all bands of a pair share, and of that of each band.
const FLUCTUATION: [f64; 2] = [0.5, 0.5];

/// Time between independent values of the fluctuation over D5-75.
const FLUCTUATION_TIME: f64 = 0.25;

/// D5-75 of the envelope over that of the target: fluctuations lengthen it.
const ENVELOPE: f64 = 0.85;

/// How often the bands' amplitudes are corrected.
const CORRECTIONS: usize = 6;

/// Period at which the correction of PGA is applied, in s, and the share of
/// it that is: PGA is the work of lower bands, too.
const PGA_PERIOD_S: f64 = 0.04;
const PGA_SHARE: f64 = 0.5;

/// Periods whose corrections share in that of PGV, in s.
const VELOCITY_PERIODS_S: RangeInclusive<f64> = 0.3..=1.5;

/// Largest correction of a logarithm.
const LARGEST_CORRECTION: f64 = 1.5;

/// Longest motion, in s.
const LONGEST_S: f64 = 90.0;

/// Damping ratio of the response spectrum.
const DAMPING: f64 = 0.05;

/// Both components of one motion.
pub(super) fn pair(
    seed: &str,
    mw: f64,
    targets: &[[f64; QUANTITIES]; 2],
    stream: impl Fn(Role) -> u64,
) -> [Vec<f64>; 2] {
    let mut shared = Stream::new(seed, stream(Role::Parameters));
    let [middle, spread, low, high] = SHAPE;
    let shape = middle * libm::exp(spread * shared.normals(1)[0]);
    let shape = shape.clamp(low, high);
    let envelopes = targets.map(|t| {
        let d5_75_s = ENVELOPE * libm::exp(t[DURATION]);
        Envelope::of(d5_75_s, shape)
    });
    let ends = envelopes.map(|e| e.time_s(0.99));
    let end_s = if ends[0] > ends[1] { ends[0] } else { ends[1] };
    let n = (duration_s(end_s) / DT_S).round() as usize + 1;
    let nodes = nodes_of(n, envelopes[0].d5_75_s)
        .max(nodes_of(n, envelopes[1].d5_75_s));
    let common = shared.normals(nodes);
    let component = |k: usize, role: Role| {
        let mut draws = Stream::new(seed, stream(role));
        let noise = Noise {
            envelope: &envelopes[k],
            common: &common,
            corner_hz: corner_hz(mw),
            samples: n,
        };
        matched(&noise.bands(&mut draws), &targets[k])
    };
    [component(0, Role::First), component(1, Role::Second)]
}

/// Length of a record whose motion has all but ended at `end_s`: a fifth and
/// eight seconds more, at least 20 s.
fn duration_s(end_s: f64) -> f64 {
    (1.2 * end_s + 8.0).ceil().clamp(20.0, LONGEST_S)
}

/// Amplitude whose square is a gamma density.
#[derive(Clone, Copy, Debug)]
pub(super) struct Envelope {
    shape: f64,
    scale_s: f64,
    d5_75_s: f64,
}

impl Envelope {
    /// The envelope of this D5-75 and shape.
    pub(super) fn of(d5_75_s: f64, shape: f64) -> Self {
        let unit = gamma_quantile(0.75, shape) - gamma_quantile(0.05, shape);
        Self { shape, scale_s: d5_75_s / unit, d5_75_s }
    }

    /// Time at which `share` of the energy has come, in s.
    pub(super) fn time_s(&self, share: f64) -> f64 {
        self.scale_s * gamma_quantile(share, self.shape)
    }

    /// Value at `t`; its square has the integral 1.
    pub(super) fn value(&self, t: f64) -> f64 {
        if !(t > 0.0) {
            return 0.0;
        }
        let x = t / self.scale_s;
        let ln_density = (self.shape - 1.0) * libm::log(x)
            - x
            - libm::lgamma(self.shape)
            - libm::log(self.scale_s);
        libm::exp(0.5 * ln_density)
    }
}

/// Values of a fluctuation that a component of `n` samples needs.
fn nodes_of(n: usize, d5_75_s: f64) -> usize {
    (n as f64 * DT_S / (FLUCTUATION_TIME * d5_75_s)) as usize + 2
}

/// What the noise of one component is made from.
struct Noise<'a> {
    envelope: &'a Envelope,
    /// Fluctuation that the components share, one value a node.
    common: &'a [f64],
    corner_hz: f64,
    samples: usize,
}

impl Noise<'_> {
    /// Noise of each band with a mean square of 1: white noise under the
    /// envelope and both fluctuations, filtered, high-passed.
    fn bands(&self, draws: &mut Stream) -> Vec<Vec<f64>> {
        let n = self.samples;
        let envelope: Vec<f64> =
            (0..n).map(|i| self.envelope.value(i as f64 * DT_S)).collect();
        let spacing_s = FLUCTUATION_TIME * self.envelope.d5_75_s;
        // Between two nodes the weights are cosine and sine of one angle,
        // so that the variance is 1 throughout.
        let places: Vec<(usize, f64, f64)> = (0..n)
            .map(|i| {
                let place = i as f64 * DT_S / spacing_s;
                let node = place as usize;
                let angle = FRAC_PI_2 * (place - node as f64);
                let (sin, cos) = libm::sincos(angle);
                (node, cos, sin)
            })
            .collect();
        let nodes = nodes_of(n, self.envelope.d5_75_s);
        let [shared, own] = FLUCTUATION;
        (0..BANDS)
            .map(|band| {
                let values: Vec<f64> = draws
                    .normals(nodes)
                    .iter()
                    .zip(self.common)
                    .map(|(z, c)| own * z + shared * c)
                    .collect();
                let mut x = draws.normals(n);
                for (x, ((node, cos, sin), e)) in
                    x.iter_mut().zip(places.iter().zip(&envelope))
                {
                    let ln = cos * values[*node] + sin * values[node + 1];
                    *x *= e * libm::exp(ln);
                }
                resonate(&mut x, band_hz(band));
                resonate(&mut x, band_hz(band));
                high_pass(&mut x, self.corner_hz);
                let squares = x.iter().fold(0.0, |s, a| s + a * a);
                let scale = 1.0 / (squares / n as f64).sqrt();
                for a in &mut x {
                    *a *= scale;
                }
                x
            })
            .collect()
    }
}

/// Centre frequency of a band, in Hz.
fn band_hz(band: usize) -> f64 {
    let [low, high] = BAND_ENDS_HZ.map(libm::log);
    let share = band as f64 / (BANDS - 1) as f64;
    libm::exp(low + (high - low) * share)
}

fn band_damping(hz: f64) -> f64 {
    let [low, high] = BAND_DAMPING;
    let share = libm::log2(hz).clamp(0.0, 2.0) / 2.0;
    low + (high - low) * share
}

/// Passes samples through a damped oscillator's velocity, sampled by impulse
/// invariance.
fn resonate(samples: &mut [f64], hz: f64) {
    let w = 2.0 * PI * hz * DT_S;
    let damping = band_damping(hz);
    let decay = libm::exp(-damping * w);
    let turn = libm::cos(w * (1.0 - damping * damping).sqrt());
    let (c1, c2) = (2.0 * decay * turn, decay * decay);
    let (mut y1, mut y2, mut x1) = (0.0, 0.0, 0.0);
    for x in samples {
        let y = *x - x1 + c1 * y1 - c2 * y2;
        x1 = *x;
        (y2, y1) = (y1, y);
        *x = y;
    }
}

/// Sum of the bands whose amplitudes are corrected until its response
/// spectrum is near the target, scaled to the PGV of the target.
fn matched(bands: &[Vec<f64>], target: &[f64; QUANTITIES]) -> Vec<f64> {
    let centres: Vec<f64> =
        (0..BANDS).map(|b| -libm::log(band_hz(b))).collect();
    let mut ln_gains: Vec<f64> = centres
        .iter()
        .map(|x| {
            // Above 12 Hz spectra of acceleration fall.
            let above = -libm::log(12.0) - x;
            read_off(target, *x) - if above > 0.0 { above } else { 0.0 }
        })
        .collect();
    let oscillators: Vec<Oscillator> =
        PERIODS_S[1..].iter().map(|t| Oscillator::new(*t)).collect();
    let miss = |samples: &[f64]| {
        let mut out = [0.0; PGV + 1];
        out[PGV] = target[PGV] - libm::log(peak_velocity_m_s(samples));
        out[0] = target[0] - libm::log(peak(samples));
        for (k, oscillator) in oscillators.iter().enumerate() {
            out[k + 1] = target[k + 1] - libm::log(oscillator.peak(samples));
        }
        out
    };
    let samples = sum(bands, &ln_gains);
    let start = target[0] - libm::log(peak(&samples));
    for gain in &mut ln_gains {
        *gain += start;
    }
    for _ in 0..CORRECTIONS {
        stop::point();
        let samples = sum(bands, &ln_gains);
        let mut left = miss(&samples);
        left[0] *= PGA_SHARE;
        // PGV and the spectrum about its periods share what is left.
        for (k, period) in PERIODS_S.iter().enumerate() {
            if VELOCITY_PERIODS_S.contains(period) {
                left[k] = 0.5 * (left[k] + left[PGV]);
            }
        }
        for (gain, x) in ln_gains.iter_mut().zip(&centres) {
            let correction = read_off(&left, *x);
            *gain += correction.clamp(-LARGEST_CORRECTION, LARGEST_CORRECTION);
        }
    }
    let mut samples = sum(bands, &ln_gains);
    let scale = libm::exp(miss(&samples)[PGV]);
    for a in &mut samples {
        *a *= scale;
    }
    samples
}

/// Value at a period of what is given at the periods of the target, linear in
/// the logarithm of the period, constant beyond the ends.
fn read_off(values: &[f64], ln_period: f64) -> f64 {
    let place = |k: usize| match k {
        0 => libm::log(PGA_PERIOD_S),
        _ => libm::log(PERIODS_S[k]),
    };
    let last = PERIODS_S.len() - 1;
    if !(ln_period > place(0)) {
        return values[0];
    }
    let Some(k) = (1..=last).find(|k| ln_period < place(*k)) else {
        return values[last];
    };
    let share = (ln_period - place(k - 1)) / (place(k) - place(k - 1));
    values[k - 1] + (values[k] - values[k - 1]) * share
}

fn sum(bands: &[Vec<f64>], ln_gains: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; bands.first().map_or(0, Vec::len)];
    for (band, gain) in bands.iter().zip(ln_gains) {
        let gain = libm::exp(*gain);
        for (sum, x) in out.iter_mut().zip(band) {
            *sum += gain * x;
        }
    }
    out
}

fn peak(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |peak, a| {
        let a = a.abs();
        if a > peak { a } else { peak }
    })
}

/// Largest velocity from rest, by trapezoids.
fn peak_velocity_m_s(samples: &[f64]) -> f64 {
    let (mut velocity, mut largest) = (0.0_f64, 0.0);
    for pair in samples.windows(2) {
        velocity += 0.5 * (pair[0] + pair[1]);
        let size = velocity.abs();
        if size > largest {
            largest = size;
        }
    }
    largest * DT_S * GRAVITY_M_S2
}

/// Pseudo-spectral acceleration at a period, as the corrections see it.
#[cfg(test)]
pub(super) fn matched_peak(period_s: f64, samples: &[f64]) -> f64 {
    Oscillator::new(period_s).peak(samples)
}

/// A damped oscillator under samples joined by straight lines, exact at the
/// samples (Nigam and Jennings 1969). The largest value at a sample is below
/// the true peak by 5 % at most at 0.1 s and less at longer periods: enough
/// for corrections, which is why the core's slower measures are not asked.
struct Oscillator {
    back: [f64; 2],
    push: [f64; 3],
}

impl Oscillator {
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
        // A lasting push of 1 has the answer 1.
        let b1 = 1.0 - 2.0 * c + e * e - b0 - b2;
        Self { back: [2.0 * c, e * e], push: [b0, b1, b2] }
    }

    fn peak(&self, samples: &[f64]) -> f64 {
        let ([a1, a2], [b0, b1, b2]) = (self.back, self.push);
        let (mut x1, mut x2, mut y1, mut y2) = (0.0, 0.0, 0.0, 0.0);
        let mut peak = 0.0;
        for x in samples {
            let y = b0 * x + b1 * x1 + b2 * x2 + a1 * y1 - a2 * y2;
            (x2, x1) = (x1, *x);
            (y2, y1) = (y1, y);
            let size = y.abs();
            if size > peak {
                peak = size;
            }
        }
        peak
    }
}
