//! Flags of the analyses of a curve: grazing scenes as levels of an
//! incremental dynamic analysis.

use anyhow::{Context as _, Result};
use rayon::prelude::*;
use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{Analysis, Batch, Grid, IdaPoint, curve, curves};
use rocking::integrator::{
    self, Certify, Extent, Impact, Observe, Outcome, Scene, Solver, certify,
    uplift_threshold,
};
use rocking::number::Real as _;

use super::method::{Context, Memo, Reply, WrongModel};
use crate::scene::Forcing;
use crate::trials::{Stratum, WORK, WideTruth, trial, truth};

/// Difference of a peak ratio that counts as another peak.
const ANOTHER: f64 = 1e-6;

/// Rough estimate from which on an analysis is flagged.
const FLAGGED: f64 = 2.5e-3;

/// A level by every analysis.
#[derive(Clone)]
struct LevelResult {
    alone: IdaPoint,
    lanes: IdaPoint,
    certified: IdaPoint,
    /// Bound on the error of the certified peak.
    error: f64,
    /// Outcome and peak by wider arithmetic.
    truth: WideTruth,
    /// The rough estimate with every flight rounded at its landing's speed.
    at_landing: f64,
}

/// Levels by the number of scenes.
static FOUND: Memo<u64, LevelResult> = Memo::new();

/// Peaks and outcomes that a curve calls resolved but that differ in wider
/// arithmetic; levels at which the lanes give another result.
pub fn first_hops(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Scenes whose first hop grazes: this many, from index 0 on.
        first_hops: u64,
    }
    let found = FOUND.get(first_hops, |count| {
        let all = (0..*count).into_par_iter().map(level);
        let all = all.collect::<Result<Vec<Option<LevelResult>>>>()?;
        Ok(all.into_iter().flatten().collect())
    })?;
    let at_landing = context.is(WrongModel::RoundingAtTheLanding);
    let resolved = |point: &IdaPoint| point.resolution.resolved;
    let silent = |level: &LevelResult, point: &IdaPoint| {
        let rough = level.at_landing < FLAGGED;
        let resolved = if at_landing { rough } else { resolved(point) };
        resolved && level.is_other(point, ANOTHER)
    };
    let certified = |level: &LevelResult| {
        let point = &level.certified;
        resolved(point) && level.is_other(point, level.error)
    };
    type Is<'a> = &'a dyn Fn(&LevelResult) -> bool;
    let mut count = |name: &str, is: Is<'_>| {
        let count = found.iter().filter(|level| is(level)).count();
        answer.see(name, [count as f64]);
    };
    count("wrong-and-resolved", &|l| silent(l, &l.alone));
    count("wrong-and-resolved-in-lanes", &|l| silent(l, &l.lanes));
    count("wrong-and-certified", &certified);
    count("levels-that-lanes-change", &|l| l.alone != l.lanes);
    count("levels", &|_| true);
    count("wrong", &|l| l.is_other(&l.alone, ANOTHER));
    count("unresolved", &|l| !resolved(&l.alone));
    count("unresolved-when-certified", &|l| !resolved(&l.certified));
    for never in [
        "wrong-and-resolved",
        "wrong-and-resolved-in-lanes",
        "wrong-and-certified",
        "levels-that-lanes-change",
    ] {
        answer.put(never, [], [0.0]);
    }
    Ok(())
}

impl LevelResult {
    /// True if the outcome of a point differs in wider arithmetic, or its peak
    /// by more than `error`.
    fn is_other(&self, point: &IdaPoint, error: f64) -> bool {
        let own = &point.outcome;
        match self.truth {
            WideTruth::Stands { peak_ratio, .. } => {
                let gap = (own.edp() - peak_ratio.to_f64()).abs();
                own.is_overturned() || !(gap <= error)
            }
            WideTruth::Overturned => !own.is_overturned(),
            WideTruth::Undecided => false,
        }
    }
}

/// The scene of an index as the one level of a curve.
fn level(index: u64) -> Result<Option<LevelResult>> {
    let Some(trial) = trial(Stratum::FirstHop, index)? else {
        return Ok(None);
    };
    let of = trial.scene;
    let Forcing::Samples { dt_s, acceleration_m_s2 } = of.forcing else {
        return Ok(None);
    };
    let record = Accelerogram::try_new(trial.name, dt_s, acceleration_m_s2);
    let record = NormalisedRecord::new(&record?);
    let block = Block::try_new(of.slenderness_rad, of.frequency_rad_s)?;
    let restitution = Restitution::constant(of.restitution)?;
    let pga_g = record.pga_g();
    let analysis = Analysis {
        model: of.model,
        overturning: of.overturning,
        grid: Grid::Pga { step_g: pga_g },
        // One level.
        highest_im: 1.5 * pga_g / uplift_threshold(&block, of.model),
        ..Analysis::paper(block, restitution)
    };
    let point = |points: &[IdaPoint]| {
        let point = points.iter().find(|point| point.pga_g == pga_g);
        point.copied().context("the level is not analysed")
    };
    let alone = point(&curve(&record, &analysis)?.points)?;
    let certifying = Analysis { certify: true, ..analysis };
    let batch = Batch::default();
    let records = std::slice::from_ref(&record);
    let both = curves(records, &[analysis, certifying], &batch)?;
    let lanes = point(&both[0][0].points)?;
    let certified = point(&both[1][0].points)?;
    let record_at = ScaledRecord::to_pga(&record, pga_g);
    let scene = Scene {
        model: of.model,
        overturning: of.overturning,
        ..Scene::new(block, restitution, Excitation::Record(record_at))
    };
    let truth = truth(&scene, None)?;
    let options = Certify { work_limit: WORK, ..Certify::default() };
    let error = certify(&scene, &options)?.error;
    // A level without an error bound counts as one that is not flagged.
    let error = error.unwrap_or(0.0).max(ANOTHER);
    let at_landing = at_landing(&scene, of.restitution, &record)?;
    Ok(Some(LevelResult { alone, lanes, certified, error, truth, at_landing }))
}

/// The rough estimate of a run, its rounding in flight as small as the speed
/// at which the flight ends.
fn at_landing(
    scene: &Scene,
    eta: f64,
    record: &NormalisedRecord,
) -> Result<f64> {
    let observe = Observe { events: true, ..Observe::default() };
    let run = integrator::respond(scene, &observe)?;
    let solver = Solver { extent: Extent::Peak, ..Solver::default() };
    let quick = solver.respond(scene, &Observe::default())?;
    let block = scene.block;
    let (alpha, p) = (block.slenderness_rad(), block.frequency_rad_s());
    let threshold = uplift_threshold(&block, scene.model);
    let (dt_s, samples) = (record.dt_s(), record.samples());
    let pga_g = record.pga_g();
    let end_s = dt_s * (samples.len() - 1) as f64;
    let mut seen = 0;
    let ground = |time_s: f64| {
        let at = time_s / dt_s;
        let sample = |k| samples.get(at as usize + k).copied();
        let [a, b] = [0, 1].map(|k| sample(k).unwrap_or(0.0));
        pga_g * (a + (b - a) * at.fract())
    };
    let lifts = |from_s: f64| {
        let first = (from_s / dt_s) as usize;
        let lifted = |k: &usize| pga_g * samples[*k].abs() > threshold;
        let next = (first..samples.len()).find(lifted);
        next.map_or(from_s, |k| from_s.max((k as f64 - 1.0) * dt_s))
    };
    let mut began_s = run.uplift_time_s.unwrap_or(0.0);
    let [mut uu, mut uw, mut ww, mut doubt] = [0.0; 4];
    let mut positive = ground(began_s) < 0.0;
    for Impact { time_s, speed_before_rad_s, .. } in &run.impacts {
        if *time_s < began_s {
            continue;
        }
        // The quick run leaves out free motion, and impacts that cannot raise
        // the peak.
        if *time_s > end_s || seen == quick.work.impacts {
            break;
        }
        seen += 1;
        let speed = speed_before_rad_s / p;
        let tau = p * (time_s - began_s);
        let (c, s) = (libm::cosh(tau), libm::sinh(tau));
        let rounded = 0.5 * f64::EPSILON * speed;
        ww += rounded * rounded * tau / (p * dt_s);
        (uu, uw, ww) = (
            c * c * uu + 2.0 * c * s * uw + s * s * ww,
            c * s * (uu + ww) + (c * c + s * s) * uw,
            s * s * uu + 2.0 * c * s * uw + c * c * ww,
        );
        let f = if positive { ground(*time_s) } else { -ground(*time_s) };
        let (before, after) = (-threshold - f, -threshold + f);
        let by_u = before / speed;
        doubt += (by_u * by_u * uu + 2.0 * by_u * uw + ww) / (speed * speed);
        doubt += (uu + ww) / (0.01 * alpha * 0.01 * alpha);
        let hop = 0.5 * after / (speed * speed);
        doubt += uu * hop * hop;
        let shear = (eta * before + after) / speed;
        (uu, uw, ww) = (
            eta * eta * uu,
            eta * shear * uu + eta * eta * uw,
            shear * shear * uu + 2.0 * eta * shear * uw + eta * eta * ww,
        );
        (began_s, positive) = (*time_s, !positive);
        // Impacts that end within the sample end in a rest.
        let back = threshold - ground(*time_s).abs();
        let ends = 2.0 * eta * speed / (back * (1.0 - eta)) / p;
        if back > 0.0 && ends < dt_s * (1.0 - (time_s / dt_s).fract()) {
            began_s = lifts(time_s + ends);
            positive = ground(began_s + dt_s) < 0.0;
            (uu, uw, ww) = (0.0, 0.0, 0.0);
        }
    }
    let own = match run.outcome {
        Outcome::Overturned { .. } => 1.0,
        _ => (1.0 - run.peak_ratio).min(1.0).abs(),
    };
    Ok(doubt.sqrt() / own)
}
