//! Invariance to the mirror image, a shift in time, resampling, padding and
//! units; and how Eq. 1 departs from similarity.

use anyhow::{Result, bail};
use rocking::accelerogram::Accelerogram;
use rocking_synthesis::{Pair, SuiteKind};
use serde::Deserialize;

use super::method::{Context, Reply, SPEEDS, suite};
use crate::engine::Core;
use crate::references;
use crate::scene::{CaseScene, Engine, Forcing, Model, PulseName};

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum SceneChange {
    /// The record times -1.
    Mirror,
    /// 64 exact zeros and a ramp's foot before the record.
    Shift,
    /// Twice as many samples on the same lines.
    Resample,
    /// Exact zeros after the record.
    Pad,
    /// Another unit of acceleration.
    Unit,
    /// Scaled record against adjusted slenderness.
    Adjust,
}

/// Leading zeros of a shifted record.
const SHIFT: usize = 64;

/// A record and its changed twin on several blocks.
pub fn invariance(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        change: SceneChange, equation: Model, record: String,
        /// PGA over the uplift threshold.
        intensity: f64,
        /// Samples kept; the record then ends with a jump.
        #[serde(default)]
        samples: Option<usize>,
        /// Blocks: alpha (rad), p (rad/s), eta.
        blocks: Vec<[f64; 3]>,
    }
    let (dt_s, mut record) = references::record(&record)?;
    if let Some(count) = samples {
        record.truncate(count);
    }
    for [alpha, p, eta] in blocks {
        let scene = CaseScene::at_rest([alpha, p], eta).in_equation(equation);
        let scene = scene.shaken(dt_s, record.clone(), intensity);
        let peak = record.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        let expected = Core.respond(&scene)?;
        let twin = twin(&scene, change, peak)?;
        let observed = context.engine.respond(&twin)?;
        let shifted = matches!(change, SceneChange::Shift);
        let shift_s = if shifted { SHIFT as f64 * dt_s } else { 0.0 };
        let mirrored = matches!(change, SceneChange::Mirror);
        let mirror = if mirrored { -1.0 } else { 1.0 };
        let (seen, due) = (observed.impacts.iter(), expected.impacts.iter());
        let times = seen.clone().map(|i| (i.time_s - shift_s) * p);
        let due_times = due.clone().map(|i| i.time_s * p);
        answer.put("impact-times-p", times, due_times);
        let ratio = alpha / twin.slenderness_rad;
        let speeds = seen.map(|i| i.speed_before_rad_s * ratio);
        answer.put(SPEEDS, speeds, due.map(|i| i.speed_before_rad_s));
        answer.put("peak-ratio", [observed.peak_ratio], [expected.peak_ratio]);
        let over = observed.overturned_s.map(|t| (t - shift_s) * p);
        let due = expected.overturned_s.map(|t| t * p);
        answer.put("alpha-time-p", over, due);
        let side = observed.first_side * mirror;
        answer.put("side", [side], [expected.first_side]);
    }
    Ok(())
}

fn twin(
    scene: &CaseScene,
    change: SceneChange,
    peak_m_s2: f64,
) -> Result<CaseScene> {
    let mut twin = scene.clone();
    let Forcing::Samples { dt_s, acceleration_m_s2 } = &mut twin.forcing
    else {
        bail!("no record");
    };
    let a = acceleration_m_s2;
    match change {
        SceneChange::Mirror => a.iter_mut().for_each(|x| *x = -*x),
        SceneChange::Shift => {
            a.splice(0..0, std::iter::repeat_n(0.0, SHIFT));
        }
        SceneChange::Resample => {
            let between = |p: &[f64]| [p[0], 0.5 * (p[0] + p[1])];
            let fine = a.windows(2).flat_map(between).chain(a.last().copied());
            *a = fine.collect();
            *dt_s *= 0.5;
        }
        SceneChange::Pad => a.extend(std::iter::repeat_n(0.0, 400)),
        SceneChange::Unit => {
            a.iter_mut().for_each(|x| *x *= 100.0);
            twin.gravity_m_s2 *= 100.0;
        }
        SceneChange::Adjust => {
            // The record as it was, on the block that it moves as much.
            let factor =
                peak_m_s2 / a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            a.iter_mut().for_each(|x| *x *= factor);
            twin.slenderness_rad *= factor;
        }
    }
    Ok(twin)
}

/// Relative change of the first peak of Eq. 1 against Eq. 2 as alpha grows,
/// and the order of that change between the two smallest alphas.
pub fn defect(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        omega_over_p: f64, amplitude: f64,
        /// `g-tan-alpha` or `g-alpha`.
        over: String,
        slenderness_rad: Vec<f64>, frequency_rad_s: f64,
    }
    let p = frequency_rad_s;
    let first_speed = |alpha: f64, equation| -> Result<f64> {
        let over = match (equation, over.as_str()) {
            (Model::Linearized, _) | (_, "g-alpha") => alpha,
            (_, "g-tan-alpha") => libm::tan(alpha),
            (_, other) => bail!("over `{other}`"),
        };
        let (a, omega) = (amplitude * 9.81 * over, omega_over_p * p);
        let pulse = Forcing::pulse(PulseName::OneSine, a, omega);
        let scene = CaseScene::new([alpha, p, 9.81], 0.92, pulse);
        let trace = context.engine.respond(&scene.in_equation(equation))?;
        let impact = trace.impacts.first();
        Ok(impact.map_or(f64::NAN, |i| i.speed_before_rad_s / (p * alpha)))
    };
    let change = |alpha: &f64| {
        let linear = first_speed(*alpha, Model::Linearized)?;
        Ok(first_speed(*alpha, Model::Nonlinear)? / linear - 1.0)
    };
    let changes = slenderness_rad.iter().map(change);
    let changes = changes.collect::<Result<Vec<f64>>>()?;
    let [a, b, ..] = slenderness_rad.as_slice() else {
        bail!("two slendernesses");
    };
    let order = libm::log((changes[1] / changes[0]).abs()) / libm::log(b / a);
    answer.see("order", [order]);
    answer.see("change", changes);
    Ok(())
}

/// Median over a suite's records of the peak theta/alpha over that of alpha =
/// 0.10 at an intensity just above uplift: where rotations are small, Eq. 1
/// gives theta/alpha in proportion to sin(alpha)/alpha, for every motion and
/// size.
///
/// With a = IM g tan(alpha) S(t) and x = |theta|/sin(alpha), Eq. 1 of the
/// motion on one side, -p^2 (sin(alpha - theta) + a/g cos(alpha - theta)),
/// becomes x'' = -p^2 (1 + IM S) and, of order 1 in x, p^2 cos(alpha) x (1 -
/// IM S tan^2(alpha)). Neither the terms of order 0 nor the loss at an impact
/// contain alpha. The remainder is of order p^2 t^2 alpha^2, with t the
/// duration of the flights.
///
/// The slendernesses are given or, as in Figure 9, chosen so that each
/// unscaled record has that intensity, tan(alpha) = PGA/(g IM); their closed
/// form is then divided out record by record.
pub fn sine_bias(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// None: adjusted to each record.
        #[serde(default)]
        slenderness_rad: Vec<f64>,
        frequencies_rad_s: Vec<f64>, intensity: f64,
    }
    let suite = suite(SuiteKind::PulseType)?;
    let closed_form =
        |alpha: f64| (libm::sin(alpha) / alpha) / (libm::sin(0.1) / 0.1);
    let mut left = Vec::new();
    for &p in &frequencies_rad_s {
        let peak = |alpha: f64, record: &Accelerogram| {
            let factor = intensity * 9.81 * libm::tan(alpha) / record.pga_g();
            let forcing = Forcing::record(record, factor);
            let scene = CaseScene::new([alpha, p, 9.81], 0.92, forcing);
            anyhow::Ok(context.engine.respond(&scene)?.peak_ratio)
        };
        let of = |pair: &Pair| peak(0.1, &pair.components[0]);
        let references = suite.iter().map(of).collect::<Result<Vec<f64>>>()?;
        let mut worst: f64 = 0.0;
        let adjusted = slenderness_rad.is_empty().then_some(None);
        let given = slenderness_rad.iter().copied().map(Some);
        for given in given.chain(adjusted) {
            let mut ratios = Vec::new();
            for (pair, reference) in suite.iter().zip(&references) {
                let record = &pair.components[0];
                let own = libm::atan(record.pga_g() / intensity);
                let alpha = given.unwrap_or(own);
                let ratio = peak(alpha, record)? / reference;
                let form = given.map_or_else(|| closed_form(alpha), |_| 1.0);
                ratios.push(ratio / form);
            }
            ratios.sort_by(f64::total_cmp);
            let n = ratios.len();
            let median = 0.5 * (ratios[(n - 1) / 2] + ratios[n / 2]);
            if left.is_empty() {
                answer.see("ratio", [median]);
            }
            let due = given.map_or(1.0, closed_form);
            worst = worst.max((median - due).abs());
        }
        left.push((p, worst));
    }
    if let [(p, a), .., (q, b)] = left[..] {
        answer.see("order-in-p", [libm::log(b / a) / libm::log(q / p)]);
    }
    Ok(())
}
