//! Declared cases, run again.

use std::error::Error;

use rocking_proof::cases::{Case, Cost, load_all};
use rocking_proof::verdict::checks_of;
use serde::Serialize;

use crate::bits::Bits;

/// A declared case, before it is run.
#[derive(Serialize)]
pub struct Listed {
    id: String,
    claim: String,
    method: String,
}

/// A case that was run.
#[derive(Serialize)]
pub struct Found {
    id: String,
    holds: bool,
    bits: String,
    checks: Vec<Check>,
}

#[derive(Serialize)]
struct Check {
    quantity: String,
    holds: bool,
    values: usize,
    bits: String,
    /// The first values, and what was expected of them.
    observed: Vec<String>,
    expected: Vec<String>,
    margin: String,
}

/// Values shown of a list.
const SHOWN: usize = 3;

/// Methods whose cases take longer than about a second in a browser: trials of
/// many scenes or samples, whole suites, the data set of the score.
const SLOW: [&str; 24] = [
    "adjustment-on-suite",
    "bias",
    "certificate-trials",
    "certified-values",
    "coverage",
    "coverage-of-inference",
    "critical-durations",
    "curves-of-first-hops",
    "diagnosis",
    "ends-of-observation",
    "fates-over-levels",
    "interval-of-a-probability",
    "lilliefors-asymptotics",
    "lilliefors-mean",
    "lilliefors-null",
    "lilliefors-table",
    "many-half-cycles",
    "orders-of-naive-schemes",
    "power-of-a-design",
    "rates-by-earthquake",
    "rejected-share",
    "sine-bias",
    "touches-of-the-threshold",
    "velocity-pulse",
];

/// Methods that ask `statrs` for quantiles of Student's and the beta
/// distribution: it takes the logarithm of the platform, so that their last
/// digits differ between platforms.
const OF_PLATFORM: [&str; 3] =
    ["earthquakes-of-other-packages", "paired-procedures", "proportions"];

/// The cases that a page runs: those of every `cargo test`, but for slow ones
/// and those whose bits depend on the platform.
pub fn list() -> Result<Vec<Listed>, Box<dyn Error>> {
    let quick = |case: &Case| {
        let left = |methods: &[&str]| methods.contains(&&*case.method);
        case.cost == Cost::Quick && !left(&SLOW) && !left(&OF_PLATFORM)
    };
    let quick = load_all()?.into_iter().filter(quick);
    let listed = |case: Case| Listed {
        id: case.id,
        claim: case.claim,
        method: case.method,
    };
    Ok(quick.map(listed).collect())
}

/// Runs one case, without its wrong models.
pub fn run(id: &str) -> Result<Found, Box<dyn Error>> {
    let cases = load_all()?;
    let case = cases.iter().find(|case| case.id == id);
    let case = case.ok_or_else(|| format!("no case {id}"))?;
    let mut bits = Bits::default();
    let mut checks = Vec::new();
    for check in checks_of(case)? {
        bits = bits.add(&check.quantity, &check.observed);
        let shown = |numbers: &[f64]| {
            numbers.iter().take(SHOWN).map(f64::to_string).collect()
        };
        checks.push(Check {
            holds: check.holds(),
            values: check.observed.len(),
            bits: Bits::default().add("", &check.observed).hex(),
            observed: shown(&check.observed),
            expected: shown(&check.expected),
            margin: check.margin.to_string(),
            quantity: check.quantity,
        });
    }
    let holds = checks.iter().all(|check| check.holds);
    Ok(Found { id: id.to_owned(), holds, bits: bits.hex(), checks })
}
