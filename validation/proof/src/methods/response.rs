//! Single responses against references: impacts, peaks, rest, overturning.

use serde::Deserialize;
use serde_json::Value;

use super::method::{Answer, Context};
use crate::error::MethodError;
use crate::references;
use crate::references::{
    FREE_ROCKING, LINEAR_PULSES, Named, Numbered, PulseOnBlocks, RECT_PULSE,
    TRAJECTORIES,
};
use crate::scene::{Forcing, Model, Overturning, Scene, Trace};

/// Impact times times `rate` and speeds over `unit_speed`, as many as the
/// reference lists; a block that goes on where it should not shows in its
/// fate.
fn put_impacts(
    answer: &mut Answer,
    trace: &Trace,
    listed: (Vec<f64>, Vec<f64>),
    rate: f64,
    unit_speed: f64,
) {
    let (times, speeds) = listed;
    let count = times.len();
    let impacts = || trace.impacts.iter().take(count);
    answer.put("impact-times-p", impacts().map(|i| i.time_s * rate), times);
    answer.put(
        "impact-speeds",
        impacts().map(|i| i.speed_before_rad_s / unit_speed),
        speeds,
    );
}

/// A sampled or pulse trajectory of 36 digits.
pub(super) fn trajectory(context: &Context) -> Result<Answer, MethodError> {
    let Named { entry } = context.input()?;
    let file = &TRAJECTORIES;
    let case = references::trajectory(&entry)?;
    let expected = file.get(case, "expected")?;
    let scene = references::scene(case, Overturning::HalfPi)?;
    let p = scene.frequency_rad_s;
    let trace = context.engine.respond(&scene)?;
    let first = Scene { overturning: Overturning::Alpha, ..scene };
    let first = context.engine.respond(&first)?;

    let mut answer = Answer::default();
    let times = |list: &[Value]| -> Result<Vec<f64>, MethodError> {
        Ok(file.column(list, "t")?.iter().map(|t| t * p).collect())
    };
    let uplifts = file.list(expected, "uplifts")?;
    answer.put(
        "uplift-time-p",
        trace.uplift_s.map(|t| t * p),
        times(uplifts)?.into_iter().take(1),
    );
    answer.put(
        "uplifts",
        [trace.uplifts as f64],
        [file.f64(expected, "n_uplifts")?],
    );
    let side = uplifts.first().map(|u| file.f64(u, "side"));
    let side = side.transpose()?.unwrap_or(0.0);
    answer.put("side", [trace.first_side], [side]);
    let impacts = file.list(expected, "impacts")?;
    let speeds = file.column(impacts, "theta_dot_before")?;
    put_impacts(
        &mut answer,
        &trace,
        (times(impacts)?, speeds.iter().map(|v| v.abs()).collect()),
        p,
        1.0,
    );
    let rests = file.list(expected, "rest_times")?;
    let rest = rests.last().map(|t| file.number(t)).transpose()?;
    answer.put(
        "rest-time-p",
        trace.rest_s.map(|t| t * p),
        rest.map(|t| t * p),
    );
    let overturns = expected["overturned_pi_over_2"] == true;
    if !overturns {
        answer.put(
            "peak-ratio",
            [trace.peak_ratio],
            [file.f64(expected, "peak_abs_theta_over_alpha")?],
        );
        let peak = file.optional(expected, "t_peak")?;
        answer.put(
            "peak-time-p",
            trace.peak_time_s.map(|t| t * p),
            peak.map(|t| t * p),
        );
    }
    let fate = [
        ("half-pi-time-p", &trace, "t_abs_theta_eq_pi_over_2"),
        ("alpha-time-p", &first, "t_first_abs_theta_eq_alpha"),
    ];
    for (name, trace, key) in fate {
        let time = file.optional(expected, key)?;
        answer.put(
            name,
            trace.overturned_s.map(|t| t * p),
            time.map(|t| t * p),
        );
    }
    Ok(answer)
}

/// A pulse in Eq. 2 on several blocks: theta/alpha against p t is the same.
pub(super) fn linear_pulse(context: &Context) -> Result<Answer, MethodError> {
    let input: PulseOnBlocks = context.input()?;
    let file = &LINEAR_PULSES;
    let case = &references::entry(file, input.entry)?;
    let expected = file.get(case, "expected")?;
    let impacts = file.list(expected, "impacts")?;
    let times = file.column(impacts, "tau")?;
    let speeds: Vec<f64> = file
        .column(impacts, "phi_dot_before")?
        .iter()
        .map(|v| v.abs())
        .collect();
    let uplift = file.f64(expected, "uplift_tau")?;
    let side = file.f64(expected, "side")?;
    let over = file.optional(expected, "tau_first_abs_phi_eq_1")?;
    let hops = file.list(expected, "peak_of_hop_before_impact")?;
    let hops: Result<Vec<f64>, _> =
        hops.iter().map(|x| file.number(x)).collect();
    let hops = hops?;
    // Later hops are free and decay: the largest of those listed is the peak.
    let listed = hops.iter().fold(0.0, |a: f64, b| a.max(*b));

    let mut answer = Answer::default();
    for [alpha, p, g] in input.blocks.iter().copied() {
        let block = [alpha, p, g];
        let scene = references::linear_scene(case, block, Overturning::Alpha)?;
        let trace = context.engine.respond(&scene)?;
        put_impacts(
            &mut answer,
            &trace,
            (times.clone(), speeds.clone()),
            p,
            p * alpha,
        );
        answer.put("side", [trace.first_side], [side]);
        answer.put("uplift-time-p", trace.uplift_s.map(|t| t * p), [uplift]);
        answer.put("alpha-time-p", trace.overturned_s.map(|t| t * p), over);
        if case["expected"]["verdict"] == "returns" {
            answer.put("peak-ratio", [trace.peak_ratio], [listed]);
        }
    }
    Ok(answer)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FreeInput {
    entry: usize,
    equation: Model,
}

/// Free rocking: impacts and settling time.
pub(super) fn free_rocking(context: &Context) -> Result<Answer, MethodError> {
    let input: FreeInput = context.input()?;
    let file = &FREE_ROCKING;
    let case = &references::entry(file, input.entry)?;
    // The file's own names.
    let key = match input.equation {
        Model::Nonlinear => "nonlinear",
        Model::Linearized => "linear",
    };
    let expected = file.get(case, key)?;
    let p = file.f64(case, "p")?;
    let rotation_rad = file.f64(case, "theta0")?;
    let scene = Scene {
        model: input.equation,
        ..Scene::new(
            [file.f64(case, "alpha")?, p, 9.81],
            file.f64(case, "eta")?,
            Forcing::Free { rotation_rad },
        )
    };
    let trace = context.engine.respond(&scene)?;
    let mut answer = Answer::default();
    let impacts = file.list(expected, "impacts")?;
    let times = file.column(impacts, "t")?;
    put_impacts(
        &mut answer,
        &trace,
        (
            times.iter().map(|t| t * p).collect(),
            file.column(impacts, "speed")?,
        ),
        p,
        1.0,
    );
    answer.put(
        "peak-ratio",
        [trace.peak_ratio],
        [rotation_rad / scene.slenderness_rad],
    );
    answer.put(
        "rest-time-p",
        trace.rest_s.map(|t| t * p),
        [file.f64(expected, "settling_time")? * p],
    );
    Ok(answer)
}

/// Rectangular pulse in Eq. 1, by elliptic integrals.
pub(super) fn rectangular_pulse(
    context: &Context,
) -> Result<Answer, MethodError> {
    let Numbered { entry } = context.input()?;
    let file = &RECT_PULSE;
    let case = &references::entry(file, entry)?;
    let p = file.f64(case, "p")?;
    let scene = |criterion| references::rectangular_scene(case, criterion);
    let trace = context.engine.respond(&scene(Overturning::HalfPi)?)?;
    let mut answer = Answer::default();
    answer.put("side", [trace.first_side], [-1.0]);
    answer.put("uplift-time-p", trace.uplift_s.map(|t| t * p), [0.0]);
    if case["outcome"] == "overturns" {
        let first = context.engine.respond(&scene(Overturning::Alpha)?)?;
        for (name, trace, key) in [
            ("alpha-time-p", &first, "t_theta_eq_alpha"),
            ("half-pi-time-p", &trace, "t_theta_eq_pi_over_2"),
        ] {
            answer.put(
                name,
                trace.overturned_s.map(|t| t * p),
                [file.f64(case, key)? * p],
            );
        }
        return Ok(answer);
    }
    let impacts = file.list(case, "impacts")?;
    let times = file.column(impacts, "t")?;
    let speeds = file.column(impacts, "speed")?;
    let times = times.iter().map(|t| t * p).collect();
    put_impacts(&mut answer, &trace, (times, speeds), p, 1.0);
    answer.put(
        "peak-ratio",
        [trace.peak_ratio],
        [file.f64(case, "peak_over_alpha")?],
    );
    answer.put(
        "peak-time-p",
        trace.peak_time_s.map(|t| t * p),
        [file.f64(case, "t_peak")? * p],
    );
    if !case["settling_time"].is_null() {
        answer.put(
            "rest-time-p",
            trace.rest_s.map(|t| t * p),
            [file.f64(case, "settling_time")? * p],
        );
    }
    Ok(answer)
}
