//! Single responses against references: impacts, peaks, rest, overturning,
//! and states along a trajectory.

use anyhow::Result;

use super::method::{Context, Reply, SPEEDS};
use crate::references::{
    self, Decimal, FREE_ROCKING, LINEAR_PULSES, RECT_PULSE, hits,
};
use crate::scene::{CaseScene, Forcing, Model, Overturning, by_equation};

/// Puts optional times, found and due, each times `p`.
fn put_times<const N: usize>(
    answer: &mut Reply,
    p: f64,
    times: [(&str, Option<f64>, Option<Decimal>); N],
) {
    for (name, found_s, due) in times {
        let due = due.map(|t| t.near * p);
        answer.put(name, found_s.map(|t| t * p), due);
    }
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
    let half_pi = due.overturned(Overturning::HalfPi);
    let alpha = due.overturned(Overturning::Alpha);
    let times = [
        ("uplift-time-p", trace.uplift_s, uplift.map(|u| u.t)),
        ("rest-time-p", trace.rest_s, due.rest_times.last().copied()),
        ("half-pi-time-p", trace.overturned_s, half_pi),
        ("alpha-time-p", first.overturned_s, alpha),
    ];
    put_times(answer, p, times);
    if half_pi.is_none() {
        let peak = ("peak-time-p", trace.peak_time_s, due.t_peak);
        put_times(answer, p, [peak]);
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
    let due = by_equation(equation, &case.nonlinear, &case.linear);
    let [alpha, p, rotation_rad] =
        [case.alpha, case.p, case.theta0].map(|digits| digits.near);
    let release = Forcing::Free { rotation_rad };
    let scene = CaseScene::new([alpha, p, 9.81], case.eta.near, release);
    let trace = context.engine.respond(&scene.in_equation(equation))?;
    answer.put_impacts(SPEEDS, &trace, [p, 1.0], &hits(&due.impacts, p));
    answer.put("peak-ratio", [trace.peak_ratio], [rotation_rad / alpha]);
    let rest = ("rest-time-p", trace.rest_s, Some(due.settling_time));
    put_times(answer, p, [rest]);
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
        let alpha = case.overturned(Overturning::Alpha);
        let first = run(Overturning::Alpha)?;
        let times = [
            ("half-pi-time-p", trace.overturned_s, half_pi),
            ("alpha-time-p", first.overturned_s, alpha),
        ];
        put_times(answer, p, times);
        return Ok(());
    }
    let peak = ("peak-time-p", trace.peak_time_s, case.t_peak);
    put_times(answer, p, [peak]);
    if let Some(due) = case.settling_time {
        put_times(answer, p, [("rest-time-p", trace.rest_s, Some(due))]);
    }
    answer.put_impacts(SPEEDS, &trace, [p, 1.0], &hits(&case.impacts, p));
    let peak = case.peak_over_alpha.map(|peak| peak.near);
    answer.put("peak-ratio", [trace.peak_ratio], peak);
    Ok(())
}

/// Checkpoints of trajectories, and the peak of every hop that they list.
pub fn points(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; entries: Vec<String>);
    for entry in &entries {
        let case = references::trajectory(entry)?;
        let scene = case.scene(Overturning::HalfPi)?;
        let (alpha, p) = (scene.slenderness_rad, scene.frequency_rad_s);
        let mut put = |names: [&str; 2], time_s, due: [f64; 2]| {
            let seen = context.state(&scene, time_s)?;
            let speed = seen.velocity_rad_s / (p * alpha);
            answer.put(names[0], [seen.rotation_rad / alpha], [due[0]]);
            answer.put(names[1], [speed], [due[1]]);
            anyhow::Ok(())
        };
        for point in &case.expected.checkpoints {
            let names = ["checkpoint-rotations", "checkpoint-velocities"];
            let velocity = point.theta_dot.near / (p * alpha);
            let due = [point.theta.near / alpha, velocity];
            put(names, point.t.near, due)?;
        }
        // At its peak the block is at rest for an instant.
        for hop in &case.expected.hops {
            let names = ["hop-peaks", "velocity-at-hop-peaks"];
            let peak = hop.side * hop.abs_theta_over_alpha.near;
            put(names, hop.t.near, [peak, 0.0])?;
        }
    }
    Ok(())
}

/// Coordinates on the growing and the decaying manifold of the saddle,
/// z - 1 + z' and z - 1 - z', at the end of a pulse in Eq. 2.
pub fn pulse_ends(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; block: [f64; 3]);
    let [alpha, p, _] = block;
    for case in &LINEAR_PULSES.read()?.cases {
        let Some(due) = &case.expected.state_at_pulse_end else { continue };
        let scene = case.scene(block, Overturning::HalfPi)?;
        let seen = context.state(&scene, scene.forcing.end_s())?;
        let side = seen.rotation_rad.signum();
        let z = side * seen.rotation_rad / alpha;
        let w = side * seen.velocity_rad_s / (p * alpha);
        answer.put("growing", [z - 1.0 + w], [due.growing.near]);
        answer.put("decaying", [z - 1.0 - w], [due.decaying.near]);
    }
    Ok(())
}
