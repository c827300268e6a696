//! Grids of blocks and pulses against the oracles.

use std::convert::Infallible;

use rocking::excitation::{PulseName, PulseParameter};

use super::method::{Answer, Context, MethodError};
use crate::edge::{around, edge};
use crate::oracles::overturning;
use crate::oracles::rectangular::Rectangular;
use crate::oracles::{free_rocking, linear};
use crate::scene::{
    Engine, Forcing, Model, Overturning, PulseKind, Scene, Trace, rescaled,
};

/// Free rocking of every combination of block, loss and release.
pub(super) fn free(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        equation: Model, slenderness_rad: Vec<f64>, frequency_rad_s: Vec<f64>,
        restitution: Vec<f64>,
        /// Rotation at release over alpha.
        release: Vec<f64>,
        impacts: usize,
    }
    let mut answer = Answer::default();
    for &alpha in &slenderness_rad {
        for &p in &frequency_rad_s {
            for &eta in &restitution {
                for &release in &release {
                    let rotation_rad = release * alpha;
                    let scene = Scene {
                        model: equation,
                        ..Scene::new(
                            [alpha, p, 9.81],
                            eta,
                            Forcing::Free { rotation_rad },
                        )
                    };
                    let trace = context.engine.respond(&scene)?;
                    let oracle = match equation {
                        Model::Nonlinear => free_rocking::nonlinear,
                        Model::Linearized => free_rocking::linearized,
                    };
                    let form = oracle(alpha, eta, rotation_rad, impacts);
                    put_free(&mut answer, &trace, &form, p);
                }
            }
        }
    }
    Ok(answer)
}

fn put_free(
    answer: &mut Answer,
    trace: &Trace,
    form: &free_rocking::FreeRocking,
    p: f64,
) {
    let impacts = || trace.impacts.iter().take(form.impact_times_p.len());
    answer.put(
        "impact-times-p",
        impacts().map(|i| i.time_s * p),
        form.impact_times_p.iter().copied(),
    );
    answer.put(
        "impact-speeds-p",
        impacts().map(|i| i.speed_before_rad_s / p),
        form.impact_speeds_p.iter().copied(),
    );
    answer.put(
        "rest-time-p",
        trace.rest_s.map(|t| t * p),
        form.settling_p.is_finite().then_some(form.settling_p),
    );
}

/// Pulses in Eq. 2 over amplitudes and durations.
pub(super) fn pulses(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        pulse: PulseName, amplitudes: Vec<f64>,
        /// Frequencies over p, or durations or periods times p.
        scales: Vec<f64>,
        restitution: Vec<f64>,
        /// Blocks: alpha (rad), p (rad/s), g (m/s2).
        blocks: Vec<[f64; 3]>,
        impacts: usize,
    }
    let mut answer = Answer::default();
    for &a in &amplitudes {
        for &scale in &scales {
            let pulse = shaped(pulse, a, scale);
            for &eta in &restitution {
                let form = linear::respond(pulse, eta, impacts);
                for block in &blocks {
                    let scene = linear_scene(pulse, eta, *block, None);
                    let trace = context.engine.respond(&scene)?;
                    put_pulse(&mut answer, &trace, &form, *block);
                }
            }
        }
    }
    Ok(answer)
}

fn put_pulse(
    answer: &mut Answer,
    trace: &Trace,
    form: &linear::Response,
    [alpha, p, _]: [f64; 3],
) {
    let impacts = || trace.impacts.iter().take(form.impacts.len());
    answer.put(
        "impact-times-p",
        impacts().map(|i| i.time_s * p),
        form.impacts.iter().map(|i| i.0),
    );
    answer.put(
        "impact-speeds",
        impacts().map(|i| i.speed_before_rad_s / (p * alpha)),
        form.impacts.iter().map(|i| i.1),
    );
    answer.put("uplift-time-p", trace.uplift_s.map(|t| t * p), form.uplift);
    answer.put(
        "alpha-time-p",
        trace.overturned_s.map(|t| t * p),
        form.overturned,
    );
    answer.put("side", [trace.first_side], [form.side]);
}

/// The pulse of this name, for a block with p = 1 rad/s and
/// g alpha = 1 m/s2.
fn shaped(name: PulseName, amplitude: f64, scale: f64) -> PulseKind {
    use PulseParameter as P;
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

/// A block (alpha, p, g) in Eq. 2 under the pulse that acts on one with
/// p = 1 rad/s and g alpha = 1 m/s2 as it does on this one.
pub(super) fn linear_scene(
    pulse: PulseKind,
    restitution: f64,
    block: [f64; 3],
    until_p: Option<f64>,
) -> Scene {
    let [alpha, p, g] = block;
    let forcing = Forcing::Pulse(rescaled(pulse, g * alpha, p));
    Scene {
        model: Model::Linearized,
        until_s: until_p.map(|t| t / p),
        ..Scene::new([alpha, p, g], restitution, forcing)
    }
}

/// Amplitudes at which a pulse overturns without impact.
pub(super) fn critical(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        pulse: PulseName, scales: Vec<f64>,
        /// Block: alpha (rad), p (rad/s), g (m/s2).
        block: [f64; 3],
    }
    let mut answer = Answer::default();
    for &scale in &scales {
        let condition = match pulse {
            PulseName::HalfSine => overturning::sine_without_impact(1, scale),
            PulseName::OneSine => overturning::sine_without_impact(2, scale),
            PulseName::OneCosine => overturning::one_cosine(scale),
            PulseName::Rectangle => overturning::rectangle(scale),
            PulseName::Triangle => overturning::triangle(scale),
            other => {
                return Err(MethodError::Input(format!("pulse `{other}`")));
            }
        };
        let found = flip(condition, |a| {
            let pulse = shaped(pulse, a, scale);
            let until = Some(200.0);
            let mut scene = linear_scene(pulse, 0.92, block, until);
            scene.overturning = Overturning::HalfPi;
            overturns_at_once(context.engine, &scene)
        })?;
        answer.put("critical-amplitude", [found], [condition]);
    }
    Ok(answer)
}

pub(super) fn overturns_at_once(
    engine: &dyn Engine,
    scene: &Scene,
) -> Result<bool, MethodError> {
    let trace = engine.respond(scene)?;
    Ok(trace.overturned_s.is_some() && trace.impacts.is_empty())
}

/// Where a predicate turns true within 1e-6 of `near`; not a number where
/// it does not.
pub(super) fn flip(
    near: f64,
    above: impl Fn(f64) -> Result<bool, MethodError>,
) -> Result<f64, MethodError> {
    edge(around(near, 1e-6), 1e-13, above)
}

/// The frequency beyond which a one-sine pulse cannot overturn after an
/// impact.
pub(super) fn fold(context: &Context) -> Result<Answer, MethodError> {
    input!(context; restitution: Vec<f64>, block: [f64; 3]);
    let mut answer = Answer::default();
    for &eta in &restitution {
        let (omega, a) = overturning::fold(eta);
        let found = flip(omega, |omega| {
            let pulse =
                PulseKind::OneSine { amplitude: a, omega_rad_s: omega };
            let mut scene = linear_scene(pulse, eta, block, Some(200.0));
            scene.overturning = Overturning::HalfPi;
            let trace = context.engine.respond(&scene)?;
            Ok(trace.overturned_s.is_none())
        })?;
        answer.put("fold", [found], [omega]);
        let pulse = PulseKind::OneSine { amplitude: a, omega_rad_s: omega };
        let scene = linear_scene(pulse, eta, block, None);
        let seen = context.state(&scene, scene.forcing.end_s())?;
        answer.put(
            "rotation-at-pulse-end",
            [seen.rotation_rad.abs() / scene.slenderness_rad],
            [2.0 - 1.0 / (eta * eta)],
        );
    }
    Ok(answer)
}

/// Critical durations of rectangular pulses in Eq. 1.
pub(super) fn durations(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        slenderness_rad: Vec<f64>, frequency_rad_s: Vec<f64>,
        /// Acceleration over g tan(alpha).
        intensity: Vec<f64>,
    }
    let mut answer = Answer::default();
    for &alpha in &slenderness_rad {
        for &p in &frequency_rad_s {
            for &intensity in &intensity {
                let pull = intensity * libm::tan(alpha);
                let form =
                    Rectangular { alpha_rad: alpha, frequency_rad_s: p, pull };
                let critical = form.critical_duration_s();
                let found = flip(critical, |duration_s| {
                    let scene = Scene {
                        overturning: Overturning::HalfPi,
                        until_s: Some(200.0 / p),
                        ..Scene::new(
                            [alpha, p, 9.81],
                            0.92,
                            Forcing::Pulse(PulseKind::Rectangle {
                                amplitude: pull * 9.81,
                                duration_s,
                            }),
                        )
                    };
                    overturns_at_once(context.engine, &scene)
                })?;
                answer.put("critical-duration-p", [found * p], [critical * p]);
            }
        }
    }
    Ok(answer)
}
