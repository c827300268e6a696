//! The core behind its public interface.

mod wide;

pub use wide::{Arithmetic, WideTrace};

use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, Pulse, PulseKind, ScaledRecord};
use rocking::integrator::{
    self, Model, Observe, Order, Outcome, Overturning, Response, SceneError,
    Solver,
};
use rocking::number::Real;

use super::scene::{
    Criterion, Engine, EngineError, Equation, Forcing, Impact, Scene, Trace,
};

/// The code under test.
pub struct Core;

impl Engine for Core {
    fn respond(&self, scene: &Scene) -> Result<Trace, EngineError> {
        let observe = Observe {
            events: true,
            until_s: scene.until_s,
            ..Observe::default()
        };
        let response = respond(scene, &observe)?;
        Ok(Trace {
            uplift_s: response.uplift_time_s,
            uplifts: usize::try_from(response.work.uplifts)
                .unwrap_or(usize::MAX),
            first_side: first_side(scene, &response)?,
            peak_ratio: response.outcome.edp(),
            peak_time_s: response
                .peak_time_s
                .filter(|_| !response.outcome.is_overturned()),
            overturned_s: match response.outcome {
                Outcome::Overturned { time_s, .. } => Some(time_s),
                _ => None,
            },
            rest_s: response.rest_time_s,
            impacts: response
                .impacts
                .iter()
                .map(|impact| Impact {
                    time_s: impact.time_s,
                    speed_rad_s: impact.speed_before_rad_s,
                })
                .collect(),
        })
    }
}

/// Sign of the rotation after the first uplift. An overturned block shows
/// it by its side and its impacts; any other by a history of its first hop.
fn first_side(scene: &Scene, response: &Response) -> Result<f64, EngineError> {
    if let Outcome::Overturned { side, .. } = response.outcome {
        let even = response.impacts.len().is_multiple_of(2);
        return Ok(if even { side.sign() } else { -side.sign() });
    }
    let (Some(start), Some(first)) =
        (response.uplift_time_s, response.impacts.first())
    else {
        return Ok(match &scene.forcing {
            Forcing::Free { rotation_rad } => rotation_rad.signum(),
            _ => 0.0,
        });
    };
    let observe = Observe {
        history_interval_s: Some(0.25 * (first.time_s - start)),
        until_s: Some(first.time_s),
        ..Observe::default()
    };
    let history = respond(scene, &observe)?.history;
    let moved = history.iter().find(|point| point.rotation_rad != 0.0);
    Ok(moved.map_or(0.0, |point| point.rotation_rad.signum()))
}

/// Runs the core on a scene of the harness.
///
/// # Errors
/// [`EngineError::Refused`] or [`EngineError::Work`] with the core's own
/// words.
pub fn respond(
    scene: &Scene,
    observe: &Observe,
) -> Result<Response, EngineError> {
    with_core_scene(scene, Quotient::Rounded, |scene| {
        integrator::respond(scene, observe)
    })
}

/// Where the quotient of an acceleration and gravity is rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quotient {
    /// To double precision, before the run.
    Rounded,
    /// In the precision of the run.
    Kept,
}

/// Runs the core on a scene of the harness in other arithmetic.
///
/// # Errors
/// [`EngineError::Refused`] or [`EngineError::Work`] with the core's own
/// words.
pub fn respond_in<N: Real>(
    scene: &Scene,
    observe: &Observe,
    quotient: Quotient,
) -> Result<Response<N>, EngineError> {
    with_core_scene(scene, quotient, |scene| {
        integrator::respond_precise(scene, observe)
    })
}

/// Runs the core on a record at a fixed order of Eq. 1, with events.
///
/// # Errors
/// [`EngineError::Refused`] or [`EngineError::Work`] with the core's own
/// words.
pub fn respond_at_order(
    scene: &Scene,
    order: Order,
) -> Result<Response, EngineError> {
    let observe = Observe { events: true, ..Observe::default() };
    with_core_scene(scene, Quotient::Rounded, |scene| {
        let order = Some(order);
        Solver { order, ..Solver::default() }.respond(scene, &observe)
    })
}

fn with_core_scene<R>(
    scene: &Scene,
    quotient: Quotient,
    run: impl FnOnce(&integrator::Scene<'_>) -> Result<R, SceneError>,
) -> Result<R, EngineError> {
    fn refused(error: impl std::fmt::Display) -> EngineError {
        EngineError::Refused(error.to_string())
    }
    let block = Block::try_new(scene.slenderness_rad, scene.frequency_rad_s)
        .map_err(refused)?;
    let restitution =
        Restitution::constant(scene.restitution).map_err(refused)?;
    let g = scene.gravity_m_s2;
    // Divided here, or by the core.
    let (unit, divisor) = match quotient {
        Quotient::Rounded => (g, 1.0),
        Quotient::Kept => (1.0, g),
    };
    let samples = match &scene.forcing {
        Forcing::Samples { acceleration_m_s2, .. } => {
            acceleration_m_s2.iter().map(|a| a / unit).collect()
        }
        _ => Vec::new(),
    };
    let pulse = pulse(scene, unit);
    let pulse = pulse
        .map(|kind| Pulse::try_new_si(kind, divisor))
        .transpose()
        .map_err(refused)?;
    let mut initial_ratio = 0.0;
    let excitation = match (&scene.forcing, &pulse) {
        (Forcing::Samples { dt_s, .. }, _) => Excitation::Record(
            ScaledRecord::try_new_si(&samples, *dt_s, divisor)
                .map_err(refused)?,
        ),
        (Forcing::Free { rotation_rad }, _) => {
            initial_ratio = rotation_rad.abs() / scene.slenderness_rad;
            Excitation::Free
        }
        (_, Some(pulse)) => Excitation::Pulse(pulse),
        _ => Excitation::Free,
    };
    let scene = integrator::Scene {
        block,
        restitution,
        model: match scene.equation {
            Equation::Nonlinear => Model::Nonlinear,
            Equation::Linearized => Model::Linearized,
        },
        overturning: match scene.criterion {
            Criterion::Alpha => Overturning::Alpha,
            Criterion::HalfPi => Overturning::HalfPi,
        },
        excitation,
        initial_ratio,
    };
    run(&scene).map_err(|error| match error {
        SceneError::Work { .. } => EngineError::Work(error.to_string()),
        _ => refused(error),
    })
}

/// The pulse of a scene, its accelerations over `unit`.
fn pulse(scene: &Scene, unit: f64) -> Option<PulseKind> {
    Some(match scene.forcing {
        Forcing::Sine { amplitude_m_s2, omega_rad_s, half_cycles } => {
            let amplitude = amplitude_m_s2 / unit;
            match half_cycles {
                1 => PulseKind::HalfSine { amplitude, omega_rad_s },
                2 => PulseKind::OneSine { amplitude, omega_rad_s },
                _ => return None,
            }
        }
        Forcing::Cosine { amplitude_m_s2, omega_rad_s } => {
            PulseKind::OneCosine {
                amplitude: amplitude_m_s2 / unit,
                omega_rad_s,
            }
        }
        Forcing::Rectangle { amplitude_m_s2, duration_s } => {
            PulseKind::Rectangle {
                amplitude: amplitude_m_s2 / unit,
                duration_s,
            }
        }
        Forcing::Triangle { amplitude_m_s2, duration_s } => {
            PulseKind::Triangle {
                amplitude: amplitude_m_s2 / unit,
                duration_s,
            }
        }
        Forcing::Ricker {
            amplitude_m_s2,
            period_s,
            cycles,
            antisymmetric,
        } => {
            let amplitude = amplitude_m_s2 / unit;
            if antisymmetric {
                PulseKind::RickerAntisymmetric { amplitude, period_s, cycles }
            } else {
                PulseKind::RickerSymmetric { amplitude, period_s, cycles }
            }
        }
        Forcing::Mavroeidis {
            velocity_m_s,
            frequency_hz,
            gamma,
            phase_rad,
        } => PulseKind::MavroeidisPapageorgiou {
            velocity: velocity_m_s / unit,
            frequency_hz,
            gamma,
            phase_rad,
        },
        Forcing::Free { .. } | Forcing::Samples { .. } => return None,
    })
}
