//! The error estimate against the true error.

use anyhow::Result;
use rayon::prelude::*;
use rocking::number::double::DoubleDouble;
use rocking::number::{Number as _, Real as _};
use rocking_statistics::streams::Streams;

use super::method::{Context, Reply, WrongModel};
use crate::engine::{Precision, WideTrace};
use crate::references;
use crate::scene::{CaseScene, Model, Overturning};
use crate::trials::Draw;

/// Shares of a distribution that are reported.
const SHARES: [(&str, usize); 3] =
    [("median-ratio", 50), ("upper-decile-ratio", 90), ("largest-ratio", 100)];

/// Error of the peak over its estimate, over many scenes.
pub fn estimate(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Random scenes; none: the reference trajectories.
        #[serde(default)]
        scenes: u64,
        /// `double` or `double-double`.
        arithmetic: Precision,
    }
    let factor = context.or(WrongModel::EstimateHundredth, 0.01, 1.0);
    let unit = match arithmetic {
        Precision::DoubleDouble => 2.0 * DoubleDouble::ROUNDOFF,
        _ => f64::EPSILON,
    };
    let streams = Streams::new("error estimate", 0);
    let random = (0..scenes).into_par_iter().map(|k| {
        let scene = drawn(&streams, k);
        let run = WideTrace::run(&scene, arithmetic)?;
        Ok((run, WideTrace::run(&scene, Precision::DoubleDouble)?))
    });
    let all = match scenes {
        0 => against_references(arithmetic)?,
        _ => random.collect::<Result<Vec<_>>>()?,
    };
    let mut ratios = Vec::new();
    let (mut wrong, mut open) = (0.0, 0.0);
    for (run, truth) in all {
        match (run.overturned_s.is_some(), truth.overturned_s.is_some()) {
            (false, false) => {
                let error = (run.peak_ratio - truth.peak_ratio).abs().to_f64();
                // A run without motion claims no error: its limit is one
                // unit in the last place.
                let estimate = run.error_estimate.max(unit);
                ratios.push(error / estimate / factor);
            }
            (true, true) => {}
            _ if run.resolved => wrong += 1.0,
            _ => open += 1.0,
        }
    }
    ratios.sort_by(f64::total_cmp);
    let exceeded = ratios.iter().filter(|r| !(**r <= 1.0)).count();
    answer.put("estimates-exceeded", [exceeded as f64], [0.0]);
    answer.put("sure-of-a-wrong-fate", [wrong], [0.0]);
    answer.see("peaks-compared", [ratios.len() as f64]);
    answer.see("fates-left-open", [open]);
    for (name, percent) in SHARES {
        let last = ratios.len().saturating_sub(1);
        let ratio = ratios.get(last * percent / 100);
        answer.see(name, [ratio.copied().unwrap_or(f64::NAN)]);
    }
    Ok(())
}

/// Runs of the reference trajectories, each with the truth.
fn against_references(
    arithmetic: Precision,
) -> Result<Vec<(WideTrace, WideTrace)>> {
    let mut found = Vec::new();
    for case in references::trajectories()? {
        for criterion in [Overturning::Alpha, Overturning::HalfPi] {
            let run = WideTrace::run(&case.scene(criterion)?, arithmetic)?;
            let mut truth = run.clone();
            let over = case.expected.overturned(criterion);
            truth.overturned_s = over.map(|t| t.wide);
            if let Some(peak) = case.expected.peak() {
                truth.peak_ratio = peak.wide;
            }
            found.push((run, truth));
        }
    }
    Ok(found)
}

/// A random block under random filtered noise, uniform or uniform in the
/// logarithm over the ranges of the study and beyond.
fn drawn(streams: &Streams, index: u64) -> CaseScene {
    let mut draw = Draw(streams.stream(index));
    let mut uniform = |low: f64, high: f64| draw.uniform(low, high);
    let alpha = uniform(0.02, 0.4);
    let p = libm::exp(uniform(libm::log(0.5), libm::log(8.0)));
    let eta = uniform(0.7, 1.0);
    let linear = uniform(0.0, 1.0) < 0.3;
    let dt_s = [0.005, 0.01, 0.02][uniform(0.0, 3.0) as usize];
    let intensity = libm::exp(uniform(0.05, 1.5));
    let count = uniform(100.0, 500.0) as usize;
    let (mut fast, mut slow) = (0.0, 0.0);
    let sample = |k: usize| {
        let white = uniform(-1.0, 1.0);
        fast += 0.3 * (white - 0.5 * fast);
        slow += 0.2 * (fast - slow);
        let share = k as f64 / count as f64;
        slow * share * (1.0 - share)
    };
    let samples: Vec<f64> = (0..count).map(sample).collect();
    let half_pi = uniform(0.0, 1.0) < 0.3;
    CaseScene::at_rest([alpha, p], eta)
        .in_equation(if linear { Model::Linearized } else { Model::Nonlinear })
        .to(if half_pi { Overturning::HalfPi } else { Overturning::Alpha })
        .shaken(dt_s, samples, intensity)
}
