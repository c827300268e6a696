//! Single responses against references: impacts, peaks, rest, overturning.

use anyhow::Result;

use super::method::{Context, Reply, SPEEDS};
use crate::references::{
    self, Decimal, FREE_ROCKING, LINEAR_PULSES, RECT_PULSE, hits,
};
use crate::scene::{CaseScene, Forcing, Model, Overturning};

/// A time that there may be, found and due, each times `p`.
fn put_time(
    answer: &mut Reply,
    name: &str,
    found_s: Option<f64>,
    due: Option<Decimal>,
    p: f64,
) {
    let due = due.map(|t| t.near * p);
    answer.put(name, found_s.map(|t| t * p), due);
}

/// A sampled or pulse trajectory of 36 digits.
pub fn trajectory(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; entry: String);
    let case = references::trajectory(&entry)?;
    let due = &case.expected;
    let scene = case.scene(Overturning::HalfPi)?;
    let p = scene.frequency_rad_s;
    let trace = context.engine.respond(&scene)?;
    let first = context.engine.respond(&scene.to(Overturning::Alpha))?;

    let uplift = due.uplifts.first();
    let at = uplift.map(|u| u.t);
    put_time(answer, "uplift-time-p", trace.uplift_s, at, p);
    let rest = due.rest_times.last().copied();
    put_time(answer, "rest-time-p", trace.rest_s, rest, p);
    let half_pi = due.overturned(Overturning::HalfPi);
    put_time(answer, "half-pi-time-p", trace.overturned_s, half_pi, p);
    let alpha = due.overturned(Overturning::Alpha);
    put_time(answer, "alpha-time-p", first.overturned_s, alpha, p);
    if half_pi.is_none() {
        put_time(answer, "peak-time-p", trace.peak_time_s, due.t_peak, p);
        let peak = due.peak().map(|peak| peak.near);
        answer.put("peak-ratio", [trace.peak_ratio], peak);
    }
    answer.put("uplifts", [trace.uplifts as f64], [due.n_uplifts]);
    let side = uplift.map_or(0.0, |u| u.side);
    answer.put("side", [trace.first_side], [side]);
    answer.put_impacts(SPEEDS, &trace, [p, 1.0], &hits(&due.impacts, p));
    Ok(())
}

/// A pulse in Eq. 2 on several blocks: theta/alpha against p t is the same.
pub fn linear_pulse(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; entry: usize, blocks: Vec<[f64; 3]>);
    let case = LINEAR_PULSES.entry(entry)?;
    let due = &case.expected;
    // Later hops are free and decay: the largest of those listed is the peak.
    let peak = due.hops.iter().fold(0.0, |a: f64, hop| a.max(hop.near));
    for block in blocks {
        let [alpha, p, _] = block;
        let scene = case.scene(block, Overturning::Alpha)?;
        let trace = context.engine.respond(&scene)?;
        let units = [p, p * alpha];
        answer.put_impacts(SPEEDS, &trace, units, &hits(&due.impacts, 1.0));
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
    Ok(())
}

/// Free rocking: impacts and settling time.
pub fn free_rocking(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; entry: usize, equation: Model);
    let case = FREE_ROCKING.entry(entry)?;
    let due = match equation {
        Model::Nonlinear => &case.nonlinear,
        Model::Linearized => &case.linear,
    };
    let [alpha, p, rotation_rad] =
        [case.alpha, case.p, case.theta0].map(|digits| digits.near);
    let release = Forcing::Free { rotation_rad };
    let scene = CaseScene::new([alpha, p, 9.81], case.eta.near, release);
    let trace = context.engine.respond(&scene.in_equation(equation))?;
    answer.put_impacts(SPEEDS, &trace, [p, 1.0], &hits(&due.impacts, p));
    answer.put("peak-ratio", [trace.peak_ratio], [rotation_rad / alpha]);
    let settling = Some(due.settling_time);
    put_time(answer, "rest-time-p", trace.rest_s, settling, p);
    Ok(())
}

/// Rectangular pulse in Eq. 1, by elliptic integrals.
pub fn rectangular_pulse(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; entry: usize);
    let case = RECT_PULSE.entry(entry)?;
    let p = case.p.near;
    let run = |criterion| context.engine.respond(&case.scene(criterion));
    let trace = run(Overturning::HalfPi)?;
    answer.put("side", [trace.first_side], [-1.0]);
    answer.put("uplift-time-p", trace.uplift_s.map(|t| t * p), [0.0]);
    let half_pi = case.overturned(Overturning::HalfPi);
    if half_pi.is_some() {
        put_time(answer, "half-pi-time-p", trace.overturned_s, half_pi, p);
        let alpha = case.overturned(Overturning::Alpha);
        let first = run(Overturning::Alpha)?;
        put_time(answer, "alpha-time-p", first.overturned_s, alpha, p);
        return Ok(());
    }
    put_time(answer, "peak-time-p", trace.peak_time_s, case.t_peak, p);
    if case.settling_time.is_some() {
        let due = case.settling_time;
        put_time(answer, "rest-time-p", trace.rest_s, due, p);
    }
    answer.put_impacts(SPEEDS, &trace, [p, 1.0], &hits(&case.impacts, p));
    let peak = case.peak_over_alpha.map(|peak| peak.near);
    answer.put("peak-ratio", [trace.peak_ratio], peak);
    Ok(())
}
