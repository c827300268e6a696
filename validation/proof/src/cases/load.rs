//! Reads case files; refuses what it does not know.

use std::collections::BTreeSet;

use serde::Deserialize;
use thiserror::Error;
use toml::{Table, Value};

use super::defaults::{Defaults, expand};
use super::{
    Bound, Case, Cost, Expect, FAMILIES, Family, Kind, Source, Status,
    Tolerance, pinned,
};

/// Bytes of a case file, at most.
const LARGEST: usize = 256 << 10;

/// Why a file of cases was refused.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CaseError {
    /// The file is not of the expected form.
    #[error("cases/{family}.toml: {message}")]
    Form {
        /// The family.
        family: String,
        /// What is wrong, with its line or its case.
        message: String,
    },
    /// A value equals the one that its case would inherit.
    #[error(
        "cases/{family}.toml: {place}: `{key}` repeats the inherited value: \
         leave it out"
    )]
    Repeated {
        /// The family.
        family: String,
        /// The case, or the table of defaults.
        place: String,
        /// The key.
        key: String,
    },
    /// No case inherits a default.
    #[error("cases/{family}.toml: {place}: no case inherits `{key}`")]
    Idle {
        /// The family.
        family: String,
        /// The table of defaults.
        place: String,
        /// The key.
        key: String,
    },
    /// A case does without a bound that it does not inherit.
    #[error(
        "cases/{family}.toml: {place}: `tolerance.without` names `{name}`, \
         of which no bound is inherited"
    )]
    Absent {
        /// The family.
        family: String,
        /// The case, or the table of defaults.
        place: String,
        /// The quantity.
        name: String,
    },
    /// No hand writes so many cases, and parsing takes a hundred times the
    /// text's memory.
    #[error("cases/{family}.toml: {bytes} bytes: expected at most {LARGEST}")]
    Long {
        /// The family.
        family: String,
        /// Length of the text.
        bytes: usize,
    },
    /// Two cases have one name.
    #[error("cases/{family}.toml: two cases are named `{name}`")]
    Duplicate {
        /// The family.
        family: String,
        /// The name.
        name: String,
    },
    /// A file without cases proves nothing.
    #[error("cases/{family}.toml: no case")]
    Empty {
        /// The family.
        family: String,
    },
    /// A name is not of lower-case letters, digits, points and hyphens.
    #[error("cases/{family}.toml: case name `{name}`")]
    Name {
        /// The family.
        family: String,
        /// The name.
        name: String,
    },
    /// A bound is negative or not a number.
    #[error("{id}: bound of `{quantity}` is {bound:?}")]
    BadBound {
        /// The case.
        id: String,
        /// The quantity.
        quantity: String,
        /// What was found.
        bound: Bound,
    },
    /// A text that must say something is empty.
    #[error("{id}: `{field}` says nothing")]
    Silent {
        /// The case.
        id: String,
        /// The field.
        field: &'static str,
    },
}

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
