//! Scenes in which a discrete decision is taken within rounding.
//!
//! Bisection on one number, in double precision, finds the neighbouring
//! doubles between which the decision changes; the scene is then moved by some
//! units in the last place. The later ground motion makes the decision count.

use rocking::integrator::{Observe, Outcome, Response};

use super::draw::Draw;
use super::random::{
    FoundScene, NamedScene, PULSES, ordinary_record, under_pulse,
};
use super::records::{filtered, noise, normalised};
use super::search::{Sides, geometric, linear, moved, near, sides};
use crate::engine::respond;
use crate::scene::{CaseScene, EngineResult, Forcing};

/// Most scenes drawn to find one that grazes.
const ATTEMPTS: usize = 40;
/// Most units in the last place by which a decision is missed.
const NEAR: usize = 1000;
/// The same for outcomes.
const NEAR_FATE: usize = 10_000;
/// The same for a first hop.
const NEAR_BASE: usize = 1 << 26;
/// Kinds of decision.
const KINDS: u64 = 5;
/// Least change of the peak across a contact for a scene to be used.
const COUNTS: f64 = 1e-11;
/// Least change of the peak across the graze of a first hop.
const COUNTS_LATER: f64 = 1e-6;
/// Most samples of the part of a record that grazes.
const LONGEST: usize = 400;

/// The scene of an index: one kind of decision after the other.
pub(super) fn grazing(draw: &mut Draw, index: u64) -> FoundScene {
    attempts(|| match index % KINDS {
        0 => contact(draw),
        1 => fate(draw, (index / KINDS) as usize),
        2 => Ok(Some(uplift(draw)?)),
        3 => rest(draw),
        _ => late(draw),
    })
}

/// The first scene that is found.
fn attempts(mut find: impl FnMut() -> FoundScene) -> FoundScene {
    for _ in 0..ATTEMPTS {
        let found = find()?;
        if found.is_some() {
            return Ok(found);
        }
    }
    Ok(None)
}

/// Number of impacts until an instant (s); none if the block overturns.
fn impacts(scene: &CaseScene, until_s: f64) -> EngineResult<Option<u64>> {
    let response = run_until(scene, until_s)?;
    let stands = !response.outcome.is_overturned();
    Ok(stands.then_some(response.work.impacts))
}

/// A scene next to a decision, if the decision changes the peak by more than
/// `least`.
fn counted(
    draw: &mut Draw,
    (name, most, least): (&str, usize, f64),
    peak: fn(&Response) -> f64,
    (at, ends): Sides<'_>,
) -> FoundScene {
    let [a, b] = ends.map(|x| respond(&at(x), &Observe::default()));
    let counts = (peak(&a?) - peak(&b?)).abs() > least;
    Ok(counts.then(|| (name.to_owned(), near(draw, most, (at, ends)))))
}

/// A contact made or missed during the first part of a record.
fn contact(draw: &mut Draw) -> FoundScene {
    let (_, scene) = ordinary_record(draw, LONGEST);
    let Forcing::Samples { dt_s, acceleration_m_s2: first } = &scene.forcing
    else {
        return Ok(None);
    };
    let late = draw.uniform(0.3, 1.0) * (first.len() - 1) as f64 * dt_s;
    let then = shock(draw, &scene, first, *dt_s)?;
    let at = |factor: f64| {
        let samples = first.iter().map(|x| x * factor);
        scene.with_samples(samples.chain(then.iter().copied()).collect())
    };
    let impacts = |scene: &CaseScene| impacts(scene, late);
    // One more impact is cut off by the end of the run; two are a contact and
    // the return from it.
    let turns = |a: &Option<u64>, b: &Option<u64>| {
        a.zip(*b).is_some_and(|(a, b)| a.abs_diff(b) == 2)
    };
    let range = (&linear(0.7, 1.7)[..], first.len());
    let Some(sides) = sides(draw, range, at, impacts, turns)? else {
        return Ok(None);
    };
    counted(draw, ("contact", NEAR, COUNTS), |run| run.peak_ratio, sides)
}

/// An amplitude between two outcomes.
fn fate(draw: &mut Draw, which: usize) -> FoundScene {
    // A released block stays up: a record takes the place of the release.
    let (kind, mut scene) = match which % PULSES {
        k if k + 1 == PULSES => ordinary_record(draw, LONGEST),
        k => under_pulse(draw, k),
    };
    let size = scene.forcing.peak();
    let at = |amplitude: f64| {
        let mut scene = scene.clone();
        // A pulse's quotient is 1 or -1: its amplitude takes every double.
        for a in scene.forcing.amplitudes_mut() {
            *a = *a / size * amplitude;
        }
        scene
    };
    let range = (&geometric(0.5 * size, 10.0 * size)[..], usize::MAX);
    let found = sides(draw, range, at, overturns, bool::ne)?;
    let name = format!("fate {kind}");
    Ok(found.map(|ends| (name, near(draw, NEAR_FATE, ends))))
}

/// A peak or a plateau at the threshold of uplift, then a shock.
fn uplift(draw: &mut Draw) -> EngineResult<NamedScene> {
    let (_, mut scene) = ordinary_record(draw, LONGEST);
    let in_p = draw.log(0.005, 0.1);
    let dt_s = in_p / scene.frequency_rad_s;
    let threshold = scene.threshold_m_s2();
    let held = (draw.log(0.5, 40.0) / in_p) as usize;
    let ulps = if draw.chance(0.5) { 0 } else { few(draw, NEAR) };
    let peak = draw.sign() * moved(threshold, ulps);
    let below = 0.9 * threshold;
    let mut samples: Vec<f64> =
        (0..draw.below(50)).map(|_| draw.uniform(-below, below)).collect();
    samples.extend(vec![peak; held.clamp(1, 1000)]);
    let then = shock(draw, &scene, &samples, dt_s)?;
    // If the shock drives the block on at once, the decision still counts.
    let strong = then.iter().position(|x| x.abs() > threshold).unwrap_or(0);
    let sign = if then[strong] * peak > 0.0 { 1.0 } else { -1.0 };
    let skipped = if draw.chance(0.7) { strong } else { 0 };
    samples.extend(then.into_iter().skip(skipped).map(|x| sign * x));
    scene.forcing = Forcing::samples(dt_s, samples);
    Ok(("uplift".to_owned(), scene))
}

/// A rest that just comes before the next uplift, or just does not.
fn rest(draw: &mut Draw) -> FoundScene {
    let (_, mut scene) = ordinary_record(draw, LONGEST);
    let in_p = draw.log(0.005, 0.05);
    let dt_s = in_p / scene.frequency_rad_s;
    scene.forcing = Forcing::samples(dt_s, Vec::new());
    let threshold = scene.threshold_m_s2();
    let length = (draw.log(0.3, 2.0) / in_p) as usize + 4;
    let first = if draw.chance(0.5) {
        half_sine(length, 1.0)
    } else {
        normalised(filtered(draw, length, dt_s))
    };
    let size = draw.log(1.1, 3.0) * threshold;
    let scaled_first =
        |factor: f64| first.iter().map(move |x| x * (size * factor));
    let events = Observe { events: true, ..Observe::default() };
    let alone = scene.with_samples(scaled_first(1.0).collect());
    let alone = respond(&alone, &events)?;
    let quiet = alone.rest_time_s.map_or(-1.0, |t| t / dt_s) as i64
        - first.len() as i64;
    if !(0..3000).contains(&quiet) {
        return Ok(None);
    }
    let again = shock(draw, &scene, &[], dt_s)?;
    let lifts = again.iter().position(|x| x.abs() > threshold).unwrap_or(0);
    let quiet = usize::try_from(quiet).unwrap_or(0).saturating_sub(lifts);
    let at = |factor: f64| {
        let zeros = std::iter::repeat_n(0.0, quiet);
        let samples = scaled_first(factor).chain(zeros);
        scene.with_samples(samples.chain(again.iter().copied()).collect())
    };
    let late = (first.len() + quiet + lifts) as f64 * dt_s;
    let uplifts = |scene: &CaseScene| Ok(run_until(scene, late)?.work.uplifts);
    let range = (&linear(0.8, 1.2)[..], first.len());
    let found = sides(draw, range, at, uplifts, u64::ne)?;
    Ok(found.map(|ends| ("rest".to_owned(), near(draw, NEAR, ends))))
}

/// A clear shock that makes the highest peak, then long shaking at the
/// amplitude between two outcomes.
fn late(draw: &mut Draw) -> FoundScene {
    let (_, mut scene) = ordinary_record(draw, LONGEST);
    let p = scene.frequency_rad_s;
    let in_p = draw.log(0.02, 0.1);
    let dt_s = in_p / p;
    scene.forcing = Forcing::samples(dt_s, Vec::new());
    let threshold = scene.threshold_m_s2();
    let length = (draw.log(0.5, 2.0) / in_p) as usize + 2;
    let mut first = half_sine(length, draw.log(1.2, 2.5) * threshold);
    first.resize(first.len() + (5.0 / in_p) as usize, 0.0);
    let turns = draw.log(3.0, 15.0);
    let n = (draw.uniform(50.0, 200.0) / in_p) as usize;
    let shaking = normalised(noise(draw, n, turns * in_p));
    let at = |amplitude: f64| {
        let shaking = shaking.iter().map(|x| x * amplitude);
        scene.with_samples(first.iter().copied().chain(shaking).collect())
    };
    let range = (&geometric(threshold, 20.0 * threshold)[..], usize::MAX);
    let found = sides(draw, range, at, overturns, bool::ne)?;
    let name = "late chaos".to_owned();
    Ok(found.map(|ends| (name, near(draw, NEAR_FATE, ends))))
}

/// A shock after earlier samples: strong, but in most cases too weak to
/// overturn the block.
fn shock(
    draw: &mut Draw,
    scene: &CaseScene,
    before: &[f64],
    dt_s: f64,
) -> EngineResult<Vec<f64>> {
    let n = draw.count(50, LONGEST);
    let peak = draw.log(1.5, 5.0) * scene.threshold_m_s2();
    let mut samples = normalised(filtered(draw, n, dt_s));
    samples.iter_mut().for_each(|x| *x *= peak);
    let tries = if draw.chance(0.8) { 8 } else { 0 };
    let mut whole = scene.clone();
    for _ in 0..tries {
        let all = before.iter().chain(&samples).copied().collect();
        whole.forcing = Forcing::samples(dt_s, all);
        let response = respond(&whole, &Observe::default())?;
        if !response.outcome.is_overturned() {
            break;
        }
        samples.iter_mut().for_each(|x| *x *= 0.8);
    }
    Ok(samples)
}

/// Half a sine of this size in `length` intervals.
fn half_sine(length: usize, size: f64) -> Vec<f64> {
    let half = std::f64::consts::PI / length as f64;
    (0..=length).map(|k| size * libm::sin(half * k as f64)).collect()
}

fn run_until(scene: &CaseScene, until_s: f64) -> EngineResult<Response> {
    let until_s = Some(until_s);
    respond(scene, &Observe { until_s, ..Observe::default() })
}

fn overturns(scene: &CaseScene) -> EngineResult<bool> {
    Ok(respond(scene, &Observe::default())?.outcome.is_overturned())
}

/// At most `most` units in the last place, to either side.
pub(super) fn few(draw: &mut Draw, most: usize) -> i64 {
    let ulps = if draw.chance(0.1) { 0 } else { draw.count(1, most) };
    if draw.chance(0.5) { ulps as i64 } else { -(ulps as i64) }
}

/// A scene whose first hop after rest grazes the base: the block lifts, falls
/// back, and is caught within rounding of its base while it hardly moves.
/// Shaking that follows magnifies the error that the graze leaves.
///
/// Only the fast part of that hop shows that its rotation is rounded: the
/// block starts without error and lands slowly.
pub(super) fn first_hop(draw: &mut Draw) -> FoundScene {
    attempts(|| hop(draw))
}

/// A lobe that lifts the block, one that pulls it back, and one that catches
/// it, each held constant, then levels held for a few samples each, under
/// which a block rocks for long; the amplitude of all of it decides.
fn hop(draw: &mut Draw) -> FoundScene {
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
    let late = (first - 1) as f64 * dt_s;
    let impacts = |scene: &CaseScene| impacts(scene, late);
    // Missed, or met and left again.
    let turns = |a: &Option<u64>, b: &Option<u64>| {
        matches!((a, b), (Some(0), Some(2)) | (Some(2), Some(0)))
    };
    let range = geometric(1.05 * threshold, 4.0 * threshold);
    let range = (&range[..], first);
    let Some(sides) = sides(draw, range, at, impacts, turns)? else {
        return Ok(None);
    };
    let standing = |run: &Response| match run.outcome {
        Outcome::Overturned { .. } => f64::NAN,
        _ => run.peak_ratio,
    };
    counted(draw, ("first hop", NEAR_BASE, COUNTS_LATER), standing, sides)
}
