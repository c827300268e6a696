//! Hard scenes: near the saddle, chatter under a constant acceleration, and
//! double precision against double-double.

use anyhow::{Result, ensure};
use rocking::number::Real as _;

use super::closed_forms::rectangle;
use super::fates::SceneInput;
use super::method::{Context, Reply, SPEEDS};
use crate::engine::{Precision, WideTrace};
use crate::oracles::free_rocking;
use crate::oracles::rectangular::Rectangular;
use crate::scene::{CaseScene, Forcing, Model};

/// Rectangular pulses in Eq. 1 that leave a block just enough energy to stop
/// at a distance before the saddle, or as much energy above the saddle.
pub fn saddle(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        slenderness_rad: Vec<f64>, frequency_rad_s: f64,
        /// Acceleration over g tan(alpha).
        intensity: f64,
        /// Distances of the peak from alpha, over alpha.
        distances: Vec<f64>,
    }
    let p = frequency_rad_s;
    for &alpha in &slenderness_rad {
        let form = Rectangular::new(alpha, p, intensity);
        for &distance in &distances {
            // A peak at alpha (1 - d) has an energy 2 sin^2(alpha d/2) below
            // the saddle's.
            let half = libm::sin(0.5 * alpha * distance);
            let depth = 2.0 * half * half;
            for (sign, falls) in [(-1.0, 0.0), (1.0, 1.0)] {
                let duration_s = form.duration_to_energy_s(sign * depth);
                let scene = rectangle(&form, duration_s).until(100.0 / p);
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
    Ok(())
}

/// Chatter to rest under a constant acceleration: after the first impact all
/// times and speeds and the end of the series have a closed form.
pub fn chatter(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        equation: Model, slenderness_rad: f64, frequency_rad_s: f64,
        restitution: f64,
        /// Constant acceleration over the uplift threshold, below 1, that
        /// follows a jolt.
        intensity: f64,
        impacts: usize,
    }
    let (p, alpha) = (frequency_rad_s, slenderness_rad);
    let scene =
        CaseScene::at_rest([alpha, p], restitution).in_equation(equation);
    let steady = intensity * scene.threshold_m_s2();
    let dt_s = 0.01 / p;
    let scene = scene.under(|threshold| {
        let mut samples = vec![1.6 * threshold; 12];
        samples.resize(4000, steady);
        Forcing::samples(dt_s, samples)
    });
    let mut trace = context.engine.respond(&scene)?;
    // The jolt drives theta negative; the first hop on the other side is
    // pressed down harder.
    ensure!(!trace.impacts.is_empty(), "no impact");
    let first = trace.impacts.remove(0);
    let steady_s = 13.0 * dt_s;
    ensure!(first.time_s > steady_s, "impact before {steady_s} s");
    let block = [alpha, restitution, steady / 9.81];
    let first = (first.time_s * p, first.speed_before_rad_s / p);
    let form = free_rocking::chatter(equation, block, first, impacts);
    answer.put_impacts(SPEEDS, &trace, [p, p], &form.impacts);
    answer.put("rest-time-p", trace.rest_s.map(|t| t * p), [form.settling_p]);
    Ok(())
}

/// Double precision against double-double, to the last digits.
pub fn twin(context: &Context, answer: &mut Reply) -> Result<()> {
    let input: SceneInput = context.input()?;
    for scene in input.scenes()? {
        let p = scene.frequency_rad_s;
        let truth = WideTrace::run(&scene, Precision::DoubleDouble)?;
        let trace = context.engine.respond(&scene)?;
        let listed = truth.impacts.iter().take(input.impacts);
        let listed = listed.map(|i| (i.0.to_f64() * p, i.1.to_f64()));
        let listed: Vec<_> = listed.collect();
        answer.put_impacts(SPEEDS, &trace, [p, 1.0], &listed);
        let over = truth.overturned_s.map(|t| t.to_f64() * p);
        let found = trace.overturned_s.map(|t| t * p);
        answer.put("alpha-time-p", found, over);
        if over.is_none() {
            let peak = truth.peak_ratio.to_f64();
            answer.put("peak-ratio", [trace.peak_ratio], [peak]);
        }
    }
    Ok(())
}
