//! Pulse-type motions: the near-fault model of Dabaghi and Der Kiureghian,
//! a velocity pulse plus a filtered-noise residual.

mod coefficients;

use std::f64::consts::PI;

use coefficients::{CORRELATION, DEVIATION, REGRESSION};

use rocking::statistics::normal;

use rayon::prelude::*;

use crate::draws::{Stream, cholesky, correlate, dot};
use crate::noise::{
    DT_S, Filter, corner_hz, energy, filtered_noise, high_pass,
};
use crate::pair::{
    GRAVITY_M_S2, MOST_DRAWS, PULSE_SEED, Pair, Role, Scenario,
    SynthesisError, finished, stream_index,
};
use crate::special::{beta_quantile, two_sided_exponential_quantile};

/// Pairs of the suite.
const PAIRS: u64 = 44;

/// All pairs, each with streams of its own. A pair that the model's limits or
/// the least PGA refuse is drawn again with the next streams.
pub(super) fn suite() -> Result<Vec<Pair>, SynthesisError> {
    (1..=PAIRS)
        .into_par_iter()
        .panic_fuse()
        .map(|number| {
            for refused in 0..MOST_DRAWS {
                let stream = |role| stream_index(number, refused, role);
                let scenario = scenario(PULSE_SEED, stream);
                if let Some(samples) = pair(&scenario, PULSE_SEED, stream)
                    && let Some(components) =
                        finished("pulse", number, samples)?
                {
                    return Ok(Pair { components, scenario, refused });
                }
            }
            Err(SynthesisError::Weak { suite: PULSE_SEED, pair: number })
        })
        .collect()
}

/// Earthquake and site.
fn scenario(seed: &str, stream: impl Fn(Role) -> u64) -> Scenario {
    let mut draws = Stream::new(seed, stream(Role::Scenario));
    Scenario {
        earthquake: 0,
        mw: draws.uniform(6.3, 7.6),
        rrup_km: draws.log_uniform(1.0, 15.0),
        vs30_m_s: draws.log_uniform(200.0, 760.0),
        reverse: draws.uniform(0.0, 1.0) < 0.5,
        towards_site_km: draws.uniform(5.0, 40.0),
    }
}

/// Length of a record whose motion has all but ended at `end_s`: eight
/// seconds more for the high-pass filter to come to rest, at least 20 s;
/// `None` above a minute.
fn duration_s(end_s: f64) -> Option<f64> {
    let wanted = (end_s + 8.0).ceil();
    if !(wanted <= 60.0) {
        None
    } else if wanted < 20.0 {
        Some(20.0)
    } else {
        Some(wanted)
    }
}

/// The modified Mavroeidis-Papageorgiou velocity pulse (Dabaghi and Der
/// Kiureghian 2014): the pulse of 2003 less a bump that takes its residual
/// displacement away.
#[derive(Clone, Copy, Debug)]
struct Pulse {
    amplitude_m_s: f64,
    period_s: f64,
    gamma: f64,
    phase_rad: f64,
    peak_s: f64,
}

impl Pulse {
    /// Ground acceleration at `t`, in m/s2.
    fn acceleration_m_s2(&self, t: f64) -> f64 {
        let tau = t - self.peak_s;
        if !(tau.abs() < 0.5 * self.gamma * self.period_s) {
            return 0.0;
        }
        let w = 2.0 * PI / self.period_s;
        let envelope_w = w / self.gamma;
        let carrier = w * tau + self.phase_rad;
        let left = 0.5 * self.amplitude_m_s * libm::cos(carrier)
            - self.residual_m() / (self.gamma * self.period_s);
        let left_rate = -0.5 * self.amplitude_m_s * w * libm::sin(carrier);
        left_rate * (1.0 + libm::cos(envelope_w * tau))
            - left * envelope_w * libm::sin(envelope_w * tau)
    }

    /// Residual displacement of the pulse of 2003, in m.
    fn residual_m(&self) -> f64 {
        let turn = PI * self.gamma;
        self.amplitude_m_s * self.period_s
            / (4.0 * PI * (1.0 - self.gamma * self.gamma))
            * (libm::sin(self.phase_rad + turn)
                - libm::sin(self.phase_rad - turn))
    }
}

/// Modulating function: a power of time up to `peak_s`, then an
/// exponential decay.
#[derive(Clone, Copy, Debug)]
struct Modulation {
    /// 2 alpha + 1, the exponent of the energy.
    exponent: f64,
    peak_s: f64,
    /// 2 beta, decay rate of the energy.
    decay_per_s: f64,
}

impl Modulation {
    /// The function whose energy reaches 5, 30 and 95 % closest to the three
    /// times, by least squares as in the source. For given exponent and
    /// share of energy before the peak the times are proportional to the
    /// time of the peak, so that two unknowns are left: found on a grid that
    /// shrinks about its best point.
    fn fit(times_s: [f64; 3]) -> Self {
        let (mut ln_exponent, mut share) = (1.5, 0.5);
        let (mut wide_ln, mut wide_share) = (1.5, 0.48);
        let mut best = (f64::INFINITY, Self::unit(1.0, 0.5));
        for _ in 0..12 {
            let centre = (ln_exponent, share);
            for i in -8..=8 {
                for j in -8..=8 {
                    let x = centre.0 + wide_ln * f64::from(i) / 8.0;
                    let y = centre.1 + wide_share * f64::from(j) / 8.0;
                    if !(x >= 0.0 && (0.01..=0.99).contains(&y)) {
                        continue;
                    }
                    let mut m = Self::unit(libm::exp(x), y);
                    let at = [0.05, 0.3, 0.95].map(|s| m.time_s(s));
                    m.stretch(dot(&times_s, &at) / dot(&at, &at));
                    let miss = m.miss(times_s);
                    if miss < best.0 {
                        best = (miss, m);
                        (ln_exponent, share) = (x, y);
                    }
                }
            }
            wide_ln *= 0.4;
            wide_share *= 0.4;
        }
        best.1
    }

    /// The function whose peak is at 1 s, from its exponent and the share
    /// of the energy that comes before the peak.
    fn unit(exponent: f64, before: f64) -> Self {
        let decay_per_s = exponent * before / (1.0 - before);
        Self { exponent, peak_s: 1.0, decay_per_s }
    }

    /// Multiplies all times by `factor`.
    fn stretch(&mut self, factor: f64) {
        self.peak_s *= factor;
        self.decay_per_s /= factor;
    }

    /// Sum of the squared differences to the three times.
    fn miss(&self, times_s: [f64; 3]) -> f64 {
        let at = [0.05, 0.3, 0.95].map(|s| self.time_s(s));
        times_s
            .iter()
            .zip(&at)
            .fold(0.0, |sum, (t, a)| sum + (t - a) * (t - a))
    }

    /// Time at which `share` of the energy has come, in s.
    fn time_s(&self, share: f64) -> f64 {
        let rise = self.peak_s / self.exponent;
        let fall = 1.0 / self.decay_per_s;
        let before = rise / (rise + fall);
        if share <= before {
            let root = libm::log(share / before) / self.exponent;
            self.peak_s * libm::exp(root)
        } else {
            self.peak_s + fall * libm::log((1.0 - before) / (1.0 - share))
        }
    }

    /// Value at `t`, 1 at the peak.
    fn value(&self, t: f64) -> f64 {
        if !(t > 0.0) {
            0.0
        } else if t < self.peak_s {
            let alpha = 0.5 * (self.exponent - 1.0);
            libm::exp(alpha * libm::log(t / self.peak_s))
        } else {
            libm::exp(-0.5 * self.decay_per_s * (t - self.peak_s))
        }
    }
}

/// The seven parameters of one component's residual.
struct Residual {
    intensity_s: f64,
    modulation: Modulation,
    mid_hz: f64,
    slope_hz_s: f64,
    damping: f64,
}

impl Residual {
    /// From the seven transformed parameters.
    fn physical(u: &[f64]) -> Option<Self> {
        let (d5_95, t5, t30) =
            (libm::exp(u[1]), libm::exp(u[2]), libm::exp(u[3]));
        let t95 = t5 + d5_95;
        if !(t5 < t30 && t30 < t95) {
            return None;
        }
        let ln_damping = -4.7
            + 4.7
                * beta_quantile(normal::cdf(u[6]), 5.335_519_36, 3.829_548_44);
        let damping = libm::exp(ln_damping);
        let modulation = Modulation::fit([t5, t30, t95]);
        // The model's intensity is in cm/s.
        Some(Self {
            intensity_s: libm::exp(u[0]) / 980.665,
            modulation,
            mid_hz: libm::exp(u[4]),
            slope_hz_s: two_sided_exponential_quantile(
                normal::cdf(u[5]),
                (14.293_553_72, 6.402_423_76, 4.421_795_88),
                (-3.5, 1.5),
            ),
            damping,
        })
    }

    /// Samples in g of the residual, with exactly its Arias intensity.
    fn samples(&self, noise: &[f64], mw: f64) -> Vec<f64> {
        let m = &self.modulation;
        let filter = Filter {
            mid_hz: self.mid_hz,
            slope_hz_s: self.slope_hz_s,
            damping: self.damping,
            mid_s: m.time_s(0.3),
            between_s: (m.time_s(0.01), m.time_s(0.99)),
        };
        let mut samples = filtered_noise(noise, &filter);
        for (k, a) in samples.iter_mut().enumerate() {
            *a *= m.value(k as f64 * DT_S);
        }
        high_pass(&mut samples, corner_hz(mw));
        let scale = (self.intensity_s / energy(&samples)).sqrt();
        for a in &mut samples {
            *a *= scale;
        }
        samples
    }
}

/// Mean of the 19 transformed parameters for a scenario.
fn mean(scenario: &Scenario) -> Vec<f64> {
    let ln_r = 0.5 * libm::log(scenario.rrup_km * scenario.rrup_km + 36.0);
    let above = scenario.mw - 6.5;
    let regressors = [
        1.0,
        scenario.mw,
        if above > 0.0 { above } else { 0.0 },
        ln_r,
        scenario.mw * ln_r,
        if scenario.reverse { 1.0 } else { 0.0 },
        libm::log(scenario.vs30_m_s),
        scenario.towards_site_km,
    ];
    REGRESSION.iter().map(|row| dot(row, &regressors)).collect()
}

/// Both components of one motion along two perpendicular directions that
/// make a random angle with the pulse, or `None` where the model's own
/// limits refuse the parameters drawn.
pub(super) fn pair(
    scenario: &Scenario,
    suite: &str,
    stream: impl Fn(Role) -> u64,
) -> Option<[Vec<f64>; 2]> {
    let factor = cholesky(&CORRELATION)?;
    let mut draws = Stream::new(suite, stream(Role::Parameters));
    let errors = correlate(&factor, &draws.normals(19));
    // The model is truncated at two standard deviations.
    if errors.iter().any(|e| !(e.abs() <= 2.0)) {
        return None;
    }
    let u: Vec<f64> = mean(scenario)
        .iter()
        .zip(&errors)
        .zip(&DEVIATION)
        .map(|((mean, e), sd)| sd.mul_add(*e, *mean))
        .collect();
    let gamma = 2.0
        + 1.2 * beta_quantile(normal::cdf(u[2]), 1.303_261_78, 3.968_580_84);
    let pulse = Pulse {
        amplitude_m_s: libm::exp(u[0]) / 100.0,
        period_s: libm::exp(u[1]),
        gamma,
        phase_rad: 2.0 * PI * normal::cdf(u[3]),
        peak_s: libm::exp(u[4]),
    };
    let half = 0.5 * pulse.gamma * pulse.period_s;
    if !(pulse.peak_s >= half) {
        return None;
    }
    let along = Residual::physical(&u[5..12])?;
    let across = Residual::physical(&u[12..19])?;
    let mut end = pulse.peak_s + half;
    for t in [along.modulation.time_s(0.99), across.modulation.time_s(0.99)] {
        if t > end {
            end = t;
        }
    }
    let duration_s = duration_s(end)?;
    let n = (duration_s / DT_S).round() as usize + 1;
    let noise = |role| Stream::new(suite, stream(role)).normals(n);
    let mut first = along.samples(&noise(Role::First), scenario.mw);
    let mut second = across.samples(&noise(Role::Second), scenario.mw);
    let (sin, cos) = libm::sincos(draws.uniform(0.0, 2.0 * PI));
    for (k, (a, b)) in first.iter_mut().zip(&mut second).enumerate() {
        let with_pulse =
            *a + pulse.acceleration_m_s2(k as f64 * DT_S) / GRAVITY_M_S2;
        let other = *b;
        *a = cos * with_pulse - sin * other;
        *b = sin * with_pulse + cos * other;
    }
    Some([first, second])
}

#[cfg(test)]
mod tests;
