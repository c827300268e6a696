//! Reads case files; refuses what it does not know.

use std::collections::BTreeSet;

use serde::Deserialize;
use toml::{Table, Value};

use super::case::{
    Bound, Case, Cost, Expect, Family, Kind, Source, Status, Tolerance,
};
use super::defaults::{Defaults, expand};
use super::error::{CaseError, LARGEST};
use super::families::FAMILIES;
use super::pinned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    family: Family,
    #[serde(default)]
    case: Vec<Table>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: String,
    claim: String,
    source: Source,
    method: String,
    cost: Cost,
    #[serde(default)]
    input: Table,
    expect: Expect,
    tolerance: Tolerance,
    status: Status,
}

/// All embedded families, in the order of [`FAMILIES`], with the accepted
/// work counters as expected values.
///
/// # Errors
/// [`CaseError`] of the first file refused.
pub fn load_all() -> Result<Vec<Case>, CaseError> {
    let mut cases = Vec::new();
    for (family, text) in FAMILIES {
        cases.extend(load_family(family, text)?);
    }
    pinned::expect_counters(&mut cases, pinned::ACCEPTED);
    Ok(cases)
}

/// The cases of one file.
///
/// # Errors
/// [`CaseError`] for unknown keys, missing fields, duplicate or malformed
/// names, bounds that are negative or not numbers, files without cases,
/// values that repeat what they would inherit, and defaults that no case
/// inherits.
///
/// ```
/// use rocking_proof::cases::load_family;
/// let text = "[family]\ntitle = \"t\"\nkind = \"regression\"\nx = 1\n";
/// let error = load_family("f", text).unwrap_err();
/// assert!(error.to_string().contains("unknown field `x`"));
/// ```
pub fn load_family(family: &str, text: &str) -> Result<Vec<Case>, CaseError> {
    if text.len() > LARGEST {
        let (family, bytes) = (family.to_owned(), text.len());
        return Err(CaseError::Long { family, bytes });
    }
    let form = |message: String| CaseError::Form {
        family: family.to_owned(),
        message,
    };
    let file: File =
        toml::from_str(text).map_err(|error| form(error.to_string()))?;
    if file.case.is_empty() {
        return Err(CaseError::Empty { family: family.to_owned() });
    }
    let kind = file.family.kind;
    let mut defaults = Defaults::new(family, file.family);
    let mut names = BTreeSet::new();
    let mut cases = Vec::with_capacity(file.case.len());
    for declared in file.case {
        for case in expand(declared).map_err(form)? {
            let case = defaults.complete(case)?;
            let entry = read(case).map_err(form)?;
            if !names.insert(entry.name.clone()) {
                let (family, name) = (family.to_owned(), entry.name);
                return Err(CaseError::Duplicate { family, name });
            }
            cases.push(check(family, kind, entry)?);
        }
    }
    defaults.all_used()?;
    Ok(cases)
}

/// A case that has all it inherits.
fn read(case: Table) -> Result<Entry, String> {
    let name = case.get("name").and_then(Value::as_str);
    let place = format!("case `{}`", name.unwrap_or_default());
    Value::Table(case)
        .try_into()
        .map_err(|error: toml::de::Error| format!("{place}: {error}"))
}

fn check(family: &str, kind: Kind, entry: Entry) -> Result<Case, CaseError> {
    let known = |c: char| {
        c.is_ascii_lowercase() || c.is_ascii_digit() || "-.".contains(c)
    };
    if entry.name.is_empty() || !entry.name.chars().all(known) {
        let (family, name) = (family.to_owned(), entry.name);
        return Err(CaseError::Name { family, name });
    }
    let id = format!("{family}/{}", entry.name);
    let texts = [
        ("claim", &entry.claim),
        ("source.cite", &entry.source.cite),
        ("expect.origin", &entry.expect.origin),
        ("tolerance.because", &entry.tolerance.because),
    ];
    for (field, text) in texts {
        if text.trim().is_empty() {
            return Err(CaseError::Silent { id, field });
        }
    }
    for (quantity, bound) in &entry.tolerance.bounds {
        let sound = match bound {
            Bound::Exact => true,
            Bound::Absolute(x) | Bound::Relative(x) | Bound::Order(x) => {
                *x >= 0.0 && x.is_finite()
            }
            Bound::Interval(low, high) => low <= high,
            Bound::Coverage(trials) => *trials > 0,
            Bound::Waived(reason) => !reason.trim().is_empty(),
        };
        if !sound {
            let (quantity, bound) = (quantity.clone(), bound.clone());
            return Err(CaseError::BadBound { id, quantity, bound });
        }
    }
    Ok(Case {
        id,
        family: family.to_owned(),
        kind,
        claim: entry.claim,
        source: entry.source,
        method: entry.method,
        cost: entry.cost,
        input: entry.input,
        expect: entry.expect,
        tolerance: entry.tolerance,
        status: entry.status,
    })
}
