//! Running random blocks under random motions.

use proptest::prelude::*;

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, ScaledRecord};
use rocking::integrator::{Observe, Response, Scene, respond};

use super::drawn::Body;

pub fn interval_s() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.005), Just(0.01), Just(0.02), 0.002..0.05_f64]
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
        ..Observe::default()
    }
}

pub fn run(body: Body, excitation: Excitation<'_>) -> Response {
    respond(&scene(body, excitation), &observe()).unwrap()
}

pub fn under(body: Body, record: &Accelerogram) -> Response {
    run(body, Excitation::Record(ScaledRecord::by_factor(record, 1.0)))
}
