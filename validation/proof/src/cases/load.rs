//! Reads case files and refuses unknown keys.

use std::collections::BTreeSet;

use anyhow::{Context as _, Result, anyhow, ensure};
use serde::Deserialize;
use toml::Table;

use super::case::{Bound, Case, Family};
use super::defaults::{Defaults, expand, text};
use super::pinned;

/// Each family with the text of its file, in the order of their names.
pub const FAMILIES: &[(&str, &str)] =
    include!(concat!(env!("OUT_DIR"), "/families.rs"));

/// Largest size of a case file in bytes: parsing takes a hundred times the
/// memory of the text.
const LARGEST: usize = 256 << 10;

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
/// A message about the first file refused.
pub fn load_all() -> Result<Vec<Case>> {
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
/// A message for unknown keys, missing fields, duplicate or malformed names,
/// bounds that are negative or not numbers, files without cases, values that
/// repeat the inherited one, and defaults that no case inherits.
///
/// ```
/// use rocking_proof::cases::load_family;
/// let text = "[family]\ntitle = \"t\"\nkind = \"regression\"\nx = 1\n";
/// let error = load_family("f", text).unwrap_err();
/// assert!(error.to_string().contains("unknown field `x`"));
/// ```
pub fn load_family(family: &str, text: &str) -> Result<Vec<Case>> {
    load(family, text).map_err(|e| anyhow!("cases/{family}.toml: {e:#}"))
}

fn load(family: &str, file: &str) -> Result<Vec<Case>> {
    let size = file.len();
    ensure!(size <= LARGEST, "{size} bytes: expected at most {LARGEST}");
    let file: CaseFile = toml::from_str(file)?;
    ensure!(!file.case.is_empty(), "no case");
    let kind = file.family.kind.name();
    let mut defaults = Defaults::new(file.family);
    let mut names = BTreeSet::new();
    let mut cases = Vec::with_capacity(file.case.len());
    for declared in file.case {
        for case in expand(declared)? {
            let mut case = defaults.complete(case)?;
            for (key, value) in [("family", family), ("kind", kind)] {
                let unknown = case.insert(key.into(), value.into());
                ensure!(unknown.is_none(), "unknown field `{key}`");
            }
            let place = format!("case `{}`", text(&case, "name"));
            let mut case: Case = case.try_into().context(place)?;
            let first = names.insert(case.id.clone());
            ensure!(first, "two cases are named `{}`", case.id);
            check(&case)?;
            case.id = format!("{family}/{}", case.id);
            cases.push(case);
        }
    }
    defaults.all_used()?;
    Ok(cases)
}

fn check(case: &Case) -> Result<()> {
    let name = &case.id;
    let known = |c: char| {
        c.is_ascii_lowercase() || c.is_ascii_digit() || "-.".contains(c)
    };
    let sound = !name.is_empty() && name.chars().all(known);
    ensure!(sound, "case name `{name}`");
    for (field, text) in [
        ("claim", &case.claim),
        ("source.cite", &case.source.cite),
        ("expect.origin", &case.expect.origin),
        ("tolerance.because", &case.tolerance.because),
    ] {
        let empty = text.trim().is_empty();
        ensure!(!empty, "case `{name}`: `{field}` is empty");
    }
    for (quantity, bound) in &case.tolerance.bounds {
        let sound = match bound {
            Bound::Exact => true,
            Bound::Absolute(x) | Bound::Relative(x) | Bound::Order(x) => {
                *x >= 0.0 && x.is_finite()
            }
            Bound::Interval(low, high) => low <= high,
            Bound::Waived(reason) => !reason.trim().is_empty(),
        };
        ensure!(sound, "case `{name}`: bound of `{quantity}` is {bound:?}");
    }
    Ok(())
}
