//! Motions that meet a target spectrum.

use std::f64::consts::{FRAC_PI_2, PI};

use rocking::stop;

use crate::attenuation::{DURATION, PERIODS_S, PGV, QUANTITIES};
use crate::draws::{Deviates, cholesky, dot};
use crate::noise::{DT_S, corner_hz, high_pass};
use crate::pair::Role;
use crate::peaks::{Peak, SamplePeak};
use crate::special::{gamma_quantile, two_sided_exponential_quantile};
use crate::targets::Target;

/// Bands of noise, and the centre frequencies of the lowest and the highest,
/// in Hz; the others lie between them at equal ratios.
const BANDS: usize = 24;
const BAND_ENDS_HZ: [f64; 2] = [0.1, 25.0];

/// Damping ratio of a band's filter, which is passed forwards and backwards.
const BAND_DAMPING: f64 = 0.25;

/// The frequency content of ground motion falls while the motion lasts
/// (Rezaeian and Der Kiureghian, EESD 39, 2010, Table 3): mean frequency in Hz
/// and mean damping ratio of the filter that white noise is passed through,
/// and parameters and ends of the distribution of the frequency's rate in
/// Hz/s. The frequency is not below 0.3 Hz.
const FILTER_HZ: f64 = 5.87;
const LEAST_HZ: f64 = 0.3;
const FILTER_DAMPING: f64 = 0.213;
const RATE_HZ_S: (f64, f64, f64) = (17.095, 6.7729, 4.8512);
const RATE_ENDS_HZ_S: (f64, f64) = (-2.0, 0.5);

/// Least quiet time before the motion, in s, into which the backward passes
/// reach.
const LEAD_S: f64 = 3.0;

/// Shape of the envelope's gamma density: median, standard deviation of the
/// logarithm, and its ends. The median gives the recorded ratio of D5-95 to
/// D5-75.
const SHAPE: [f64; 4] = [2.0, 0.3, 1.15, 6.0];

/// Standard deviation of the logarithm of the amplitude's fluctuation that
/// all bands of a pair share, and of the fluctuation of each band.
const FLUCTUATION: [f64; 2] = [0.4, 0.4];

/// Time between independent values of the fluctuation over D5-75.
const FLUCTUATION_TIME: f64 = 0.25;

/// D5-75 of the envelope over D5-75 of the target: fluctuations lengthen it.
const ENVELOPE: f64 = 0.93;

/// A band is cut into packets around the instants at which these shares of the
/// energy are reached, if these are further apart than the period of the band.
const CUTS: [f64; 4] = [0.1, 0.35, 0.6, 0.85];

/// Number of corrections of the packets' amplitudes.
const CORRECTIONS: usize = 8;

/// Largest correction of a logarithm.
const LARGEST_CORRECTION: f64 = 0.7;

/// Corrections of two packets have the correlation exp(-d/w) with the width w,
/// where d is the difference of the logarithms of their frequencies. At
/// different times it is multiplied by the second number.
const CORRECTION_WIDTH: f64 = 0.5;
const CORRECTION_APART: f64 = 0.7;

/// Standard deviation with which a logarithm is met, over that of a
/// correction: of spectral accelerations, of PGA and PGV, and of spectral
/// accelerations from 3 s on. A low acceleration at long periods and a high
/// PGV may exclude each other.
const SOFTNESS: [f64; 3] = [0.12, 0.05, 0.2];

/// Longest motion, in s.
const LONGEST_S: f64 = 90.0;

/// Both components of one motion.
pub(super) fn pair(
    seed: &str,
    target: &Target,
    stream: impl Fn(Role) -> u64,
) -> [Vec<f64>; 2] {
    let mut shared = Deviates::new(seed, stream(Role::Parameters));
    let [middle, spread, low, high] = SHAPE;
    let shape = middle * libm::exp(spread * shared.normals(1)[0]);
    let shape = shape.clamp(low, high);
    let rate_hz_s = two_sided_exponential_quantile(
        shared.uniform(0.0, 1.0),
        RATE_HZ_S,
        RATE_ENDS_HZ_S,
    );
    let envelopes = target
        .components
        .map(|t| Envelope::of(ENVELOPE * libm::exp(t[DURATION]), shape));
    let mut lead_s = LEAD_S;
    let [first, second] = envelopes.map(|e| e.time_s(0.99));
    let mut end_s = first.max(second);
    // Beginning and end of the pulse after the beginning of the envelope.
    let mut pulse_s = 0.0;
    if let Some(pulse) = &target.pulse {
        let most = 0.5 * envelopes[0].d5_75_s;
        let delay_s = pulse.delay_s.clamp(-most, most);
        let centre = envelopes[0].time_s(0.3) + delay_s;
        pulse_s = centre - pulse.half_s();
        lead_s = lead_s.max(-pulse_s);
        end_s = end_s.max(centre + pulse.half_s());
    }
    // The motion has all but ended after `end_s`: a fifth and eight seconds
    // more, at least 20 s.
    let duration_s = (lead_s + 1.2 * end_s + 8.0).ceil();
    let duration_s = duration_s.clamp(20.0, LONGEST_S);
    let n = (duration_s / DT_S).round() as usize + 1;
    let [first, second] = envelopes.map(|e| nodes_of(n, e.d5_75_s));
    let common = shared.normals(first.max(second));
    let from = ((lead_s + pulse_s) / DT_S).round() as usize;
    let component = |k: usize, role: Role| {
        let mut draws = Deviates::new(seed, stream(role));
        let noise = Noise {
            envelope: &envelopes[k],
            common: &common,
            rate_hz_s,
            corner_hz: corner_hz(target.scenario.mw),
            lead_s,
            samples: n,
        };
        let pulse = target.pulse.as_ref().map(|pulse| {
            let mut samples = pulse.samples()[k].clone();
            samples.truncate(n - from);
            let hz = 1.0 / pulse.period_s;
            Packet { hz, cut: None, from, samples }
        });
        let packets = noise.packets(&mut draws);
        matched(packets, pulse, &target.components[k], n)
    };
    [component(0, Role::First), component(1, Role::Second)]
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

/// Ingredients of the noise of one component.
struct Noise<'a> {
    envelope: &'a Envelope,
    /// Fluctuation that the components share, one value a node.
    common: &'a [f64],
    /// Rate of the frequency content.
    rate_hz_s: f64,
    corner_hz: f64,
    /// Time before the envelope begins, in s.
    lead_s: f64,
    samples: usize,
}

impl Noise<'_> {
    /// The bands, cut into packets.
    fn packets(&self, draws: &mut Deviates) -> Vec<Packet> {
        let sample = |share| {
            let t = self.lead_s + self.envelope.time_s(share);
            (t / DT_S).round() as usize
        };
        let cuts = CUTS.map(sample);
        let apart_s = (cuts[3] - cuts[0]) as f64 * DT_S / CUTS.len() as f64;
        let mut packets = Vec::new();
        for (band, samples) in self.bands(draws).into_iter().enumerate() {
            let hz = band_hz(band);
            if !(hz * apart_s > 1.0) {
                packets.push(Packet { hz, cut: None, from: 0, samples });
                continue;
            }
            for cut in 0..CUTS.len() {
                let before = cut.checked_sub(1).map(|k| cuts[k]);
                let after = cuts.get(cut + 1);
                let from = before.unwrap_or(0);
                let to = after.copied().unwrap_or(samples.len());
                let weight = |i: usize| match (before, after) {
                    (Some(low), _) if i < cuts[cut] => {
                        rise(i - low, cuts[cut] - low)
                    }
                    (_, Some(high)) if i >= cuts[cut] => {
                        1.0 - rise(i - cuts[cut], high - cuts[cut])
                    }
                    _ => 1.0,
                };
                let samples =
                    (from..to).map(|i| weight(i) * samples[i]).collect();
                packets.push(Packet { hz, cut: Some(cut), from, samples });
            }
        }
        packets
    }

    /// Noise of each band with a mean square of 1: white noise under the
    /// envelope and both fluctuations, filtered, high-passed.
    fn bands(&self, draws: &mut Deviates) -> Vec<Vec<f64>> {
        let n = self.samples;
        let time_s = |i: usize| i as f64 * DT_S - self.lead_s;
        let envelope: Vec<f64> =
            (0..n).map(|i| self.envelope.value(time_s(i))).collect();
        let ends = [0.01, 0.45, 0.99].map(|p| self.envelope.time_s(p));
        let content_hz = |t: f64| {
            let since_s = t.clamp(ends[0], ends[2]) - ends[1];
            let hz = FILTER_HZ + self.rate_hz_s * since_s;
            hz.max(LEAST_HZ)
        };
        let content: Vec<f64> =
            (0..n).map(|i| content_hz(time_s(i))).collect();
        let spacing_s = FLUCTUATION_TIME * self.envelope.d5_75_s;
        // Between two nodes the weights are cosine and sine of one angle,
        // so that the variance is 1 throughout.
        let place = |i: usize| {
            let place = i as f64 * DT_S / spacing_s;
            let node = place as usize;
            let (sin, cos) = libm::sincos(FRAC_PI_2 * (place - node as f64));
            (node, cos, sin)
        };
        let places: Vec<(usize, f64, f64)> = (0..n).map(place).collect();
        let nodes = nodes_of(n, self.envelope.d5_75_s);
        let [shared, own] = FLUCTUATION;
        let band = |band| {
            let mut values = draws.normals(nodes);
            for (z, c) in values.iter_mut().zip(self.common) {
                *z = own * *z + shared * c;
            }
            let mut x = draws.normals(n);
            let hz = band_hz(band);
            for (i, x) in x.iter_mut().enumerate() {
                let (node, cos, sin) = places[i];
                let ln = cos * values[node] + sin * values[node + 1];
                let gain = filter_gain(hz, content[i]);
                *x *= envelope[i] * gain * libm::exp(ln);
            }
            resonate(x.iter_mut(), hz);
            resonate(x.iter_mut().rev(), hz);
            high_pass(&mut x, self.corner_hz);
            let squares = x.iter().fold(0.0, |s, a| s + a * a);
            let scale = 1.0 / (squares / n as f64).sqrt();
            x.iter_mut().for_each(|a| *a *= scale);
            x
        };
        (0..BANDS).map(band).collect()
    }
}

/// Half a wave of a cosine from 0 to 1 over `all` samples.
fn rise(sample: usize, all: usize) -> f64 {
    0.5 - 0.5 * libm::cos(PI * sample as f64 / all as f64)
}

/// Amplitude at `hz` of white noise passed through the filter of frequency
/// `centre_hz` and scaled to a variance that does not depend on it.
fn filter_gain(hz: f64, centre_hz: f64) -> f64 {
    let apart = centre_hz * centre_hz - hz * hz;
    let damped = 2.0 * FILTER_DAMPING * centre_hz * hz;
    let cube = centre_hz * centre_hz * centre_hz;
    (cube / (apart * apart + damped * damped)).sqrt()
}

/// Centre frequency of a band, in Hz.
fn band_hz(band: usize) -> f64 {
    let [low, high] = BAND_ENDS_HZ.map(libm::log);
    let share = band as f64 / (BANDS - 1) as f64;
    libm::exp(low + (high - low) * share)
}

/// Passes samples through a damped oscillator's velocity, sampled by impulse
/// invariance.
fn resonate<'a>(samples: impl Iterator<Item = &'a mut f64>, hz: f64) {
    let w = 2.0 * PI * hz * DT_S;
    let decay = libm::exp(-BAND_DAMPING * w);
    let turn = libm::cos(w * (1.0 - BAND_DAMPING * BAND_DAMPING).sqrt());
    let (c1, c2) = (2.0 * decay * turn, decay * decay);
    let (mut y1, mut y2, mut x1) = (0.0, 0.0, 0.0);
    for x in samples {
        let y = *x - x1 + c1 * y1 - c2 * y2;
        x1 = *x;
        (y2, y1) = (y1, y);
        *x = y;
    }
}

/// Waves of a band about an instant, or the whole band.
struct Packet {
    /// Centre frequency of the band.
    hz: f64,
    /// Which of the [`CUTS`].
    cut: Option<usize>,
    /// Place of the first sample in the motion.
    from: usize,
    samples: Vec<f64>,
}

impl Packet {
    /// Sum of products with `weights`, of which the last is for sample `at`.
    fn product(&self, weights: &[f64], at: usize) -> f64 {
        let first = at + 1 - weights.len();
        let from = first.max(self.from);
        let to = (at + 1).min(self.from + self.samples.len());
        if from >= to {
            return 0.0;
        }
        product(
            &weights[from - first..to - first],
            &self.samples[from - self.from..to - self.from],
        )
    }

    /// Correlation of the corrections of two packets.
    fn alike(&self, other: &Self) -> f64 {
        let apart = libm::log(self.hz / other.hz).abs();
        let same = if self.cut == other.cut { 1.0 } else { CORRECTION_APART };
        same * libm::exp(-apart / CORRECTION_WIDTH)
    }
}

/// The motion of `n` samples with these amplitudes.
fn sum(packets: &[Packet], ln_gains: &[f64], n: usize) -> Vec<f64> {
    let mut out = vec![0.0; n];
    for (packet, gain) in packets.iter().zip(ln_gains) {
        let gain = libm::exp(*gain);
        for (sum, x) in out[packet.from..].iter_mut().zip(&packet.samples) {
            *sum += gain * x;
        }
    }
    out
}

/// Sum of the packets whose amplitudes are corrected until it is near the
/// target in PGA, response spectrum and PGV.
///
/// Each of these is the largest value of a quantity that is linear in the
/// amplitudes, so that its derivatives are the values of the packets at the
/// instant of that value. A correction is the least change of the amplitudes'
/// logarithms that removes the difference, as far as the equations are
/// definite (Levenberg-Marquardt).
fn matched(
    mut packets: Vec<Packet>,
    pulse: Option<Packet>,
    target: &[f64; QUANTITIES],
    n: usize,
) -> Vec<f64> {
    let peaks: Vec<Peak> = (0..=PGV).map(Peak::of).collect();
    let mut pulse_gain = 0.0;
    // The noise begins with the rest after the pulse.
    let mut left = *target;
    if let Some(pulse) = &pulse {
        let sizes: Vec<f64> =
            peaks.iter().map(|p| p.found(&pulse.samples).size).collect();
        let room = target[PGV] - libm::log(sizes[PGV]);
        pulse_gain = room.min(0.0);
        for (left, size) in left.iter_mut().zip(&sizes) {
            let share = libm::exp(libm::log(*size) + pulse_gain - *left);
            let rest = 1.0 - share * share;
            *left += 0.5 * libm::log(rest.max(0.1));
        }
    }
    let first = |packet: &Packet| {
        let x = -libm::log(packet.hz);
        // Above 10 Hz spectra of acceleration fall.
        let above = 3.0 * (-libm::log(10.0) - x);
        read_off(&left, x) - above.max(0.0)
    };
    let mut ln_gains: Vec<f64> = packets.iter().map(first).collect();
    let size = peaks[0].found(&sum(&packets, &ln_gains, n)).size;
    for gain in &mut ln_gains {
        *gain += left[0] - libm::log(size);
    }
    if let Some(pulse) = pulse {
        packets.push(pulse);
        ln_gains.push(pulse_gain);
    }
    let alike = |a: &Packet| packets.iter().map(|b| a.alike(b)).collect();
    let prior: Vec<Vec<f64>> = packets.iter().map(alike).collect();
    let mut best = (f64::INFINITY, Vec::new());
    for round in 0..=CORRECTIONS {
        stop::point();
        let samples = sum(&packets, &ln_gains, n);
        let found: Vec<SamplePeak> =
            peaks.iter().map(|peak| peak.found(&samples)).collect();
        let both = found.iter().zip(target);
        let missed = both.map(|(peak, due)| due - libm::log(peak.size));
        let missed: Vec<f64> = missed.collect();
        let total = missed.iter().enumerate().fold(0.0, |sum, (k, m)| {
            sum + (m / softness(k)) * (m / softness(k))
        });
        if total < best.0 {
            best = (total, samples);
        }
        if round == CORRECTIONS {
            break;
        }
        let slopes = |(peak, found): (&Peak, &SamplePeak)| {
            let weights = peak.weights(found);
            let slope = |(packet, gain): (&Packet, &f64)| {
                if !(packet.hz < peak.highest_hz()) {
                    return 0.0;
                }
                let share = packet.product(&weights, found.at);
                libm::exp(*gain) * share / found.size
            };
            packets.iter().zip(&ln_gains).map(slope).collect()
        };
        let slopes: Vec<Vec<f64>> =
            peaks.iter().zip(&found).map(slopes).collect();
        let spread =
            |row: &Vec<f64>| prior.iter().map(|p| product(p, row)).collect();
        let spread: Vec<Vec<f64>> = slopes.iter().map(spread).collect();
        let weights = solved(&slopes, &spread, &missed);
        for (b, gain) in ln_gains.iter_mut().enumerate() {
            let rows = spread.iter().zip(&weights);
            let step = rows.fold(0.0, |sum, (row, w)| sum + row[b] * w);
            *gain += step.clamp(-LARGEST_CORRECTION, LARGEST_CORRECTION);
        }
    }
    best.1
}

/// Standard deviation with which quantity `k` is met.
fn softness(k: usize) -> f64 {
    match k {
        0 | PGV => SOFTNESS[1],
        _ if PERIODS_S[k] < 3.0 => SOFTNESS[0],
        _ => SOFTNESS[2],
    }
}

/// Solves (J C J' + D) x = m, where `slopes` is J, `spread` J C, and D has the
/// squares of the softness: by the Cholesky factor of the matrix whose
/// diagonal is scaled to 1.
fn solved(slopes: &[Vec<f64>], spread: &[Vec<f64>], m: &[f64]) -> Vec<f64> {
    let n = m.len();
    let scale = |k: usize| {
        let soft = softness(k);
        1.0 / (soft * soft + product(&spread[k], &slopes[k])).sqrt()
    };
    let scale: Vec<f64> = (0..n).map(scale).collect();
    let entry = |k: usize, j: usize| {
        scale[k] * scale[j] * product(&spread[k], &slopes[j])
    };
    let row = |k| (0..k).map(|j| entry(k, j)).collect();
    let lower: Vec<Vec<f64>> = (0..n).map(row).collect();
    // Definite because D is.
    let factor = cholesky(&lower).unwrap_or_default();
    let mut x: Vec<f64> = Vec::with_capacity(n);
    for (k, row) in factor.iter().enumerate() {
        let rest = scale[k] * m[k] - dot(row, &x);
        x.push(rest / row[k]);
    }
    for k in (0..x.len()).rev() {
        let rest = (k + 1..x.len()).fold(x[k], |r, j| r - factor[j][k] * x[j]);
        x[k] = rest / factor[k][k];
    }
    x.iter().zip(&scale).map(|(x, s)| x * s).collect()
}

/// Value at a period by values at the periods of the target, linear in
/// the logarithm of the period, constant beyond the ends; PGA as at 0.04 s.
fn read_off(values: &[f64], ln_period: f64) -> f64 {
    let place = |k: usize| match k {
        0 => libm::log(0.04),
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

/// Sum of products of two slices of one length, in eight parts, which is
/// several times as fast as in order.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    let mut parts = [0.0; 8];
    for (a, b) in a.iter().zip(b) {
        for k in 0..8 {
            parts[k] += a[k] * b[k];
        }
    }
    let rest = a_rest.iter().zip(b_rest).fold(0.0, |s, (a, b)| s + a * b);
    parts.iter().fold(rest, |s, part| s + part)
}
