//! The pulses and their parameters. A row and an arm of `form` have everything
//! about a pulse.
//!
//! No pulse here has a jump between stretches (`PulseForcing::exceedance`),
//! and its pieces have equal length (`Driver::time`). A further [`PulseShape`]
//! needs `at`, a bound (`bound`, proof P8), and its `shape_series` and `count`
//! in `integrator::forcing`.

use thiserror::Error;

use super::{PulseShape, PulseSine, gauss};
use crate::names::named;
use crate::number::Real;

named! {
    /// A parameter of a [`PulseKind`]; its name has its SI unit.
    pub enum PulseParameter: "pulse parameter" {
        /// Amplitude of the acceleration.
        Amplitude = "amplitude-m-s2",
        /// Circular frequency in rad/s.
        Omega = "omega-rad-s",
        /// Duration in s.
        Duration = "duration-s",
        /// Period in s.
        Period = "period-s",
        /// Length in periods.
        Cycles = "cycles",
        /// Amplitude of the velocity.
        Velocity = "velocity-m-s",
        /// Prevailing frequency in Hz.
        Frequency = "frequency-hz",
        /// Oscillatory character gamma.
        Gamma = "gamma",
        /// Phase in rad.
        Phase = "phase-rad",
    }
}

impl PulseParameter {
    /// Quantity, SI unit, and name if accelerations are multiples of gravity,
    /// as in Python.
    const fn row(self) -> [&'static str; 3] {
        match self {
            Self::Amplitude => ["peak acceleration", "m/s2", "amplitude_g"],
            Self::Omega => ["circular frequency", "rad/s", "omega"],
            Self::Duration => ["duration", "s", "duration"],
            Self::Period => ["period", "s", "period"],
            Self::Cycles => ["cycles", "", "cycles"],
            Self::Velocity => ["velocity amplitude", "m/s", "velocity_g_s"],
            Self::Frequency => ["prevailing frequency", "Hz", "frequency_hz"],
            Self::Gamma => ["oscillatory character gamma", "", "gamma"],
            Self::Phase => ["phase", "rad", "phase_rad"],
        }
    }

    /// The quantity, as messages and help texts name it.
    pub const fn quantity(self) -> &'static str {
        self.row()[0]
    }

    /// SI unit; empty if there is none.
    pub const fn unit(self) -> &'static str {
        self.row()[1]
    }

    /// Name if accelerations are multiples of gravity.
    pub const fn name_over_gravity(self) -> &'static str {
        self.row()[2]
    }

    /// Default value, if there is one.
    pub const fn default_value(self) -> Option<f64> {
        match self {
            Self::Cycles => Some(4.0),
            _ => None,
        }
    }

    /// Refuses a value out of range.
    pub(super) fn check(self, value: f64) -> Result<(), PulseError> {
        let is_signed =
            matches!(self, Self::Amplitude | Self::Velocity | Self::Phase);
        if value.is_finite() && (is_signed || value > 0.0) {
            return Ok(());
        }
        let expected = if is_signed { "finite" } else { "positive" };
        let what = self.quantity();
        Err(PulseError::Parameter { what, found: value, expected })
    }
}

/// Makes [`PulseKind`] and [`PulseName`] of a table: variant, name, fields
/// and parameters. The first field is the amplitude.
macro_rules! pulses {
    ($($(#[$about:meta])+ $kind:ident = $name:literal {
        $(#[$of_first:meta])+ $first:ident: $amplitude:ident
        $(, $(#[$of_field:meta])+ $field:ident: $parameter:ident)* $(,)?
    },)+) => {
        /// Shape of a pulse. The constructor says in which unit its amplitude
        /// is: multiples of gravity for
        /// [`Pulse::try_new`](super::Pulse::try_new), m/s2 for
        /// [`Pulse::try_new_si`](super::Pulse::try_new_si) (a velocity:
        /// gravity times s, or m/s).
        ///
        /// Every pulse starts at t = 0 and is zero afterwards (a jump, if it
        /// does not end at zero).
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        pub enum PulseKind {
            $($(#[$about])+ $kind {
                $(#[$of_first])+ $first: f64,
                $($(#[$of_field])+ $field: f64),*
            },)+
        }

        impl PulseKind {
            /// The amplitude: an acceleration, or a velocity.
            pub fn amplitude_mut(&mut self) -> &mut f64 {
                match self {
                    $(Self::$kind { $first, .. } => $first,)+
                }
            }

            /// Its parameters with their values, the amplitude first.
            pub fn parameters_mut(
                &mut self,
            ) -> Vec<(PulseParameter, &mut f64)> {
                match self {
                    $(Self::$kind { $first, $($field),* } => vec![
                        (PulseParameter::$amplitude, $first),
                        $((PulseParameter::$parameter, $field)),*
                    ],)+
                }
            }
        }

        named! {
            /// The name of a [`PulseKind`], without its parameters.
            ///
            /// ```
            /// use rocking::excitation::{
            ///     PulseKind, PulseName, PulseParameter,
            /// };
            /// let name: PulseName = "one-sine".parse()?;
            /// let kind = name.kind(|parameter| match parameter {
            ///     PulseParameter::Amplitude => Ok(0.3),
            ///     PulseParameter::Omega => Ok(6.0),
            ///     other => Err(format!("{name} has no {other:?}")),
            /// })?;
            /// let (amplitude, omega_rad_s) = (0.3, 6.0);
            /// let sine = PulseKind::OneSine { amplitude, omega_rad_s };
            /// assert_eq!(kind, sine);
            /// # Ok::<(), Box<dyn std::error::Error>>(())
            /// ```
            #[non_exhaustive]
            pub enum PulseName: "pulse" {
                $(#[doc = concat!("[`PulseKind::", stringify!($kind), "`].")]
                $kind = $name,)+
            }
        }

        impl PulseName {
            /// The pulse of this name with the values of its parameters.
            ///
            /// # Errors
            /// The error of `value`.
            pub fn kind<E>(
                self,
                mut value: impl FnMut(PulseParameter) -> Result<f64, E>,
            ) -> Result<PulseKind, E> {
                Ok(match self {
                    $(Self::$kind => PulseKind::$kind {
                        $first: value(PulseParameter::$amplitude)?,
                        $($field: value(PulseParameter::$parameter)?),*
                    },)+
                })
            }

            /// Its parameters, in the order of [`kind`](Self::kind).
            pub fn parameters(self) -> &'static [PulseParameter] {
                use PulseParameter as P;
                match self {
                    $(Self::$kind => &[P::$amplitude, $(P::$parameter),*],)+
                }
            }
        }
    };
}

pulses! {
    /// a sin(omega t) for one full period.
    OneSine = "one-sine" {
        /// Peak acceleration.
        amplitude: Amplitude,
        /// Circular frequency in rad/s.
        omega_rad_s: Omega,
    },
    /// a sin(omega t) for half a period.
    HalfSine = "half-sine" {
        /// Peak acceleration.
        amplitude: Amplitude,
        /// Circular frequency in rad/s.
        omega_rad_s: Omega,
    },
    /// a cos(omega t) for one full period.
    OneCosine = "one-cosine" {
        /// Peak acceleration.
        amplitude: Amplitude,
        /// Circular frequency in rad/s.
        omega_rad_s: Omega,
    },
    /// Constant a.
    Rectangle = "rectangle" {
        /// Acceleration.
        amplitude: Amplitude,
        /// Duration in s.
        duration_s: Duration,
    },
    /// Isosceles triangle.
    Triangle = "triangle" {
        /// Peak acceleration, at half the duration.
        amplitude: Amplitude,
        /// Duration in s.
        duration_s: Duration,
    },
    /// a (1 - x^2) exp(-x^2/2), x = sqrt(2) pi (t - t_c)/T, over `cycles`
    /// periods T about the centre t_c.
    RickerSymmetric = "ricker-symmetric" {
        /// Peak acceleration.
        amplitude: Amplitude,
        /// Period T in s.
        period_s: Period,
        /// Length in periods.
        cycles: Cycles,
    },
    /// (a / beta) (x^2 - 3) x exp(-x^2/2), x = 2 pi (t - t_c)/(sqrt(3) T),
    /// with beta = 1.38 such that the peak is a.
    RickerAntisymmetric = "ricker-antisymmetric" {
        /// Peak acceleration.
        amplitude: Amplitude,
        /// Period T in s.
        period_s: Period,
        /// Length in periods.
        cycles: Cycles,
    },
    /// Derivative of the velocity
    /// (V/2) (1 + cos(2 pi f u/gamma)) cos(2 pi f u + nu), with
    /// u = t - gamma/(2 f) and |u| <= gamma/(2 f).
    MavroeidisPapageorgiou = "mavroeidis-papageorgiou" {
        /// Velocity amplitude V.
        velocity: Velocity,
        /// Prevailing frequency f in Hz.
        frequency_hz: Frequency,
        /// Oscillatory character gamma.
        gamma: Gamma,
        /// Phase nu in rad.
        phase_rad: Phase,
    },
}

/// Why a pulse was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PulseError {
    /// Amplitudes and phases must be finite; frequencies, periods, durations
    /// and cycles must be positive.
    #[error("pulse {what} {found}: expected a {expected} number")]
    Parameter {
        /// The quantity.
        what: &'static str,
        /// The value.
        found: f64,
        /// Expected kind of number.
        expected: &'static str,
    },
    /// Gravity must be positive and finite.
    #[error("gravity {0} m/s2: expected a positive number")]
    Gravity(f64),
}

/// A pulse in the form for computation; accelerations are multiples of
/// gravity.
pub(super) struct PulseForm<N> {
    /// End (s) and shape of each smooth stretch.
    pub stretches: Vec<(N, PulseShape<N>)>,
    /// True if the amplitude is the peak ground acceleration.
    pub is_peak: bool,
    /// The velocity over gravity, s.
    pub velocity: Velocity,
}

/// The velocity of a pulse, 0 at its start.
pub(super) enum Velocity {
    /// Its peak.
    Peak(f64),
    /// Its value at a time (s).
    At(Box<dyn Fn(f64) -> f64>),
}

/// Peak of (x^2 - 3) x exp(-x^2/2): sqrt(6) sqrt(3 - sqrt(6))
/// exp(-(3 - sqrt(6))/2) = 1.380119...
fn ricker_beta<N: Real>() -> N {
    let root = N::from_f64(6.0).sqrt();
    let square = N::from_f64(3.0) - root;
    root * square.sqrt() * (-(square * N::ratio(1, 2))).exp()
}

impl PulseKind {
    /// The amplitude.
    pub(super) fn amplitude(mut self) -> f64 {
        *self.amplitude_mut()
    }

    /// The pulse with another amplitude.
    pub(super) fn with_amplitude(mut self, amplitude: f64) -> Self {
        *self.amplitude_mut() = amplitude;
        self
    }

    /// The form of the pulse with this amplitude over g.
    pub(super) fn form<N: Real>(&self, amplitude: N) -> PulseForm<N> {
        let size = amplitude.to_f64();
        let half = N::ratio(1, 2);
        let half_turn = N::from_f64(2.0) * N::right_angle();
        let full_turn = N::from_f64(4.0) * N::right_angle();
        let closed = |stretches, peak_velocity| PulseForm {
            stretches,
            is_peak: true,
            velocity: Velocity::Peak(peak_velocity),
        };
        // `share` is the peak velocity times omega over the amplitude.
        let sine = |turn: N, omega_rad_s: f64, phase_rad, share: f64| {
            let rate_rad_s = N::from_f64(omega_rad_s);
            let sine = PulseSine { amplitude, rate_rad_s, phase_rad };
            let silent = PulseSine { amplitude: N::zero(), ..sine };
            let sines = PulseShape::Sines([sine, silent, silent]);
            let stretch = (turn / rate_rad_s, sines);
            closed(vec![stretch], share * size.abs() / omega_rad_s)
        };
        // `integral` is the integral by x of the polynomial times the bell.
        let bell = |[end, rate, scale, beta]: [N; 4],
                    polynomial: [f64; 4],
                    integral: fn(f64) -> f64| {
            let centre_s = half * end;
            let [centre, fast] = [centre_s, rate].map(N::to_f64);
            let speed = size / (beta.to_f64() * fast);
            let first = integral(fast * (0.0 - centre));
            let velocity = move |t_s: f64| {
                speed * (integral(fast * (t_s - centre)) - first)
            };
            let shape =
                PulseShape::Gauss { scale, polynomial, rate, centre_s };
            let velocity = Velocity::At(Box::new(velocity));
            let stretches = vec![(end, shape)];
            PulseForm { stretches, is_peak: false, velocity }
        };
        match *self {
            Self::OneSine { omega_rad_s, .. } => {
                sine(full_turn, omega_rad_s, N::zero(), 2.0)
            }
            Self::HalfSine { omega_rad_s, .. } => {
                sine(half_turn, omega_rad_s, N::zero(), 2.0)
            }
            Self::OneCosine { omega_rad_s, .. } => {
                sine(full_turn, omega_rad_s, N::right_angle(), 1.0)
            }
            Self::Rectangle { duration_s, .. } => {
                let (at_zero, slope) = (amplitude, N::zero());
                let level = PulseShape::Line { at_zero, slope };
                let end = N::from_f64(duration_s);
                closed(vec![(end, level)], size.abs() * duration_s)
            }
            Self::Triangle { duration_s, .. } => {
                let end = N::from_f64(duration_s);
                let twice = N::from_f64(2.0) * amplitude;
                let slope = twice / end;
                let up = PulseShape::Line { at_zero: N::zero(), slope };
                let down = PulseShape::Line { at_zero: twice, slope: -slope };
                let stretches = vec![(half * end, up), (end, down)];
                closed(stretches, 0.5 * size.abs() * duration_s)
            }
            Self::RickerSymmetric { period_s, cycles, .. } => {
                let [period, cycles] = [period_s, cycles].map(N::from_f64);
                let rate = N::from_f64(2.0).sqrt() * half_turn / period;
                let shape = [cycles * period, rate, amplitude, N::one()];
                // (1 - x^2) G = (x G)'.
                let form =
                    bell(shape, [1.0, 0.0, -1.0, 0.0], |x| x * gauss(x));
                PulseForm { is_peak: true, ..form }
            }
            Self::RickerAntisymmetric { period_s, cycles, .. } => {
                let [period, cycles] = [period_s, cycles].map(N::from_f64);
                let rate = full_turn / (N::from_f64(3.0).sqrt() * period);
                let beta = ricker_beta();
                let shape = [cycles * period, rate, amplitude / beta, beta];
                // (x^2 - 3) x G = ((1 - x^2) G)'.
                let integral = |x| (1.0 - x * x) * gauss(x);
                bell(shape, [0.0, -3.0, 0.0, 1.0], integral)
            }
            Self::MavroeidisPapageorgiou {
                frequency_hz: f,
                gamma: g,
                phase_rad: nu,
                ..
            } => {
                // a = -V W { sin(W u + nu)/2
                //   + (1 + 1/gamma)/4 sin(W (1 + 1/gamma) u + nu)
                //   + (1 - 1/gamma)/4 sin(W (1 - 1/gamma) u + nu) },
                // u = t - gamma/(2 f), hence phases nu - W k gamma/(2 f).
                let [frequency, gamma, phase] = [f, g, nu].map(N::from_f64);
                let rate = full_turn * frequency;
                let middle = half * gamma / frequency;
                let term = |weight: N, ratio: N| {
                    let rate_rad_s = rate * ratio;
                    let amplitude = -amplitude * rate * weight;
                    let phase_rad = (-rate_rad_s).mul_add(middle, phase);
                    PulseSine { amplitude, rate_rad_s, phase_rad }
                };
                let quarter = N::ratio(1, 4);
                let up = N::one() + N::one() / gamma;
                let down = N::one() - N::one() / gamma;
                let terms = [
                    term(half, N::one()),
                    term(quarter * up, up),
                    term(quarter * down, down),
                ];
                // It is zero at both ends: 1 + cos(pi) = 0.
                let (w, middle) = (rate.to_f64(), 0.5 * g / f);
                let velocity = move |t_s: f64| {
                    let u = t_s - middle;
                    let envelope = 1.0 + libm::cos(w * u / g);
                    0.5 * size * envelope * libm::cos(w * u + nu)
                };
                let velocity = Velocity::At(Box::new(velocity));
                let shape = PulseShape::Sines(terms);
                let stretches = vec![(gamma / frequency, shape)];
                PulseForm { stretches, is_peak: false, velocity }
            }
        }
    }
}
