//! Analytic pulses.

mod bound;
mod kind;

pub use kind::{PulseError, PulseKind, PulseName, PulseParameter};

use crate::number::Real;
use kind::{PulseForm, Velocity};

/// An analytic pulse, checked.
///
/// ```
/// use rocking::excitation::{Pulse, PulseKind};
/// let pulse = Pulse::try_new(PulseKind::OneSine {
///     amplitude: 0.3,
///     omega_rad_s: 6.0,
/// })?;
/// assert_eq!(pulse.pga_g(), 0.3);
/// // v = (a/omega) (1 - cos(omega t)) peaks at 2 a/omega.
/// assert!((pulse.pgv_g_s() - 0.1).abs() < 1e-15);
/// # Ok::<(), rocking::excitation::PulseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    kind: PulseKind,
    /// Divisor of the amplitude: 1, or gravity in m/s2. It is separate because
    /// the quotient is rounded in the precision of the run.
    divisor: f64,
}

/// A smooth stretch of a pulse, as the integrator expands it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PulseShape<N> {
    /// Sum of `amplitude * sin(rate * t + phase)`, t from the pulse's start.
    Sines([PulseSine<N>; 3]),
    /// `at_zero + slope * t`.
    Line { at_zero: N, slope: N },
    /// `scale * (q0 + q1 x + q2 x^2 + q3 x^3) exp(-x^2/2)`,
    /// x = rate * (t - centre), with small integers q.
    Gauss { scale: N, polynomial: [f64; 4], rate: N, centre_s: N },
}

/// One sine of a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PulseSine<N> {
    pub amplitude: N,
    pub rate_rad_s: N,
    pub phase_rad: N,
}

/// exp(-x^2/2).
fn gauss(x: f64) -> f64 {
    libm::exp(-0.5 * x * x)
}

impl Pulse {
    /// Checks the parameters.
    ///
    /// # Errors
    /// [`PulseError`] for an amplitude or phase that is not finite, and for a
    /// frequency, period, duration or count that is not positive.
    pub fn try_new(mut kind: PulseKind) -> Result<Self, PulseError> {
        for (parameter, value) in kind.parameters_mut() {
            parameter.check(*value)?;
        }
        Ok(Self { kind, divisor: 1.0 })
    }

    /// A pulse whose amplitude is in m/s2 (a velocity: m/s) instead of
    /// multiples of gravity.
    ///
    /// # Errors
    /// As [`Pulse::try_new`], and [`PulseError::Gravity`] unless gravity is
    /// positive and finite.
    ///
    /// ```
    /// use rocking::excitation::{Pulse, PulseKind};
    /// let kind = PulseKind::Rectangle { amplitude: 4.0, duration_s: 0.25 };
    /// let pulse = Pulse::try_new_si(kind, 9.81)?;
    /// assert_eq!(pulse.pga_g(), 4.0 / 9.81);
    /// # Ok::<(), rocking::excitation::PulseError>(())
    /// ```
    pub fn try_new_si(
        kind: PulseKind,
        gravity_m_s2: f64,
    ) -> Result<Self, PulseError> {
        if !(gravity_m_s2 > 0.0 && gravity_m_s2.is_finite()) {
            return Err(PulseError::Gravity(gravity_m_s2));
        }
        Ok(Self { divisor: gravity_m_s2, ..Self::try_new(kind)? })
    }

    /// The shape and its parameters, in multiples of gravity.
    pub fn kind(&self) -> PulseKind {
        self.kind.with_amplitude(self.kind.amplitude() / self.divisor)
    }

    /// The same pulse with every acceleration times `factor`.
    ///
    /// # Errors
    /// [`PulseError::Parameter`] if the product is not finite.
    pub fn scaled(&self, factor: f64) -> Result<Self, PulseError> {
        let kind = self.kind();
        Self::try_new(kind.with_amplitude(kind.amplitude() * factor))
    }

    /// The same pulse scaled to a peak ground acceleration over g: to the last
    /// bit if the amplitude is the peak.
    ///
    /// # Errors
    /// [`PulseError::Parameter`] if the amplitude is not finite, as for a
    /// pulse of amplitude zero.
    pub fn with_pga(&self, pga_g: f64) -> Result<Self, PulseError> {
        let own = self.pga_g();
        let kind = self.kind();
        if !(self.form::<f64>().is_peak && own > 0.0) {
            return self.scaled(pga_g / own);
        }
        Self::try_new(kind.with_amplitude(pga_g.copysign(kind.amplitude())))
    }

    /// The pulse in the form for computation.
    fn form<N: Real>(&self) -> PulseForm<N> {
        let gravity = N::from_f64(self.divisor);
        self.kind.form(N::from_f64(self.kind.amplitude()) / gravity)
    }

    /// Smooth stretches: the end of each (s) and its shape.
    pub(crate) fn stretches<N: Real>(&self) -> Vec<(N, PulseShape<N>)> {
        self.form().stretches
    }

    /// Duration in s.
    pub fn duration_s(&self) -> f64 {
        self.stretches().last().map_or(0.0, |(end_s, _)| *end_s)
    }

    /// Peak ground acceleration over g.
    pub fn pga_g(&self) -> f64 {
        let form = self.form();
        if form.is_peak {
            self.kind().amplitude().abs()
        } else {
            self.extreme(|t_s| form.acceleration_g(t_s))
        }
    }

    /// Peak ground velocity over g in s, with v(0) = 0.
    pub fn pgv_g_s(&self) -> f64 {
        match self.form::<f64>().velocity {
            Velocity::Peak(peak) => peak,
            Velocity::At(velocity) => self.extreme(velocity),
        }
    }

    /// Acceleration over g at `t_s`; zero outside the pulse.
    pub fn acceleration_g(&self, t_s: f64) -> f64 {
        self.form().acceleration_g(t_s)
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

impl PulseForm<f64> {
    fn acceleration_g(&self, t_s: f64) -> f64 {
        let mut stretches = self.stretches.iter();
        let here = stretches.find(|(end_s, _)| t_s <= *end_s);
        let here = here.filter(|_| t_s >= 0.0);
        here.map_or(0.0, |(_, shape)| shape.at(t_s))
    }
}

impl PulseShape<f64> {
    fn at(&self, t_s: f64) -> f64 {
        match self {
            PulseShape::Sines(sines) => sines.iter().fold(0.0, |sum, sine| {
                let angle = sine.rate_rad_s.mul_add(t_s, sine.phase_rad);
                sine.amplitude.mul_add(libm::sin(angle), sum)
            }),
            PulseShape::Line { at_zero, slope } => {
                slope.mul_add(t_s, *at_zero)
            }
            PulseShape::Gauss { scale, polynomial: q, rate, centre_s } => {
                let x = rate * (t_s - centre_s);
                let sum = q[3].mul_add(x, q[2]).mul_add(x, q[1]);
                scale * sum.mul_add(x, q[0]) * gauss(x)
            }
        }
    }
}
