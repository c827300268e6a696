//! The code under test, run on scenes of the harness.

use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, Pulse, ScaledRecord};
use rocking::integrator::{
    self, Assessment, Observe, Outcome, Response, Scene, SceneError,
};
use rocking::number::Real;
use rocking::number::double::DoubleDouble;
use serde::Deserialize;

use crate::arithmetic::{RoundedConstants, Single, wide};
use crate::scene::{
    CaseScene, Engine, EngineError, EngineResult, Forcing, Trace,
};

/// The code under test.
pub struct Core;

impl Engine for Core {
    fn respond(&self, scene: &CaseScene) -> EngineResult<Trace> {
        let observe = Observe { events: true, ..Observe::default() };
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
fn first_side(scene: &CaseScene, response: &Response) -> EngineResult<f64> {
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

/// Runs the code under test in double precision, until the end of the
/// observation or that of the scene.
///
/// # Errors
/// [`EngineError`] with the message of the core.
pub fn respond(
    scene: &CaseScene,
    observe: &Observe,
) -> EngineResult<Response> {
    let until_s = observe.until_s.or(scene.until_s);
    on_core(scene, Quotient::Rounded, |scene| {
        integrator::respond(scene, &Observe { until_s, ..*observe })
    })
}

/// Rounding of the quotient of an acceleration and gravity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quotient {
    /// To double precision, before the run.
    Rounded,
    /// In the precision of the run.
    Kept,
}

/// Runs `work` on the scene of the core that equals a scene of the harness.
///
/// # Errors
/// [`EngineError::Refused`] or [`EngineError::Work`] with the message of the
/// core.
pub fn on_core<R>(
    scene: &CaseScene,
    quotient: Quotient,
    work: impl FnOnce(&Scene<'_>) -> Result<R, SceneError>,
) -> EngineResult<R> {
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
    let scene = Scene {
        model: scene.model,
        overturning: scene.overturning,
        initial_ratio,
        ..Scene::new(block, restitution, excitation)
    };
    work(&scene).map_err(|error| match error {
        SceneError::Work { .. } => EngineError::Work(error.to_string()),
        _ => refused(error),
    })
}

/// Result of a run in any arithmetic, as double-doubles.
#[derive(Clone, Debug, PartialEq)]
pub struct WideTrace {
    /// First uplift, s.
    pub uplift_s: Option<DoubleDouble>,
    /// Impacts: time in s and speed before in rad/s.
    pub impacts: Vec<(DoubleDouble, DoubleDouble)>,
    /// Largest |theta|/alpha reached.
    pub peak_ratio: DoubleDouble,
    /// Time of overturning, s.
    pub overturned_s: Option<DoubleDouble>,
    /// Time of rest, s.
    pub rest_s: Option<DoubleDouble>,
    /// Bound on the error of the peak ratio.
    pub error_estimate: f64,
    /// False if the run leaves its outcome open.
    pub resolved: bool,
}

/// Arithmetic of a run. A page only has the correct ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    /// Every operation rounded to 24 bits.
    #[cfg(not(target_family = "wasm"))]
    Single,
    /// Double precision, the engine that users get.
    Double,
    /// Double-double; the quotients by gravity too.
    DoubleDouble,
    /// Double-double from inputs over gravity rounded to double precision:
    /// the very problem that double precision solves.
    DoubleDoubleOfRounded,
    /// Double-double with coefficients rounded to double precision: a
    /// mistake.
    #[cfg(not(target_family = "wasm"))]
    RoundedConstants,
}

impl WideTrace {
    fn of<N: Real>(response: &Response<N>) -> Self {
        let impacts = response.impacts.iter();
        Self {
            uplift_s: response.uplift_time_s.map(wide),
            impacts: impacts
                .map(|i| (wide(i.time_s), wide(i.speed_before_rad_s)))
                .collect(),
            peak_ratio: wide(response.peak_ratio),
            overturned_s: match response.outcome {
                Outcome::Overturned { time_s, .. } => Some(wide(time_s)),
                Outcome::Rocked { .. } | Outcome::NoUplift => None,
            },
            rest_s: response.rest_time_s.map(wide),
            error_estimate: response.error_estimate.unwrap_or(f64::INFINITY),
            resolved: response.assessment() == Assessment::Clear,
        }
    }

    fn run_in<N: Real>(
        scene: &CaseScene,
        observe: &Observe,
        quotient: Quotient,
    ) -> EngineResult<Self> {
        on_core(scene, quotient, |scene| {
            Ok(Self::of::<N>(&integrator::respond_precise(scene, observe)?))
        })
    }

    /// Runs a scene, with events and accuracy.
    ///
    /// # Errors
    /// [`EngineError::Refused`] with the message of the core.
    pub fn run(
        scene: &CaseScene,
        arithmetic: Precision,
    ) -> EngineResult<Self> {
        let observe = Observe {
            events: true,
            accuracy: true,
            until_s: scene.until_s,
            ..Observe::default()
        };
        let (o, kept) = (&observe, Quotient::Kept);
        match arithmetic {
            #[cfg(not(target_family = "wasm"))]
            Precision::Single => Self::run_in::<Single>(scene, o, kept),
            Precision::Double => Ok(Self::of(&respond(scene, o)?)),
            Precision::DoubleDouble => {
                Self::run_in::<DoubleDouble>(scene, o, kept)
            }
            Precision::DoubleDoubleOfRounded => {
                Self::run_in::<DoubleDouble>(scene, o, Quotient::Rounded)
            }
            #[cfg(not(target_family = "wasm"))]
            Precision::RoundedConstants => {
                Self::run_in::<RoundedConstants>(scene, o, kept)
            }
        }
    }
}
