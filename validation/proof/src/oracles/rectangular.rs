//! Rectangular pulse on the nonlinear block: gravity is turned by
//! psi = atan(a/g), and the motion is that of a pendulum.

use super::carlson::rf;

/// A block (alpha, p) under a constant acceleration `pull` = a/g > tan
/// alpha, from rest; y = |theta|.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangular {
    /// Slenderness angle in rad.
    pub alpha_rad: f64,
    /// Frequency parameter in rad/s.
    pub frequency_rad_s: f64,
    /// Acceleration over g.
    pub pull: f64,
}

impl Rectangular {
    /// The block (alpha in rad, p in rad/s) under `intensity` times tan alpha.
    pub fn new(alpha: f64, p: f64, intensity: f64) -> Self {
        let pull = intensity * libm::tan(alpha);
        Self { alpha_rad: alpha, frequency_rad_s: p, pull }
    }

    /// Time in s at which the pulse has lifted the block to y:
    /// (sqrt(S)/P) R_F(q^2 C, q^2 (1 - q^2), S1 (1 - q^2)), with
    /// delta = psi - alpha, q = sin(delta/2), S1 = sin^2((y + delta)/2),
    /// S = S1 - q^2, C = 1 - S1, P = p (1 + (a/g)^2)^(1/4).
    pub fn time_s(&self, y_rad: f64) -> f64 {
        let delta = libm::atan(self.pull) - self.alpha_rad;
        let turn = (1.0 + self.pull * self.pull).sqrt().sqrt();
        let rate = self.frequency_rad_s * turn;
        let q = libm::sin(0.5 * delta);
        let s1 = libm::sin(0.5 * (y_rad + delta));
        let s1 = s1 * s1;
        // sin^2 a - sin^2 b = sin(a - b) sin(a + b).
        let s = libm::sin(0.5 * y_rad) * libm::sin(0.5 * y_rad + delta);
        let q2 = q * q;
        s.sqrt() / rate * rf(q2 * (1.0 - s1), q2 * (1.0 - q2), s1 * (1.0 - q2))
    }

    /// Duration (s) after which the energy exceeds that of the saddle by
    /// `above` (in units of 1 - cos alpha); for 0 the shortest pulse that
    /// overturns, which lifts the block to alpha - asin[sin alpha - (1 - cos
    /// alpha) g/a].
    pub fn duration_to_energy_s(&self, above: f64) -> f64 {
        let half = libm::sin(0.5 * self.alpha_rad);
        let need = (2.0 * half * half + above) / self.pull;
        let sine = libm::sin(self.alpha_rad) - need;
        self.time_s(self.alpha_rad - libm::asin(sine))
    }
}
