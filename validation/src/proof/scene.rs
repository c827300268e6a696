//! What a declared case puts before an engine, in the harness' own words.
//!
//! Engines (the core behind its public interface, the naive integrator) all
//! read the same [`Scene`] and answer with the same [`Trace`].

use std::f64::consts::{PI, TAU};

use thiserror::Error;

/// Equation of motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Equation {
    /// Eq. 1.
    Nonlinear,
    /// Eq. 2.
    Linearized,
}

/// What ends a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// |theta| reaches alpha.
    Alpha,
    /// |theta| reaches pi/2.
    HalfPi,
}

/// Ground acceleration in m/s2, from t = 0, zero after its end.
#[derive(Clone, Debug, PartialEq)]
pub enum Forcing {
    /// None; the block is released at rest at this rotation (rad).
    Free {
        /// Initial rotation in rad.
        rotation_rad: f64,
    },
    /// Sine of one or two half periods.
    Sine {
        /// Amplitude in m/s2.
        amplitude_m_s2: f64,
        /// Circular frequency in rad/s.
        omega_rad_s: f64,
        /// Half-sine (1) or one-sine (2).
        half_cycles: u32,
    },
    /// One period of a cosine.
    Cosine {
        /// Amplitude in m/s2.
        amplitude_m_s2: f64,
        /// Circular frequency in rad/s.
        omega_rad_s: f64,
    },
    /// Constant acceleration.
    Rectangle {
        /// Amplitude in m/s2.
        amplitude_m_s2: f64,
        /// Duration in s.
        duration_s: f64,
    },
    /// Isosceles triangle.
    Triangle {
        /// Amplitude in m/s2.
        amplitude_m_s2: f64,
        /// Duration in s.
        duration_s: f64,
    },
    /// Ricker pulse over `cycles` periods, centred.
    Ricker {
        /// Amplitude in m/s2.
        amplitude_m_s2: f64,
        /// Period in s.
        period_s: f64,
        /// Length in periods.
        cycles: f64,
        /// (x^2 - 3) x instead of 1 - x^2.
        antisymmetric: bool,
    },
    /// Derivative of the Mavroeidis-Papageorgiou velocity pulse.
    Mavroeidis {
        /// Velocity amplitude in m/s.
        velocity_m_s: f64,
        /// Frequency in Hz.
        frequency_hz: f64,
        /// Oscillatory character.
        gamma: f64,
        /// Phase in rad.
        phase_rad: f64,
    },
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
    pub equation: Equation,
    /// What ends the run.
    pub criterion: Criterion,
    /// Ground acceleration.
    pub forcing: Forcing,
    /// Where the run stops at the latest, s; none: at rest or overturning.
    pub until_s: Option<f64>,
}

/// One impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// When, s.
    pub time_s: f64,
    /// |theta'| just before it, rad/s.
    pub speed_rad_s: f64,
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
    /// The engine leaves the question open.
    #[error("fate left open by the engine at t = {time_s} s")]
    Unresolved {
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
    /// Uplift threshold in m/s2: g tan(alpha) in Eq. 1, g alpha in Eq. 2.
    #[must_use]
    pub fn threshold_m_s2(&self) -> f64 {
        let group = match self.equation {
            Equation::Nonlinear => libm::tan(self.slenderness_rad),
            Equation::Linearized => self.slenderness_rad,
        };
        self.gravity_m_s2 * group
    }

    /// Rotation that ends the run, rad.
    #[must_use]
    pub fn limit_rad(&self) -> f64 {
        match self.criterion {
            Criterion::Alpha => self.slenderness_rad,
            Criterion::HalfPi => PI / 2.0,
        }
    }
}

/// Peak of (x^2 - 3) x exp(-x^2/2).
#[must_use]
pub fn ricker_beta() -> f64 {
    let r = 3.0 - 6.0_f64.sqrt();
    6.0_f64.sqrt() * r.sqrt() * libm::exp(-0.5 * r)
}

impl Forcing {
    /// End of the ground motion, s.
    #[must_use]
    pub fn end_s(&self) -> f64 {
        match self {
            Self::Free { .. } => 0.0,
            Self::Sine { omega_rad_s, half_cycles, .. } => {
                f64::from(*half_cycles) * PI / omega_rad_s
            }
            Self::Cosine { omega_rad_s, .. } => TAU / omega_rad_s,
            Self::Rectangle { duration_s, .. }
            | Self::Triangle { duration_s, .. } => *duration_s,
            Self::Ricker { period_s, cycles, .. } => cycles * period_s,
            Self::Mavroeidis { frequency_hz, gamma, .. } => {
                gamma / frequency_hz
            }
            Self::Samples { dt_s, acceleration_m_s2 } => {
                (acceleration_m_s2.len() - 1) as f64 * dt_s
            }
        }
    }

    /// Instants between which the acceleration is smooth and, as far as
    /// closed forms say, monotone; from 0 to the end.
    #[must_use]
    pub fn pieces_s(&self) -> Vec<f64> {
        let end = self.end_s();
        let mut at = vec![0.0];
        match self {
            Self::Free { .. } | Self::Rectangle { .. } => {}
            Self::Sine { omega_rad_s, half_cycles, .. } => {
                for k in 1..2 * half_cycles {
                    at.push(f64::from(k) * 0.5 * PI / omega_rad_s);
                }
            }
            Self::Cosine { omega_rad_s, .. } => {
                for k in 1..4 {
                    at.push(f64::from(k) * 0.5 * PI / omega_rad_s);
                }
            }
            Self::Triangle { duration_s, .. } => at.push(0.5 * duration_s),
            Self::Ricker { period_s, antisymmetric, .. } => {
                let (rate, x) = if *antisymmetric {
                    let r = 6.0_f64.sqrt();
                    let rate = TAU / (3.0_f64.sqrt() * period_s);
                    (rate, [(3.0 + r).sqrt(), (3.0 - r).sqrt()])
                } else {
                    let rate = 2.0_f64.sqrt() * PI / period_s;
                    (rate, [3.0_f64.sqrt(), 0.0])
                };
                for x in [-x[0], -x[1], x[1], x[0]] {
                    at.push(0.5 * end + x / rate);
                }
            }
            Self::Mavroeidis { .. } => {
                at.extend((1..256).map(|k| f64::from(k) / 256.0 * end));
            }
            Self::Samples { dt_s, acceleration_m_s2 } => {
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
    #[must_use]
    pub fn at(&self, piece: usize, t_s: f64) -> f64 {
        match self {
            Self::Free { .. } => 0.0,
            Self::Sine { amplitude_m_s2, omega_rad_s, .. } => {
                amplitude_m_s2 * libm::sin(omega_rad_s * t_s)
            }
            Self::Cosine { amplitude_m_s2, omega_rad_s } => {
                amplitude_m_s2 * libm::cos(omega_rad_s * t_s)
            }
            Self::Rectangle { amplitude_m_s2, .. } => *amplitude_m_s2,
            Self::Triangle { amplitude_m_s2, duration_s } => {
                let half = 0.5 * duration_s;
                let rise = if piece == 0 { t_s } else { duration_s - t_s };
                amplitude_m_s2 * rise / half
            }
            Self::Ricker {
                amplitude_m_s2,
                period_s,
                cycles,
                antisymmetric,
            } => {
                let u = t_s - 0.5 * cycles * period_s;
                if *antisymmetric {
                    let x = TAU * u / (3.0_f64.sqrt() * period_s);
                    let bell = libm::exp(-0.5 * x * x);
                    amplitude_m_s2 * (x * x - 3.0) * x * bell / ricker_beta()
                } else {
                    let x = 2.0_f64.sqrt() * PI * u / period_s;
                    let bell = libm::exp(-0.5 * x * x);
                    amplitude_m_s2 * (1.0 - x * x) * bell
                }
            }
            Self::Mavroeidis {
                velocity_m_s,
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
                -velocity_m_s * w * sum
            }
            Self::Samples { dt_s, acceleration_m_s2 } => {
                let a = acceleration_m_s2[piece];
                let b = acceleration_m_s2[piece + 1];
                a + (b - a) * (t_s / dt_s - piece as f64)
            }
        }
    }
}
