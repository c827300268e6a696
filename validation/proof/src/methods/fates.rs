//! Scenes that a case writes out, and the outcomes of records over levels.

use std::f64::consts::FRAC_PI_2;

use anyhow::{Context as _, Result, bail, ensure};
use rocking_synthesis::SuiteKind;
use serde::Deserialize;

use super::method::{Context, Reply, input_of, suite as pairs_of};
use crate::cases::Case;
use crate::engine::Core;
use crate::references;
use crate::scene::{
    CaseScene, Engine as _, Forcing, Model, Overturning, PulseName,
};

/// A scene that a case writes out.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneInput {
    equation: Model,
    slenderness_rad: f64,
    frequency_rad_s: f64,
    restitution: f64,
    half_sine: Option<SineInput>,
    /// A record of the references, scaled to PGA over the threshold.
    named: Option<(String, f64)>,
    record: Option<CornerRecord>,
    until_s: Option<f64>,
    /// Factors on the whole motion, a scene each; none: one scene.
    #[serde(default)]
    factors: Vec<f64>,
    /// Impacts compared.
    #[serde(default)]
    pub impacts: usize,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SineInput {
    amplitude_m_s2: f64,
    omega_rad_s: f64,
}

/// A record written as runs of straight lines.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CornerRecord {
    dt_s: f64,
    /// Corner points: sample number and acceleration in m/s2.
    corners: Vec<(usize, f64)>,
}

/// The record at an interval (s) that runs straight between corner points:
/// sample number and acceleration in m/s2.
pub(super) fn through(dt_s: f64, corners: &[(usize, f64)]) -> Result<Forcing> {
    let mut samples = Vec::new();
    for pair in corners.windows(2) {
        let [(from, a), (to, b)] = pair else { continue };
        ensure!(to > from, "corner {to} after corner {from}");
        let rise = (b - a) / (to - from) as f64;
        samples.extend((0..to - from).map(|k| a + rise * k as f64));
    }
    samples.extend(corners.last().map(|corner| corner.1));
    Ok(Forcing::samples(dt_s, samples))
}

impl SceneInput {
    /// The scene with each of the factors.
    pub(super) fn scenes(&self) -> Result<Vec<CaseScene>> {
        let block = [self.slenderness_rad, self.frequency_rad_s];
        let scene = CaseScene::at_rest(block, self.restitution);
        let scene = CaseScene { until_s: self.until_s, ..scene };
        let scene = scene.in_equation(self.equation);
        let scene = match (&self.half_sine, &self.named, &self.record) {
            (Some(sine), None, None) => {
                let (a, omega) = (sine.amplitude_m_s2, sine.omega_rad_s);
                scene.under(|_| Forcing::pulse(PulseName::HalfSine, a, omega))
            }
            (None, Some((name, intensity)), None) => {
                let (dt_s, samples) = references::record(name)?;
                scene.shaken(dt_s, samples, *intensity)
            }
            (None, None, Some(record)) => {
                let forcing = through(record.dt_s, &record.corners)?;
                scene.under(|_| forcing)
            }
            _ => bail!("expected one of `half_sine`, `named` and `record`"),
        };
        let scaled = |factor: &f64| {
            let mut scene = scene.clone();
            scene.forcing.scale(*factor);
            scene
        };
        let once = self.factors.is_empty().then_some(&1.0);
        Ok(self.factors.iter().chain(once).map(scaled).collect())
    }
}

/// The first scene that a case writes out.
pub(super) fn scene_of(case: &Case) -> Result<CaseScene> {
    let scenes = input_of::<SceneInput>(case)?.scenes()?;
    scenes.into_iter().next().context("no scene")
}

/// Peak, outcome and counts of a scene; the case has the expected values.
pub fn response(context: &Context, answer: &mut Reply) -> Result<()> {
    let scene = scene_of(context.case)?;
    let trace = context.engine.respond(&scene)?;
    answer.see("peak-ratio", [trace.peak_ratio]);
    answer.see("uplifts", [trace.uplifts as f64]);
    let overturned = trace.overturned_s.is_some();
    answer.see("overturned", [f64::from(overturned)]);
    Ok(())
}

/// Outcomes of one record over levels of 0.01 g, under both criteria.
pub fn levels(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        record: String, slenderness_rad: f64, frequency_rad_s: f64,
        first_level_g: f64,
        /// One letter a level of 0.01 g: S survives, R exceeds alpha and comes
        /// to rest, r exceeds alpha, returns and overturns later, O overturns.
        letters: String,
    }
    let (dt_s, record) = references::record(&record)?;
    let peak = record.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    answer.put("impact-in-between", [], []);
    for (k, letter) in letters.chars().enumerate() {
        let level_g = first_level_g + 0.01 * k as f64;
        let mut forcing = Forcing::samples(dt_s, record.clone());
        forcing.scale(level_g * 9.81 / peak);
        let block = [slenderness_rad, frequency_rad_s, 9.81];
        let scene = CaseScene::new(block, 0.92, forcing);
        let first = context.engine.respond(&scene)?.overturned_s;
        let trace = context.engine.respond(&scene.to(Overturning::HalfPi))?;
        let last = trace.overturned_s;
        ensure!("SRrO".contains(letter), "letter `{letter}`");
        let (alpha, half_pi) = (letter != 'S', "rO".contains(letter));
        let mut put = |name: &str, seen: bool, due: bool| {
            answer.put(name, [f64::from(seen)], [f64::from(due)]);
        };
        put("reaches-alpha", first.is_some(), alpha);
        put("reaches-half-pi", last.is_some(), half_pi);
        // A block that comes back rocks on: it meets the base in between.
        if let (Some(first), Some(last)) = (first, last) {
            let back = |t: f64| t > first && t < last;
            let back = trace.impacts.iter().any(|i| back(i.time_s));
            put("impact-in-between", back, letter == 'r');
        }
    }
    Ok(())
}

/// Eq. 2 on every record of an embedded suite: the scaled record on the
/// reference block against the record as it is on the adjusted block.
pub fn adjustment(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        suite: SuiteKind, slenderness_rad: f64, frequency_rad_s: f64,
        /// PGA/(g alpha).
        intensities: Vec<f64>,
    }
    let mut differences = Vec::new();
    for pair in pairs_of(suite)?.iter() {
        let record = &pair.components[0];
        for &im in &intensities {
            let alpha = slenderness_rad;
            let adjusted = record.pga_g() / im;
            // No block has a slenderness of pi/2 or more.
            if !(adjusted < FRAC_PI_2) {
                continue;
            }
            let factor = im * alpha / record.pga_g();
            let scene = |alpha: f64, factor: f64| {
                let forcing = Forcing::record(record, factor);
                CaseScene::new([alpha, frequency_rad_s, 1.0], 0.92, forcing)
                    .in_equation(Model::Linearized)
            };
            let scaled = Core.respond(&scene(alpha, factor))?;
            let twin = context.engine.respond(&scene(adjusted, 1.0))?;
            let (a, b) = (twin.peak_ratio, scaled.peak_ratio);
            differences.push(if a == b { 0.0 } else { (a / b - 1.0).abs() });
        }
    }
    differences.sort_by(f64::total_cmp);
    let at = |share: usize| differences[differences.len() * share / 10];
    answer.put("median-difference", [at(5)], [0.0]);
    answer.put("upper-decile-difference", [at(9)], [0.0]);
    Ok(())
}
