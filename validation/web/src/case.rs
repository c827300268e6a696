//! Reference cases, run in the page.

use std::error::Error;
use std::sync::OnceLock;

use rocking_proof::cases::{Case, Cost, load_all};
use rocking_proof::methods::page_methods;
use rocking_proof::verdict::checks_of;
use serde::Serialize;

use crate::bits::Bits;

/// A reference case, before it is run.
#[derive(Serialize)]
pub struct CaseSummary {
    id: String,
    claim: String,
}

/// A case that was run.
#[derive(Serialize)]
pub struct CaseRun {
    holds: bool,
    bits: String,
    /// Name and first value of the first quantity.
    quantity: String,
    first: String,
}

/// The declared cases, read once.
fn cases() -> Result<&'static [Case], Box<dyn Error>> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    if let Some(cases) = CASES.get() {
        return Ok(cases);
    }
    let cases = load_all()?;
    Ok(CASES.get_or_init(|| cases))
}

/// The cases that a page runs: quick cases of methods that take little time.
pub fn list() -> Result<Vec<CaseSummary>, Box<dyn Error>> {
    let quick = |case: &Case| {
        let of_page = page_methods().any(|(name, _)| *name == case.method);
        case.cost == Cost::Quick && of_page
    };
    let quick = cases()?.iter().filter(|case| quick(case));
    let listed = |case: &Case| CaseSummary {
        id: case.id.clone(),
        claim: case.claim.clone(),
    };
    Ok(quick.map(listed).collect())
}

/// Runs one case, without its wrong models.
pub fn run(id: &str) -> Result<CaseRun, Box<dyn Error>> {
    let case = cases()?.iter().find(|case| case.id == id);
    let case = case.ok_or_else(|| format!("no case {id}"))?;
    let checks = checks_of(case)?;
    let bits = checks.iter().fold(Bits::default(), |bits, check| {
        bits.add(&check.quantity, &check.observed)
    });
    let holds = checks.iter().all(|check| check.holds());
    let first = checks.into_iter().next();
    let first = first.ok_or_else(|| format!("{id} gives nothing"))?;
    Ok(CaseRun {
        holds,
        bits: bits.hex(),
        first: first
            .observed
            .first()
            .map_or_else(|| "none".to_owned(), f64::to_string),
        quantity: first.quantity,
    })
}
