//! Shapes of pulses and their parameters.

use thiserror::Error;

use crate::names::named;

/// Shape of a pulse. The constructor says in which unit its amplitude is:
/// multiples of gravity for [`Pulse::try_new`](super::Pulse::try_new), m/s2
/// for [`Pulse::try_new_si`](super::Pulse::try_new_si) (a velocity: gravity
/// times s, or m/s).
///
/// Every pulse starts at t = 0 and is zero afterwards (a jump, if it does not
/// end at zero).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PulseKind {
    /// a sin(omega t) for one full period.
    OneSine {
        /// Peak acceleration.
        amplitude: f64,
        /// Circular frequency in rad/s.
        omega_rad_s: f64,
    },
    /// a sin(omega t) for half a period.
    HalfSine {
        /// Peak acceleration.
        amplitude: f64,
        /// Circular frequency in rad/s.
        omega_rad_s: f64,
    },
    /// a cos(omega t) for one full period.
    OneCosine {
        /// Peak acceleration.
        amplitude: f64,
        /// Circular frequency in rad/s.
        omega_rad_s: f64,
    },
    /// Constant a.
    Rectangle {
        /// Acceleration.
        amplitude: f64,
        /// Duration in s.
        duration_s: f64,
    },
    /// Isosceles triangle.
    Triangle {
        /// Peak acceleration, at half the duration.
        amplitude: f64,
        /// Duration in s.
        duration_s: f64,
    },
    /// a (1 - x^2) exp(-x^2/2), x = sqrt(2) pi (t - t_c)/T, over `cycles`
    /// periods T about the centre t_c.
    RickerSymmetric {
        /// Peak acceleration.
        amplitude: f64,
        /// Period T in s.
        period_s: f64,
        /// Length in periods.
        cycles: f64,
    },
    /// (a / beta) (x^2 - 3) x exp(-x^2/2), x = 2 pi (t - t_c)/(sqrt(3) T),
    /// with beta = 1.38 such that the peak is a.
    RickerAntisymmetric {
        /// Peak acceleration.
        amplitude: f64,
        /// Period T in s.
        period_s: f64,
        /// Length in periods.
        cycles: f64,
    },
    /// Derivative of the velocity
    /// (V/2) (1 + cos(2 pi f u/gamma)) cos(2 pi f u + nu), with
    /// u = t - gamma/(2 f) and |u| <= gamma/(2 f).
    MavroeidisPapageorgiou {
        /// Velocity amplitude V.
        velocity: f64,
        /// Prevailing frequency f in Hz.
        frequency_hz: f64,
        /// Oscillatory character gamma.
        gamma: f64,
        /// Phase nu in rad.
        phase_rad: f64,
    },
}

/// A parameter of a [`PulseKind`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PulseParameter {
    /// Amplitude of the acceleration.
    Amplitude,
    /// Circular frequency in rad/s.
    Omega,
    /// Duration in s.
    Duration,
    /// Period in s.
    Period,
    /// Length in periods.
    Cycles,
    /// Amplitude of the velocity.
    Velocity,
    /// Prevailing frequency in Hz.
    Frequency,
    /// Oscillatory character gamma.
    Gamma,
    /// Phase in rad.
    Phase,
}

/// Makes [`PulseName`] of a table: variant, name, fields and parameters.
macro_rules! pulses {
    ($($kind:ident = $name:literal {
        $($field:ident: $parameter:ident),+
    },)+) => {
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
            /// That of `value`.
            pub fn kind<E>(
                self,
                mut value: impl FnMut(PulseParameter) -> Result<f64, E>,
            ) -> Result<PulseKind, E> {
                Ok(match self {
                    $(Self::$kind => PulseKind::$kind {
                        $($field: value(PulseParameter::$parameter)?),+
                    }),+
                })
            }

            /// Its parameters, as [`kind`](Self::kind) asks for them.
            #[must_use]
            pub fn parameters(self) -> &'static [PulseParameter] {
                match self {
                    $(Self::$kind => &[$(PulseParameter::$parameter),+]),+
                }
            }
        }
    };
}

pulses! {
    OneSine = "one-sine" { amplitude: Amplitude, omega_rad_s: Omega },
    HalfSine = "half-sine" { amplitude: Amplitude, omega_rad_s: Omega },
    OneCosine = "one-cosine" { amplitude: Amplitude, omega_rad_s: Omega },
    Rectangle = "rectangle" { amplitude: Amplitude, duration_s: Duration },
    Triangle = "triangle" { amplitude: Amplitude, duration_s: Duration },
    RickerSymmetric = "ricker-symmetric" {
        amplitude: Amplitude, period_s: Period, cycles: Cycles
    },
    RickerAntisymmetric = "ricker-antisymmetric" {
        amplitude: Amplitude, period_s: Period, cycles: Cycles
    },
    MavroeidisPapageorgiou = "mavroeidis-papageorgiou" {
        velocity: Velocity, frequency_hz: Frequency, gamma: Gamma,
        phase_rad: Phase
    },
}

/// Why a pulse was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PulseError {
    /// Amplitudes must be finite.
    #[error("pulse amplitude {0}: expected a finite number")]
    Amplitude(f64),
    /// Frequencies, periods, durations and cycles must be positive.
    #[error("pulse {what} {found}: expected a positive number")]
    NotPositive {
        /// The quantity.
        what: &'static str,
        /// What was given.
        found: f64,
    },
    /// The phase must be finite.
    #[error("pulse phase {0} rad: expected a finite number")]
    Phase(f64),
    /// Gravity must be positive and finite.
    #[error("gravity {0} m/s2: expected a positive number")]
    Gravity(f64),
}

impl PulseKind {
    /// The amplitude: an acceleration, or a velocity.
    pub fn amplitude_mut(&mut self) -> &mut f64 {
        match self {
            Self::OneSine { amplitude: a, .. }
            | Self::HalfSine { amplitude: a, .. }
            | Self::OneCosine { amplitude: a, .. }
            | Self::Rectangle { amplitude: a, .. }
            | Self::Triangle { amplitude: a, .. }
            | Self::RickerSymmetric { amplitude: a, .. }
            | Self::RickerAntisymmetric { amplitude: a, .. }
            | Self::MavroeidisPapageorgiou { velocity: a, .. } => a,
        }
    }

    /// The amplitude.
    pub(super) fn amplitude(mut self) -> f64 {
        *self.amplitude_mut()
    }

    /// The same with another amplitude.
    pub(super) fn with_amplitude(mut self, amplitude: f64) -> Self {
        *self.amplitude_mut() = amplitude;
        self
    }
}
