//! The answers of this project's own integrator.

use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, Pulse, ScaledRecord};
use rocking::integrator::{
    Observe, Outcome, Response, SceneError, respond, respond_precise,
};
use rocking::number::Real;

use crate::answers::Answers;
use crate::reference::{Problem, SceneExcitation, Value, reference};

/// Interval of the times of requested rotations, s.
const GRID_S: f64 = 1.0 / 64.0;

/// A run of the core for a scene, in the arithmetic of `N`.
#[derive(Clone, Debug)]
pub struct OwnResponse<N> {
    response: Response<N>,
    /// +1, or -1 if the scene was mirrored.
    sign: f64,
}

impl OwnResponse<f64> {
    /// Runs a scene in double precision.
    ///
    /// # Errors
    /// The core's reason to refuse the scene.
    pub fn double(scene: &Problem) -> Result<Self, String> {
        Self::run(scene, respond)
    }
}

impl<N: Real> OwnResponse<N> {
    /// Runs a scene in the arithmetic of `N`.
    ///
    /// # Errors
    /// The core's reason to refuse the scene.
    pub fn precise(scene: &Problem) -> Result<Self, String> {
        Self::run(scene, respond_precise::<N>)
    }

    fn run(
        scene: &Problem,
        by: impl FnOnce(
            &rocking::Scene<'_>,
            &Observe,
        ) -> Result<Response<N>, SceneError>,
    ) -> Result<Self, String> {
        let theta = scene.initial_theta_rad;
        let respond = || -> Result<Response<N>, Box<dyn std::error::Error>> {
            let block = Block::try_new(scene.alpha_rad, scene.p_rad_s)?;
            let eta = Restitution::constant(scene.eta)?;
            let (g, pulse) = (scene.g_m_s2, &mut None);
            let excitation = match &scene.excitation {
                SceneExcitation::Free => Excitation::Free,
                SceneExcitation::Pulse(kind) => {
                    let made = Pulse::try_new_si(*kind, g)?;
                    Excitation::Pulse(pulse.insert(made))
                }
                SceneExcitation::Samples { dt_s, samples_m_s2: a } => {
                    Excitation::Record(ScaledRecord::try_new_si(a, *dt_s, g)?)
                }
            };
            let core = rocking::Scene {
                model: scene.equation,
                overturning: scene.overturning,
                initial_ratio: theta.abs() / scene.alpha_rad,
                ..rocking::Scene::new(block, eta, excitation)
            };
            let observe = Observe {
                events: true,
                history_interval_s: Some(GRID_S),
                ..Observe::default()
            };
            Ok(by(&core, &observe)?)
        };
        let response =
            respond().map_err(|e| format!("{}: {e}", scene.name))?;
        Ok(Self { response, sign: if theta < 0.0 { -1.0 } else { 1.0 } })
    }

    /// The outcome, as the core names it.
    pub fn fate(&self) -> &'static str {
        self.response.outcome.name()
    }

    /// Number of impacts until a time, s.
    pub fn impacts(&self, until_s: f64) -> usize {
        let times = self.response.impacts.iter().map(|i| i.time_s.to_f64());
        times.filter(|t| *t <= until_s).count()
    }

    /// A quantity that is a number; `None` if the run has none.
    pub fn number(&self, scene: &Problem, quantity: &str) -> Option<N> {
        let found = &self.response;
        let falls = found.outcome.is_overturned();
        let numbered = |before: &str, after: &str| {
            let middle = quantity.strip_prefix(before)?.strip_suffix(after)?;
            middle.parse::<usize>().ok()?.checked_sub(1)
        };
        if let Some(k) = numbered("impact_", "_time_s") {
            return found.impacts.get(k).map(|i| i.time_s);
        }
        if let Some(k) = numbered("theta_", "_rad") {
            let time = scene.theta_times_s.get(k)?;
            let point = found.history.get((time / GRID_S).round() as usize)?;
            return Some(N::from_f64(self.sign) * point.rotation_rad);
        }
        match quantity {
            "uplift_time_s" => found.uplift_time_s,
            "impact_1_speed_rad_s" => {
                found.impacts.first().map(|i| i.speed_before_rad_s)
            }
            "peak_ratio" => (!falls).then_some(found.peak_ratio),
            "peak_time_s" => found.peak_time_s.filter(|_| !falls),
            "rest_time_s" => found.rest_time_s,
            "overturning_time_s" => match found.outcome {
                Outcome::Overturned { time_s, .. } => Some(time_s),
                _ => None,
            },
            _ => None,
        }
    }

    fn value(&self, scene: &Problem, quantity: &str) -> Option<Value> {
        let impacts = || self.impacts(scene.impacts_until_s) as u64;
        Some(match quantity {
            "fate" => Value::Fate(self.fate().into()),
            "impacts" => Value::Count(impacts()),
            _ => Value::Number(self.number(scene, quantity)?.to_f64()),
        })
    }
}

/// The answers of the core in double precision, with its defaults.
///
/// # Errors
/// The core's reason to refuse a scene.
pub fn own_answers() -> Result<Answers, String> {
    answers_of(OwnResponse::double)
}

/// The answers of a run of each scene.
///
/// # Errors
/// The errors of the runs.
pub fn answers_of<N: Real>(
    run: impl Fn(&Problem) -> Result<OwnResponse<N>, String>,
) -> Result<Answers, String> {
    let set = reference();
    let runs: Vec<OwnResponse<N>> =
        set.scenes.iter().map(run).collect::<Result<_, _>>()?;
    let mut answers = Answers::none();
    for (place, item) in set.items.iter().enumerate() {
        let (scene, run) = (set.scene(item), &runs[item.scene]);
        answers.set(place, run.value(scene, &item.quantity));
    }
    Ok(answers)
}
