//! The questions that a reader asks first, answered in a sentence or two
//! made from the numbers.

use super::evidence::{NOT_RUN, Proof};
use super::timings::Timings;
use crate::paper::{Arm, Intensity};
use crate::study::claims::Claim;
use crate::study::figures::Results;

/// Slenderness, distribution, accuracy, speed, and what was not checked.
pub(super) fn answers(
    results: &Results,
    claims: &[Claim],
    timings: &Timings,
    proof: Option<&Proof>,
) -> Vec<String> {
    vec![
        slenderness(results, claims),
        distribution(results),
        accuracy(proof, timings),
        timings.plain(),
        not_checked(results),
    ]
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

fn accuracy(proof: Option<&Proof>, timings: &Timings) -> String {
    let cases = proof.map_or(NOT_RUN.into(), Proof::to_string);
    format!("How accurate is the integrator? {} {cases}", timings.accuracy())
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
    use super::*;

    #[test]
    fn what_was_not_measured_is_said() {
        assert_eq!(percent(value(&[], "absent", None)), "(not measured)");
        assert_eq!(percent(0.0978), "9.8 %");
    }
}
