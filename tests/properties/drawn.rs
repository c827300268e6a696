//! Random blocks and motions, and running them.

use std::sync::LazyLock;

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, ScaledRecord};
use rocking::integrator::{
    Model, Observe, Overturning, Response, Scene, respond,
};
use rocking::record::Accelerogram;

pub fn config(cases: u32) -> Config {
    static SEED: LazyLock<u64> = LazyLock::new(|| {
        println!("properties: seed 1234");
        1234
    });
    Config {
        cases,
        rng_seed: RngSeed::Fixed(*SEED),
        failure_persistence: None,
        ..Config::default()
    }
}

/// What a scene is made of, but for the excitation.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    pub alpha_rad: f64,
    pub p_rad_s: f64,
    pub eta: f64,
    pub model: Model,
    pub overturning: Overturning,
}

pub fn body() -> impl Strategy<Value = Body> {
    (
        0.02..0.6_f64,
        0.8..6.0_f64,
        prop_oneof![Just(1.0), 0.4..1.0_f64],
        prop_oneof![Just(Model::Nonlinear), Just(Model::Linearized)],
        prop_oneof![Just(Overturning::Alpha), Just(Overturning::HalfPi)],
    )
        .prop_map(|(alpha_rad, p_rad_s, eta, model, overturning)| Body {
            alpha_rad,
            p_rad_s,
            eta,
            model,
            overturning,
        })
}

/// Samples in g with zeros, plateaus, spikes and noise among them.
pub fn samples() -> impl Strategy<Value = Vec<f64>> {
    let sample = prop_oneof![
        6 => -1.0..1.0_f64,
        2 => Just(0.0),
        1 => Just(0.25),
        1 => -4.0..4.0_f64,
    ];
    (vec((sample, 1..4_usize), 2..60), 0.05..1.5_f64).prop_map(
        |(runs, size)| {
            let repeat = |(a, n): (f64, usize)| vec![size * a; n];
            runs.into_iter().flat_map(repeat).collect()
        },
    )
}

pub fn interval_s() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.005), Just(0.01), Just(0.02), 0.002..0.05_f64]
}

pub fn record(dt_s: f64, samples: &[f64]) -> Accelerogram {
    Accelerogram::try_new("drawn", dt_s, samples.to_vec()).unwrap()
}

pub fn scene<'a>(body: Body, excitation: Excitation<'a>) -> Scene<'a> {
    Scene {
        block: Block::try_new(body.alpha_rad, body.p_rad_s).unwrap(),
        restitution: Restitution::constant(body.eta).unwrap(),
        model: body.model,
        overturning: body.overturning,
        excitation,
        initial_ratio: 0.0,
    }
}

/// Ends observation, because eta = 1 never comes to rest.
pub const UNTIL_S: f64 = 12.0;

pub fn observe() -> Observe {
    Observe {
        events: true,
        accuracy: true,
        history_interval_s: Some(0.02),
        until_s: Some(UNTIL_S),
    }
}

pub fn run(body: Body, excitation: Excitation<'_>) -> Response {
    respond(&scene(body, excitation), &observe()).unwrap()
}

pub fn under(body: Body, record: &Accelerogram) -> Response {
    run(body, Excitation::Record(ScaledRecord::by_factor(record, 1.0)))
}

pub fn close(
    a: Option<f64>,
    b: Option<f64>,
    shift: f64,
    tolerance: f64,
) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a + shift - b).abs() <= tolerance,
        (None, None) => true,
        _ => false,
    }
}
