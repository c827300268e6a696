//! Random blocks and motions.

use std::sync::LazyLock;

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

use rocking::accelerogram::Accelerogram;
use rocking::integrator::{Model, Overturning};

pub fn config(cases: u32) -> Config {
    static SEED: LazyLock<u64> = LazyLock::new(|| {
        println!("properties: seed 1234");
        1234
    });
    Config {
        cases,
        rng_seed: RngSeed::Fixed(*SEED),
        failure_persistence: None,
        max_shrink_iters: cases,
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

pub fn record(dt_s: f64, samples: &[f64]) -> Accelerogram {
    Accelerogram::try_new("drawn", dt_s, samples.to_vec()).unwrap()
}
