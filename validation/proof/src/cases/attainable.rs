//! Bounds computed from what a careful double-precision code reached on a
//! reference trajectory, `attainable_float64` in its file.

use serde::Deserialize;
use toml::{Table, Value};

use crate::references::trajectory;
use rocking_common::words::rounded;

/// A quantity whose error the reference lists.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum ErrorQuantity {
    /// Times of impacts, times p.
    ImpactTimes,
    /// Speeds before impacts, relative.
    ImpactSpeeds,
    /// Peak rotation, relative.
    Peak,
    /// Time at which |theta| reaches alpha, times p.
    AlphaTime,
}

impl ErrorQuantity {
    const ALL: [Self; 4] =
        [Self::ImpactTimes, Self::ImpactSpeeds, Self::Peak, Self::AlphaTime];

    /// Name of its error in the reference.
    fn key(self) -> &'static str {
        match self {
            Self::ImpactTimes => "t_impact_max_abs_err_times_p",
            Self::ImpactSpeeds => "v_impact_max_rel_err",
            Self::Peak => "peak_rel_err",
            Self::AlphaTime => "t_alpha_abs_err_times_p",
        }
    }
}

/// A bound that follows from errors of the reference.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct AttainableRule {
    /// So many times the largest error of
    attainable: f64,
    /// these quantities,
    of: Vec<ErrorQuantity>,
    /// and never less than this.
    least: f64,
}

/// The entry of a reference trajectory that a case has as its input.
///
/// # Errors
/// What is missing, in words.
pub(super) fn entry_of(case: &Table) -> Result<String, String> {
    let entry = case.get("input").and_then(|input| input.get("entry"));
    let entry = entry.and_then(Value::as_str).map(str::to_owned);
    let name = case.get("name").and_then(Value::as_str);
    entry.ok_or_else(|| {
        let name = name.unwrap_or_default();
        format!("the input of `{name}` names no `entry` of a reference")
    })
}

/// The largest error of some quantities of an entry. One that the reference
/// does not list, because the motion lacks the quantity, counts as 0.
fn largest(
    entry: &Result<String, String>,
    of: &[ErrorQuantity],
) -> Result<f64, String> {
    let case = trajectory(entry.as_ref().map_err(String::clone)?);
    let errors = &case.map_err(|e| e.to_string())?.attainable_float64;
    let found = of.iter().filter_map(|q| errors.get(q.key()));
    Ok(found.fold(0.0, |largest, error| {
        let error = error.as_f64().unwrap_or(f64::NAN);
        if error <= largest { largest } else { error }
    }))
}

/// Replaces a rule by its bound on the entry, to two digits, and the words
/// `{attainable}` in the reason of a tolerance by the largest error.
///
/// # Errors
/// What is wrong, in words.
pub(super) fn resolve(
    entry: &Result<String, String>,
    path: &[String],
    value: &mut Value,
) -> Result<(), String> {
    let path: Vec<&str> = path.iter().map(String::as_str).collect();
    match (&path[..], value) {
        (["tolerance", "because"], Value::String(text))
            if text.contains(WORDS) =>
        {
            let error = largest(entry, &ErrorQuantity::ALL)?;
            *text = text.replace(WORDS, &format!("{error:.0e}"));
        }
        (["tolerance", "bounds", _], Value::Table(bound)) => {
            for kind in ["absolute", "relative"] {
                let Some(size @ Value::Table(_)) = bound.get_mut(kind) else {
                    continue;
                };
                let rule: AttainableRule = size
                    .clone()
                    .try_into()
                    .map_err(|error| error.message().to_owned())?;
                let due = rule.attainable * largest(entry, &rule.of)?;
                if !(rule.attainable > 0.0 && rule.least > 0.0) {
                    return Err("no positive numbers".to_owned());
                }
                let due = if due <= rule.least { rule.least } else { due };
                *size = Value::Float(rounded(due, 2));
            }
        }
        _ => {}
    }
    Ok(())
}

/// Stand for the error in the reason of a tolerance.
const WORDS: &str = "{attainable}";
