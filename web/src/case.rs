//! Declared cases, run again.

use std::error::Error;

use rocking_proof::cases::{Case, Cost, load_all};
use rocking_proof::methods::METHODS;
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

/// The cases that a page runs: those of every `cargo test` whose method does
/// not take long.
pub fn list() -> Result<Vec<Listed>, Box<dyn Error>> {
    let quick = |case: &Case| {
        let of_page = METHODS.iter().any(|(name, _)| *name == case.method);
        case.cost == Cost::Quick && of_page
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
