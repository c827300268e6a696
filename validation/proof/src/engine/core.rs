//! The core on scenes of the harness.

use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, Pulse, ScaledRecord};
use rocking::integrator::{
    self, CertifiedFate, Certify, Observe, Order, Outcome, Response,
    SceneError, Solver,
};
use rocking::number::Real;

use crate::scene::{CaseScene, Engine, EngineError, Forcing, Trace};

/// The code under test.
pub struct Core;

impl Engine for Core {
    fn respond(&self, scene: &CaseScene) -> Result<Trace, EngineError> {
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
            impacts: response.impacts,
        })
    }
}

/// Sign of the rotation after the first uplift. An overturned block shows
/// it by its side and its impacts; any other by a history of its first hop.
fn first_side(
    scene: &CaseScene,
    response: &Response,
) -> Result<f64, EngineError> {
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
    scene: &CaseScene,
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
    scene: &CaseScene,
    observe: &Observe,
    quotient: Quotient,
) -> Result<Response<N>, EngineError> {
    with_core_scene(scene, quotient, |scene| {
        integrator::respond_precise(scene, observe)
    })
}

/// The certified fate of a scene, to its end of observation; the quotients by
/// gravity are taken in the precision that the fate needs.
///
/// # Errors
/// [`EngineError::Refused`] or [`EngineError::Work`] with the core's own
/// words.
pub fn certify(scene: &CaseScene) -> Result<CertifiedFate, EngineError> {
    let ask = Certify { until_s: scene.until_s, ..Certify::default() };
    with_core_scene(scene, Quotient::Kept, |scene| {
        integrator::certify(scene, &ask)
    })
}

/// Runs the core on a record at a fixed order of Eq. 1, with events.
///
/// # Errors
/// [`EngineError::Refused`] or [`EngineError::Work`] with the core's own
/// words.
pub fn respond_at_order(
    scene: &CaseScene,
    order: Order,
) -> Result<Response, EngineError> {
    let observe = Observe { events: true, ..Observe::default() };
    with_core_scene(scene, Quotient::Rounded, |scene| {
        let order = Some(order);
        Solver { order, ..Solver::default() }.respond(scene, &observe)
    })
}

fn with_core_scene<R>(
    scene: &CaseScene,
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
    let mut forcing = scene.forcing.clone();
    if !matches!(forcing, Forcing::Free { .. }) {
        forcing.amplitudes_mut().iter_mut().for_each(|a| *a /= unit);
    }
    let mut initial_ratio = 0.0;
    let pulse;
    let excitation = match &forcing {
        Forcing::Samples { dt_s, acceleration_m_s2 } => Excitation::Record(
            ScaledRecord::try_new_si(acceleration_m_s2, *dt_s, divisor)
                .map_err(refused)?,
        ),
        Forcing::Pulse(kind) => {
            pulse = Pulse::try_new_si(*kind, divisor).map_err(refused)?;
            Excitation::Pulse(&pulse)
        }
        Forcing::Free { rotation_rad } => {
            initial_ratio = rotation_rad.abs() / scene.slenderness_rad;
            Excitation::Free
        }
    };
    let scene = integrator::Scene {
        model: scene.model,
        overturning: scene.overturning,
        initial_ratio,
        ..integrator::Scene::new(block, restitution, excitation)
    };
    run(&scene).map_err(|error| match error {
        SceneError::Work { .. } => EngineError::Work(error.to_string()),
        _ => refused(error),
    })
}
