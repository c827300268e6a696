//! Bounds computed from the errors of a careful double-precision code on a
//! reference trajectory, `attainable_float64` in its file.

use anyhow::{Context as _, Result, anyhow, bail};
use serde::Deserialize;
use toml::Value;

use crate::references::trajectory;
use rocking_common::words::rounded;

/// The errors by the names that cases give them, and their keys in the
/// reference: times are multiplied by p, speeds and the peak are relative.
const ERRORS: [(&str, &str); 4] = [
    ("impact-times", "t_impact_max_abs_err_times_p"),
    ("impact-speeds", "v_impact_max_rel_err"),
    ("peak", "peak_rel_err"),
    ("alpha-time", "t_alpha_abs_err_times_p"),
];

/// A bound that follows from errors of the reference.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct AttainableRule {
    /// Factor on the largest of the errors.
    attainable: f64,
    /// Names of the errors.
    of: Vec<String>,
    /// Lower limit of the bound.
    least: f64,
}

/// The largest error of an entry among some of [`ERRORS`]. An error that the
/// reference lacks, because the motion lacks the quantity, counts as 0.
fn largest<'a>(
    entry: &Result<String, String>,
    of: impl IntoIterator<Item = &'a str>,
) -> Result<f64> {
    let entry = entry.as_ref().map_err(|missing| anyhow!("{missing}"))?;
    let errors = &trajectory(entry)?.attainable_float64;
    let mut largest = 0.0;
    for name in of {
        let known = ERRORS.iter().find(|(known, _)| *known == name);
        let (_, key) = known.with_context(|| format!("no error `{name}`"))?;
        let Some(error) = errors.get(*key) else { continue };
        let error = error.as_f64().unwrap_or(f64::NAN);
        largest = if error <= largest { largest } else { error };
    }
    Ok(largest)
}

/// Replaces a rule by its bound on the entry, to two digits, and the words
/// `{attainable}` in the reason of a tolerance by the largest error.
///
/// # Errors
/// A message that says what is missing or wrong.
pub(super) fn resolve(
    entry: &Result<String, String>,
    path: &[String],
    value: &mut Value,
) -> Result<()> {
    let path: Vec<&str> = path.iter().map(String::as_str).collect();
    match (&path[..], value) {
        (["tolerance", "because"], Value::String(text))
            if text.contains(PLACEHOLDER) =>
        {
            let error = largest(entry, ERRORS.map(|(name, _)| name))?;
            *text = text.replace(PLACEHOLDER, &format!("{error:.0e}"));
        }
        (["tolerance", "bounds", _], Value::Table(bound)) => {
            for kind in ["absolute", "relative"] {
                let Some(size @ Value::Table(_)) = bound.get_mut(kind) else {
                    continue;
                };
                let rule: AttainableRule = size.clone().try_into()?;
                let of = rule.of.iter().map(String::as_str);
                let due = rule.attainable * largest(entry, of)?;
                if !(rule.attainable > 0.0 && rule.least > 0.0) {
                    bail!("no positive numbers");
                }
                let due = if due <= rule.least { rule.least } else { due };
                *size = Value::Float(rounded(due, 2));
            }
        }
        _ => {}
    }
    Ok(())
}

/// Stands for the error in the reason of a tolerance.
const PLACEHOLDER: &str = "{attainable}";
