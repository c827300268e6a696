//! What a pool says of its runs, beside what the curves show: the whole
//! response of the scalar driver, work included.

use crate::block::{Block, Restitution};
use crate::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use crate::integrator::class::Class;
use crate::integrator::pool::{Source, Tally, class_of, run};
use crate::integrator::{
    Model, Observe, Overturning, Response, Scene, respond,
};
use crate::number::dispatch::Isa;
use crate::record::Accelerogram;

/// Scenes to be run, and what came of them.
struct Bench<'a> {
    left: Vec<Scene<'a>>,
    done: Vec<(Scene<'a>, Response)>,
}

impl<'a> Source<'a> for Bench<'a> {
    type Task = Scene<'a>;

    fn take(&mut self) -> Option<(Scene<'a>, Scene<'a>)> {
        self.left.pop().map(|scene| (scene, scene))
    }

    fn settle(&mut self, task: Scene<'a>, response: &Response) {
        self.done.push((task, response.clone()));
    }
}

fn wave(seed: f64, dt_s: f64) -> NormalisedRecord {
    let sample = |k: u32| {
        let t = dt_s * f64::from(k);
        let low = libm::sin((3.0 + seed) * t + seed);
        let high = 0.7 * libm::sin((11.0 + 2.0 * seed) * t);
        (low + high) * libm::sin(0.8 * t)
    };
    let samples = (0..200).map(sample).collect();
    NormalisedRecord::new(
        &Accelerogram::try_new("wave", dt_s, samples).unwrap(),
    )
}

/// Screens that tell less than they could change no bit; they show here. The
/// counts are as they are: a change of them is to be meant.
const SHORT: Tally = Tally {
    sweeps: 298,
    batches: [67, 333, 32],
    solved: 1874,
    passed: 88,
    left: 802,
};
const SMOOTH: Tally = Tally {
    sweeps: 256,
    batches: [10, 359, 0],
    solved: 1575,
    passed: 0,
    left: 739,
};
const LINEARIZED: Tally = Tally {
    sweeps: 265,
    batches: [0, 287, 0],
    solved: 1811,
    passed: 0,
    left: 178,
};

#[test]
fn a_pool_gives_the_whole_response_of_single_runs() {
    let Some(isa) = Isa::available().into_iter().rfind(|isa| isa.is_wide())
    else {
        println!("no wide level on this machine");
        return;
    };
    let p = 2.5;
    for (dt_s, model, class, regressed) in [
        (0.016, Model::Nonlinear, Class::Short, SHORT),
        (0.03, Model::Nonlinear, Class::Smooth, SMOOTH),
        (0.02, Model::Linearized, Class::Linearized, LINEARIZED),
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
        assert_eq!(tally, regressed, "{class:?}");
        for (scene, found) in &bench.done {
            let alone = respond(scene, &Observe::default()).unwrap();
            assert_eq!(*found, alone);
        }
    }
}
