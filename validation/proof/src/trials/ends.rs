//! Scenes whose end of observation is a decision, and scenes whose ground
//! acceleration has its peak at the uplift threshold.

use rocking::excitation::{Pulse, PulseName};
use rocking::integrator::{Observe, Outcome};

use super::draw::Draw;
use super::grazing::few;
use super::random::{
    self, FoundScene, NamedScene, ordinary_record, under_pulse,
};
use super::search::moved;
use crate::engine::respond;
use crate::scene::{EngineError, Forcing};

/// Most scenes drawn to find one with the required event.
const ATTEMPTS: usize = 60;
/// Most units in the last place between an event and the end.
const NEAR_EVENT: usize = 10_000;
/// Most units in the last place between a peak and the threshold.
const NEAR_THRESHOLD: usize = 100;
/// Most samples of a record.
const LONGEST: usize = 400;
/// Longest observation (in 1/p) after the ground motion.
const AFTER: f64 = 4.0;

/// Kinds of pulse.
const PULSES: usize = PulseName::ALL.len();

/// A scene whose observation ends near an overturning, near the first uplift,
/// or anywhere; the index cycles through the kinds.
pub(super) fn ending(draw: &mut Draw, index: u64) -> FoundScene {
    for _ in 0..ATTEMPTS {
        let (_, mut scene) = match draw.below(3) {
            0 => ordinary_record(draw, LONGEST),
            1 => {
                let which = draw.below(random::PULSES);
                under_pulse(draw, which)
            }
            _ => random::extreme(draw),
        };
        let response = match respond(&scene, &Observe::default()) {
            Err(EngineError::Work(_)) => continue,
            response => response?,
        };
        let uplift_s = response.uplift_time_s.filter(|t| *t > 0.0);
        let mut about = |event_s| moved(event_s, few(draw, NEAR_EVENT));
        let (name, until_s) = match (index % 3, response.outcome, uplift_s) {
            (0, Outcome::Overturned { time_s, .. }, _) => {
                ("end at overturning", about(time_s))
            }
            (1, _, Some(time_s)) => ("end at uplift", about(time_s)),
            (2, ..) => {
                let after_s = AFTER / scene.frequency_rad_s;
                let end_s = scene.forcing.end_s();
                let whole = draw.chance(0.3);
                let from_s = if whole { 0.0 } else { end_s };
                ("end anywhere", draw.uniform(from_s, end_s + after_s))
            }
            _ => continue,
        };
        if until_s > 0.0 {
            scene.until_s = Some(until_s);
            return Ok(Some((name.to_owned(), scene)));
        }
    }
    Ok(None)
}

/// A pulse, or the first sample of a record, that rises to the threshold of
/// uplift to within some units in the last place.
pub(super) fn touching(draw: &mut Draw, index: u64) -> Option<NamedScene> {
    let which = (index % (PULSES as u64 + 1)) as usize;
    if which == PULSES {
        let (_, mut scene) = ordinary_record(draw, LONGEST);
        let threshold = scene.threshold_m_s2();
        let peak = moved(threshold, few(draw, NEAR_THRESHOLD));
        let most = scene.forcing.peak();
        scene.forcing.scale(draw.uniform(0.1, 0.95) * threshold / most);
        scene.forcing.amplitudes_mut()[0] = peak * draw.sign();
        return Some(("touch, first sample".into(), scene));
    }
    let (kind, mut scene) = under_pulse(draw, which);
    let name = format!("touch, {kind}");
    let threshold = scene.threshold_m_s2();
    let Forcing::Pulse(kind) = &mut scene.forcing else { return None };
    let pulse = Pulse::try_new(*kind).ok()?.with_pga(threshold).ok()?;
    *kind = pulse.kind();
    let amplitude = kind.amplitude_mut();
    let size = moved(amplitude.abs(), few(draw, NEAR_THRESHOLD));
    *amplitude = size.copysign(*amplitude);
    Some((name, scene))
}
