//! Settings of the measures.

use super::{IntensityError, Oscillator};
use rocking::units::STANDARD_GRAVITY_M_S2;

/// Default periods of the response spectrum, in s.
pub const DEFAULT_PERIODS_S: [f64; 7] = [0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0];

/// Gravity, and damping and periods of the response spectrum.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    gravity_m_s2: f64,
    damping_ratio: f64,
    periods_s: Vec<f64>,
}

impl Default for Settings {
    /// Standard gravity, 5 % of critical damping, [`DEFAULT_PERIODS_S`].
    fn default() -> Self {
        Self {
            gravity_m_s2: STANDARD_GRAVITY_M_S2,
            damping_ratio: 0.05,
            periods_s: DEFAULT_PERIODS_S.to_vec(),
        }
    }
}

/// The shortest period of an oscillator, in s.
pub(crate) const LEAST_PERIOD_S: f64 = 1e-3;

impl Settings {
    /// Settings by their values; the list of periods may be empty.
    ///
    /// # Errors
    /// [`IntensityError`] for gravity that is not positive and finite, a
    /// period that is not finite or below 0.001 s, or a damping ratio outside
    /// 0 to below 1.
    pub fn try_new(
        gravity_m_s2: f64,
        damping_ratio: f64,
        periods_s: Vec<f64>,
    ) -> Result<Self, IntensityError> {
        if !(gravity_m_s2 > 0.0 && gravity_m_s2.is_finite()) {
            return Err(IntensityError::Gravity(gravity_m_s2));
        }
        if !(0.0..1.0).contains(&damping_ratio) {
            return Err(IntensityError::Damping(damping_ratio));
        }
        let fits = |t: &f64| *t >= LEAST_PERIOD_S && t.is_finite();
        if let Some(wrong) = periods_s.iter().find(|t| !fits(t)) {
            return Err(IntensityError::Period(*wrong));
        }
        Ok(Self { gravity_m_s2, damping_ratio, periods_s })
    }

    /// Gravity in m/s2.
    pub fn gravity_m_s2(&self) -> f64 {
        self.gravity_m_s2
    }

    /// Damping ratio of the response spectrum.
    pub fn damping_ratio(&self) -> f64 {
        self.damping_ratio
    }

    /// Periods of the response spectrum in s.
    pub fn periods_s(&self) -> &[f64] {
        &self.periods_s
    }

    pub(super) fn oscillators(&self, dt_s: f64) -> Vec<Oscillator> {
        self.periods_s
            .iter()
            .map(|period| Oscillator::new(*period, self.damping_ratio, dt_s))
            .collect()
    }
}
