//! Reads case files; refuses what it does not know.

use std::collections::BTreeSet;

use serde::Deserialize;
use thiserror::Error;

use super::{
    Bound, Case, Cost, Expect, FAMILIES, Family, Source, Status, Tolerance,
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
        /// What the parser says, with line and column.
        message: String,
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
    case: Vec<Entry>,
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
    input: toml::Table,
    expect: Expect,
    tolerance: Tolerance,
    status: Status,
}

/// All embedded families, in the order of [`FAMILIES`].
///
/// # Errors
/// [`CaseError`] of the first file refused.
pub fn load_all() -> Result<Vec<Case>, CaseError> {
    let mut cases = Vec::new();
    for (family, text) in FAMILIES {
        cases.extend(load_family(family, text)?);
    }
    Ok(cases)
}

/// The cases of one file.
///
/// # Errors
/// [`CaseError`] for unknown keys, missing fields, duplicate or malformed
/// names, bounds that are negative or not numbers, and files without cases.
///
/// ```
/// use rocking_validation::proof::cases::load_family;
/// let text = "[family]\ntitle = \"t\"\nkind = \"regression\"\nx = 1\n";
/// let error = load_family("f", text).unwrap_err();
/// assert!(error.to_string().contains("unknown field `x`"));
/// ```
pub fn load_family(family: &str, text: &str) -> Result<Vec<Case>, CaseError> {
    if text.len() > LARGEST {
        let (family, bytes) = (family.to_owned(), text.len());
        return Err(CaseError::Long { family, bytes });
    }
    let file: File = toml::from_str(text).map_err(|e| CaseError::Form {
        family: family.to_owned(),
        message: e.to_string(),
    })?;
    if file.case.is_empty() {
        return Err(CaseError::Empty { family: family.to_owned() });
    }
    let mut names = BTreeSet::new();
    let mut cases = Vec::with_capacity(file.case.len());
    for entry in file.case {
        let known = |c: char| {
            c.is_ascii_lowercase() || c.is_ascii_digit() || "-.".contains(c)
        };
        if entry.name.is_empty() || !entry.name.chars().all(known) {
            let (family, name) = (family.to_owned(), entry.name);
            return Err(CaseError::Name { family, name });
        }
        if !names.insert(entry.name.clone()) {
            let (family, name) = (family.to_owned(), entry.name);
            return Err(CaseError::Duplicate { family, name });
        }
        cases.push(check(family, &file.family, entry)?);
    }
    Ok(cases)
}

fn check(
    family: &str,
    header: &Family,
    entry: Entry,
) -> Result<Case, CaseError> {
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
        kind: header.kind,
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

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"
[family]
title = "t"
kind = "code-verification"
[[case]]
name = "a"
claim = "c"
source = { cite = "s", where = "w" }
method = "m"
cost = "quick"
expect = { oracle = "closed-form", origin = "o" }
status = { expect = "pass" }
[case.tolerance]
basis = "identity"
because = "b"
bounds = { x = "exact", y = { relative = 1e-9 } }
"#;

    #[test]
    fn validates_a_good_file_and_refuses_each_flaw() {
        assert_eq!(load_family("f", GOOD).unwrap()[0].id, "f/a");
        let twice =
            format!("{GOOD}{}", &GOOD[GOOD.find("[[case]]").unwrap()..]);
        let duplicate = load_family("f", &twice).unwrap_err();
        assert!(matches!(duplicate, CaseError::Duplicate { .. }));
        let flaws = [
            ("cost = \"quick\"", "cost = \"slow\""),
            ("claim = \"c\"", "claim = \" \""),
            ("claim = \"c\"", "claim = \"c\"\nextra = 1"),
            ("relative = 1e-9", "relative = -1.0"),
            ("relative = 1e-9", "relative = nan"),
            ("relative = 1e-9", "relativ = 1e-9"),
            ("name = \"a\"", "name = \"A b\""),
            ("expect = \"pass\"", "expect = \"known-failure\""),
        ];
        for (from, to) in flaws {
            let text = GOOD.replace(from, to);
            assert!(load_family("f", &text).is_err(), "{to}");
        }
        let none = GOOD.split("[[case]]").next().unwrap();
        assert!(matches!(
            load_family("f", none).unwrap_err(),
            CaseError::Empty { .. }
        ));
    }
}
