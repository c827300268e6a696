//! States along a trajectory: checkpoints, the turning point of every hop,
//! and the end of a pulse.

use serde::Deserialize;

use super::method::{Answer, Context};
use crate::error::MethodError;
use crate::references;
use crate::references::{LINEAR_PULSES, TRAJECTORIES};
use crate::scene::Overturning;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Input {
    entries: Vec<String>,
}

/// Checkpoints of trajectories, and the peak of every hop that they list.
pub(super) fn trajectories(context: &Context) -> Result<Answer, MethodError> {
    let input: Input = context.input()?;
    let file = &TRAJECTORIES;
    let mut answer = Answer::default();
    for entry in &input.entries {
        let case = references::trajectory(entry)?;
        let scene = references::scene(case, Overturning::HalfPi)?;
        let (alpha, p) = (scene.slenderness_rad, scene.frequency_rad_s);
        let expected = file.get(case, "expected")?;
        for point in file.list(expected, "checkpoints")? {
            let seen = context.state(&scene, file.f64(point, "t")?)?;
            answer.put(
                "checkpoint-rotations",
                [seen.rotation_rad / alpha],
                [file.f64(point, "theta")? / alpha],
            );
            answer.put(
                "checkpoint-velocities",
                [seen.velocity_rad_s / (p * alpha)],
                [file.f64(point, "theta_dot")? / (p * alpha)],
            );
        }
        for hop in file.list(expected, "peak_of_hop_before_impact")? {
            let seen = context.state(&scene, file.f64(hop, "t")?)?;
            let peak = file.f64(hop, "abs_theta_over_alpha")?;
            let side = file.f64(hop, "side")?;
            answer.put(
                "hop-peaks",
                [seen.rotation_rad / alpha],
                [side * peak],
            );
            // At rest for an instant: the peak is where the reference has
            // it.
            answer.put(
                "velocity-at-hop-peaks",
                [seen.velocity_rad_s / (p * alpha)],
                [0.0],
            );
        }
    }
    Ok(answer)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PulseEnds {
    /// Block: alpha (rad), p (rad/s), g (m/s2).
    block: [f64; 3],
}

/// Coordinates on the growing and the decaying manifold of the saddle,
/// z - 1 + z' and z - 1 - z', where a pulse in Eq. 2 ends.
pub(super) fn pulse_ends(context: &Context) -> Result<Answer, MethodError> {
    let PulseEnds { block } = context.input()?;
    let [alpha, p, _] = block;
    let file = &LINEAR_PULSES;
    let all = file.read()?;
    let mut answer = Answer::default();
    for case in file.list(&all, "cases")? {
        let expected = file.get(case, "expected")?;
        let end = file.get(expected, "state_at_pulse_end")?;
        if end.is_null() {
            continue;
        }
        let scene =
            references::linear_scene(case, block, Overturning::HalfPi)?;
        let seen = context.state(&scene, scene.forcing.end_s())?;
        let side = seen.rotation_rad.signum();
        let z = side * seen.rotation_rad / alpha;
        let w = side * seen.velocity_rad_s / (p * alpha);
        for (name, key, value) in [
            ("growing", "E_plus", z - 1.0 + w),
            ("decaying", "E_minus", z - 1.0 - w),
        ] {
            answer.put(name, [value], [file.f64(end, key)?]);
        }
    }
    Ok(answer)
}
