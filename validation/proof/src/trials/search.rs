//! Search for the two neighbouring doubles between which a decision turns.

use std::rc::Rc;

use super::draw::Draw;
use crate::scene::{CaseScene, EngineError, Forcing};

/// Parts into which the range of the number is divided to find a change.
const PARTS: usize = 24;

/// Numbers that divide a range evenly.
pub(super) fn linear(low: f64, high: f64) -> Vec<f64> {
    let step = (high - low) / PARTS as f64;
    (0..=PARTS).map(|k| low + step * k as f64).collect()
}

/// Numbers that divide a range of positive numbers by equal ratios.
pub(super) fn geometric(low: f64, high: f64) -> Vec<f64> {
    linear(libm::log(low), libm::log(high))
        .into_iter()
        .map(libm::exp)
        .collect()
}

/// A scene that a number makes, with the number and what else it makes.
pub(super) type SearchSide<'a> = (CaseScene, f64, SceneMaker<'a>);

/// What makes a scene from a number.
pub(super) type SceneMaker<'a> = Rc<dyn Fn(f64) -> CaseScene + 'a>;

/// Two scenes of neighbouring doubles between which a decision turns,
/// somewhere in a rising range; none where it does not. `at` makes the scene
/// of a positive number, `see` looks at it, `turns` says whether two sights
/// lie on the two sides; `first` samples of a record come before the
/// decision, at most.
pub(super) fn sides<'a, V>(
    draw: &mut Draw,
    (range, first): (&[f64], usize),
    at: impl Fn(f64) -> CaseScene + 'a,
    see: impl Fn(&CaseScene) -> Result<V, EngineError>,
    turns: impl Fn(&V, &V) -> bool,
) -> Result<Option<[SearchSide<'a>; 2]>, EngineError> {
    let seen = range
        .iter()
        .map(|x| see(&at(*x)))
        .collect::<Result<Vec<_>, EngineError>>()?;
    let places: Vec<usize> =
        (1..range.len()).filter(|k| turns(&seen[k - 1], &seen[*k])).collect();
    if places.is_empty() {
        return Ok(None);
    }
    let place = draw.one_of(&places);
    let ends = [range[place - 1], range[place]];
    let at: SceneMaker<'a> = Rc::new(at);
    let Some(ends) = bisected(ends, &*at, &see, &turns)? else {
        return Ok(None);
    };
    let fine = if draw.chance(0.7) {
        finer(draw, &at(ends[1]), first, &see, &turns)?
    } else {
        None
    };
    let (at, ends) = fine.unwrap_or((at, ends));
    Ok(Some(ends.map(|x| (at(x), x, Rc::clone(&at)))))
}

/// Neighbouring doubles between two positive numbers.
fn bisected<V>(
    [mut low, mut high]: [f64; 2],
    at: &dyn Fn(f64) -> CaseScene,
    see: &impl Fn(&CaseScene) -> Result<V, EngineError>,
    turns: &impl Fn(&V, &V) -> bool,
) -> Result<Option<[f64; 2]>, EngineError> {
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

/// The same by the size of one sample, which moves the block far less than
/// one unit in the last place of them all.
fn finer<'a, V>(
    draw: &mut Draw,
    scene: &CaseScene,
    first: usize,
    see: &impl Fn(&CaseScene) -> Result<V, EngineError>,
    turns: &impl Fn(&V, &V) -> bool,
) -> Result<Option<(SceneMaker<'a>, [f64; 2])>, EngineError> {
    let Forcing::Samples { acceleration_m_s2: samples, .. } = &scene.forcing
    else {
        return Ok(None);
    };
    let place = draw.below(first.min(samples.len()));
    let (size, sign) = (samples[place].abs(), samples[place].signum());
    let own = scene.clone();
    let at: SceneMaker<'a> = Rc::new(move |size: f64| {
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

/// One of two neighbouring scenes, moved away by some units in the last
/// place at most.
pub(super) fn near(
    draw: &mut Draw,
    most: usize,
    [(low, below, at), (high, above, _)]: [SearchSide<'_>; 2],
) -> CaseScene {
    let ulps = if draw.chance(0.1) { 0 } else { draw.count(1, most) as i64 };
    match (draw.chance(0.5), ulps) {
        (true, 0) => low,
        (false, 0) => high,
        (true, ulps) => at(moved(below, -ulps)),
        (false, ulps) => at(moved(above, ulps)),
    }
}

/// A positive number moved by units in the last place.
pub(crate) fn moved(x: f64, ulps: i64) -> f64 {
    f64::from_bits(x.to_bits().wrapping_add_signed(ulps))
}
