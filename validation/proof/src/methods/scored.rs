//! The reference data set for other codes: its certified values against the
//! core in double-double, and its diagnosis of codes with a known mistake.

use anyhow::{Result, anyhow};
use rocking::number::double::DoubleDouble;
use rocking::number::{Number as _, Real};
use rocking_score::{
    Answers, CodeVerdict, Diagnosis, Item, OwnResponse, Problem,
    SceneExcitation, Value, answers_of, diagnose, reference,
};
use rocking_statistics::streams::{Streams, standard_normal};

use super::method::{Context, Memo, Reply, WrongModel};
use crate::arithmetic::{RoundedConstants, decimal, wide};
use crate::scene::{CaseScene, Engine as _, Forcing, Impact, Trace};

/// The scene as a wrong model of the input has it.
fn mistaken(context: &Context, scene: &Problem) -> Problem {
    let mut scene = scene.clone();
    if context.is(WrongModel::EtaSquared) {
        scene.eta *= scene.eta;
    }
    scene
}

/// Largest error of a certified value over its size and condition; the number
/// of outcomes and counts that differ.
pub fn certified(context: &Context, answer: &mut Reply) -> Result<()> {
    let (mut worst, mut wrong) = (0.0_f64, 0.0);
    // One scene in eight is enough to reject a wrong model.
    let step = if context.wrong.is_some() { 8 } else { 1 };
    let scenes = reference().scenes.iter().enumerate();
    for (index, scene) in scenes.step_by(step) {
        let scene = mistaken(context, scene);
        let (error, others) = if context.is(WrongModel::F64Constants) {
            errors::<RoundedConstants>(index, &scene)?
        } else {
            errors::<DoubleDouble>(index, &scene)?
        };
        worst = worst.max(error);
        wrong += others;
    }
    answer.put("error-over-condition", [worst], [0.0]);
    answer.put("fates-and-counts-wrong", [wrong], [0.0]);
    Ok(())
}

fn errors<N: Real>(index: usize, scene: &Problem) -> Result<(f64, f64)> {
    let run = OwnResponse::<N>::precise(scene).map_err(|e| anyhow!(e))?;
    let (mut worst, mut wrong) = (0.0_f64, 0.0);
    let items = reference().items.iter();
    for item in items.filter(|item| item.scene == index) {
        let right = match &item.value {
            Value::Fate(fate) => fate == run.fate(),
            Value::Count(n) => *n == run.impacts(scene.impacts_until_s) as u64,
            Value::Number(size) => {
                let due = decimal(&item.digits);
                let found = run.number(scene, &item.quantity);
                let error = found.zip(due).map_or(f64::INFINITY, |(a, b)| {
                    (wide(a) - b).abs().to_f64() / size.abs()
                });
                worst = worst.max(error / item.condition.max(1.0));
                true
            }
        };
        wrong += f64::from(!right);
    }
    Ok((worst, wrong))
}

/// Quantities that a wrong model of the input does not change.
const SHARE_NAMES: [&str; 3] = [
    "wrong-models-named",
    "unknown-models-guessed",
    "models-of-the-harness-named",
];

/// Their values by case and scatter.
static SHARES: Memo<(String, u64), f64> = Memo::new();

/// Shares of codes whose diagnosis is right: of the right code, of every
/// wrong model and pair on its own answers, of wrong models by the core on
/// altered inputs; and the share of wrong models that are mistaken for another
/// one if the diagnosis does not know them.
pub fn diagnosis(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Relative scatter of the answers.
        noise: Vec<f64>,
        /// Wrong models that the harness makes by altering the input.
        altered: Vec<WrongModel>,
    }
    let set = reference();
    let run = |scene: &_| OwnResponse::double(&mistaken(context, scene));
    let right = answers_of(run).map_err(|e| anyhow!(e))?;
    for scatter in noise {
        let noisy =
            |name: &str, of: &dyn Fn(usize, &Item) -> Option<Value>| {
                let streams = Streams::new(&format!("{scatter}/{name}"), 0);
                let mut stream = streams.stream(0);
                let mut answers = Answers::none();
                for (place, item) in set.items.iter().enumerate() {
                    let mut value = of(place, item);
                    if let Some(Value::Number(x)) = &mut value {
                        *x *= 1.0 + scatter * standard_normal(&mut stream);
                    }
                    answers.set(place, value);
                }
                answers
            };
        let own = noisy("right", &|place, _| right.get(place).cloned());
        let none = diagnose(&own, &[]).verdict == CodeVerdict::None;
        answer.see("right-code-told-none", [f64::from(none)]);
        let make = |_: &_| {
            let (mut named, mut guessed, mut singles) = (0.0, 0.0, 0.0);
            for (model, name) in set.models.iter().enumerate() {
                let own = noisy(name, &|_, item| item.wrong[model].clone());
                let found = names(&diagnose(&own, &[]));
                named += f64::from(found == [name.clone()]);
                if !name.contains('+') {
                    let all = diagnose(&own, &[name.as_str()]).explanations;
                    let other = all.iter().any(|one| one.factor.is_none());
                    guessed += f64::from(other);
                    singles += 1.0;
                }
            }
            let mut good = 0.0;
            for wrong in &altered {
                // The core refuses a release beyond an alpha that is too low:
                // this scene has no answers.
                let runs = set.scenes.iter();
                let runs =
                    runs.map(|scene| wrong.respond(&scene_of(scene)).ok());
                let runs: Vec<Option<Trace>> = runs.collect();
                let own = noisy(wrong.name(), &|_, item| {
                    let run = runs[item.scene].as_ref()?;
                    seen(&set.scenes[item.scene], run, item)
                });
                let found = names(&diagnose(&own, &[]));
                good += f64::from(found == [wrong.name()]);
            }
            let named = named / set.models.len() as f64;
            Ok(vec![named, guessed / singles, good / altered.len() as f64])
        };
        let shares =
            SHARES.get((context.case.id.clone(), scatter.to_bits()), make)?;
        for (name, share) in SHARE_NAMES.into_iter().zip(shares.iter()) {
            answer.see(name, [*share]);
        }
    }
    Ok(())
}

/// The explanations, each as the names of its mistakes.
fn names(found: &Diagnosis) -> Vec<String> {
    let explanations = found.explanations.iter().map(|one| {
        let all = one.mistakes.iter().map(|mistake| mistake.name.as_str());
        all.collect::<Vec<_>>().join("+")
    });
    explanations.collect()
}

/// A scene of the data set as the harness has it.
fn scene_of(asked: &Problem) -> CaseScene {
    let forcing = match &asked.excitation {
        SceneExcitation::Free => {
            Forcing::Free { rotation_rad: asked.initial_theta_rad }
        }
        SceneExcitation::Pulse(kind) => Forcing::Pulse(*kind),
        SceneExcitation::Samples { dt_s, samples_m_s2 } => {
            Forcing::samples(*dt_s, samples_m_s2.clone())
        }
    };
    let block = [asked.alpha_rad, asked.p_rad_s, asked.g_m_s2];
    CaseScene::new(block, asked.eta, forcing)
        .in_equation(asked.equation)
        .to(asked.overturning)
}

/// The value of a quantity in a trace of the harness; none for rotations.
fn seen(asked: &Problem, trace: &Trace, item: &Item) -> Option<Value> {
    let falls = trace.overturned_s.is_some();
    let quantity = item.quantity.as_str();
    let number = match quantity {
        "fate" => {
            let moves = trace.uplifts > 0 || asked.initial_theta_rad != 0.0;
            let stands = if moves { "rocked" } else { "no-uplift" };
            let fate = if falls { "overturned" } else { stands };
            return Some(Value::Fate(fate.into()));
        }
        "impacts" => {
            let counts = |i: &&Impact| i.time_s <= asked.impacts_until_s;
            let count = trace.impacts.iter().filter(counts).count();
            return Some(Value::Count(count as u64));
        }
        "uplift_time_s" => trace.uplift_s,
        "peak_ratio" => {
            (!falls && trace.peak_ratio > 0.0).then_some(trace.peak_ratio)
        }
        "peak_time_s" => trace.peak_time_s,
        "rest_time_s" => trace.rest_s,
        "overturning_time_s" => trace.overturned_s,
        "impact_1_speed_rad_s" => {
            trace.impacts.first().map(|i| i.speed_before_rad_s)
        }
        _ => {
            let place = quantity.strip_prefix("impact_")?;
            let place: usize = place.strip_suffix("_time_s")?.parse().ok()?;
            trace.impacts.get(place - 1).map(|i| i.time_s)
        }
    };
    number.map(Value::Number)
}
