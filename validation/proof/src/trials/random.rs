//! Random scenes.

use std::convert::Infallible;
use std::f64::consts::TAU;

use rocking::excitation::{PulseName, PulseParameter as P};

use super::draw::Draw;
use super::records::RecordKind;
use crate::scene::{CaseScene, EngineResult, Forcing, Model, Overturning};

/// Most samples of a record that is not long.
const COMMON: usize = 2000;
/// Most samples of a long record.
const LONG: usize = 100_000;
/// Share of long records.
const SHARE_OF_LONG: f64 = 1.0 / 256.0;

/// A scene with the name of its kind.
pub(super) type NamedScene = (String, CaseScene);

/// A scene with the name of its kind; none if the search found none.
pub(super) type FoundScene = EngineResult<Option<NamedScene>>;

/// Ranges of a stratum.
struct Ranges {
    alpha: [f64; 2],
    p: [f64; 2],
    /// Largest acceleration over the threshold of uplift.
    intensity: [f64; 2],
    /// Duration of a pulse's period, or of all of it, times p.
    period: [f64; 2],
    /// Periods of a Ricker pulse.
    cycles: [f64; 2],
    /// Oscillatory character of the Mavroeidis pulse.
    gamma: [f64; 2],
}

const ORDINARY: Ranges = Ranges {
    alpha: [0.05, 0.35],
    p: [0.5, 6.0],
    intensity: [1.0, 5.0],
    period: [0.3, 6.0],
    cycles: [2.0, 6.0],
    gamma: [1.0, 5.0],
};

const EXTREME: Ranges = Ranges {
    alpha: [0.01, 0.8],
    p: [0.1, 20.0],
    intensity: [0.5, 50.0],
    period: [0.05, 20.0],
    cycles: [1.0, 1000.0],
    gamma: [1.0, 1000.0],
};

/// Largest number of periods of a pulse times their duration times p.
const LONGEST_PULSE: f64 = 500.0;

/// A scene like those of the study.
pub(super) fn ordinary(draw: &mut Draw) -> NamedScene {
    let mut scene = block(draw, &ORDINARY);
    scene.restitution = draw.uniform(0.8, 0.97);
    if !draw.chance(0.6) {
        let which = draw.below(PULSES);
        return shaped(draw, scene, &ORDINARY, which);
    }
    let dt_s = draw.one_of(&[0.005, 0.01, 0.02]);
    let n = draw.count(200, 4000);
    let two = draw.chance(0.15);
    let kind = if two { RecordKind::TwoShocks } else { RecordKind::Filtered };
    record(draw, scene, kind, (n, dt_s), &ORDINARY)
}

/// A scene at the limits of valid input.
pub(super) fn extreme(draw: &mut Draw) -> NamedScene {
    let mut scene = block(draw, &EXTREME);
    scene.restitution = match draw.uniform(0.0, 1.0) {
        0.0..0.02 => 1.0,
        0.02..0.04 => 1.0 - 1e-6,
        _ => draw.uniform(0.3, 1.0),
    };
    if draw.chance(0.4) {
        let which = draw.below(PULSES);
        return shaped(draw, scene, &EXTREME, which);
    }
    let elastic = scene.restitution > 0.999;
    let n = if elastic {
        draw.count(2, 100)
    } else if draw.chance(SHARE_OF_LONG) {
        draw.count(COMMON, LONG)
    } else {
        draw.count(2, COMMON)
    };
    let dt_s = draw.log(1e-4, 0.5) / scene.frequency_rad_s;
    let kind = draw.one_of(&RecordKind::ALL);
    let (kind, mut scene) = record(draw, scene, kind, (n, dt_s), &EXTREME);
    let threshold = scene.threshold_m_s2();
    if let Some(a) = scene.forcing.samples_mut() {
        if draw.chance(0.1) {
            a.iter_mut().for_each(|x| *x = (*x * 1e3).round() / 1e3);
        }
        if draw.chance(0.1) {
            let at = draw.below(n);
            a[at] = threshold * draw.sign();
        }
    }
    (kind, scene)
}

/// A block at rest, without ground motion; restitution 1.
fn block(draw: &mut Draw, ranges: &Ranges) -> CaseScene {
    let linear = draw.chance(0.3);
    let half_pi = draw.chance(0.3);
    let alpha = draw.uniform(ranges.alpha[0], ranges.alpha[1]);
    let p = draw.log(ranges.p[0], ranges.p[1]);
    CaseScene::new([alpha, p, 1.0], 1.0, Forcing::NONE)
        .in_equation(if linear { Model::Linearized } else { Model::Nonlinear })
        .to(if half_pi { Overturning::HalfPi } else { Overturning::Alpha })
}

/// Gives a scene a record of a kind with a peak over the threshold.
fn record(
    draw: &mut Draw,
    mut scene: CaseScene,
    kind: RecordKind,
    (n, dt_s): (usize, f64),
    ranges: &Ranges,
) -> NamedScene {
    let intensity = draw.log(ranges.intensity[0], ranges.intensity[1]);
    let mut samples = kind.samples(draw, n, dt_s);
    let peak = intensity * scene.threshold_m_s2();
    samples.iter_mut().for_each(|x| *x *= peak);
    scene.forcing = Forcing::samples(dt_s, samples);
    (kind.name().to_owned(), scene)
}

/// Kinds of pulse, the release among them, which is the last.
pub(super) const PULSES: usize = PulseName::ALL.len() + 1;

/// A block under a pulse of a kind.
pub(super) fn under_pulse(draw: &mut Draw, which: usize) -> NamedScene {
    let extreme = draw.chance(0.3);
    let ranges = if extreme { EXTREME } else { ORDINARY };
    let (least, most) = if extreme { (0.3, 1.0) } else { (0.8, 0.97) };
    let mut scene = block(draw, &ranges);
    scene.restitution = draw.uniform(least, most);
    shaped(draw, scene, &ranges, which)
}

/// An ordinary block under a short ordinary record.
pub(super) fn ordinary_record(draw: &mut Draw, longest: usize) -> NamedScene {
    let mut scene = block(draw, &ORDINARY);
    scene.restitution = draw.uniform(0.8, 0.97);
    let dt_s = draw.one_of(&[0.005, 0.01, 0.02]);
    let n = draw.count(100, longest);
    record(draw, scene, RecordKind::Filtered, (n, dt_s), &ORDINARY)
}

/// Gives a scene a pulse, or a rotation to be released from.
fn shaped(
    draw: &mut Draw,
    mut scene: CaseScene,
    ranges: &Ranges,
    which: usize,
) -> NamedScene {
    let intensity = draw.log(ranges.intensity[0], ranges.intensity[1]);
    let amplitude = intensity * scene.threshold_m_s2() * draw.sign();
    let in_p = draw.log(ranges.period[0], ranges.period[1]);
    let period_s = in_p / scene.frequency_rad_s;
    let omega_rad_s = TAU / period_s;
    let most = (LONGEST_PULSE / in_p).max(1.0);
    let Some(pulse) = PulseName::ALL.get(which) else {
        let near = draw.log(1e-12, 1.0);
        let ratio = match draw.below(3) {
            0 => 1.0 - near,
            1 => near,
            _ => draw.uniform(0.0, 1.0),
        };
        // Below 1 after any rounding.
        let ratio = ratio.min(1.0 - 1e-14);
        let rotation_rad = scene.slenderness_rad * ratio;
        scene.forcing = Forcing::Free { rotation_rad };
        return ("free".to_owned(), scene);
    };
    let Ok(kind) = pulse.kind(|parameter| {
        Ok::<_, Infallible>(match parameter {
            P::Amplitude => amplitude,
            P::Velocity => amplitude / omega_rad_s,
            P::Omega => omega_rad_s,
            P::Duration | P::Period => period_s,
            P::Frequency => 1.0 / period_s,
            P::Cycles => {
                draw.log(ranges.cycles[0], ranges.cycles[1]).min(most)
            }
            P::Gamma => draw.log(ranges.gamma[0], ranges.gamma[1]).min(most),
            P::Phase => draw.uniform(0.0, TAU),
        })
    });
    scene.forcing = Forcing::Pulse(kind);
    (pulse.to_string(), scene)
}
