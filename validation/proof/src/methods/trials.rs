//! The certificate on random scenes.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use serde::Deserialize;

use super::method::{Answer, Context, MethodError};
use crate::trials::{Finding, Reading, SHARES, Stratum, Summary, findings};

/// Scenes of a stratum.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Scenes {
    /// Number of scenes.
    count: u64,
    /// Index of the first.
    first: u64,
}

impl Scenes {
    fn indices(&self) -> Result<Vec<u64>, MethodError> {
        let Self { count, first } = *self;
        let end = first.checked_add(count).ok_or_else(|| {
            let what = format!("count {count} from {first}");
            MethodError::Input(format!("{what}: too many"))
        })?;
        Ok((first..end).collect())
    }
}

/// Findings by stratum and indices: wrong readings of the certificate need no
/// run of their own.
type Found = BTreeMap<(Stratum, Vec<u64>), Arc<Vec<Finding>>>;

static FOUND: Mutex<Found> = Mutex::new(BTreeMap::new());

/// Wrong fates and exceeded estimates of runs whose certificate is clear.
pub(super) fn certificate(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        /// Stratum: `ordinary`, `extreme` or `grazing`.
        kind: String,
        /// Which scenes.
        scenes: Scenes,
    }
    let stratum = Stratum::named(&kind).ok_or_else(|| {
        let names = Stratum::ALL.map(Stratum::name).join(", ");
        let found = &kind;
        MethodError::Input(format!("kind `{found}`: expected one of {names}"))
    })?;
    let found = all(stratum, scenes.indices()?)?;
    let summary = Summary::of(&found, Reading::of(context.wrong));
    let mut answer = Answer::default();
    for (name, count) in [
        ("wrong-and-clear", summary.wrong_and_clear),
        ("estimates-exceeded", summary.exceeded),
    ] {
        answer.put(name, [count as f64], [0.0]);
    }
    let counts = [
        ("runs", summary.runs as f64),
        ("unresolved-share", summary.unresolved_share()),
        ("wrong-and-unresolved", summary.wrong_and_unresolved as f64),
        ("clear-and-undecided", summary.undecided as f64),
    ];
    let ratios = SHARES.map(|(name, share)| (name, summary.ratio(share)));
    for (name, value) in counts.into_iter().chain(ratios) {
        answer.see(name, [value]);
    }
    Ok(answer)
}

/// Findings, from memory where they were made before. Nothing is locked
/// while they are made: a thread that waits there may take up another case.
fn all(
    stratum: Stratum,
    indices: Vec<u64>,
) -> Result<Arc<Vec<Finding>>, MethodError> {
    let lock = || FOUND.lock().unwrap_or_else(PoisonError::into_inner);
    let key = (stratum, indices);
    if let Some(found) = lock().get(&key) {
        return Ok(Arc::clone(found));
    }
    let found = Arc::new(findings(stratum, &key.1)?);
    lock().insert(key, Arc::clone(&found));
    Ok(found)
}
