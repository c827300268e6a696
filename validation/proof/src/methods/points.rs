//! States along a trajectory: checkpoints, the turning point of every hop,
//! and the end of a pulse.

use super::method::{Context, Reply};
use crate::references::{self, LINEAR_PULSES};
use crate::scene::Overturning;
use anyhow::Result;

/// Checkpoints of trajectories, and the peak of every hop that they list.
pub fn trajectories(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; entries: Vec<String>);
    for entry in &entries {
        let case = references::trajectory(entry)?;
        let scene = case.scene(Overturning::HalfPi)?;
        let (alpha, p) = (scene.slenderness_rad, scene.frequency_rad_s);
        for point in &case.expected.checkpoints {
            let seen = context.state(&scene, point.t.near)?;
            let due = point.theta.near / alpha;
            let angle = seen.rotation_rad / alpha;
            answer.put("checkpoint-rotations", [angle], [due]);
            let due = point.theta_dot.near / (p * alpha);
            let speed = seen.velocity_rad_s / (p * alpha);
            answer.put("checkpoint-velocities", [speed], [due]);
        }
        for hop in &case.expected.hops {
            let seen = context.state(&scene, hop.t.near)?;
            let peak = hop.side * hop.abs_theta_over_alpha.near;
            answer.put("hop-peaks", [seen.rotation_rad / alpha], [peak]);
            // At rest for an instant: the peak is where the reference has
            // it.
            let speed = seen.velocity_rad_s / (p * alpha);
            answer.put("velocity-at-hop-peaks", [speed], [0.0]);
        }
    }
    Ok(())
}

/// Coordinates on the growing and the decaying manifold of the saddle,
/// z - 1 + z' and z - 1 - z', where a pulse in Eq. 2 ends.
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
