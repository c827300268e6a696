//! What a declared case puts before an engine.
//!
//! The equation, the criterion and the kind of a pulse are the core's types,
//! which are data alone. What a pulse's acceleration is, and where it ends,
//! is computed here anew.
//!
//! Engines (the core behind its public interface, the naive integrator) all
//! read the same [`Scene`] and answer with the same [`Trace`].

use std::f64::consts::{PI, TAU};
use std::slice;

pub use rocking::excitation::PulseKind;
pub use rocking::integrator::{Impact, Model, Overturning};
use thiserror::Error;

/// Ground acceleration in m/s2, from t = 0, zero after its end.
#[derive(Clone, Debug, PartialEq)]
pub enum Forcing {
    /// None; the block is released at rest at this rotation (rad).
    Free {
        /// Initial rotation in rad.
        rotation_rad: f64,
    },
    /// A pulse, its amplitude in m/s2 or m/s.
    Pulse(PulseKind),
    /// Equally spaced samples, linear between them.
    Samples {
        /// Interval in s.
        dt_s: f64,
        /// Samples in m/s2.
        acceleration_m_s2: Vec<f64>,
    },
}

/// A block, what moves it, and what ends the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Slenderness angle alpha in rad.
    pub slenderness_rad: f64,
    /// Frequency parameter p in rad/s.
    pub frequency_rad_s: f64,
    /// Coefficient of restitution eta.
    pub restitution: f64,
    /// Gravity in m/s2.
    pub gravity_m_s2: f64,
    /// Equation of motion.
    pub model: Model,
    /// What ends the run.
    pub overturning: Overturning,
    /// Ground acceleration.
    pub forcing: Forcing,
    /// Where the run stops at the latest, s; none: at rest or overturning.
    pub until_s: Option<f64>,
}

/// What an engine saw.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Trace {
    /// First start from rest, s.
    pub uplift_s: Option<f64>,
    /// Number of starts from rest.
    pub uplifts: usize,
    /// Sign of theta after the first uplift.
    pub first_side: f64,
    /// Impacts in order.
    pub impacts: Vec<Impact>,
    /// Largest |theta|/alpha; infinite where the criterion was met.
    pub peak_ratio: f64,
    /// When, s; none where the block did not move or overturned.
    pub peak_time_s: Option<f64>,
    /// When the criterion was met, s.
    pub overturned_s: Option<f64>,
    /// When rocking died out for good, s.
    pub rest_s: Option<f64>,
}

/// Why an engine gave no trace.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EngineError {
    /// The scene is refused by the code under test.
    #[error("scene refused: {0}")]
    Refused(String),
    /// The run takes more work than is allowed.
    #[error("{0}")]
    Work(String),
    /// The run came to no end.
    #[error("no end after {steps} steps, at t = {time_s} s")]
    NoEnd {
        /// Steps done.
        steps: usize,
        /// Time reached in s.
        time_s: f64,
    },
}

/// Something that answers scenes.
pub trait Engine: Sync {
    /// Runs a scene.
    ///
    /// # Errors
    /// [`EngineError`] when no trace can be given.
    fn respond(&self, scene: &Scene) -> Result<Trace, EngineError>;
}

impl Scene {
    /// A block (alpha in rad, p in rad/s, g in m/s2) of a restitution in
    /// Eq. 1, until it rests or reaches alpha.
    #[must_use]
    pub fn new(
        [slenderness_rad, frequency_rad_s, gravity_m_s2]: [f64; 3],
        restitution: f64,
        forcing: Forcing,
    ) -> Self {
        Self {
            slenderness_rad,
            frequency_rad_s,
            restitution,
            gravity_m_s2,
            model: Model::Nonlinear,
            overturning: Overturning::Alpha,
            forcing,
            until_s: None,
        }
    }

    /// Uplift threshold in m/s2: g tan(alpha) in Eq. 1, g alpha in Eq. 2.
    #[must_use]
    pub fn threshold_m_s2(&self) -> f64 {
        let group = match self.model {
            Model::Nonlinear => libm::tan(self.slenderness_rad),
            Model::Linearized => self.slenderness_rad,
        };
        self.gravity_m_s2 * group
    }

    /// Rotation that ends the run, rad.
    #[must_use]
    pub fn limit_rad(&self) -> f64 {
        match self.overturning {
            Overturning::Alpha => self.slenderness_rad,
            Overturning::HalfPi => PI / 2.0,
        }
    }
}

/// Peak of (x^2 - 3) x exp(-x^2/2).
#[must_use]
pub fn ricker_beta() -> f64 {
    let r = 3.0 - 6.0_f64.sqrt();
    6.0_f64.sqrt() * r.sqrt() * libm::exp(-0.5 * r)
}

/// The other equation of motion.
#[must_use]
pub fn other(model: Model) -> Model {
    match model {
        Model::Nonlinear => Model::Linearized,
        Model::Linearized => Model::Nonlinear,
    }
}

/// A pulse on a block with p = 1 rad/s, as it acts on one with this p; its
/// acceleration is multiplied by `unit`.
#[must_use]
pub fn rescaled(mut pulse: PulseKind, unit: f64, p: f64) -> PulseKind {
    use PulseKind as P;
    *pulse.amplitude_mut() *= unit;
    match &mut pulse {
        P::OneSine { omega_rad_s, .. }
        | P::HalfSine { omega_rad_s, .. }
        | P::OneCosine { omega_rad_s, .. } => *omega_rad_s *= p,
        P::Rectangle { duration_s, .. } | P::Triangle { duration_s, .. } => {
            *duration_s /= p;
        }
        P::RickerSymmetric { period_s, .. }
        | P::RickerAntisymmetric { period_s, .. } => *period_s /= p,
        P::MavroeidisPapageorgiou { velocity, frequency_hz, .. } => {
            *velocity /= p;
            *frequency_hz *= p;
        }
        _ => *pulse.amplitude_mut() = f64::NAN,
    }
    pulse
}

/// Acceleration of a pulse at `t_s`, in the unit of its amplitude.
fn pulse_at(pulse: PulseKind, piece: usize, t_s: f64) -> f64 {
    match pulse {
        PulseKind::OneSine { amplitude, omega_rad_s }
        | PulseKind::HalfSine { amplitude, omega_rad_s } => {
            amplitude * libm::sin(omega_rad_s * t_s)
        }
        PulseKind::OneCosine { amplitude, omega_rad_s } => {
            amplitude * libm::cos(omega_rad_s * t_s)
        }
        PulseKind::Rectangle { amplitude, .. } => amplitude,
        PulseKind::Triangle { amplitude, duration_s } => {
            let half = 0.5 * duration_s;
            let rise = if piece == 0 { t_s } else { duration_s - t_s };
            amplitude * rise / half
        }
        PulseKind::RickerSymmetric { amplitude, period_s, cycles } => {
            let u = t_s - 0.5 * cycles * period_s;
            let x = 2.0_f64.sqrt() * PI * u / period_s;
            amplitude * (1.0 - x * x) * libm::exp(-0.5 * x * x)
        }
        PulseKind::RickerAntisymmetric { amplitude, period_s, cycles } => {
            let u = t_s - 0.5 * cycles * period_s;
            let x = TAU * u / (3.0_f64.sqrt() * period_s);
            let bell = libm::exp(-0.5 * x * x);
            amplitude * (x * x - 3.0) * x * bell / ricker_beta()
        }
        PulseKind::MavroeidisPapageorgiou {
            velocity,
            frequency_hz,
            gamma,
            phase_rad,
        } => {
            let w = TAU * frequency_hz;
            let u = t_s - 0.5 * gamma / frequency_hz;
            let up = 1.0 + 1.0 / gamma;
            let down = 1.0 - 1.0 / gamma;
            let sum = 0.5 * libm::sin(w * u + phase_rad)
                + 0.25 * up * libm::sin(w * up * u + phase_rad)
                + 0.25 * down * libm::sin(w * down * u + phase_rad);
            -velocity * w * sum
        }
        _ => f64::NAN,
    }
}

impl Forcing {
    /// A block at rest, and no ground motion.
    pub const NONE: Self = Self::Free { rotation_rad: 0.0 };

    /// Numbers in proportion to which the motion is: the rotation, the
    /// amplitude of a pulse, or the samples.
    pub fn amplitudes_mut(&mut self) -> &mut [f64] {
        match self {
            Self::Free { rotation_rad } => slice::from_mut(rotation_rad),
            Self::Pulse(kind) => slice::from_mut(kind.amplitude_mut()),
            Self::Samples { acceleration_m_s2, .. } => acceleration_m_s2,
        }
    }

    /// End of the ground motion, s.
    #[must_use]
    pub fn end_s(&self) -> f64 {
        use PulseKind as P;
        match self {
            Self::Free { .. } => 0.0,
            Self::Pulse(P::HalfSine { omega_rad_s, .. }) => PI / omega_rad_s,
            Self::Pulse(
                P::OneSine { omega_rad_s, .. }
                | P::OneCosine { omega_rad_s, .. },
            ) => TAU / omega_rad_s,
            Self::Pulse(
                P::Rectangle { duration_s, .. }
                | P::Triangle { duration_s, .. },
            ) => *duration_s,
            Self::Pulse(
                P::RickerSymmetric { period_s, cycles, .. }
                | P::RickerAntisymmetric { period_s, cycles, .. },
            ) => cycles * period_s,
            Self::Pulse(P::MavroeidisPapageorgiou {
                frequency_hz,
                gamma,
                ..
            }) => gamma / frequency_hz,
            Self::Pulse(_) => f64::NAN,
            Self::Samples { dt_s, acceleration_m_s2 } => {
                (acceleration_m_s2.len() - 1) as f64 * dt_s
            }
        }
    }

    /// Instants between which the acceleration is smooth and, as far as
    /// closed forms say, monotone; from 0 to the end.
    #[must_use]
    pub fn pieces_s(&self) -> Vec<f64> {
        use PulseKind as P;
        let end = self.end_s();
        let mut at = vec![0.0];
        let mut quarters = |count: u32, omega_rad_s: f64| {
            for k in 1..count {
                at.push(f64::from(k) * 0.5 * PI / omega_rad_s);
            }
        };
        match *self {
            Self::Pulse(P::HalfSine { omega_rad_s, .. }) => {
                quarters(2, omega_rad_s);
            }
            Self::Pulse(
                P::OneSine { omega_rad_s, .. }
                | P::OneCosine { omega_rad_s, .. },
            ) => quarters(4, omega_rad_s),
            Self::Pulse(P::Triangle { duration_s, .. }) => {
                at.push(0.5 * duration_s);
            }
            Self::Pulse(P::RickerSymmetric { period_s, .. }) => {
                let rate = 2.0_f64.sqrt() * PI / period_s;
                let x = 3.0_f64.sqrt();
                at.extend([-x, 0.0, x].map(|x| 0.5 * end + x / rate));
            }
            Self::Pulse(P::RickerAntisymmetric { period_s, .. }) => {
                let rate = TAU / (3.0_f64.sqrt() * period_s);
                let r = 6.0_f64.sqrt();
                let (far, near) = ((3.0 + r).sqrt(), (3.0 - r).sqrt());
                let turns = [-far, -near, near, far];
                at.extend(turns.map(|x| 0.5 * end + x / rate));
            }
            Self::Pulse(P::MavroeidisPapageorgiou { .. }) => {
                at.extend((1..256).map(|k| f64::from(k) / 256.0 * end));
            }
            Self::Samples { dt_s, ref acceleration_m_s2 } => {
                let last = acceleration_m_s2.len() - 1;
                at.extend((1..last).map(|i| i as f64 * dt_s));
            }
            Self::Free { .. } | Self::Pulse(_) => {}
        }
        at.push(end);
        at.retain(|t| *t >= 0.0 && *t <= end);
        at.dedup();
        at
    }

    /// Acceleration in m/s2 at `t_s` inside the piece that starts at
    /// `pieces_s()[piece]`.
    #[must_use]
    pub fn at(&self, piece: usize, t_s: f64) -> f64 {
        match self {
            Self::Free { .. } => 0.0,
            Self::Pulse(kind) => pulse_at(*kind, piece, t_s),
            Self::Samples { dt_s, acceleration_m_s2 } => {
                let a = acceleration_m_s2[piece];
                let b = acceleration_m_s2[piece + 1];
                a + (b - a) * (t_s / dt_s - piece as f64)
            }
        }
    }
}
