//! Registry of what a case can ask to be computed, and how wrong models go
//! wrong.

mod closed_forms;
mod convergence;
mod curves;
mod digits;
mod edges;
mod ends;
mod estimate;
mod fates;
mod forces;
mod hard;
mod intensity;
mod invariance;
mod points;
mod precise;
mod references;
mod response;
mod schemes;
mod sines;
mod solution;
mod spectrum;
mod squares;
mod statistics;
mod trials;
mod velocity_pulse;
mod wrong;

pub use digits::{DIGITS_HEADER, DigitsError, Reach, Row, digits, digits_csv};
pub(crate) use references::attainable_float64;

use std::collections::BTreeMap;

use rocking::integrator::{HistoryPoint, Observe};
use rocking::names::UnknownName;
use serde::de::DeserializeOwned;
use thiserror::Error;

use crate::cases::{Case, WrongModel};
use crate::engine::{self, Core};
use crate::naive::{Naive, Rules};
use crate::scene::{Engine, EngineError, Scene};

/// Numbers by name.
pub type Quantities = BTreeMap<String, Vec<f64>>;

/// What a method observed, and what it expected where the case names a
/// reference or an oracle instead of writing the values.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Answer {
    /// From the code under test.
    pub observed: Quantities,
    /// From outside it.
    pub expected: Quantities,
}

impl Answer {
    /// Adds to the lists of a quantity: what was observed, and what is
    /// expected of it.
    pub fn put(
        &mut self,
        name: &str,
        observed: impl IntoIterator<Item = f64>,
        expected: impl IntoIterator<Item = f64>,
    ) {
        self.see(name, observed);
        self.expected.entry(name.to_owned()).or_default().extend(expected);
    }

    /// Adds to what was observed of a quantity whose values the case writes.
    pub fn see(
        &mut self,
        name: &str,
        observed: impl IntoIterator<Item = f64>,
    ) {
        self.observed.entry(name.to_owned()).or_default().extend(observed);
    }
}

/// Why a method gave no answer.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MethodError {
    /// No method of this name is registered.
    #[error("method `{0}` is not registered")]
    Unknown(String),
    /// The input is not what the method reads.
    #[error("input: {0}")]
    Input(String),
    /// A name in the input that is none.
    #[error("input: {0}")]
    Name(#[from] UnknownName),
    /// A reference lacks what was asked for.
    #[error("{file}: {what}")]
    Reference {
        /// The file.
        file: &'static str,
        /// What is missing.
        what: String,
    },
    /// The engine gave no trace.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// An oracle has no value for this input.
    #[error("oracle: {0}")]
    Oracle(String),
}

/// What a method works with.
pub struct Context<'a> {
    /// The case.
    pub case: &'a Case,
    /// What answers scenes: the core, or a wrong model.
    pub engine: &'a dyn Engine,
    /// The wrong model; the engine makes the mistake, or the method.
    pub wrong: Option<WrongModel>,
}

impl Context<'_> {
    /// The case's input.
    ///
    /// # Errors
    /// [`MethodError::Input`] for missing, unknown or malformed keys.
    pub fn input<T: DeserializeOwned>(&self) -> Result<T, MethodError> {
        input_of(self.case)
    }

    /// The scene as the wrong model sees it, where that changes the input;
    /// for methods that run the core themselves.
    #[must_use]
    pub fn altered(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        if let Some(wrong) = self.wrong {
            wrong.alter(&mut scene);
        }
        scene
    }

    /// The state of a scene at an instant, by a history of that interval.
    fn state(
        &self,
        scene: &Scene,
        time_s: f64,
    ) -> Result<HistoryPoint, MethodError> {
        let observe = Observe {
            history_interval_s: Some(time_s),
            until_s: Some(1.5 * time_s),
            ..Observe::default()
        };
        let response = engine::respond(&self.altered(scene), &observe)?;
        // A run that has ended before says so by what cannot be compared.
        let missing = HistoryPoint {
            time_s,
            rotation_rad: f64::NAN,
            velocity_rad_s: f64::NAN,
        };
        Ok(response.history.get(1).copied().unwrap_or(missing))
    }
}

fn input_of<T: DeserializeOwned>(case: &Case) -> Result<T, MethodError> {
    let table = toml::Value::Table(case.input.clone());
    table.try_into().map_err(|e| MethodError::Input(e.to_string()))
}

type Run = fn(&Context) -> Result<Answer, MethodError>;

/// Registered methods by name.
pub const METHODS: &[(&str, Run)] = &[
    ("trajectory", response::trajectory),
    ("linear-pulse", response::linear_pulse),
    ("free-rocking", response::free_rocking),
    ("rectangular-pulse", response::rectangular_pulse),
    ("square-waves", squares::chained),
    ("fates-after-square-waves", squares::exclusions),
    ("overturning-edges", spectrum::edges),
    ("free-rocking-grid", closed_forms::free),
    ("linear-pulse-grid", closed_forms::pulses),
    ("critical-amplitudes", closed_forms::critical),
    ("fold", closed_forms::fold),
    ("half-sine-approximation", sines::approximation),
    ("many-half-cycles", sines::many),
    ("critical-durations", closed_forms::durations),
    ("invariance", invariance::invariance),
    ("similarity-defect", invariance::defect),
    ("sine-bias", invariance::sine_bias),
    ("energy-in-flight", solution::energy),
    ("order-of-convergence", convergence::order),
    ("orders-of-naive-schemes", schemes::orders),
    ("response", fates::response),
    ("fates-over-levels", fates::levels),
    ("adjustment-on-suite", fates::adjustment),
    ("edge-defect", edges::defect),
    ("bay-opens", edges::bay),
    ("grazing-uplift", edges::grazing),
    ("block-sizes", edges::sizes),
    ("restitution", edges::restitution),
    ("error-estimate", estimate::estimate),
    ("certificate-trials", trials::certificate),
    ("ends-of-observation", ends::ends),
    ("touches-of-the-threshold", ends::touches),
    ("curves-of-first-hops", curves::first_hops),
    ("forces-at-uplift", forces::uplift),
    ("forces-in-free-motion", forces::free),
    ("forces-by-momentum", forces::momentum),
    ("work-counters", solution::work),
    ("near-saddle", hard::saddle),
    ("chatter", hard::chatter),
    ("double-against-double-double", hard::twin),
    ("points-of-trajectories", points::trajectories),
    ("pulse-ends", points::pulse_ends),
    ("precise-trajectory", precise::trajectory),
    ("precise-linear-pulse", precise::linear_pulse),
    ("precise-free-rocking", precise::free_rocking),
    ("precise-rectangular-pulse", precise::rectangular_pulse),
    ("sample-moments", statistics::moments),
    ("lilliefors-null", statistics::null),
    ("lilliefors-largest", statistics::largest),
    ("lilliefors-table", statistics::table),
    ("lilliefors-published", statistics::published),
    ("lilliefors-asymptotics", statistics::asymptotics),
    ("normal-draws", statistics::draws),
    ("choice", statistics::choice),
    ("fits", statistics::fits),
    ("quantiles", statistics::quantiles),
    ("tests-of-normality", statistics::tests),
    ("paired-procedures", statistics::paired),
    ("two-samples", statistics::two_samples),
    ("proportions", statistics::proportions),
    ("inversion", statistics::inversion),
    ("equations-5-to-7", statistics::transforms),
    ("annual-frequency", statistics::annual_frequency),
    ("cornell", statistics::cornell),
    ("interval-of-a-probability", statistics::interval),
    ("rejected-share", statistics::rejection),
    ("coverage", statistics::coverage),
    ("coverage-of-inference", statistics::inference),
    ("bias", statistics::bias),
    ("intensity", intensity::measures),
    ("velocity-pulse", velocity_pulse::pulses),
];

/// Runs a case's method, on the core or on a wrong model.
///
/// # Errors
/// [`MethodError`] when no answer can be given.
pub fn run(
    case: &Case,
    wrong: Option<WrongModel>,
) -> Result<Answer, MethodError> {
    let changed = wrong.map(|wrong| wrong.engine(&Core));
    run_on(case, changed.as_deref().unwrap_or(&Core), wrong)
}

/// Runs a case's method on the naive integrator with its rules right.
///
/// # Errors
/// [`MethodError`] when no answer can be given.
pub fn run_naive(case: &Case) -> Result<Answer, MethodError> {
    run_on(case, &Naive(Rules::default()), None)
}

fn run_on(
    case: &Case,
    engine: &dyn Engine,
    wrong: Option<WrongModel>,
) -> Result<Answer, MethodError> {
    let (_, method) = METHODS
        .iter()
        .find(|(name, _)| *name == case.method)
        .ok_or_else(|| MethodError::Unknown(case.method.clone()))?;
    method(&Context { case, engine, wrong })
}
