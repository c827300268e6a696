//! Square waves in Eq. 1, chained exactly; the engine reads them as records
//! whose jumps are ramps over two intervals.

use anyhow::Result;
use serde::Deserialize;

use super::method::{Context, Reply, SPEEDS, WrongModel};
use crate::oracles::square::{SquareState, SquareWave};
use crate::scene::{CaseScene, Forcing, Overturning};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WaveInput {
    /// Block: alpha (rad), p (rad/s), eta.
    block: [f64; 3],
    /// Unit of the durations, times p.
    unit_p: f64,
    /// Parts into which a unit is divided; then twice as many.
    intervals: usize,
    /// Square waves: acceleration over g tan(alpha) and whole units of each
    /// stretch.
    waves: Vec<Vec<(f64, usize)>>,
}

impl WaveInput {
    fn wave(&self, stretches: &[(f64, usize)]) -> SquareWave {
        let [alpha_rad, _, eta] = self.block;
        let scaled = |(level, units): &(f64, usize)| {
            (level * libm::tan(alpha_rad), *units as f64 * self.unit_p)
        };
        let stretches = stretches.iter().map(scaled).collect();
        SquareWave { alpha_rad, eta, stretches }
    }

    /// The wave as a record: a sample at a jump has the mean of both sides,
    /// which keeps the first moment and leaves an error of the second order
    /// in the interval.
    fn scene(
        &self,
        stretches: &[(f64, usize)],
        intervals: usize,
    ) -> CaseScene {
        let [alpha, p, eta] = self.block;
        let unit = 9.81 * libm::tan(alpha);
        let mut samples: Vec<f64> = Vec::new();
        for &(level, units) in stretches {
            if let Some(jump) = samples.last_mut() {
                *jump = 0.5 * (*jump + level * unit);
            } else {
                samples.push(level * unit);
            }
            let more = samples.len() + units * intervals;
            samples.resize(more, level * unit);
        }
        let dt_s = self.unit_p / (intervals as f64 * p);
        let forcing = Forcing::samples(dt_s, samples);
        CaseScene::new([alpha, p, 9.81], eta, forcing).to(Overturning::HalfPi)
    }

    /// The result of `measure`, extrapolated from two intervals to none.
    fn extrapolated(
        &self,
        measure: impl Fn(usize) -> Result<Vec<f64>>,
    ) -> Result<Vec<f64>> {
        let coarse = measure(self.intervals)?;
        let fine = measure(2 * self.intervals)?;
        if coarse.len() != fine.len() {
            return Ok(Vec::new());
        }
        let pairs = fine.iter().zip(&coarse);
        Ok(pairs.map(|(f, c)| f + (f - c) / 3.0).collect())
    }
}

/// Impacts, peak and end of the motion during square waves.
pub fn chained(context: &Context, answer: &mut Reply) -> Result<()> {
    let input: WaveInput = context.input()?;
    let [alpha, p, _] = input.block;
    for wave in &input.waves {
        let form = input.wave(wave);
        let due = form.motion();
        let end_p: f64 = form.stretches.iter().map(|s| s.1).sum();
        let count = due.impacts.len();
        let seen = input.extrapolated(|intervals| {
            let scene = input.scene(wave, intervals);
            let trace = context.engine.respond(&scene)?;
            let impacts = trace.impacts.iter().take(count);
            let times = impacts.clone().map(|i| i.time_s);
            Ok(times.chain(impacts.map(|i| i.speed_before_rad_s)).collect())
        })?;
        let (times, speeds) = seen.split_at(seen.len() / 2);
        let listed = due.impacts.iter().map(|i| i.0);
        answer.put("impact-times-p", times.iter().map(|t| t * p), listed);
        let listed = due.impacts.iter().map(|i| i.1 / alpha);
        let speeds = speeds.iter().map(|v| v / (p * alpha));
        answer.put(SPEEDS, speeds, listed);
        let end = input.extrapolated(|intervals| {
            let scene = input.scene(wave, intervals);
            let seen = context.state(&scene, end_p / p)?;
            let speed = seen.velocity_rad_s / (p * alpha);
            Ok(vec![seen.rotation_rad / alpha, speed])
        })?;
        let SquareState { side, y, w } = due.end;
        let state = [side * y / alpha, side * w / alpha];
        answer.put("state-at-end", end, state);
    }
    Ok(())
}

/// Outcomes after square waves, by the place of the block, its direction and
/// whether its energy passes the saddle.
pub fn exclusions(context: &Context, answer: &mut Reply) -> Result<()> {
    let input: WaveInput = context.input()?;
    let [alpha, p, _] = input.block;
    for wave in &input.waves {
        let form = input.wave(wave);
        let motion = form.motion();
        let end = motion.end;
        let due = form.ending(end);
        let end_s = form.stretches.iter().map(|s| s.1).sum::<f64>() / p;
        let scene = input.scene(wave, input.intervals);
        let trace = context.engine.respond(&scene)?;
        let before = motion.impacts.len();
        // Sides change at each impact.
        let odd = (trace.impacts.len() % 2) as f64;
        let side = trace.first_side * (1.0 - 2.0 * odd);
        let over = trace.overturned_s.is_some();
        let (falls, side) = match context.wrong {
            Some(WrongModel::EnergyWhicheverWay) => (due.passes, end.side),
            Some(WrongModel::AngleAlone) => (end.y > alpha, end.side),
            _ => (over, side),
        };
        let fate = if falls { side } else { 0.0 };
        answer.put("overturned-side", [fate], [due.overturned]);
        let speed = input.extrapolated(|intervals| {
            let scene = input.scene(wave, intervals);
            let trace = context.engine.respond(&scene)?;
            let after = trace.impacts.iter().skip(before).take(1);
            let after = after.filter(|impact| impact.time_s > end_s);
            Ok(after.map(|i| i.speed_before_rad_s / (p * alpha)).collect())
        })?;
        let due = due.impact.map(|v| v / alpha);
        answer.put("impact-speed-after", speed, due);
    }
    Ok(())
}
