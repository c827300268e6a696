//! Whole scenes written in the case, and the fates of records over levels.

use serde::Deserialize;

use super::method::{Answer, Context, MethodError, input_of};
use super::wrong::scale;
use crate::cases::Case;
use crate::engine::Core;
use crate::references;
use crate::scene::{
    Engine as _, Forcing, Model, Overturning, PulseKind, Scene,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneInput {
    equation: Model,
    slenderness_rad: f64,
    frequency_rad_s: f64,
    restitution: f64,
    #[serde(default)]
    half_sine: Option<Sine>,
    #[serde(default)]
    record: Option<Samples>,
    until_s: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sine {
    amplitude_m_s2: f64,
    omega_rad_s: f64,
}

/// A record written as runs of straight lines.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Samples {
    dt_s: f64,
    /// Corner points: sample number and acceleration in m/s2.
    corners: Vec<(usize, f64)>,
}

impl Samples {
    pub(super) fn forcing(&self) -> Result<Forcing, MethodError> {
        let mut samples = Vec::new();
        for pair in self.corners.windows(2) {
            let [(from, a), (to, b)] = pair else { continue };
            if to <= from {
                let text = format!("corner {to} after corner {from}");
                return Err(MethodError::Input(text));
            }
            let rise = (b - a) / (to - from) as f64;
            samples.extend((0..to - from).map(|k| a + rise * k as f64));
        }
        samples.extend(self.corners.last().map(|corner| corner.1));
        Ok(Forcing::Samples { dt_s: self.dt_s, acceleration_m_s2: samples })
    }
}

/// The scene that a case writes out.
pub(super) fn scene_of(case: &Case) -> Result<Scene, MethodError> {
    let input: SceneInput = input_of(case)?;
    let forcing = match (&input.half_sine, &input.record) {
        (Some(sine), None) => Forcing::Pulse(PulseKind::HalfSine {
            amplitude: sine.amplitude_m_s2,
            omega_rad_s: sine.omega_rad_s,
        }),
        (None, Some(record)) => record.forcing()?,
        _ => {
            let text = "one of `half_sine` and `record`".to_owned();
            return Err(MethodError::Input(text));
        }
    };
    Ok(Scene {
        model: input.equation,
        until_s: input.until_s,
        ..Scene::new(
            [input.slenderness_rad, input.frequency_rad_s, 9.81],
            input.restitution,
            forcing,
        )
    })
}

/// Peak, fate and counts of a scene; what is expected is in the case.
pub(super) fn response(context: &Context) -> Result<Answer, MethodError> {
    let scene = scene_of(context.case)?;
    let trace = context.engine.respond(&scene)?;
    let mut answer = Answer::default();
    answer.see("peak-ratio", [trace.peak_ratio]);
    answer.see("uplifts", [trace.uplifts as f64]);
    let over = f64::from(trace.overturned_s.is_some());
    answer.see("overturned", [over]);
    Ok(answer)
}

/// Fates of one record over levels of 0.01 g, under both criteria.
pub(super) fn levels(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        record: String, slenderness_rad: f64, frequency_rad_s: f64,
        first_level_g: f64,
        /// One letter a level of 0.01 g: S survives, R exceeds alpha and comes
        /// to rest, r exceeds alpha, returns and overturns later, O overturns.
        letters: String,
    }
    let (dt_s, record) = references::record(&record)?;
    let peak = record.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    let mut answer = Answer::default();
    answer.put("impact-in-between", [], []);
    for (k, letter) in letters.chars().enumerate() {
        let level_g = first_level_g + 0.01 * k as f64;
        let mut scene = Scene::new(
            [slenderness_rad, frequency_rad_s, 9.81],
            0.92,
            Forcing::Samples { dt_s, acceleration_m_s2: record.clone() },
        );
        scale(&mut scene.forcing, level_g * 9.81 / peak);
        let first = context.engine.respond(&scene)?.overturned_s;
        scene.overturning = Overturning::HalfPi;
        let trace = context.engine.respond(&scene)?;
        let last = trace.overturned_s;
        let (alpha, half_pi) = match letter {
            'S' => (0.0, 0.0),
            'R' => (1.0, 0.0),
            'r' | 'O' => (1.0, 1.0),
            other => {
                return Err(MethodError::Input(format!("letter `{other}`")));
            }
        };
        let seen = |x: Option<f64>| f64::from(x.is_some());
        answer.put("reaches-alpha", [seen(first)], [alpha]);
        answer.put("reaches-half-pi", [seen(last)], [half_pi]);
        // A block that comes back rocks on: it meets the base in between.
        if let (Some(first), Some(last)) = (first, last) {
            let back = |t: f64| t > first && t < last;
            let back = trace.impacts.iter().any(|i| back(i.time_s));
            answer.put(
                "impact-in-between",
                [f64::from(back)],
                [f64::from(letter == 'r')],
            );
        }
    }
    Ok(answer)
}

/// Eq. 2 on every record of an embedded suite: the scaled record on the
/// reference block against the record as it is on the adjusted block.
pub(super) fn adjustment(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        suite: String, slenderness_rad: f64, frequency_rad_s: f64,
        /// PGA/(g alpha).
        intensities: Vec<f64>,
    }
    let suite = match suite.as_str() {
        "ordinary" => rocking_synthesis::ordinary(),
        "pulse" => rocking_synthesis::pulse(),
        other => return Err(MethodError::Input(format!("suite `{other}`"))),
    };
    let suite = suite.map_err(|e| MethodError::Oracle(e.to_string()))?;
    let mut answer = Answer::default();
    let mut differences = Vec::new();
    for pair in &suite {
        let record = &pair.components[0];
        for &im in &intensities {
            let alpha = slenderness_rad;
            let factor = im * alpha / record.pga_g();
            let scene = |slenderness_rad: f64, factor: f64| Scene {
                model: Model::Linearized,
                ..Scene::new(
                    [slenderness_rad, frequency_rad_s, 1.0],
                    0.92,
                    Forcing::Samples {
                        dt_s: record.dt_s(),
                        acceleration_m_s2: record
                            .samples_g()
                            .iter()
                            .map(|a| a * factor)
                            .collect(),
                    },
                )
            };
            // A slenderness above pi/2 is none.
            let adjusted = record.pga_g() / im;
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
    Ok(answer)
}
