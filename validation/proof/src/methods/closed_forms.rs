//! Grids of blocks and pulses against the oracles.

use std::f64::consts::PI;

use anyhow::{Result, bail};

use super::edges::WITHOUT_IMPACT;
use super::method::{Context, Reply, SPEEDS, WrongModel, pairs};
use crate::edge::{around, edge};
use crate::oracles::overturning::{self, sine_without_impact};
use crate::oracles::rectangular::Rectangular;
use crate::oracles::{free_rocking, linear};
use crate::pulse::rescaled;
use crate::scene::{
    CaseScene, Forcing, Model, Overturning, PulseKind, PulseName, Trace, pulse,
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
        let kind = self::pulse(pulse, a, scale);
        let form = linear::respond(kind, eta, impacts);
        for block in &blocks {
            let [alpha, p, _] = *block;
            let scene = linear_scene(kind, eta, *block);
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

/// A block (alpha, p, g) in Eq. 2 under the equivalent of a pulse on a block
/// with p = 1 rad/s and g alpha = 1 m/s2.
fn linear_scene(kind: PulseKind, eta: f64, block: [f64; 3]) -> CaseScene {
    let [alpha, p, g] = block;
    let forcing = Forcing::Pulse(rescaled(kind, g * alpha, p));
    CaseScene::new(block, eta, forcing).in_equation(Model::Linearized)
}

/// A long run of a scene, until it rests or passes pi/2.
fn long(context: &Context, scene: CaseScene) -> Result<Trace> {
    let until_s = 200.0 / scene.frequency_rad_s;
    let scene = scene.to(Overturning::HalfPi).until(until_s);
    Ok(context.engine.respond(&scene)?)
}

/// The number at which a predicate turns true, within 1e-6 of `near`; not a
/// number if it does not.
fn flip(near: f64, above: impl Fn(f64) -> Result<bool>) -> Result<f64> {
    edge(around(near, 1e-6), 1e-13, above)
}

/// The least amplitude at which a pulse overturns such a block without an
/// impact, within 1e-6 of `near`.
fn overturns_from(
    context: &Context,
    (pulse, scale): (PulseName, f64),
    block: [f64; 3],
    near: f64,
) -> Result<f64> {
    flip(near, |a| {
        let scene = linear_scene(self::pulse(pulse, a, scale), 0.92, block);
        Ok(WITHOUT_IMPACT(&long(context, scene)?))
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
            PulseName::HalfSine => sine_without_impact(1, scale),
            PulseName::OneSine => sine_without_impact(2, scale),
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

/// The frequency beyond which a one-sine pulse cannot overturn after an
/// impact.
pub fn fold(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; restitution: Vec<f64>, block: [f64; 3]);
    for &eta in &restitution {
        let (omega, a) = overturning::fold(eta);
        let scene = |omega: f64| {
            linear_scene(pulse(PulseName::OneSine, a, omega), eta, block)
        };
        let stands = |omega: f64| {
            Ok(long(context, scene(omega))?.overturned_s.is_none())
        };
        answer.put("fold", [flip(omega, stands)?], [omega]);
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
        let form = Rectangular::new(alpha, p, intensity);
        let critical = form.duration_to_energy_s(0.0);
        let found = flip(critical, |duration_s| {
            let scene = rectangle(&form, duration_s);
            Ok(WITHOUT_IMPACT(&long(context, scene)?))
        })?;
        answer.put("critical-duration-p", [found * p], [critical * p]);
    }
    Ok(())
}

/// A block in Eq. 1 under a rectangular pulse of a duration (s).
pub(super) fn rectangle(form: &Rectangular, duration_s: f64) -> CaseScene {
    let amplitude = form.pull * 9.81;
    let forcing = Forcing::pulse(PulseName::Rectangle, amplitude, duration_s);
    let block = [form.alpha_rad, form.frequency_rad_s, 9.81];
    CaseScene::new(block, 0.92, forcing)
}

/// Least amplitude at which a sine that never ends overturns without impact:
/// Housner's for the half sine, and the limit of many half cycles.
fn semi_infinite(omega: f64) -> f64 {
    (1.0 + omega * omega).sqrt()
}

/// Housner's sqrt(1 + Omega^2) over the least amplitude at which a half sine
/// overturns.
pub fn approximation(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        omega_over_p: Vec<f64>,
        /// Block: alpha (rad), p (rad/s), g (m/s2).
        block: [f64; 3],
    }
    for &omega in &omega_over_p {
        let classic = semi_infinite(omega);
        let exact = sine_without_impact(1, omega);
        let near = context.or(WrongModel::SemiInfiniteSine, classic, exact);
        let sine = (PulseName::HalfSine, omega);
        let found = overturns_from(context, sine, block, near)?;
        answer.see("classic-over-exact", [classic / found]);
    }
    Ok(())
}

/// Least amplitudes at which sines of N half periods overturn without
/// impact. The core reads such a sine as a record, whose broken line lies
/// below the curve by the second order of the interval: extrapolated from
/// two intervals to none.
pub fn many(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        half_cycles: Vec<u32>, omega_over_p: Vec<f64>, block: [f64; 3],
        /// Parts into which a half cycle is divided; then twice as many.
        intervals: u32,
    }
    let [alpha, p, g] = block;
    for (half_cycles, omega) in pairs(&half_cycles, &omega_over_p) {
        let exact = sine_without_impact(half_cycles, omega);
        let limit = semi_infinite(omega);
        let due = context.or(WrongModel::SemiInfiniteSine, limit, exact);
        let critical = |intervals: u32| {
            edge(around(exact, 1e-3), 1e-13, |a| {
                let sine = (a * (g * alpha), omega * p, half_cycles);
                let scene =
                    CaseScene::new(block, 0.92, broken(sine, intervals))
                        .in_equation(Model::Linearized);
                anyhow::Ok(WITHOUT_IMPACT(&long(context, scene)?))
            })
        };
        let coarse = critical(intervals)?;
        let fine = critical(2 * intervals)?;
        let found = fine + (fine - coarse) / 3.0;
        answer.put("critical-amplitude", [found], [due]);
    }
    Ok(())
}

/// A sine (amplitude in m/s2, rad/s, half periods) as a broken line with this
/// number of intervals a half period.
fn broken(
    (amplitude_m_s2, omega_rad_s, half_cycles): (f64, f64, u32),
    intervals: u32,
) -> Forcing {
    let sample = |k: u32| {
        // Exact zeros at the ends of the half periods.
        let (whole, part) = (k / intervals, k % intervals);
        let sign = if whole.is_multiple_of(2) { 1.0 } else { -1.0 };
        let phase = PI * f64::from(part) / f64::from(intervals);
        sign * amplitude_m_s2 * libm::sin(phase)
    };
    let dt_s = PI / (omega_rad_s * f64::from(intervals));
    let samples = (0..=half_cycles * intervals).map(sample);
    Forcing::samples(dt_s, samples.collect())
}
