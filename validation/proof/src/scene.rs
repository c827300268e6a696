//! The scene of a reference case, and the result of an engine on it.
//!
//! The equation, the criterion and the kind of a pulse are types of the core
//! that only hold data. `pulse` computes the acceleration and the end of a
//! pulse independently.
//!
//! The engines (the core behind its public interface, the naive integrator)
//! all take a [`CaseScene`] and return a [`Trace`].

use std::convert::Infallible;
use std::f64::consts::FRAC_PI_2;
use std::slice;

use rocking::accelerogram::Accelerogram;
use rocking::excitation::PulseParameter as P;
pub use rocking::excitation::{PulseKind, PulseName};
pub use rocking::integrator::{Impact, Model, Overturning};
use thiserror::Error;

use crate::pulse::{particular, turns};

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

/// A block, its excitation, and the end of the run.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseScene {
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
    /// Criterion of overturning, which ends the run.
    pub overturning: Overturning,
    /// Ground acceleration.
    pub forcing: Forcing,
    /// End of the observation, s; none: the run ends at rest or overturning.
    pub until_s: Option<f64>,
}

/// Result of an engine on a scene.
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
    /// Largest |theta|/alpha; infinite if the criterion was met.
    pub peak_ratio: f64,
    /// Time of the peak, s; none if the block did not move or overturned.
    pub peak_time_s: Option<f64>,
    /// Time at which the criterion was met, s.
    pub overturned_s: Option<f64>,
    /// Time at which rocking died out for good, s.
    pub rest_s: Option<f64>,
}

/// A run that failed.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum EngineError {
    /// The code under test refuses the scene.
    #[error("scene refused: {0}")]
    Refused(String),
    /// The run exceeds the work limit.
    #[error("{0}")]
    Work(String),
}

/// Result of a run by an engine.
pub type EngineResult<T> = Result<T, EngineError>;

/// An integrator that runs scenes.
pub trait Engine: Sync {
    /// Runs a scene.
    ///
    /// # Errors
    /// [`EngineError`] if no trace can be given.
    fn respond(&self, scene: &CaseScene) -> EngineResult<Trace>;
}

impl CaseScene {
    /// A block (alpha in rad, p in rad/s, g in m/s2) of a restitution in
    /// Eq. 1, until it rests or reaches alpha.
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

    /// The block (alpha in rad, p in rad/s) of a restitution at rest, under
    /// 9.81 m/s2.
    pub fn at_rest([alpha, p]: [f64; 2], restitution: f64) -> Self {
        Self::new([alpha, p, 9.81], restitution, Forcing::NONE)
    }

    /// The scene in another equation of motion.
    pub fn in_equation(self, model: Model) -> Self {
        Self { model, ..self }
    }

    /// The scene, ended by a criterion of overturning.
    pub fn to(self, overturning: Overturning) -> Self {
        Self { overturning, ..self }
    }

    /// The scene, observed until this instant (s).
    pub fn until(self, until_s: f64) -> Self {
        Self { until_s: Some(until_s), ..self }
    }

    /// The scene under a ground motion that follows from its uplift
    /// threshold (m/s2).
    pub fn under(self, forcing: impl FnOnce(f64) -> Forcing) -> Self {
        Self { forcing: forcing(self.threshold_m_s2()), ..self }
    }

    /// The scene under samples at an interval (s), scaled to a peak in uplift
    /// thresholds.
    pub fn shaken(self, dt_s: f64, samples: Vec<f64>, peak: f64) -> Self {
        self.under(|threshold| {
            let mut forcing = Forcing::samples(dt_s, samples);
            let own = forcing.peak();
            forcing.scale(peak * threshold / own);
            forcing
        })
    }

    /// The scene with other samples at the same interval.
    pub fn with_samples(&self, samples: Vec<f64>) -> Self {
        let mut scene = self.clone();
        if let Some(own) = scene.forcing.samples_mut() {
            *own = samples;
        }
        scene
    }

    /// Uplift threshold in m/s2: g tan(alpha) in Eq. 1, g alpha in Eq. 2.
    pub fn threshold_m_s2(&self) -> f64 {
        let alpha = self.slenderness_rad;
        self.gravity_m_s2 * by_equation(self.model, libm::tan(alpha), alpha)
    }

    /// Rotation that ends the run, rad.
    pub fn limit_rad(&self) -> f64 {
        by_criterion(self.overturning, self.slenderness_rad, FRAC_PI_2)
    }
}

/// The first value in Eq. 1, the second in Eq. 2.
pub fn by_equation<T>(model: Model, nonlinear: T, linear: T) -> T {
    if model == Model::Nonlinear { nonlinear } else { linear }
}

/// The first value by |theta| >= alpha, the second by |theta| >= pi/2.
pub fn by_criterion<T>(criterion: Overturning, alpha: T, half_pi: T) -> T {
    if criterion == Overturning::Alpha { alpha } else { half_pi }
}

/// The other equation of motion.
pub fn other(model: Model) -> Model {
    by_equation(model, Model::Linearized, Model::Nonlinear)
}

/// The pulse of this name with an amplitude (m/s2 or m/s) and a duration or
/// period (s), or a frequency (rad/s or Hz); its other parameters are 4
/// cycles, gamma 1.5 and phase 0.25.
pub fn pulse(name: PulseName, amplitude: f64, scale: f64) -> PulseKind {
    let Ok(kind) = name.kind(|parameter| {
        Ok::<_, Infallible>(match parameter {
            P::Amplitude | P::Velocity => amplitude,
            P::Omega | P::Duration | P::Period | P::Frequency => scale,
            P::Cycles => 4.0,
            P::Gamma => 1.5,
            P::Phase => 0.25,
        })
    });
    kind
}

impl Forcing {
    /// A block at rest, and no ground motion.
    pub const NONE: Self = Self::Free { rotation_rad: 0.0 };

    /// Samples in m/s2 at an interval (s).
    pub fn samples(dt_s: f64, acceleration_m_s2: Vec<f64>) -> Self {
        Self::Samples { dt_s, acceleration_m_s2 }
    }

    /// A record times a factor (m/s2).
    pub fn record(record: &Accelerogram, factor: f64) -> Self {
        let samples = record.samples_g().iter().map(|a| a * factor);
        Self::samples(record.dt_s(), samples.collect())
    }

    /// The motion of [`pulse`].
    pub fn pulse(name: PulseName, amplitude: f64, scale: f64) -> Self {
        Self::Pulse(self::pulse(name, amplitude, scale))
    }

    /// The samples; none if the motion is no record.
    pub fn samples_mut(&mut self) -> Option<&mut Vec<f64>> {
        match self {
            Self::Samples { acceleration_m_s2, .. } => Some(acceleration_m_s2),
            _ => None,
        }
    }

    /// The largest of the amplitudes, in size.
    pub fn peak(&mut self) -> f64 {
        let all = self.amplitudes_mut().iter();
        all.fold(0.0, |peak, a| peak.max(a.abs()))
    }

    /// Multiplies the motion; a release only changes sides.
    pub fn scale(&mut self, factor: f64) {
        let factor = match self {
            Self::Free { .. } => factor.signum(),
            _ => factor,
        };
        self.amplitudes_mut().iter_mut().for_each(|a| *a *= factor);
    }

    /// The numbers to which the motion is proportional: the rotation, the
    /// amplitude of a pulse, or the samples.
    pub fn amplitudes_mut(&mut self) -> &mut [f64] {
        match self {
            Self::Free { rotation_rad } => slice::from_mut(rotation_rad),
            Self::Pulse(kind) => slice::from_mut(kind.amplitude_mut()),
            Self::Samples { acceleration_m_s2, .. } => acceleration_m_s2,
        }
    }

    /// End of the ground motion, s.
    pub fn end_s(&self) -> f64 {
        match self {
            Self::Free { .. } => 0.0,
            Self::Pulse(kind) => turns(*kind).0,
            Self::Samples { dt_s, acceleration_m_s2 } => {
                (acceleration_m_s2.len() - 1) as f64 * dt_s
            }
        }
    }

    /// Instants between which the acceleration is smooth and, as far as
    /// closed forms say, monotone; from 0 to the end.
    pub fn pieces_s(&self) -> Vec<f64> {
        let end = self.end_s();
        let mut at = vec![0.0];
        match *self {
            Self::Free { .. } => {}
            Self::Pulse(kind) => at.extend(turns(kind).1),
            Self::Samples { dt_s, ref acceleration_m_s2 } => {
                let last = acceleration_m_s2.len() - 1;
                at.extend((1..last).map(|i| i as f64 * dt_s));
            }
        }
        at.push(end);
        at.retain(|t| *t >= 0.0 && *t <= end);
        at.dedup();
        at
    }

    /// Acceleration in m/s2 at `t_s` inside the piece that starts at
    /// `pieces_s()[piece]`.
    pub fn at(&self, piece: usize, t_s: f64) -> f64 {
        match self {
            Self::Free { .. } => 0.0,
            Self::Pulse(kind) => particular(*kind, piece, t_s).a,
            Self::Samples { dt_s, acceleration_m_s2 } => {
                let a = acceleration_m_s2[piece];
                let b = acceleration_m_s2[piece + 1];
                a + (b - a) * (t_s / dt_s - piece as f64)
            }
        }
    }
}
