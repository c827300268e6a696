//! The questions that a reader asks first, answered in a sentence or two
//! made from the numbers.

use serde_json::Value;

use super::StudyError;
use super::figures::Results;
use super::findings::Claim;
use super::speed::Timings;
use crate::evidence::committed_results;
use crate::figures::data::{Arm, Intensity};

/// Slenderness, distribution, accuracy, speed, and what was not checked.
///
/// # Errors
/// [`StudyError`] where the committed results cannot be read.
pub(super) fn answers(
    results: &Results,
    claims: &[Claim],
    timings: &Timings,
) -> Result<Vec<String>, StudyError> {
    Ok(vec![
        slenderness(results, claims),
        distribution(results),
        accuracy(&committed_results()?, timings),
        timings.plain(),
        not_checked(results),
    ])
}

/// The value of a claim, on the arm if it has arms; NaN where it was not
/// measured.
fn value(claims: &[Claim], id: &str, arm: Option<Arm>) -> f64 {
    let is = |c: &&Claim| c.id == id && (arm.is_none() || c.arm == arm);
    claims.iter().find(is).map_or(f64::NAN, |c| c.measured.value)
}

fn percent(share: f64) -> String {
    if share.is_nan() {
        "(not measured)".into()
    } else {
        format!("{:.1} %", 100.0 * share)
    }
}

fn slenderness(results: &Results, claims: &[Claim]) -> String {
    let pulse = value(claims, "one-curve-pulse", None);
    let ordinary = pulse + value(claims, "curves-ordinary-worse", None);
    let by_arm = |id: &str, text: &dyn Fn(f64) -> String| {
        let each: Vec<String> = results
            .plan
            .drawn()
            .into_iter()
            .map(|arm| {
                let found = text(value(claims, id, Some(arm)));
                format!("{found} on arm {}", arm.letter())
            })
            .collect();
        each.join(", ")
    };
    let ratio = |x: f64| format!("{x:.3}");
    format!(
        "Is the slenderness normalized out? Under one pulse-type motion \
         nearly: the IDA curves of the five slendernesses are {} apart in \
         intensity at equal demand (median over records); under one ordinary \
         motion less so, {}. In the statistics of the ordinary suite their \
         median intensities at demands 0.1 to 1.0 differ by {} at most, and \
         of the median paired ratios of responses the one farthest from 1 is \
         {} for p = 1 and {} for p = 3 and 4. Adjusting the slenderness \
         instead of scaling the records moves the medians by {} at most. \
         With Housner's restitution it is not normalized out: overturning \
         intensities of alpha = 0.25 and 0.05 differ by {}.",
        percent(pulse),
        percent(ordinary),
        by_arm("quantiles-coincide", &percent),
        by_arm("ratios-p1", &ratio),
        by_arm("ratios-p3-p4", &ratio),
        by_arm("adjustment-quantiles", &percent),
        percent(value(claims, "housner-breaks", None)),
    )
}

/// Mean accepted shares over the blocks.
fn distribution(results: &Results) -> String {
    let arm = results.plan.common();
    let mut parts = Vec::new();
    for suite in [&results.ordinary, &results.pulse] {
        for (intensity, name) in
            [(Intensity::Pga, "PGA"), (Intensity::Pgv, "PGV")]
        {
            let Some(d) = results.distributions(suite.kind, arm, intensity)
            else {
                continue;
            };
            let mean = |of: fn((f64, f64)) -> f64| {
                let sum = d.blocks.iter().fold(0.0, |s, b| s + of(b.shares()));
                sum / d.blocks.len() as f64
            };
            parts.push(format!(
                "{} for {name}, {} ({} unshifted)",
                percent(mean(|s| s.1)),
                suite.kind,
                percent(mean(|s| s.0)),
            ));
        }
    }
    format!(
        "Is rocking fragility shifted lognormal? At the 5 % level the \
         Lilliefors test accepts a shifted lognormal at this share of the \
         demand levels, mean over the 15 blocks, arm {}: {}. Accepting is \
         weak evidence with so few records; the power of the test is among \
         the tables.",
        arm.letter(),
        parts.join("; ")
    )
}

/// Cases that passed, and the share of the tolerance that half of their
/// numbers stay below.
fn accuracy(results: &Value, timings: &Timings) -> String {
    let none = serde_json::Map::new();
    let cases = results.as_object().unwrap_or(&none);
    let passed = cases.values().filter(|c| c["verdict"] == "pass").count();
    let mut margins: Vec<f64> = cases
        .values()
        .filter_map(|case| case["quantities"].as_object())
        .flat_map(serde_json::Map::values)
        .filter(|quantity| quantity["kind"] != "waived")
        .filter_map(|quantity| quantity["margin"].as_f64())
        .collect();
    margins.sort_by(f64::total_cmp);
    let middle = margins.get(margins.len() / 2).copied().unwrap_or(f64::NAN);
    format!(
        "How accurate is the integrator? {} {passed} of {} declared cases \
         pass against closed forms, trajectories with 36 digits and other \
         oracles; of the {} numbers compared half use less than {middle:.0e} \
         of their tolerance.",
        timings.accuracy(),
        cases.len(),
        margins.len()
    )
}

pub(super) fn not_checked(results: &Results) -> String {
    let records = if results.embedded() {
        "recorded earthquakes (these suites are synthetic), "
    } else {
        ""
    };
    format!(
        "What was not checked? The model against experiments, {records}\
         sliding, bouncing, vertical motion and flexible supports, and other \
         machines than x86-64 Linux."
    )
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn cases_and_the_worst_margin_are_counted() {
        let results = json!({
            "a/one": {
                "verdict": "pass",
                "quantities": {
                    "x": {"kind": "exact", "margin": 0.125},
                    "y": {"kind": "absolute", "margin": 0.2},
                    "z": {"kind": "absolute", "margin": 0.5},
                    "other": {"kind": "waived", "margin": 0.9},
                },
            },
            "a/two": {"verdict": "fail", "quantities": {}},
        });
        let text = accuracy(&results, &Timings::kept().expect("timings"));
        assert!(text.contains("1 of 2 declared cases"), "{text}");
        let end = "of the 3 numbers compared half use less than 2e-1 of \
                   their tolerance.";
        assert!(text.ends_with(end), "{text}");
    }

    #[test]
    fn what_was_not_measured_is_said() {
        assert_eq!(percent(value(&[], "absent", None)), "(not measured)");
        assert_eq!(percent(0.0978), "9.8 %");
    }
}
