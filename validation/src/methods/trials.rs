//! The certificate on random scenes.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use serde::Deserialize;

use super::{Answer, Context, MethodError};
use crate::trials::{Finding, Reading, SHARES, Stratum, Summary, findings};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Input {
    /// Stratum: `ordinary`, `extreme` or `grazing`.
    kind: String,
    /// Number of scenes.
    scenes: u64,
    /// Index of the first.
    first: u64,
}

/// Findings by stratum, first index and number: wrong readings of the
/// certificate need no run of their own.
type Found = BTreeMap<(Stratum, u64, u64), Arc<Vec<Finding>>>;

static FOUND: Mutex<Found> = Mutex::new(BTreeMap::new());

/// Wrong fates and exceeded estimates of runs whose certificate is clear.
pub(super) fn certificate(context: &Context) -> Result<Answer, MethodError> {
    let input: Input = context.input()?;
    let stratum = Stratum::named(&input.kind).ok_or_else(|| {
        let names = Stratum::ALL.map(Stratum::name).join(", ");
        let found = &input.kind;
        MethodError::Input(format!("kind `{found}`: expected one of {names}"))
    })?;
    let found = all(stratum, input.first, input.scenes)?;
    let summary = Summary::of(&found, Reading::named(context.wrong));
    let mut answer = Answer::default();
    for (name, count) in [
        ("wrong-and-clear", summary.wrong_and_clear),
        ("estimates-exceeded", summary.exceeded),
    ] {
        answer.put(name, vec![count as f64], vec![0.0]);
    }
    let counts = [
        ("runs", summary.runs as f64),
        ("unresolved-share", summary.unresolved_share()),
        ("wrong-and-unresolved", summary.wrong_and_unresolved as f64),
        ("clear-and-undecided", summary.undecided as f64),
    ];
    let ratios = SHARES.map(|(name, share)| (name, summary.ratio(share)));
    for (name, value) in counts.into_iter().chain(ratios) {
        answer.observed.insert(name.to_owned(), vec![value]);
    }
    Ok(answer)
}

/// Findings, from memory where they were made before. Nothing is locked
/// while they are made: a thread that waits there may take up another case.
fn all(
    stratum: Stratum,
    first: u64,
    scenes: u64,
) -> Result<Arc<Vec<Finding>>, MethodError> {
    let lock = || FOUND.lock().unwrap_or_else(PoisonError::into_inner);
    let key = (stratum, first, scenes);
    if let Some(found) = lock().get(&key) {
        return Ok(Arc::clone(found));
    }
    let end = first.checked_add(scenes).ok_or_else(|| {
        MethodError::Input(format!("scenes {scenes} from {first}: too many"))
    })?;
    let found = Arc::new(findings(stratum, first..end)?);
    lock().insert(key, Arc::clone(&found));
    Ok(found)
}
