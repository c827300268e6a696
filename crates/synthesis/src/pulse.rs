//! The velocity pulse of near-fault motions, after Dabaghi and Der
//! Kiureghian.

mod coefficients;

use std::f64::consts::PI;

use coefficients::{CORRELATION, DEVIATION, REGRESSION};

use rocking_statistics::normal;

use crate::draws::{Deviates, cholesky, correlate, dot};
use crate::noise::DT_S;
use crate::pair::{GRAVITY_M_S2, Scenario};
use crate::special::beta_quantile;

/// Errors are cut at this multiple of their standard deviation.
const CUT: f64 = 2.0;

/// The modified Mavroeidis-Papageorgiou velocity pulse (Dabaghi and Der
/// Kiureghian 2014): the pulse of 2003 less a bump that takes its residual
/// displacement away.
#[derive(Clone, Copy, Debug)]
pub(super) struct PulseModel {
    amplitude_m_s: f64,
    /// Period, in s.
    pub(super) period_s: f64,
    gamma: f64,
    phase_rad: f64,
    /// Time of the envelope's peak after that at which 30 % of the energy of
    /// the other waves has come, in s.
    pub(super) delay_s: f64,
    /// Angle between the pulse and the first component.
    angle_rad: f64,
}

impl PulseModel {
    /// The pulse of a scenario, along two perpendicular directions that make
    /// a random angle with it.
    pub(super) fn draw(scenario: &Scenario, draws: &mut Deviates) -> Self {
        // Definite for these constants, as a test checks.
        let factor = cholesky(&CORRELATION).unwrap_or_default();
        let errors = correlate(&factor, &draws.normals(CORRELATION.len()));
        let mut u = mean(scenario);
        for ((u, e), sd) in u.iter_mut().zip(&errors).zip(&DEVIATION) {
            *u = sd.mul_add(e.clamp(-CUT, CUT), *u);
        }
        let gamma =
            beta_quantile(normal::cdf(u[2]), 1.303_261_78, 3.968_580_84);
        Self {
            amplitude_m_s: libm::exp(u[0]) / 100.0,
            period_s: libm::exp(u[1]),
            gamma: 2.0 + 1.2 * gamma,
            phase_rad: 2.0 * PI * normal::cdf(u[3]),
            delay_s: libm::exp(u[4]) - libm::exp(u[5]),
            angle_rad: draws.uniform(0.0, 2.0 * PI),
        }
    }

    /// Half of its duration, in s.
    pub(super) fn half_s(&self) -> f64 {
        0.5 * self.gamma * self.period_s
    }

    /// Samples in g along both components, from `half_s` before its peak.
    pub(super) fn samples(&self) -> [Vec<f64>; 2] {
        let n = (2.0 * self.half_s() / DT_S).ceil() as usize;
        let (sin, cos) = libm::sincos(self.angle_rad);
        [cos, sin].map(|part| {
            let part = part / GRAVITY_M_S2;
            (0..n).map(|k| part * self.acceleration_m_s2(k)).collect()
        })
    }

    /// Ground acceleration at sample `k`, in m/s2.
    fn acceleration_m_s2(&self, k: usize) -> f64 {
        let tau = k as f64 * DT_S - self.half_s();
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

/// Mean of the transformed parameters for a scenario.
fn mean(scenario: &Scenario) -> Vec<f64> {
    let ln_r = 0.5 * libm::log(scenario.rrup_km * scenario.rrup_km + 36.0);
    let above = scenario.mw - 6.5;
    let regressors = [
        1.0,
        scenario.mw,
        if above > 0.0 { above } else { 0.0 },
        ln_r,
        if scenario.reverse { 1.0 } else { 0.0 },
        libm::log(scenario.vs30_m_s),
        scenario.towards_site_km,
    ];
    REGRESSION.iter().map(|row| dot(row, &regressors)).collect()
}

#[cfg(test)]
mod tests;
