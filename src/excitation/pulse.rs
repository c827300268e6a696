//! Analytic pulses.

mod bound;
mod kind;
mod peaks;

pub use kind::{PulseError, PulseKind, PulseName, PulseParameter};

use crate::number::{Number, Real};
use peaks::gauss;

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
    /// What the amplitude is to be divided by: 1, or gravity in m/s2. Kept
    /// apart because the quotient is rounded in the precision of the run.
    divisor: f64,
}

/// A smooth stretch of a pulse, as the integrator expands it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape<N> {
    /// Sum of `amplitude * sin(rate * t + phase)`, t from the pulse's start.
    Sines([Sine<N>; 3]),
    /// `at_zero + slope * t`.
    Line { at_zero: N, slope: N },
    /// `scale * (q0 + q1 x + q2 x^2 + q3 x^3) exp(-x^2/2)`,
    /// x = rate * (t - centre), with small integers q.
    Gauss { scale: N, polynomial: [f64; 4], rate: N, centre_s: N },
}

/// One sine of a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sine<N> {
    pub amplitude: N,
    pub rate_rad_s: N,
    pub phase_rad: N,
}

impl<N: Number> Sine<N> {
    fn silent() -> Self {
        let zero = N::zero();
        Self { amplitude: zero, rate_rad_s: zero, phase_rad: zero }
    }
}

/// Peak of (x^2 - 3) x exp(-x^2/2): sqrt(6) sqrt(3 - sqrt(6))
/// exp(-(3 - sqrt(6))/2) = 1.380119...
fn ricker_beta<N: Real>() -> N {
    let root = N::from_f64(6.0).sqrt();
    let square = N::from_f64(3.0) - root;
    root * square.sqrt() * (-(square * N::ratio(1, 2))).exp()
}

/// pi, in the precision of the type.
fn half_turn<N: Real>() -> N {
    N::from_f64(2.0) * N::right_angle()
}

/// 2 pi, in the precision of the type.
fn full_turn<N: Real>() -> N {
    N::from_f64(4.0) * N::right_angle()
}

impl Pulse {
    /// Checks the parameters.
    ///
    /// # Errors
    /// [`PulseError`] for an amplitude or phase that is not finite, and for a
    /// frequency, period, duration or count that is not positive.
    pub fn try_new(kind: PulseKind) -> Result<Self, PulseError> {
        let finite = |a: f64| {
            if a.is_finite() { Ok(()) } else { Err(PulseError::Amplitude(a)) }
        };
        let positive = |what, x: f64| {
            if x > 0.0 && x.is_finite() {
                Ok(())
            } else {
                Err(PulseError::NotPositive { what, found: x })
            }
        };
        match kind {
            PulseKind::OneSine { amplitude, omega_rad_s }
            | PulseKind::HalfSine { amplitude, omega_rad_s }
            | PulseKind::OneCosine { amplitude, omega_rad_s } => {
                finite(amplitude)?;
                positive("circular frequency", omega_rad_s)?;
            }
            PulseKind::Rectangle { amplitude, duration_s }
            | PulseKind::Triangle { amplitude, duration_s } => {
                finite(amplitude)?;
                positive("duration", duration_s)?;
            }
            PulseKind::RickerSymmetric { amplitude, period_s, cycles }
            | PulseKind::RickerAntisymmetric { amplitude, period_s, cycles } =>
            {
                finite(amplitude)?;
                positive("period", period_s)?;
                positive("number of cycles", cycles)?;
            }
            PulseKind::MavroeidisPapageorgiou {
                velocity,
                frequency_hz,
                gamma,
                phase_rad,
            } => {
                finite(velocity)?;
                positive("frequency", frequency_hz)?;
                positive("gamma", gamma)?;
                if !phase_rad.is_finite() {
                    return Err(PulseError::Phase(phase_rad));
                }
            }
        }
        Ok(Self { kind, divisor: 1.0 })
    }

    /// A pulse with its acceleration in m/s2, or its velocity in m/s, where
    /// `kind` has multiples of gravity.
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
    #[must_use]
    pub fn kind(&self) -> PulseKind {
        self.kind.with_amplitude(self.kind.amplitude() / self.divisor)
    }

    /// Amplitude over gravity.
    fn amplitude<N: Number>(&self) -> N {
        N::from_f64(self.kind.amplitude()) / N::from_f64(self.divisor)
    }

    /// The same pulse with every acceleration times `factor`.
    ///
    /// # Errors
    /// [`PulseError::Amplitude`] if the product is not finite.
    pub fn scaled(&self, factor: f64) -> Result<Self, PulseError> {
        let kind = self.kind();
        Self::try_new(kind.with_amplitude(kind.amplitude() * factor))
    }

    /// The same pulse scaled to a peak ground acceleration over g; where the
    /// amplitude is the peak, to the last bit.
    ///
    /// # Errors
    /// [`PulseError::Amplitude`] if the amplitude is not finite, as for a
    /// pulse of amplitude zero.
    pub fn with_pga(&self, pga_g: f64) -> Result<Self, PulseError> {
        let own = self.pga_g();
        let mut kind = self.kind();
        match &mut kind {
            PulseKind::OneSine { amplitude: a, .. }
            | PulseKind::HalfSine { amplitude: a, .. }
            | PulseKind::OneCosine { amplitude: a, .. }
            | PulseKind::Rectangle { amplitude: a, .. }
            | PulseKind::Triangle { amplitude: a, .. }
            | PulseKind::RickerSymmetric { amplitude: a, .. }
                if own > 0.0 =>
            {
                *a = pga_g.copysign(*a);
                Self::try_new(kind)
            }
            _ => self.scaled(pga_g / own),
        }
    }

    /// Duration in s.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.duration()
    }

    fn duration<N: Real>(&self) -> N {
        match self.kind {
            PulseKind::OneSine { omega_rad_s, .. }
            | PulseKind::OneCosine { omega_rad_s, .. } => {
                full_turn::<N>() / N::from_f64(omega_rad_s)
            }
            PulseKind::HalfSine { omega_rad_s, .. } => {
                half_turn::<N>() / N::from_f64(omega_rad_s)
            }
            PulseKind::Rectangle { duration_s, .. }
            | PulseKind::Triangle { duration_s, .. } => {
                N::from_f64(duration_s)
            }
            PulseKind::RickerSymmetric { period_s, cycles, .. }
            | PulseKind::RickerAntisymmetric { period_s, cycles, .. } => {
                N::from_f64(cycles) * N::from_f64(period_s)
            }
            PulseKind::MavroeidisPapageorgiou {
                frequency_hz, gamma, ..
            } => N::from_f64(gamma) / N::from_f64(frequency_hz),
        }
    }

    /// Smooth stretches: where each ends (s) and its shape.
    pub(crate) fn stretches<N: Real>(&self) -> Vec<(N, Shape<N>)> {
        let end: N = self.duration();
        let amplitude: N = self.amplitude();
        let half = N::ratio(1, 2);
        let sine = |amplitude, rate_rad_s, phase_rad| Sine {
            amplitude,
            rate_rad_s,
            phase_rad,
        };
        let only = |sine| Shape::Sines([sine, Sine::silent(), Sine::silent()]);
        match self.kind {
            PulseKind::OneSine { omega_rad_s, .. }
            | PulseKind::HalfSine { omega_rad_s, .. } => {
                let rate = N::from_f64(omega_rad_s);
                vec![(end, only(sine(amplitude, rate, N::zero())))]
            }
            PulseKind::OneCosine { omega_rad_s, .. } => {
                let rate = N::from_f64(omega_rad_s);
                vec![(end, only(sine(amplitude, rate, N::right_angle())))]
            }
            PulseKind::Rectangle { .. } => {
                let shape =
                    Shape::Line { at_zero: amplitude, slope: N::zero() };
                vec![(end, shape)]
            }
            PulseKind::Triangle { .. } => {
                let twice = N::from_f64(2.0) * amplitude;
                let slope = twice / end;
                let up = Shape::Line { at_zero: N::zero(), slope };
                let down = Shape::Line { at_zero: twice, slope: -slope };
                vec![(half * end, up), (end, down)]
            }
            PulseKind::RickerSymmetric { period_s, .. } => {
                let root = N::from_f64(2.0).sqrt();
                let shape = Shape::Gauss {
                    scale: amplitude,
                    polynomial: [1.0, 0.0, -1.0, 0.0],
                    rate: root * half_turn() / N::from_f64(period_s),
                    centre_s: half * end,
                };
                vec![(end, shape)]
            }
            PulseKind::RickerAntisymmetric { period_s, .. } => {
                let root = N::from_f64(3.0).sqrt();
                let shape = Shape::Gauss {
                    scale: amplitude / ricker_beta(),
                    polynomial: [0.0, -3.0, 0.0, 1.0],
                    rate: full_turn::<N>() / (root * N::from_f64(period_s)),
                    centre_s: half * end,
                };
                vec![(end, shape)]
            }
            PulseKind::MavroeidisPapageorgiou {
                frequency_hz,
                gamma,
                phase_rad,
                ..
            } => {
                // a = -V W { sin(W u + nu)/2
                //   + (1 + 1/gamma)/4 sin(W (1 + 1/gamma) u + nu)
                //   + (1 - 1/gamma)/4 sin(W (1 - 1/gamma) u + nu) },
                // u = t - gamma/(2 f), hence phases nu - W k gamma/(2 f).
                let [frequency, gamma, phase] =
                    [frequency_hz, gamma, phase_rad].map(N::from_f64);
                let rate = full_turn::<N>() * frequency;
                let middle = half * gamma / frequency;
                let term = |weight: N, ratio: N| {
                    let own = rate * ratio;
                    sine(
                        -amplitude * rate * weight,
                        own,
                        (-own).mul_add(middle, phase),
                    )
                };
                let quarter = N::ratio(1, 4);
                let up = N::one() + N::one() / gamma;
                let down = N::one() - N::one() / gamma;
                let terms = [
                    term(half, N::one()),
                    term(quarter * up, up),
                    term(quarter * down, down),
                ];
                vec![(end, Shape::Sines(terms))]
            }
        }
    }

    /// Acceleration over g at `t_s`; zero outside the pulse.
    #[must_use]
    pub fn acceleration_g(&self, t_s: f64) -> f64 {
        if !(t_s >= 0.0) {
            return 0.0;
        }
        self.stretches::<f64>()
            .into_iter()
            .find(|(end_s, _)| t_s <= *end_s)
            .map_or(0.0, |(_, shape)| shape.at(t_s))
    }
}

impl Shape<f64> {
    fn at(&self, t_s: f64) -> f64 {
        match self {
            Shape::Sines(sines) => sines.iter().fold(0.0, |sum, sine| {
                let angle = sine.rate_rad_s.mul_add(t_s, sine.phase_rad);
                sine.amplitude.mul_add(libm::sin(angle), sum)
            }),
            Shape::Line { at_zero, slope } => slope.mul_add(t_s, *at_zero),
            Shape::Gauss { scale, polynomial: q, rate, centre_s } => {
                let x = rate * (t_s - centre_s);
                let sum = q[3].mul_add(x, q[2]).mul_add(x, q[1]);
                scale * sum.mul_add(x, q[0]) * gauss(x)
            }
        }
    }
}
