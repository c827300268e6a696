//! Scenes made to be hard: beside the saddle, chatter under a constant
//! acceleration, and double precision against double-double.

use rocking::number::Real as _;
use serde::Deserialize;

use super::fates::Samples;
use super::method::{Answer, Context, MethodError, input_of};
use super::wrong::scale;
use crate::cases::Case;
use crate::engine::{Arithmetic, WideTrace};
use crate::oracles::free_rocking;
use crate::oracles::rectangular::Rectangular;
use crate::references;
use crate::scene::{Forcing, Model, PulseKind, Scene};

/// Rectangular pulses in Eq. 1 that leave a block an energy so much below
/// the saddle that its peak stops at a distance from it, or as much above.
pub(super) fn saddle(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        slenderness_rad: Vec<f64>, frequency_rad_s: f64,
        /// Acceleration over g tan(alpha).
        intensity: f64,
        /// Distances of the peak from alpha, over alpha.
        distances: Vec<f64>,
    }
    let p = frequency_rad_s;
    let mut answer = Answer::default();
    for &alpha in &slenderness_rad {
        let pull = intensity * libm::tan(alpha);
        let form = Rectangular { alpha_rad: alpha, frequency_rad_s: p, pull };
        for &distance in &distances {
            // A peak at alpha (1 - d) has an energy 2 sin^2(alpha d/2) below
            // the saddle's.
            let half = libm::sin(0.5 * alpha * distance);
            let depth = 2.0 * half * half;
            for (sign, falls) in [(-1.0, 0.0), (1.0, 1.0)] {
                let duration_s = form.duration_to_energy_s(sign * depth);
                let scene = Scene {
                    until_s: Some(100.0 / p),
                    ..Scene::new(
                        [alpha, p, 9.81],
                        0.92,
                        Forcing::Pulse(PulseKind::Rectangle {
                            amplitude: pull * 9.81,
                            duration_s,
                        }),
                    )
                };
                let trace = context.engine.respond(&scene)?;
                let over = f64::from(trace.overturned_s.is_some());
                answer.put("overturned", [over], [falls]);
                if falls == 0.0 {
                    let gap = 1.0 - trace.peak_ratio;
                    answer.put("gap-over-distance", [gap / distance], [1.0]);
                }
            }
        }
    }
    Ok(answer)
}

/// Chatter to rest under a constant acceleration: after the first impact
/// every time, speed and the end of the series are known in closed form.
pub(super) fn chatter(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        equation: Model, slenderness_rad: f64, frequency_rad_s: f64,
        restitution: f64,
        /// Constant acceleration over the uplift threshold, below 1, that
        /// follows a jolt.
        intensity: f64,
        impacts: usize,
    }
    let (p, alpha) = (frequency_rad_s, slenderness_rad);
    let mut scene = Scene {
        model: equation,
        ..Scene::new([alpha, p, 9.81], restitution, Forcing::NONE)
    };
    let threshold = scene.threshold_m_s2();
    let steady = intensity * threshold;
    let mut samples = vec![1.6 * threshold; 12];
    samples.resize(4000, steady);
    let dt_s = 0.01 / p;
    scene.forcing = Forcing::Samples { dt_s, acceleration_m_s2: samples };
    let trace = context.engine.respond(&scene)?;
    let mut answer = Answer::default();
    // The jolt drives theta negative; the first hop on the other side is
    // pressed down harder.
    let Some(first) = trace.impacts.first() else {
        return Err(MethodError::Oracle("no impact".to_owned()));
    };
    if !(first.time_s > 13.0 * dt_s) {
        let text = "first impact before the acceleration is steady";
        return Err(MethodError::Input(text.to_owned()));
    }
    let form = free_rocking::chatter(
        equation == Model::Nonlinear,
        alpha,
        restitution,
        steady / 9.81,
        (first.time_s * p, first.speed_before_rad_s / p),
        impacts,
    );
    let seen = || trace.impacts.iter().skip(1).take(impacts);
    answer.put(
        "impact-times-p",
        seen().map(|i| i.time_s * p),
        form.impact_times_p,
    );
    answer.put(
        "impact-speeds",
        seen().map(|i| i.speed_before_rad_s / p),
        form.impact_speeds_p,
    );
    answer.put("rest-time-p", trace.rest_s.map(|t| t * p), [form.settling_p]);
    Ok(answer)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TwinInput {
    equation: Model,
    slenderness_rad: f64,
    frequency_rad_s: f64,
    restitution: f64,
    /// A record of the references, scaled to PGA over the threshold.
    #[serde(default)]
    named: Option<(String, f64)>,
    /// A record written out.
    #[serde(default)]
    record: Option<Samples>,
    /// The whole record times each of these.
    #[serde(default)]
    factors: Vec<f64>,
    /// Impacts compared.
    impacts: usize,
}

/// Double precision against double-double, to the last digits.
pub(super) fn twin(context: &Context) -> Result<Answer, MethodError> {
    let input: TwinInput = context.input()?;
    let mut answer = Answer::default();
    for scene in twins(&input)? {
        let p = scene.frequency_rad_s;
        let truth = WideTrace::run(&scene, Arithmetic::DoubleDouble)?;
        let trace = context.engine.respond(&scene)?;
        let listed = || truth.impacts.iter().take(input.impacts);
        let seen = || trace.impacts.iter().take(input.impacts);
        answer.put(
            "impact-times-p",
            seen().map(|i| i.time_s * p),
            listed().map(|i| i.0.to_f64() * p),
        );
        answer.put(
            "impact-speeds",
            seen().map(|i| i.speed_before_rad_s),
            listed().map(|i| i.1.to_f64()),
        );
        answer.put(
            "alpha-time-p",
            trace.overturned_s.map(|t| t * p),
            truth.overturned_s.map(|t| t.to_f64() * p),
        );
        if truth.overturned_s.is_none() {
            answer.put(
                "peak-ratio",
                [trace.peak_ratio],
                [truth.peak_ratio.to_f64()],
            );
        }
    }
    Ok(answer)
}

/// The first scene of such a case.
pub(super) fn scene_of(case: &Case) -> Result<Scene, MethodError> {
    let input: TwinInput = input_of(case)?;
    let first = twins(&input)?.into_iter().next();
    first.ok_or_else(|| MethodError::Input("no scene".to_owned()))
}

fn twins(input: &TwinInput) -> Result<Vec<Scene>, MethodError> {
    let mut scene = Scene {
        model: input.equation,
        ..Scene::new(
            [input.slenderness_rad, input.frequency_rad_s, 9.81],
            input.restitution,
            Forcing::NONE,
        )
    };
    scene.forcing = match (&input.named, &input.record) {
        (Some((name, intensity)), None) => {
            let (dt_s, mut samples) = references::record(name)?;
            let peak = samples.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
            let factor = intensity * scene.threshold_m_s2() / peak;
            samples.iter_mut().for_each(|x| *x *= factor);
            Forcing::Samples { dt_s, acceleration_m_s2: samples }
        }
        (None, Some(record)) => record.forcing()?,
        _ => {
            let text = "one of `named` and `record`".to_owned();
            return Err(MethodError::Input(text));
        }
    };
    let factors = if input.factors.is_empty() {
        &[1.0]
    } else {
        input.factors.as_slice()
    };
    Ok(factors
        .iter()
        .map(|factor| {
            let mut scene = scene.clone();
            scale(&mut scene.forcing, *factor);
            scene
        })
        .collect())
}
