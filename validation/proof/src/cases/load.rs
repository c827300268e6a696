//! Reads case files; refuses what it does not know.

use std::collections::BTreeSet;

use serde::Deserialize;
use toml::{Table, Value};

use super::case::{Bound, Case, Family};
use super::defaults::{Defaults, expand};
use super::error::{CaseError, CaseFault, LARGEST};
use super::pinned;

/// Each family with the text of its file, in the order of their names.
pub const FAMILIES: &[(&str, &str)] =
    include!(concat!(env!("OUT_DIR"), "/families.rs"));

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CaseFile {
    family: Family,
    #[serde(default)]
    case: Vec<Table>,
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
    let refused = |fault| CaseError { family: family.to_owned(), fault };
    load(family, text).map_err(refused)
}

fn load(family: &str, text: &str) -> Result<Vec<Case>, CaseFault> {
    if text.len() > LARGEST {
        return Err(CaseFault::Long(text.len()));
    }
    let file: CaseFile = toml::from_str(text)
        .map_err(|error| CaseFault::Form(error.to_string()))?;
    if file.case.is_empty() {
        return Err(CaseFault::Empty);
    }
    let kind = file.family.kind.name();
    let mut defaults = Defaults::new(file.family);
    let mut names = BTreeSet::new();
    let mut cases = Vec::with_capacity(file.case.len());
    for declared in file.case {
        for case in expand(declared).map_err(CaseFault::Form)? {
            let mut case = defaults.complete(case)?;
            for (key, value) in [("family", family), ("kind", kind)] {
                if case.insert(key.into(), value.into()).is_some() {
                    let message = format!("unknown field `{key}`");
                    return Err(CaseFault::Form(message));
                }
            }
            let mut case = typed_case(case).map_err(CaseFault::Form)?;
            if !names.insert(case.id.clone()) {
                return Err(CaseFault::Duplicate(case.id));
            }
            check(&case)?;
            case.id = format!("{family}/{}", case.id);
            cases.push(case);
        }
    }
    defaults.all_used()?;
    Ok(cases)
}

/// A case that has all it inherits; its id is still its name.
fn typed_case(case: Table) -> Result<Case, String> {
    let name = case.get("name").and_then(Value::as_str);
    let place = format!("case `{}`", name.unwrap_or_default());
    Value::Table(case)
        .try_into()
        .map_err(|error: toml::de::Error| format!("{place}: {error}"))
}

fn check(case: &Case) -> Result<(), CaseFault> {
    let name = || case.id.clone();
    let known = |c: char| {
        c.is_ascii_lowercase() || c.is_ascii_digit() || "-.".contains(c)
    };
    if case.id.is_empty() || !case.id.chars().all(known) {
        return Err(CaseFault::Name(name()));
    }
    let texts = [
        ("claim", &case.claim),
        ("source.cite", &case.source.cite),
        ("expect.origin", &case.expect.origin),
        ("tolerance.because", &case.tolerance.because),
    ];
    let is_empty = |(_, text): &(_, &String)| text.trim().is_empty();
    if let Some((field, _)) = texts.into_iter().find(is_empty) {
        return Err(CaseFault::Silent { name: name(), field });
    }
    for (quantity, bound) in &case.tolerance.bounds {
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
            return Err(CaseFault::BadBound { name: name(), quantity, bound });
        }
    }
    Ok(())
}
