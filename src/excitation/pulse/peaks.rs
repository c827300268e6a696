//! Peaks of the acceleration and of the velocity.

use super::{Pulse, PulseKind, Shape, full_turn, ricker_beta};

impl Pulse {
    /// Peak ground acceleration over g.
    #[must_use]
    pub fn pga_g(&self) -> f64 {
        match self.kind() {
            PulseKind::OneSine { amplitude, .. }
            | PulseKind::HalfSine { amplitude, .. }
            | PulseKind::OneCosine { amplitude, .. }
            | PulseKind::Rectangle { amplitude, .. }
            | PulseKind::Triangle { amplitude, .. }
            | PulseKind::RickerSymmetric { amplitude, .. } => amplitude.abs(),
            PulseKind::RickerAntisymmetric { .. }
            | PulseKind::MavroeidisPapageorgiou { .. } => {
                self.extreme(|t| self.acceleration_g(t))
            }
        }
    }

    /// Peak ground velocity over g in s, with v(0) = 0.
    #[must_use]
    pub fn pgv_g_s(&self) -> f64 {
        match self.kind() {
            PulseKind::OneSine { amplitude, omega_rad_s }
            | PulseKind::HalfSine { amplitude, omega_rad_s } => {
                2.0 * amplitude.abs() / omega_rad_s
            }
            PulseKind::OneCosine { amplitude, omega_rad_s } => {
                amplitude.abs() / omega_rad_s
            }
            PulseKind::Rectangle { amplitude, duration_s } => {
                amplitude.abs() * duration_s
            }
            PulseKind::Triangle { amplitude, duration_s } => {
                0.5 * amplitude.abs() * duration_s
            }
            // Antiderivatives of the Gaussian shapes: (1 - x^2) G = (x G)',
            // (x^2 - 3) x G = ((1 - x^2) G)'.
            PulseKind::RickerSymmetric { amplitude, .. } => {
                let x = |t: f64| self.gauss_argument(t);
                let first = x(0.0) * gauss(x(0.0));
                let rate = self.gauss_rate();
                self.extreme(|t| {
                    amplitude / rate * (x(t) * gauss(x(t)) - first)
                })
            }
            PulseKind::RickerAntisymmetric { amplitude, .. } => {
                let x = |t: f64| self.gauss_argument(t);
                let part = |x: f64| (1.0 - x * x) * gauss(x);
                let first = part(x(0.0));
                let scale =
                    amplitude / (ricker_beta::<f64>() * self.gauss_rate());
                self.extreme(|t| scale * (part(x(t)) - first))
            }
            PulseKind::MavroeidisPapageorgiou {
                velocity,
                frequency_hz,
                gamma,
                phase_rad,
            } => {
                let rate = full_turn::<f64>() * frequency_hz;
                let half = 0.5 * gamma / frequency_hz;
                // The velocity is zero at both ends: 1 + cos(pi) = 0.
                self.extreme(|t| {
                    let u = t - half;
                    0.5 * velocity
                        * (1.0 + libm::cos(rate * u / gamma))
                        * libm::cos(rate * u + phase_rad)
                })
            }
        }
    }

    fn gauss_rate(&self) -> f64 {
        match self.stretches::<f64>()[0].1 {
            Shape::Gauss { rate, .. } => rate,
            Shape::Sines(_) | Shape::Line { .. } => 1.0,
        }
    }

    fn gauss_argument(&self, t_s: f64) -> f64 {
        self.gauss_rate() * (t_s - 0.5 * self.duration_s())
    }

    /// Largest absolute value of `f` over the pulse: a fine scan, then
    /// golden-section search about the best point.
    fn extreme(&self, f: impl Fn(f64) -> f64) -> f64 {
        const SCAN: u32 = 20_000;
        let end = self.duration_s();
        let at = |k: u32| end * f64::from(k) / f64::from(SCAN);
        let mut best = 0;
        for k in 0..=SCAN {
            if f(at(k)).abs() > f(at(best)).abs() {
                best = k;
            }
        }
        let mut low = at(best.saturating_sub(1));
        let mut high = at((best + 1).min(SCAN));
        let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
        for _ in 0..60 {
            let left = high - golden * (high - low);
            let right = low + golden * (high - low);
            if f(left).abs() > f(right).abs() {
                high = right;
            } else {
                low = left;
            }
        }
        f(0.5 * (low + high)).abs().max(f(at(best)).abs())
    }
}

pub(super) fn gauss(x: f64) -> f64 {
    libm::exp(-0.5 * x * x)
}
