//! Whatever takes long ends where a stop is requested, and gives the same
//! bits where none is.

use std::fmt::Debug;

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{Analysis, Batch, Grid, curve, curves};
use rocking::integrator::{
    Certify, Observe, Scene, certify, respond, respond_precise,
};
use rocking::number::double::DoubleDouble;
use rocking::stop::{Stop, StopError};
use rocking_procedures::{Draws, FitOptions, fit_sample};
use rocking_records::intensity::{Measures, PairMeasures, Settings};
use rocking_records::{ReadOptions, read};
use rocking_statistics::CensoredSample;
use rocking_statistics::acceptance::NullBand;
use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::lilliefors::{NullDistribution, ShiftedNull};
use rocking_statistics::normality::Battery;
use rocking_statistics::paired::hodges_lehmann;

use super::compare::same;

/// The name of some work, and the work of a size.
type Work = (&'static str, fn(u64) -> String);

/// The text of what the work gives has all its bits.
const WORK: [Work; 16] = [
    ("IDA curves", |_| {
        text(curves(&[normalised()], &[analysis()], &Batch::default()))
    }),
    ("an IDA curve", |_| text(curve(&normalised(), &analysis()))),
    ("a response", |_| under(|s| respond(s, &Observe::default()))),
    ("a free motion", |_| {
        let observe = Observe { events: true, ..Observe::default() };
        let free = Excitation::Free;
        under(|s| respond(&Scene { excitation: free, ..*s }, &observe))
    }),
    ("a response in double-double", |_| {
        under(|s| respond_precise::<DoubleDouble>(s, &Observe::default()))
    }),
    ("a certified fate", |_| under(|s| certify(s, &Certify::default()))),
    ("intensity measures", |_| {
        text(Measures::of(&record(), &Settings::default()))
    }),
    ("RotD50", |_| {
        let record = record();
        text(PairMeasures::of(&record, &record, &Settings::default(), &[50.0]))
    }),
    ("a record's file", |_| {
        let text_of = |k: i32| format!("{} 0.1\n", 0.01 * f64::from(k));
        let file: String = (0..50).map(text_of).collect();
        text(read("a.txt", file.as_bytes(), &ReadOptions::default()))
    }),
    ("the null of Lilliefors' test", |size| {
        text(NullDistribution::simulate(20, 100 * size, 0).unwrap().sorted())
    }),
    ("that of a shift estimated", |size| {
        let null =
            ShiftedNull::smallest_value(&sample(), 100 * size, 0).unwrap();
        text(null.null.sorted())
    }),
    ("the nulls of three tests of normality", |size| {
        text(Battery::simulate(20, 100 * size, 0).unwrap().nulls())
    }),
    ("the null of an accepted share", |size| {
        let levels = [sample(), sample().into_iter().rev().collect()];
        text(NullBand::simulate(&levels, 0.15, size, "stop", 0))
    }),
    ("the intervals of a fit", |_| {
        let sample = CensoredSample::try_new(&sample(), &[]).unwrap();
        let draws = Some(Draws { replicates: 2, seed: 0 });
        text(fit_sample(&sample, &FitOptions { draws, ..Default::default() }))
    }),
    ("a bootstrap", |size| {
        text(Bootstrap::new("stop", 0, 9, size as usize).map(<[_]>::to_vec))
    }),
    ("a centre of ratios", |_| text(hodges_lehmann(&sample()))),
];

fn text(found: impl Debug) -> String {
    format!("{found:?}")
}

fn sample() -> Vec<f64> {
    (1..30).map(|k| 1.0 + 0.01 * f64::from(k * k)).collect()
}

/// Two seconds of a sine.
fn record() -> Accelerogram {
    let sample = |k: u32| 0.4 * libm::sin(0.07 * f64::from(k));
    let samples = (0..200).map(sample).collect();
    Accelerogram::try_new("sine", 0.01, samples).unwrap()
}

fn normalised() -> NormalisedRecord {
    NormalisedRecord::new(&record())
}

fn analysis() -> Analysis {
    let block = Block::try_new(0.2, 3.0).unwrap();
    let restitution = Restitution::constant(0.92).unwrap();
    let paper = Analysis::paper(block, restitution);
    Analysis { grid: Grid::Im { step: 0.2 }, highest_im: 3.0, ..paper }
}

/// What is asked of a released block under the record.
fn under<T: Debug>(ask: impl Fn(&Scene<'_>) -> T) -> String {
    let Analysis { block, restitution, .. } = analysis();
    let record = record();
    let motion = ScaledRecord::by_factor(&record, 1.0);
    let scene = Scene::new(block, restitution, Excitation::Record(motion));
    text(ask(&Scene { initial_ratio: 0.5, ..scene }))
}

#[test]
fn every_long_work_ends_where_a_stop_is_requested() {
    let (never, now) = (Stop::default(), Stop::default());
    now.request();
    let mut goes_on = Vec::new();
    for (name, work) in WORK {
        let alone = [work(50)];
        for threads in [1, 3] {
            let found = never.run(threads, || work(50)).unwrap();
            same(format!("{name}, {threads} threads"), &[found], &alone);
            let found = now.run(threads, || work(1_000_000));
            if !matches!(found, Err(StopError::Stopped)) {
                goes_on.push(name);
            }
        }
    }
    assert!(goes_on.is_empty(), "not stopped: {goes_on:?}");
}

/// No more threads are started than help.
#[test]
fn threads_are_capped() {
    let processors = std::thread::available_parallelism().unwrap().get();
    let stop = Stop::default();
    for (threads, expected) in
        [(0, processors), (3, 3), (100 * processors, 8 * processors)]
    {
        let found = stop.run(threads, rayon::current_num_threads).unwrap();
        assert_eq!(found, expected, "{threads} threads");
    }
}

/// A panic of the work stays what it is.
#[test]
fn what_fails_is_not_taken_for_stopped() {
    let stop = Stop::default();
    let failed = std::panic::catch_unwind(|| {
        let _ = stop.run(1, || std::panic::resume_unwind(Box::new("broken")));
    });
    let cause = failed.unwrap_err();
    assert_eq!(cause.downcast_ref::<&str>(), Some(&"broken"));
}
