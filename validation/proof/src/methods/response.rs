//! Single responses against references: impacts, peaks, rest, overturning.

use super::method::{Answer, Context, MethodError};
use crate::references::{
    self, Digits, FREE_ROCKING, Hit, LINEAR_PULSES, RECT_PULSE,
};
use crate::scene::{Forcing, Model, Overturning, Scene, Trace};

/// Impact times times `rate` and speeds over `unit_speed`, as many as the
/// reference lists; a block that goes on where it should not shows in its
/// fate. The reference's own times are multiplied by `scale`.
fn put_impacts(
    answer: &mut Answer,
    trace: &Trace,
    listed: &[Hit],
    [rate, unit_speed, scale]: [f64; 3],
) {
    let impacts = || trace.impacts.iter().take(listed.len());
    answer.put(
        "impact-times-p",
        impacts().map(|i| i.time_s * rate),
        listed.iter().map(|hit| hit.t.near * scale),
    );
    answer.put(
        "impact-speeds",
        impacts().map(|i| i.speed_before_rad_s / unit_speed),
        listed.iter().map(Hit::speed),
    );
}

/// A time that there may be, found and due, each times `p`.
fn put_time(
    answer: &mut Answer,
    name: &str,
    found_s: Option<f64>,
    due: Option<Digits>,
    p: f64,
) {
    let due = due.map(|t| t.near * p);
    answer.put(name, found_s.map(|t| t * p), due);
}

/// A sampled or pulse trajectory of 36 digits.
pub(super) fn trajectory(context: &Context) -> Result<Answer, MethodError> {
    input!(context; entry: String);
    let case = references::trajectory(&entry)?;
    let due = &case.expected;
    let scene = case.scene(Overturning::HalfPi)?;
    let p = scene.frequency_rad_s;
    let trace = context.engine.respond(&scene)?;
    let first = Scene { overturning: Overturning::Alpha, ..scene };
    let first = context.engine.respond(&first)?;

    let mut answer = Answer::default();
    let mut put = |name: &str, found, due| {
        put_time(&mut answer, name, found, due, p);
    };
    let uplift = due.uplifts.first();
    put("uplift-time-p", trace.uplift_s, uplift.map(|u| u.t));
    put("rest-time-p", trace.rest_s, due.rest_times.last().copied());
    let half_pi = due.overturned(Overturning::HalfPi);
    put("half-pi-time-p", trace.overturned_s, half_pi);
    let alpha = due.overturned(Overturning::Alpha);
    put("alpha-time-p", first.overturned_s, alpha);
    if half_pi.is_none() {
        put("peak-time-p", trace.peak_time_s, due.t_peak);
        let peak = due.peak().map(|peak| peak.near);
        answer.put("peak-ratio", [trace.peak_ratio], peak);
    }
    answer.put("uplifts", [trace.uplifts as f64], [due.n_uplifts]);
    let side = uplift.map_or(0.0, |u| u.side);
    answer.put("side", [trace.first_side], [side]);
    put_impacts(&mut answer, &trace, &due.impacts, [p, 1.0, p]);
    Ok(answer)
}

/// A pulse in Eq. 2 on several blocks: theta/alpha against p t is the same.
pub(super) fn linear_pulse(context: &Context) -> Result<Answer, MethodError> {
    input!(context; entry: usize, blocks: Vec<[f64; 3]>);
    let case = LINEAR_PULSES.entry(entry)?;
    let due = &case.expected;
    // Later hops are free and decay: the largest of those listed is the peak.
    let peak = due.hops.iter().fold(0.0, |a: f64, hop| a.max(hop.near));
    let mut answer = Answer::default();
    for block in blocks {
        let [alpha, p, _] = block;
        let scene = case.scene(block, Overturning::Alpha)?;
        let trace = context.engine.respond(&scene)?;
        let units = [p, p * alpha, 1.0];
        put_impacts(&mut answer, &trace, &due.impacts, units);
        answer.put("side", [trace.first_side], [due.side]);
        let time = |t: Option<f64>| t.map(|t| t * p);
        let uplift = [due.uplift_tau.near];
        answer.put("uplift-time-p", time(trace.uplift_s), uplift);
        let over = due.overturned.map(|t| t.near);
        answer.put("alpha-time-p", time(trace.overturned_s), over);
        if due.verdict.as_deref() == Some("returns") {
            answer.put("peak-ratio", [trace.peak_ratio], [peak]);
        }
    }
    Ok(answer)
}

/// Free rocking: impacts and settling time.
pub(super) fn free_rocking(context: &Context) -> Result<Answer, MethodError> {
    input!(context; entry: usize, equation: Model);
    let case = FREE_ROCKING.entry(entry)?;
    let due = match equation {
        Model::Nonlinear => &case.nonlinear,
        Model::Linearized => &case.linear,
    };
    let [alpha, p, rotation_rad] =
        [case.alpha, case.p, case.theta0].map(|digits| digits.near);
    let release = Forcing::Free { rotation_rad };
    let scene = Scene {
        model: equation,
        ..Scene::new([alpha, p, 9.81], case.eta.near, release)
    };
    let trace = context.engine.respond(&scene)?;
    let mut answer = Answer::default();
    put_impacts(&mut answer, &trace, &due.impacts, [p, 1.0, p]);
    answer.put("peak-ratio", [trace.peak_ratio], [rotation_rad / alpha]);
    let settling = Some(due.settling_time);
    put_time(&mut answer, "rest-time-p", trace.rest_s, settling, p);
    Ok(answer)
}

/// Rectangular pulse in Eq. 1, by elliptic integrals.
pub(super) fn rectangular_pulse(
    context: &Context,
) -> Result<Answer, MethodError> {
    input!(context; entry: usize);
    let case = RECT_PULSE.entry(entry)?;
    let p = case.p.near;
    let run = |criterion| context.engine.respond(&case.scene(criterion));
    let trace = run(Overturning::HalfPi)?;
    let mut answer = Answer::default();
    answer.put("side", [trace.first_side], [-1.0]);
    answer.put("uplift-time-p", trace.uplift_s.map(|t| t * p), [0.0]);
    let mut put = |name: &str, found, due| {
        put_time(&mut answer, name, found, due, p);
    };
    let half_pi = case.overturned(Overturning::HalfPi);
    if half_pi.is_some() {
        put("half-pi-time-p", trace.overturned_s, half_pi);
        let alpha = case.overturned(Overturning::Alpha);
        let first = run(Overturning::Alpha)?;
        put("alpha-time-p", first.overturned_s, alpha);
        return Ok(answer);
    }
    put("peak-time-p", trace.peak_time_s, case.t_peak);
    if case.settling_time.is_some() {
        put("rest-time-p", trace.rest_s, case.settling_time);
    }
    put_impacts(&mut answer, &trace, &case.impacts, [p, 1.0, p]);
    let peak = case.peak_over_alpha.map(|peak| peak.near);
    answer.put("peak-ratio", [trace.peak_ratio], peak);
    Ok(answer)
}
