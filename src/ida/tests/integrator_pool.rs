//! What a pool says of its runs, beside what the curves show: the whole
//! response of the scalar driver, work included; and what both say of runs
//! that end before the record does.

use super::compare::hold;
use crate::accelerogram::Accelerogram;
use crate::block::{Block, Restitution};
use crate::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use crate::integrator::class::Class;
use crate::integrator::pool::{SceneSource, class_of, run};
use crate::integrator::{
    Extent, Model, Observe, Overturning, Response, Scene, Solver, WorkLimit,
    respond,
};
use crate::number::dispatch::Isa;

/// Scenes to be run, and what came of them.
struct Bench<'a> {
    left: Vec<Scene<'a>>,
    done: Vec<(Scene<'a>, Response)>,
}

impl<'a> SceneSource<'a> for Bench<'a> {
    type Task = Scene<'a>;

    fn take(&mut self) -> Option<(Scene<'a>, Scene<'a>, Extent, WorkLimit)> {
        let next = self.left.pop()?;
        Some((next, next, Extent::Peak, WorkLimit::IDA))
    }

    fn settle(&mut self, task: Scene<'a>, response: Option<&Response>) {
        self.done.push((task, response.unwrap().clone()));
    }
}

/// A wave, and a little of it after.
fn wave(seed: f64, dt_s: f64) -> NormalisedRecord {
    let sample = |k: u32| {
        let t = 0.016 * f64::from(k);
        let low = libm::sin((3.0 + seed) * t + seed);
        let high = 0.7 * libm::sin((11.0 + 2.0 * seed) * t);
        let size = if k < 200 { 1.0 } else { 0.001 };
        size * (low + high) * libm::sin(0.8 * t)
    };
    let samples = (0..500).map(sample).collect();
    NormalisedRecord::new(
        &Accelerogram::try_new("wave", dt_s, samples).unwrap(),
    )
}

/// Screens that tell less than they could change no bit; they show in the
/// tallies.
#[test]
fn a_pool_gives_the_whole_response_of_single_runs() {
    let Some(isa) = Isa::available().into_iter().rfind(|isa| isa.is_wide())
    else {
        println!("no wide level on this machine");
        return;
    };
    let p = 2.5;
    let mut tallies = Vec::new();
    for (dt_s, model, class) in [
        (0.003, Model::Nonlinear, Class::Eight),
        (0.006, Model::Nonlinear, Class::Nine),
        (0.016, Model::Nonlinear, Class::Ten),
        (0.03, Model::Nonlinear, Class::Longest),
        (0.02, Model::Linearized, Class::Linearized),
    ] {
        assert_eq!(class_of(model, p * dt_s, None), Some(class));
        let records = [0.0, 1.0, 2.0].map(|seed| wave(seed, dt_s));
        let mut left = Vec::new();
        for record in &records {
            for k in 0..40 {
                let overturning = match k % 2 {
                    0 => Overturning::Alpha,
                    _ => Overturning::HalfPi,
                };
                let alpha = 0.05 + 0.05 * f64::from(k % 5);
                // The last are violent: no short series is enough.
                let violent = if k > 36 { 300.0 } else { 1.0 };
                let pga_g = violent * alpha * (0.9 + 0.1 * f64::from(k));
                let record = ScaledRecord::to_pga(record, pga_g);
                left.push(Scene {
                    block: Block::try_new(alpha, p).unwrap(),
                    restitution: Restitution::constant(0.92).unwrap(),
                    model,
                    overturning,
                    excitation: Excitation::Record(record),
                    initial_ratio: 0.0,
                });
            }
        }
        let count = left.len();
        let mut bench = Bench { left, done: Vec::new() };
        let tally = run(class, isa, &mut bench);
        assert_eq!(bench.done.len(), count);
        let name = format!("{class:?}");
        tallies.push((name.clone(), format!("{name}: {tally:?}")));
        for (scene, found) in &bench.done {
            let alone = peak(scene);
            assert_eq!(*found, alone, "pool and alone, {name}: {scene:?}");
        }
    }
    hold("tallies.txt", "work of the pool by class", &tallies);
}

/// A run that ends early.
fn peak(scene: &Scene<'_>) -> Response {
    early(scene, Extent::Peak)
}

fn early(scene: &Scene<'_>, extent: Extent) -> Response {
    let solver = Solver { extent, ..Solver::default() };
    let work_limit = WorkLimit::IDA;
    let observe = Observe { work_limit, ..Observe::default() };
    solver.respond(scene, &observe).unwrap()
}

/// Nothing is lost with the end of a record that can change nothing, and what
/// can is not left out: the last lobe, which alone overturns, decides, and so
/// do waves as long as the hops.
#[test]
fn runs_that_end_early_say_what_whole_runs_say() {
    let block = Block::try_new(0.1, 2.5).unwrap();
    let (mut shorter, mut same, mut sooner) = (0, 0, 0);
    for model in [Model::Nonlinear, Model::Linearized] {
        for k in 0..48_u32 {
            let seed = f64::from(k);
            let wave = wave(seed, 0.01);
            let mut samples = wave.samples().to_vec();
            if k % 3 == 0 {
                let last = samples.len() - 40;
                samples[last..].fill(0.25);
            }
            if k % 3 == 1 {
                let rate = 0.015 + 0.003 * f64::from(k % 16);
                let size = [0.02, 0.05, 0.1, 0.2][k as usize / 3 % 4];
                let coda = |i: u32| size * libm::sin(rate * f64::from(i));
                samples.extend((0..1500).map(coda));
            }
            let record = NormalisedRecord::new(
                &Accelerogram::try_new("wave", 0.01, samples).unwrap(),
            );
            for level in 1..12 {
                let record =
                    ScaledRecord::to_pga(&record, 0.11 * f64::from(level));
                let scene = Scene {
                    block,
                    restitution: Restitution::constant(0.92).unwrap(),
                    model,
                    overturning: Overturning::Alpha,
                    excitation: Excitation::Record(record),
                    initial_ratio: 0.0,
                };
                let whole = respond(&scene, &Observe::default()).unwrap();
                let peak = peak(&scene);
                assert!(peak.work.steps <= whole.work.steps);
                let outcome = early(&scene, Extent::Outcome);
                assert!(outcome.work.steps <= peak.work.steps);
                sooner += i32::from(outcome.work.steps < peak.work.steps);
                let overturns = |of: &Response| of.outcome.is_overturned();
                assert_eq!(overturns(&outcome), overturns(&whole));
                if peak.work.steps < whole.work.steps {
                    shorter += 1;
                } else {
                    same += 1;
                }
                let shown = |response: &Response| {
                    (
                        response.outcome,
                        response.peak_ratio,
                        response.peak_time_s,
                        response.uplift_time_s,
                        response.fate_margin,
                    )
                };
                assert_eq!(
                    shown(&peak),
                    shown(&whole),
                    "run that ends early and whole run: {scene:?}"
                );
            }
        }
    }
    assert!(shorter > 100 && same > 100, "{shorter} shorter, {same} not");
    assert!(sooner > 100, "{sooner} by the outcome alone");
}
