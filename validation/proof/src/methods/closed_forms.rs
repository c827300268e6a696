//! Grids of blocks and pulses against the oracles.

use anyhow::{Result, bail};

use super::method::{Context, Reply, SPEEDS, pairs};
use crate::edge::{around, edge};
use crate::oracles::overturning;
use crate::oracles::rectangular::Rectangular;
use crate::oracles::{free_rocking, linear};
use crate::pulse::rescaled;
use crate::scene::{
    CaseScene, Engine, Forcing, Model, Overturning, PulseName,
};

/// Free rocking of every combination of block, loss and release.
pub fn free(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        equation: Model, slenderness_rad: Vec<f64>, frequency_rad_s: Vec<f64>,
        restitution: Vec<f64>,
        /// Rotation at release over alpha.
        release: Vec<f64>,
        impacts: usize,
    }
    let blocks = pairs(&slenderness_rad, &frequency_rad_s);
    let releases = pairs(&restitution, &release);
    for ((alpha, p), (eta, release)) in pairs(&blocks, &releases) {
        let rotation_rad = release * alpha;
        let forcing = Forcing::Free { rotation_rad };
        let scene = CaseScene::new([alpha, p, 9.81], eta, forcing);
        let trace = context.engine.respond(&scene.in_equation(equation))?;
        let block = [alpha, eta, rotation_rad];
        let form = free_rocking::free(equation, block, impacts);
        let name = "impact-speeds-p";
        answer.put_impacts(name, &trace, [p, p], &form.impacts);
        let due = Some(form.settling_p).filter(|t| t.is_finite());
        answer.put("rest-time-p", trace.rest_s.map(|t| t * p), due);
    }
    Ok(())
}

/// Pulses in Eq. 2 over amplitudes and durations.
pub fn pulses(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        pulse: PulseName, amplitudes: Vec<f64>,
        /// Frequencies over p, or durations or periods times p.
        scales: Vec<f64>,
        restitution: Vec<f64>,
        /// Blocks: alpha (rad), p (rad/s), g (m/s2).
        blocks: Vec<[f64; 3]>,
        impacts: usize,
    }
    let shapes = pairs(&amplitudes, &scales);
    for ((a, scale), eta) in pairs(&shapes, &restitution) {
        let pulse = Forcing::pulse(pulse, a, scale);
        let Forcing::Pulse(kind) = pulse else { continue };
        let form = linear::respond(kind, eta, impacts);
        for block in &blocks {
            let [alpha, p, _] = *block;
            let scene = linear_scene(&pulse, eta, *block);
            let trace = context.engine.respond(&scene)?;
            let units = [p, p * alpha];
            answer.put_impacts(SPEEDS, &trace, units, &form.impacts);
            let time = |t: Option<f64>| t.map(|t| t * p);
            answer.put("uplift-time-p", time(trace.uplift_s), form.uplift);
            let over = time(trace.overturned_s);
            answer.put("alpha-time-p", over, form.overturned);
            answer.put("side", [trace.first_side], [form.side]);
        }
    }
    Ok(())
}

/// A block (alpha, p, g) in Eq. 2 under the pulse that acts on one with
/// p = 1 rad/s and g alpha = 1 m/s2 as it does on this one.
pub(super) fn linear_scene(
    pulse: &Forcing,
    restitution: f64,
    block: [f64; 3],
) -> CaseScene {
    let [alpha, p, g] = block;
    let forcing = match pulse {
        Forcing::Pulse(kind) => Forcing::Pulse(rescaled(*kind, g * alpha, p)),
        other => other.clone(),
    };
    CaseScene::new(block, restitution, forcing).in_equation(Model::Linearized)
}

/// Where a pulse begins to overturn such a block without an impact, within
/// 1e-6 of an amplitude.
pub(super) fn overturns_from(
    context: &Context,
    (pulse, scale): (PulseName, f64),
    block: [f64; 3],
    near: f64,
) -> Result<f64> {
    flip(near, |a| {
        let pulse = Forcing::pulse(pulse, a, scale);
        let scene = linear_scene(&pulse, 0.92, block).until(200.0 / block[1]);
        overturns_at_once(context.engine, scene)
    })
}

/// Amplitudes at which a pulse overturns without impact.
pub fn critical(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        pulse: PulseName, scales: Vec<f64>,
        /// Block: alpha (rad), p (rad/s), g (m/s2).
        block: [f64; 3],
    }
    for &scale in &scales {
        let condition = match pulse {
            PulseName::HalfSine => overturning::sine_without_impact(1, scale),
            PulseName::OneSine => overturning::sine_without_impact(2, scale),
            PulseName::OneCosine => overturning::one_cosine(scale),
            PulseName::Rectangle => overturning::rectangle(scale),
            PulseName::Triangle => overturning::triangle(scale),
            other => bail!("pulse `{other}`"),
        };
        let found = overturns_from(context, (pulse, scale), block, condition)?;
        answer.put("critical-amplitude", [found], [condition]);
    }
    Ok(())
}

/// Whether a scene ends beyond pi/2, before any impact.
pub(super) fn overturns_at_once(
    engine: &dyn Engine,
    scene: CaseScene,
) -> Result<bool> {
    let trace = engine.respond(&scene.to(Overturning::HalfPi))?;
    Ok(trace.overturned_s.is_some() && trace.impacts.is_empty())
}

/// Where a predicate turns true within 1e-6 of `near`; not a number where
/// it does not.
pub(super) fn flip(
    near: f64,
    above: impl Fn(f64) -> Result<bool>,
) -> Result<f64> {
    edge(around(near, 1e-6), 1e-13, above)
}

/// The frequency beyond which a one-sine pulse cannot overturn after an
/// impact.
pub fn fold(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; restitution: Vec<f64>, block: [f64; 3]);
    for &eta in &restitution {
        let (omega, a) = overturning::fold(eta);
        let scene = |omega: f64| {
            let pulse = Forcing::pulse(PulseName::OneSine, a, omega);
            linear_scene(&pulse, eta, block)
        };
        let found = flip(omega, |omega| {
            let scene = scene(omega).until(200.0 / block[1]);
            let scene = scene.to(Overturning::HalfPi);
            Ok(context.engine.respond(&scene)?.overturned_s.is_none())
        })?;
        answer.put("fold", [found], [omega]);
        let scene = scene(omega);
        let seen = context.state(&scene, scene.forcing.end_s())?;
        let angle = seen.rotation_rad.abs() / scene.slenderness_rad;
        let due = 2.0 - 1.0 / (eta * eta);
        answer.put("rotation-at-pulse-end", [angle], [due]);
    }
    Ok(())
}

/// Critical durations of rectangular pulses in Eq. 1.
pub fn durations(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        slenderness_rad: Vec<f64>, frequency_rad_s: Vec<f64>,
        /// Acceleration over g tan(alpha).
        intensity: Vec<f64>,
    }
    let blocks = pairs(&slenderness_rad, &frequency_rad_s);
    for ((alpha, p), intensity) in pairs(&blocks, &intensity) {
        let pull = intensity * libm::tan(alpha);
        let form = Rectangular { alpha_rad: alpha, frequency_rad_s: p, pull };
        let critical = form.duration_to_energy_s(0.0);
        let found = flip(critical, |duration_s| {
            let name = PulseName::Rectangle;
            let pulse = Forcing::pulse(name, pull * 9.81, duration_s);
            let scene = CaseScene::new([alpha, p, 9.81], 0.92, pulse);
            overturns_at_once(context.engine, scene.until(200.0 / p))
        })?;
        answer.put("critical-duration-p", [found * p], [critical * p]);
    }
    Ok(())
}
