//! Registry of the methods that compute cases.

#[macro_use]
mod method;

mod cells;
mod closed_forms;
mod convergence;
mod curves;
#[cfg(not(target_family = "wasm"))]
mod digits;
mod edges;
mod ends;
mod estimate;
mod fates;
mod floor;
mod forces;
mod hard;
mod intensity;
mod invariance;
mod precise;
#[cfg(not(target_family = "wasm"))]
pub mod published;
mod response;
#[cfg(not(target_family = "wasm"))]
mod scored;
mod solution;
mod squares;
mod statistics;
mod trials;
mod velocity_pulse;
mod wrong;

#[cfg(not(target_family = "wasm"))]
pub use digits::{DIGITS_HEADER, digits_csv};
pub use method::{Context, Method, Quantities, Reply};

use anyhow::{Context as _, Result};

use crate::cases::{Case, WrongModel};
use crate::engine::Core;
use crate::naive::{Naive, Rules};
use crate::scene::Engine;
use statistics::{calibration, earthquakes, fits, inference, lilliefors};
use statistics::{risk, shaking};

/// Methods that a page runs.
const METHODS: &[Method] = &[
    ("trajectory", response::trajectory),
    ("linear-pulse", response::linear_pulse),
    ("free-rocking", response::free_rocking),
    ("rectangular-pulse", response::rectangular_pulse),
    ("square-waves", squares::chained),
    ("fates-after-square-waves", squares::exclusions),
    ("overturning-edges", edges::spectrum),
    ("free-rocking-grid", closed_forms::free),
    ("linear-pulse-grid", closed_forms::pulses),
    ("critical-amplitudes", closed_forms::critical),
    ("fold", closed_forms::fold),
    ("half-sine-approximation", closed_forms::approximation),
    ("invariance", invariance::invariance),
    ("similarity-defect", invariance::defect),
    ("energy-in-flight", solution::energy),
    ("order-of-convergence", convergence::order),
    ("response", fates::response),
    ("edge-defect", edges::defect),
    ("bay-opens", edges::bay),
    ("grazing-uplift", edges::grazing),
    ("block-sizes", edges::sizes),
    ("restitution", edges::restitution),
    ("error-estimate", estimate::estimate),
    ("forces-at-uplift", forces::uplift),
    ("forces-in-free-motion", forces::free),
    ("forces-by-momentum", forces::momentum),
    ("work-counters", solution::work),
    ("near-saddle", hard::saddle),
    ("chatter", hard::chatter),
    ("double-against-double-double", hard::twin),
    ("points-of-trajectories", response::points),
    ("pulse-ends", response::pulse_ends),
    ("precise-trajectory", precise::trajectory),
    ("precise-linear-pulse", precise::linear_pulse),
    ("precise-free-rocking", precise::free_rocking),
    ("precise-rectangular-pulse", precise::rectangular_pulse),
    ("floor", floor::motion),
    ("intensity", intensity::measures),
    ("sample-moments", fits::moments),
    ("lilliefors-largest", lilliefors::largest),
    ("lilliefors-published", lilliefors::published),
    ("normal-draws", lilliefors::draws),
    ("fits", fits::fits),
    ("counts-of-stripes", fits::counts),
    ("quantiles", fits::quantiles),
    ("tests-of-normality", fits::tests),
    ("two-samples", fits::two_samples),
    ("paired-procedures", fits::paired),
    ("proportions", fits::intervals),
    ("proportions-of-clusters", fits::of_clusters),
    ("inversion", fits::inversion),
    ("equations-5-to-7", risk::transforms),
    ("annual-frequency", risk::annual_frequency),
    ("total-fragility", risk::total),
    ("cornell", risk::cornell),
];

/// Methods that a page leaves out, because they take longer than about a second
/// in a browser: trials of many scenes or samples, whole suites, the data set of
/// the score.
#[cfg(not(target_family = "wasm"))]
const LEFT_OUT: &[Method] = &[
    ("many-half-cycles", closed_forms::many),
    ("critical-durations", closed_forms::durations),
    ("sine-bias", invariance::sine_bias),
    ("orders-of-naive-schemes", convergence::orders),
    ("fates-over-levels", fates::levels),
    ("adjustment-on-suite", fates::adjustment),
    ("certificate-trials", trials::certificate),
    ("ends-of-observation", ends::ends),
    ("touches-of-the-threshold", ends::touches),
    ("curves-of-first-hops", curves::first_hops),
    ("certified-values", scored::certified),
    ("diagnosis", scored::diagnosis),
    ("velocity-pulse", velocity_pulse::pulses),
    ("published-laws", published::laws),
    ("lilliefors-null", lilliefors::null),
    ("lilliefors-mean", lilliefors::mean),
    ("lilliefors-table", lilliefors::table),
    ("lilliefors-asymptotics", lilliefors::asymptotics),
    ("interval-of-a-probability", risk::interval),
    ("rejected-share", calibration::rejection),
    ("coverage", calibration::coverage),
    ("coverage-of-inference", inference::coverage),
    ("rates-by-earthquake", earthquakes::rates),
    ("coverage-of-fits", earthquakes::coverage_of_fits),
    ("bias", calibration::bias),
    ("earthquakes-of-other-packages", earthquakes::other_packages),
    ("tests-of-other-packages", shaking::other_packages),
    ("coverage-of-tests", shaking::coverage),
];
#[cfg(target_family = "wasm")]
const LEFT_OUT: &[Method] = &[];

/// The methods that a page runs.
pub fn page_methods() -> impl Iterator<Item = &'static Method> {
    METHODS.iter()
}

/// Every registered method.
pub fn all_methods() -> impl Iterator<Item = &'static Method> {
    METHODS.iter().chain(LEFT_OUT)
}

/// Runs a case's method on the core or on a wrong model.
///
/// # Errors
/// An error if no answer can be given.
pub fn run_method(case: &Case, wrong: Option<WrongModel>) -> Result<Reply> {
    let mistaken = wrong.as_ref().map(|wrong| wrong as &dyn Engine);
    run_on(case, mistaken.unwrap_or(&Core), wrong)
}

/// Runs a case's method on the naive integrator with correct rules.
///
/// # Errors
/// An error if no answer can be given.
pub fn run_naive(case: &Case) -> Result<Reply> {
    run_on(case, &Naive(Rules::default()), None)
}

fn run_on(
    case: &Case,
    engine: &dyn Engine,
    wrong: Option<WrongModel>,
) -> Result<Reply> {
    let method = all_methods().find(|(name, _)| *name == case.method);
    let (_, method) = method.with_context(|| {
        format!("method `{}` is not registered", case.method)
    })?;
    let mut answer = Reply::default();
    method(&Context { case, engine, wrong }, &mut answer)?;
    Ok(answer)
}
