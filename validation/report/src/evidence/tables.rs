//! Pulses against closed forms, as a table.

use serde::Deserialize;

use super::proof::Proof;
use rocking_common::table::{PlainTable, digits};
use rocking_proof::cases::Case;
use rocking_proof::verdict::snapshot::CaseResult;

/// The pulses of the closed forms, in the order in which the cases name them.
const PULSES: &str = rocking_fixtures::text("references/linear_pulses.json");
/// Method of the cases that run them.
const PULSE_METHOD: &str = "linear-pulse";

#[derive(Deserialize)]
struct PulseFile {
    cases: Vec<PulseEntry>,
}

#[derive(Deserialize)]
struct PulseEntry {
    pulse: String,
    /// Amplitude of the acceleration (of one pulse, of the velocity): a number,
    /// and words in brackets.
    #[serde(rename = "A", alias = "A_v")]
    amplitude: String,
    #[serde(rename = "Omega", alias = "f_p")]
    frequency: Option<String>,
    eta: String,
}

/// Errors against the closed forms in the given results, pulse by pulse.
pub fn similarity(proof: &Proof) -> PlainTable {
    let pulses: Vec<PulseEntry> = serde_json::from_str::<PulseFile>(PULSES)
        .map_or_else(|_| Vec::new(), |found| found.cases);
    let row = |(case, result): (&Case, &CaseResult)| {
        let entry = case.input.get("entry")?.as_integer()?;
        let pulse = pulses.get(usize::try_from(entry).ok()?)?;
        let quantities = &result.quantities;
        let error = |name: &str| {
            let Some(of) = quantities.get(name) else {
                return "–".to_owned();
            };
            let bound = of.bound.as_f64().unwrap_or(f64::NAN);
            match (of.values, of.margin.0 * bound) {
                (0, _) => "–".to_owned(),
                (_, 0.0) => "none".to_owned(),
                (_, error) => digits(error, 1),
            }
        };
        let impacts = quantities.get("impact-times-p").map(|of| of.values);
        Some(vec![
            pulse.pulse.replace('_', "-"),
            pulse.frequency.as_deref().map_or("–", bare).to_owned(),
            bare(&pulse.amplitude).to_owned(),
            pulse.eta.clone(),
            impacts.unwrap_or(0).to_string(),
            error("peak-ratio"),
            error("impact-times-p"),
            error("impact-speeds"),
        ])
    };
    let own = proof.cases().filter(|(case, _)| case.method == PULSE_METHOD);
    let header = [
        "pulse",
        "frequency / p",
        "amplitude / (g alpha)",
        "eta",
        "impacts compared",
        "peak, relative error",
        "impact times p t, error",
        "impact speeds, relative error",
    ];
    PlainTable::new(
        "sine-pulse-similarity",
        "Pulses in Eq. 2 against closed forms",
        "Each row runs six blocks (alpha 0.001 to 0.4 rad, p 0.5 to 8 rad/s) \
         that share one closed form. The error is the largest of the six. A \
         dash: the motion has no such number, or the case does not compare \
         it.",
        &header,
        own.filter_map(row).collect(),
    )
}

/// A number without the words in brackets behind it.
fn bare(number: &str) -> &str {
    number.split(" (").next().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pulse_has_a_row_with_its_errors() {
        let table = similarity(&Proof::committed(0));
        assert!(table.rows.len() > 10);
        assert!(
            table.rows.iter().any(|r| r[0] == "one-sine" && r[1] == "3.0")
        );
        assert!(table.rows.iter().flatten().all(|c| c != "NaN"));
    }
}
