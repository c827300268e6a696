//! Grids of blocks and pulses against the oracles.

use serde::Deserialize;

use super::points::state;
use super::{Answer, Context, MethodError};
use crate::proof::oracles::linear::Pulse;
use crate::proof::oracles::overturning;
use crate::proof::oracles::rectangular::Rectangular;
use crate::proof::oracles::{free_rocking, linear};
use crate::proof::scene::{
    Criterion, Engine, Equation, Forcing, Scene, Trace,
};

/// Adds to the lists of a quantity.
pub(super) fn extend(
    answer: &mut Answer,
    name: &str,
    observed: impl IntoIterator<Item = f64>,
    expected: impl IntoIterator<Item = f64>,
) {
    let list = answer.observed.entry(name.to_owned()).or_default();
    list.extend(observed);
    let list = answer.expected.entry(name.to_owned()).or_default();
    list.extend(expected);
}

pub(super) fn equation(name: &str) -> Result<Equation, MethodError> {
    match name {
        "nonlinear" => Ok(Equation::Nonlinear),
        "linearized" => Ok(Equation::Linearized),
        other => Err(MethodError::Input(format!("equation `{other}`"))),
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FreeInput {
    equation: String,
    slenderness_rad: Vec<f64>,
    frequency_rad_s: Vec<f64>,
    restitution: Vec<f64>,
    /// Rotation at release over alpha.
    release: Vec<f64>,
    impacts: usize,
}

/// Free rocking of every combination of block, loss and release.
pub(super) fn free(context: &Context) -> Result<Answer, MethodError> {
    let input: FreeInput = context.input()?;
    let equation = equation(&input.equation)?;
    let mut answer = Answer::default();
    for &alpha in &input.slenderness_rad {
        for &p in &input.frequency_rad_s {
            for &eta in &input.restitution {
                for &release in &input.release {
                    let rotation_rad = release * alpha;
                    let scene = Scene {
                        slenderness_rad: alpha,
                        frequency_rad_s: p,
                        restitution: eta,
                        gravity_m_s2: 9.81,
                        equation,
                        criterion: Criterion::Alpha,
                        forcing: Forcing::Free { rotation_rad },
                        until_s: None,
                    };
                    let trace = context.engine.respond(&scene)?;
                    let oracle = match equation {
                        Equation::Nonlinear => free_rocking::nonlinear,
                        Equation::Linearized => free_rocking::linearized,
                    };
                    let form = oracle(alpha, eta, rotation_rad, input.impacts);
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
    extend(
        answer,
        "impact-times-p",
        impacts().map(|i| i.time_s * p),
        form.impact_times_p.iter().copied(),
    );
    extend(
        answer,
        "impact-speeds-p",
        impacts().map(|i| i.speed_rad_s / p),
        form.impact_speeds_p.iter().copied(),
    );
    extend(
        answer,
        "rest-time-p",
        trace.rest_s.map(|t| t * p),
        form.settling_p.is_finite().then_some(form.settling_p),
    );
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PulseInput {
    pulse: String,
    amplitudes: Vec<f64>,
    /// Frequencies over p, or durations or periods times p.
    scales: Vec<f64>,
    restitution: Vec<f64>,
    /// Blocks: alpha (rad), p (rad/s), g (m/s2).
    blocks: Vec<[f64; 3]>,
    impacts: usize,
}

/// Pulses in Eq. 2 over amplitudes and durations.
pub(super) fn pulses(context: &Context) -> Result<Answer, MethodError> {
    let input: PulseInput = context.input()?;
    let mut answer = Answer::default();
    for &a in &input.amplitudes {
        for &scale in &input.scales {
            let pulse = pulse(&input.pulse, a, scale)?;
            for &eta in &input.restitution {
                let form = linear::respond(pulse, eta, input.impacts);
                for block in &input.blocks {
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
    extend(
        answer,
        "impact-times-p",
        impacts().map(|i| i.time_s * p),
        form.impacts.iter().map(|i| i.0),
    );
    extend(
        answer,
        "impact-speeds",
        impacts().map(|i| i.speed_rad_s / (p * alpha)),
        form.impacts.iter().map(|i| i.1),
    );
    extend(
        answer,
        "uplift-time-p",
        trace.uplift_s.map(|t| t * p),
        form.uplift,
    );
    extend(
        answer,
        "alpha-time-p",
        trace.overturned_s.map(|t| t * p),
        form.overturned,
    );
    extend(answer, "side", [trace.first_side], [form.side]);
}

fn pulse(name: &str, a: f64, scale: f64) -> Result<Pulse, MethodError> {
    let sine = |half_cycles| Pulse::Sine { a, omega: scale, half_cycles };
    Ok(match name {
        "half-sine" => sine(1),
        "one-sine" => sine(2),
        "one-cosine" => Pulse::Cosine { a, omega: scale },
        "rectangle" => Pulse::Rectangle { a, tau: scale },
        "triangle" => Pulse::Triangle { a, tau: scale },
        "ricker-symmetric" => Pulse::RickerSymmetric { a, tau: scale },
        "ricker-antisymmetric" => Pulse::RickerAntisymmetric { a, tau: scale },
        "mavroeidis-papageorgiou" => Pulse::Mavroeidis {
            velocity: a,
            frequency: scale,
            gamma: 1.5,
            phase: 0.25,
        },
        other => return Err(MethodError::Input(format!("pulse `{other}`"))),
    })
}

/// The scene of a dimensionless pulse on a block (alpha, p, g).
pub(super) fn linear_scene(
    pulse: Pulse,
    restitution: f64,
    [alpha, p, g]: [f64; 3],
    until_p: Option<f64>,
) -> Scene {
    let unit = g * alpha;
    let forcing = match pulse {
        Pulse::Sine { a, omega, half_cycles } => Forcing::Sine {
            amplitude_m_s2: a * unit,
            omega_rad_s: omega * p,
            half_cycles,
        },
        Pulse::Cosine { a, omega } => Forcing::Cosine {
            amplitude_m_s2: a * unit,
            omega_rad_s: omega * p,
        },
        Pulse::Rectangle { a, tau } => Forcing::Rectangle {
            amplitude_m_s2: a * unit,
            duration_s: tau / p,
        },
        Pulse::Triangle { a, tau } => {
            Forcing::Triangle { amplitude_m_s2: a * unit, duration_s: tau / p }
        }
        Pulse::RickerSymmetric { a, tau }
        | Pulse::RickerAntisymmetric { a, tau } => Forcing::Ricker {
            amplitude_m_s2: a * unit,
            period_s: tau / p,
            cycles: 4.0,
            antisymmetric: matches!(pulse, Pulse::RickerAntisymmetric { .. }),
        },
        Pulse::Mavroeidis { velocity, frequency, gamma, phase } => {
            Forcing::Mavroeidis {
                velocity_m_s: velocity * unit / p,
                frequency_hz: frequency * p,
                gamma,
                phase_rad: phase,
            }
        }
    };
    Scene {
        slenderness_rad: alpha,
        frequency_rad_s: p,
        restitution,
        gravity_m_s2: g,
        equation: Equation::Linearized,
        criterion: Criterion::Alpha,
        forcing,
        until_s: until_p.map(|t| t / p),
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CriticalInput {
    pulse: String,
    scales: Vec<f64>,
    /// Block: alpha (rad), p (rad/s), g (m/s2).
    block: [f64; 3],
}

/// Amplitudes at which a pulse overturns without impact.
pub(super) fn critical(context: &Context) -> Result<Answer, MethodError> {
    let input: CriticalInput = context.input()?;
    let mut answer = Answer::default();
    for &scale in &input.scales {
        let condition = match input.pulse.as_str() {
            "half-sine" => overturning::sine_without_impact(1, scale),
            "one-sine" => overturning::sine_without_impact(2, scale),
            "one-cosine" => overturning::one_cosine(scale),
            "rectangle" => overturning::rectangle(scale),
            "triangle" => overturning::triangle(scale),
            other => {
                return Err(MethodError::Input(format!("pulse `{other}`")));
            }
        };
        let found = flip(condition, |a| {
            let pulse = pulse(&input.pulse, a, scale)?;
            let until = Some(200.0);
            let mut scene = linear_scene(pulse, 0.92, input.block, until);
            scene.criterion = Criterion::HalfPi;
            overturns_at_once(context.engine, &scene)
        })?;
        extend(&mut answer, "critical-amplitude", [found], [condition]);
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
    flip_within(1e-6, near, above)
}

/// The same within `reach` of `near`.
pub(super) fn flip_within(
    reach: f64,
    near: f64,
    above: impl Fn(f64) -> Result<bool, MethodError>,
) -> Result<f64, MethodError> {
    let (mut low, mut high) = (near * (1.0 - reach), near * (1.0 + reach));
    if above(low)? || !above(high)? {
        return Ok(f64::NAN);
    }
    while high - low > 1e-13 * high {
        let mid = 0.5 * (low + high);
        if above(mid)? { high = mid } else { low = mid }
    }
    Ok(0.5 * (low + high))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FoldInput {
    restitution: Vec<f64>,
    block: [f64; 3],
}

/// The frequency beyond which a one-sine pulse cannot overturn after an
/// impact.
pub(super) fn fold(context: &Context) -> Result<Answer, MethodError> {
    let input: FoldInput = context.input()?;
    let mut answer = Answer::default();
    for &eta in &input.restitution {
        let (omega, a) = overturning::fold(eta);
        let found = flip(omega, |omega| {
            let pulse = Pulse::Sine { a, omega, half_cycles: 2 };
            let mut scene = linear_scene(pulse, eta, input.block, Some(200.0));
            scene.criterion = Criterion::HalfPi;
            let trace = context.engine.respond(&scene)?;
            Ok(trace.overturned_s.is_none())
        })?;
        extend(&mut answer, "fold", [found], [omega]);
        let pulse = Pulse::Sine { a, omega, half_cycles: 2 };
        let scene = linear_scene(pulse, eta, input.block, None);
        let seen = state(context, &scene, scene.forcing.end_s())?;
        extend(
            &mut answer,
            "rotation-at-pulse-end",
            [seen.rotation_rad.abs() / scene.slenderness_rad],
            [2.0 - 1.0 / (eta * eta)],
        );
    }
    Ok(answer)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RectangularInput {
    slenderness_rad: Vec<f64>,
    frequency_rad_s: Vec<f64>,
    /// Acceleration over g tan(alpha).
    intensity: Vec<f64>,
}

/// Critical durations of rectangular pulses in Eq. 1.
pub(super) fn durations(context: &Context) -> Result<Answer, MethodError> {
    let input: RectangularInput = context.input()?;
    let mut answer = Answer::default();
    for &alpha in &input.slenderness_rad {
        for &p in &input.frequency_rad_s {
            for &intensity in &input.intensity {
                let pull = intensity * libm::tan(alpha);
                let form =
                    Rectangular { alpha_rad: alpha, frequency_rad_s: p, pull };
                let critical = form.critical_duration_s();
                let found = flip(critical, |duration_s| {
                    let scene = Scene {
                        slenderness_rad: alpha,
                        frequency_rad_s: p,
                        restitution: 0.92,
                        gravity_m_s2: 9.81,
                        equation: Equation::Nonlinear,
                        criterion: Criterion::HalfPi,
                        forcing: Forcing::Rectangle {
                            amplitude_m_s2: pull * 9.81,
                            duration_s,
                        },
                        until_s: Some(200.0 / p),
                    };
                    overturns_at_once(context.engine, &scene)
                })?;
                extend(
                    &mut answer,
                    "critical-duration-p",
                    [found * p],
                    [critical * p],
                );
            }
        }
    }
    Ok(answer)
}
