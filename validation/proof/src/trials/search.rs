//! Search for the two neighbouring doubles between which a decision turns.

use super::draw::Draw;
use crate::scene::{CaseScene, EngineResult, Forcing};

/// Parts into which a range is divided to find a change.
const PARTS: usize = 24;

/// Numbers that divide a range evenly.
pub(super) fn linear(low: f64, high: f64) -> Vec<f64> {
    let step = (high - low) / PARTS as f64;
    (0..=PARTS).map(|k| low + step * k as f64).collect()
}

/// Numbers that divide a range of positive numbers by equal ratios.
pub(super) fn geometric(low: f64, high: f64) -> Vec<f64> {
    let logs = linear(libm::log(low), libm::log(high));
    logs.into_iter().map(libm::exp).collect()
}

/// A function that makes a scene from a number.
pub(super) type SceneMaker<'a> = Box<dyn Fn(f64) -> CaseScene + 'a>;

/// Two neighbouring doubles between which a decision turns, and the function
/// that makes their scenes.
pub(super) type Sides<'a> = (SceneMaker<'a>, [f64; 2]);

/// The sides of a decision that turns somewhere in a rising range; none if it
/// does not. `at` makes the scene of a positive number, `see` observes it,
/// `turns` compares two observations; at most `first` samples of a record
/// come before the decision.
pub(super) fn sides<'a, V>(
    draw: &mut Draw,
    (range, first): (&[f64], usize),
    at: impl Fn(f64) -> CaseScene + 'a,
    see: impl Fn(&CaseScene) -> EngineResult<V>,
    turns: impl Fn(&V, &V) -> bool,
) -> EngineResult<Option<Sides<'a>>> {
    let seen = range.iter().map(|x| see(&at(*x)));
    let seen = seen.collect::<EngineResult<Vec<_>>>()?;
    let places: Vec<usize> =
        (1..range.len()).filter(|k| turns(&seen[k - 1], &seen[*k])).collect();
    if places.is_empty() {
        return Ok(None);
    }
    let place = draw.one_of(&places);
    let ends = [range[place - 1], range[place]];
    let at: SceneMaker<'a> = Box::new(at);
    let Some(ends) = bisected(ends, &*at, &see, &turns)? else {
        return Ok(None);
    };
    if draw.chance(0.7)
        && let Some(fine) = finer(draw, &at(ends[1]), first, &see, &turns)?
    {
        return Ok(Some(fine));
    }
    Ok(Some((at, ends)))
}

/// Neighbouring doubles between two positive numbers.
fn bisected<V>(
    [mut low, mut high]: [f64; 2],
    at: &dyn Fn(f64) -> CaseScene,
    see: &impl Fn(&CaseScene) -> EngineResult<V>,
    turns: &impl Fn(&V, &V) -> bool,
) -> EngineResult<Option<[f64; 2]>> {
    let (mut at_low, mut at_high) = (see(&at(low))?, see(&at(high))?);
    loop {
        let middle = f64::from_bits(low.to_bits().midpoint(high.to_bits()));
        if middle == low {
            return Ok(Some([low, high]));
        }
        let at_middle = see(&at(middle))?;
        if turns(&at_low, &at_middle) {
            (high, at_high) = (middle, at_middle);
        } else if turns(&at_middle, &at_high) {
            (low, at_low) = (middle, at_middle);
        } else {
            return Ok(None);
        }
    }
}

/// The sides by the size of one sample, which moves the block far less than
/// one unit in the last place of all samples.
fn finer<'a, V>(
    draw: &mut Draw,
    scene: &CaseScene,
    first: usize,
    see: &impl Fn(&CaseScene) -> EngineResult<V>,
    turns: &impl Fn(&V, &V) -> bool,
) -> EngineResult<Option<Sides<'a>>> {
    let Forcing::Samples { acceleration_m_s2: samples, .. } = &scene.forcing
    else {
        return Ok(None);
    };
    let place = draw.below(first.min(samples.len()));
    let (size, sign) = (samples[place].abs(), samples[place].signum());
    let own = scene.clone();
    let at: SceneMaker<'a> = Box::new(move |size: f64| {
        let mut scene = own.clone();
        scene.forcing.amplitudes_mut()[place] = sign * size;
        scene
    });
    let here = see(scene)?;
    let mut step = f64::EPSILON;
    while size > 0.0 && step < 1e-6 {
        for other in [size * (1.0 - step), size * (1.0 + step)] {
            if turns(&here, &see(&at(other))?) {
                let ends = [size.min(other), size.max(other)];
                let found = bisected(ends, &*at, see, turns)?;
                return Ok(found.map(|ends| (at, ends)));
            }
        }
        step *= 2.0;
    }
    Ok(None)
}

/// The scene of one of the sides, moved away from the other by at most `most`
/// units in the last place.
pub(super) fn near(
    draw: &mut Draw,
    most: usize,
    (at, [below, above]): Sides<'_>,
) -> CaseScene {
    let ulps = if draw.chance(0.1) { 0 } else { draw.count(1, most) as i64 };
    let low = draw.chance(0.5);
    at(if low { moved(below, -ulps) } else { moved(above, ulps) })
}

/// A positive number moved by units in the last place.
pub(crate) fn moved(x: f64, ulps: i64) -> f64 {
    f64::from_bits(x.to_bits().wrapping_add_signed(ulps))
}
