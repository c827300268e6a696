//! Scenes whose first hop after rest grazes the base: the block lifts, falls
//! back, and is caught within rounding of its base while it hardly moves.
//! Shaking that follows magnifies the error that the graze leaves.
//!
//! Only the fast part of that hop shows that its rotation is rounded: the
//! block starts without error and lands slowly.

use rocking::integrator::Observe;

use super::draw::Draw;
use super::random::{FoundScene, ordinary_record};
use super::search::{geometric, near, sides};
use crate::engine::respond;
use crate::scene::{CaseScene, EngineResult, Forcing};

/// Most blocks drawn to find one that grazes.
const ATTEMPTS: usize = 40;
/// Most units in the last place by which the graze is missed.
const NEAR: usize = 1 << 26;
/// Least change of the peak across the graze for a scene to be used.
const COUNTS: f64 = 1e-6;

/// A graze of the first hop, then shaking.
pub(super) fn first_hop(draw: &mut Draw) -> FoundScene {
    for _ in 0..ATTEMPTS {
        if let Some(scene) = grazing(draw)? {
            return Ok(Some(("first hop".to_owned(), scene)));
        }
    }
    Ok(None)
}

/// A lobe that lifts the block, one that pulls it back, and one that catches
/// it, each held constant, then levels held for a few samples each, under
/// which a block rocks for long; the amplitude of all of it decides.
fn grazing(draw: &mut Draw) -> EngineResult<Option<CaseScene>> {
    let (_, plain) = ordinary_record(draw, 100);
    let in_p = draw.log(0.01, 0.05);
    let dt_s = in_p / plain.frequency_rad_s;
    let count = |time: f64| (time / in_p) as usize + 2;
    let mut shape = vec![1.0; count(draw.log(0.5, 1.2))];
    let pull = -draw.uniform(0.3, 0.7);
    shape.resize(shape.len() + count(draw.log(0.5, 1.2)), pull);
    shape.resize(shape.len() + count(draw.log(0.8, 1.4)), 1.0);
    let first = shape.len();
    let (size, held) = (draw.log(0.6, 1.2), count(draw.log(0.03, 0.15)));
    while shape.len() < first + count(40.0) {
        let level = size * draw.uniform(-1.0, 1.0);
        shape.resize(shape.len() + held, level);
    }
    let threshold = plain.threshold_m_s2();
    let at = move |amplitude: f64| {
        let samples = shape.iter().map(|x| x * amplitude).collect();
        let forcing = Forcing::samples(dt_s, samples);
        CaseScene { forcing, ..plain.clone() }
    };
    let until_s = Some((first - 1) as f64 * dt_s);
    let impacts = |scene: &CaseScene| {
        let observe = Observe { until_s, ..Observe::default() };
        let response = respond(scene, &observe)?;
        let over = response.outcome.is_overturned();
        Ok((!over).then_some(response.work.impacts))
    };
    // Missed, or met and left again.
    let turns = |a: &Option<u64>, b: &Option<u64>| {
        matches!((a, b), (Some(0), Some(2)) | (Some(2), Some(0)))
    };
    let range = geometric(1.05 * threshold, 4.0 * threshold);
    let range = (&range[..], first);
    let Some(sides) = sides(draw, range, at, impacts, turns)? else {
        return Ok(None);
    };
    let peak = |x: f64| {
        let response = respond(&(sides.0)(x), &Observe::default())?;
        let over = response.outcome.is_overturned();
        Ok(if over { f64::NAN } else { response.peak_ratio })
    };
    let [a, b] = sides.1;
    let counts = (peak(a)? - peak(b)?).abs() > COUNTS;
    Ok(counts.then(|| near(draw, NEAR, sides)))
}
