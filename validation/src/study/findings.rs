//! Everything that a study found, as `findings.json` holds it.

use rocking::integrator::Overturning;
use serde_json::{Map, Value, json};

use super::analyses::{Plan, SuiteResults};
use super::claims::{self, Claim, wilson};
use super::figures::{Results, adjusted_boxes, adjusted_split, of_arm};
use super::questions::{self, Answer};
use super::sensitivities::Varied;
use super::{StudyError, normality};
use crate::draw::figures::Stripe;
use crate::json::{ends, rounded};
use crate::paper::{BLOCKS, FREQUENCIES_RAD_S, SLENDERNESSES_RAD, demands};

/// Everything that goes to `findings.json`, by name; keys are sorted.
pub type Findings = Map<String, Value>;

/// Text of `findings.json`: one value a line, keys sorted, a line break at
/// the end.
#[must_use]
pub fn text(findings: &Findings) -> String {
    let value = Value::Object(findings.clone());
    // Printing a value that is already JSON cannot fail.
    serde_json::to_string_pretty(&value).unwrap_or_default() + "\n"
}

/// All findings of a study.
///
/// # Errors
/// [`StudyError`] where a number cannot be computed.
pub fn all(
    results: &Results,
    claims: &[Claim],
    answers: &[Answer],
) -> Result<Findings, StudyError> {
    let mut out = Findings::new();
    let claims = claims.iter().map(Claim::json).collect();
    out.insert("claims".into(), Value::Array(claims));
    out.insert("options".into(), options(&results.plan));
    out.insert("questions".into(), questions::json(answers));
    let suites = [&results.ordinary, &results.pulse].map(suite);
    out.insert("suites".into(), Value::Array(suites.into()));
    out.insert("figure_09".into(), adjustment(results)?);
    out.insert("uplift_unscaled".into(), uplift(results));
    out.insert("accepted_shares".into(), shares(results));
    out.insert("overturning".into(), overturning(results));
    out.insert("resurrections".into(), resurrections(results));
    out.insert("single_records".into(), single(results));
    out.insert("sensitivities".into(), varied(results)?);
    Ok(out)
}

fn options(plan: &Plan) -> Value {
    let arms: Vec<&str> = plan.arms.iter().map(|a| a.letter()).collect();
    let overturning = match plan.setup.overturning {
        Overturning::Alpha => "alpha",
        Overturning::HalfPi => "half-pi",
    };
    json!({
        "arms": arms,
        "eta": rounded(plan.setup.restitution.velocity_ratio()),
        "overturning": overturning,
        "refinement_im": rounded(plan.setup.tolerance),
        "version": env!("CARGO_PKG_VERSION"),
    })
}

fn suite(suite: &SuiteResults) -> Value {
    let chosen: Vec<&str> = suite
        .chosen
        .iter()
        .map(|record| suite.records[*record].name.as_str())
        .collect();
    let certainty = &suite.work.certainty;
    let mut value = json!({
        "kind": suite.kind,
        "source": suite.source.to_string(),
        "component_rule": suite.component_rule,
        "records": suite.records.len(),
        "sha256": suite.sha256,
        "analyses": suite.work.analyses,
        "not_told_by_double_precision": certainty.unresolved,
        "first_overturnings_told_again": {
            "all": certainty.ends.all,
            "by_double": certainty.ends.double,
            "by_double_double": certainty.ends.double_double,
            "by_octuple": certainty.ends.octuple,
            "left_open": certainty.ends.undecided,
            "told_wrongly_in_double": certainty.ends.moved,
        },
        "largest_shift_if_flipped": rounded(certainty.largest_shift),
        "shown_alone": chosen,
    });
    if let Some(remarks) = &suite.remarks {
        value["remarks"] = remarks.clone().into();
    }
    value
}

/// How many records uplift each block without being scaled.
fn uplift(results: &Results) -> Value {
    let rows: Vec<Value> = BLOCKS
        .iter()
        .map(|block| {
            json!({
                "p_rad_s": rounded(block.frequency_rad_s()),
                "alpha_rad": rounded(block.slenderness_rad()),
                "ordinary": results.ordinary.uplift_unscaled(block),
                "pulse_type": results.pulse.uplift_unscaled(block),
            })
        })
        .collect();
    Value::Array(rows)
}

fn shares(results: &Results) -> Value {
    let mut rows = Vec::new();
    for d in &results.distributions {
        for block in &d.blocks {
            let (original, shifted) = block.shares();
            rows.push(json!({
                "suite": d.kind,
                "arm": d.arm.letter(),
                "im_kind": d.intensity.name(),
                "p_rad_s": rounded(block.p_rad_s),
                "alpha_rad": rounded(block.alpha_rad),
                "im_r": rounded(block.shift),
                "original": rounded(original),
                "original_null_band": ends(block.bands[0].as_ref().and_then(normality::ends)),
                "shifted": rounded(shifted),
                "shifted_null_band": ends(block.bands[1].as_ref().and_then(normality::ends)),
            }));
        }
    }
    json!({ "levels": demands().len(), "rows": rows })
}

fn resurrections(results: &Results) -> Value {
    let rows: Vec<Value> = results
        .ordinary
        .stripes
        .iter()
        .map(|stripes| {
            let total = |counts: &[Vec<usize>]| -> usize {
                counts.iter().flatten().sum()
            };
            json!({
                "arm": stripes.arm.letter(),
                "overturned": total(&stripes.overturned),
                "stand_again": total(&stripes.stand_again),
            })
        })
        .collect();
    Value::Array(rows)
}

fn single(results: &Results) -> Value {
    let mut rows = Vec::new();
    for suite in [&results.ordinary, &results.pulse] {
        for row in claims::single_rows(suite) {
            rows.push(json!({
                "suite": suite.kind,
                "p_rad_s": rounded(row.p_rad_s),
                "im_pga": rounded(row.im),
                "usable": row.usable,
                "median_distance": rounded(row.distance),
                "median_peak_ratio": rounded(row.peak_ratio),
                "median_ln_im": rounded(row.mean_ln_im),
            }));
        }
    }
    Value::Array(rows)
}

fn varied(results: &Results) -> Result<Value, StudyError> {
    let rows = results
        .varied
        .iter()
        .map(|v: &Varied| {
            let pairs = claims::varied_ratios(results, v, 1.0)?;
            let measured = claims::median(&pairs.ratios);
            Ok(json!({
                "choice": v.choice.name(),
                "p_rad_s": rounded(FREQUENCIES_RAD_S[v.frequency]),
                "alpha_rad":
                    rounded(SLENDERNESSES_RAD[v.slenderness]),
                "edp": 1.0,
                "usable": pairs.ratios.len(),
                "median_ratio": rounded(measured.value),
                "interval": ends(measured.interval),
            }))
        })
        .collect::<Result<Vec<Value>, StudyError>>()?;
    Ok(Value::Array(rows))
}

/// Figure 9, a row a box: usable count with Wilson's 95 % interval, and
/// median; the same apart by whether the adjusted slenderness is within the
/// paper's.
fn adjustment(results: &Results) -> Result<Value, StudyError> {
    let suite = &results.ordinary;
    let mut rows = Vec::new();
    for arm in results.plan.drawn() {
        let Some(demands) = of_arm(suite, arm) else { continue };
        for (frequency, (p_rad_s, stripes)) in
            adjusted_boxes(suite, arm)?.into_iter().enumerate()
        {
            let splits = adjusted_split(suite, demands, frequency)?;
            for (stripe, split) in stripes.iter().zip(splits) {
                let median = stripe.summary.as_ref().map(|b| b.median);
                rows.push(json!({
                    "arm": arm.letter(),
                    "p_rad_s": rounded(p_rad_s),
                    "im_pga": rounded(split.im),
                    "records": stripe.records,
                    "usable": stripe.usable,
                    "usable_interval": count_interval(stripe),
                    "median": median.map(rounded),
                    "median_alpha_to_0.25": median_of_part(&split.within),
                    "median_alpha_above_0.25": median_of_part(&split.above),
                    "usable_alpha_above_0.25": split.above.len(),
                }));
            }
        }
    }
    Ok(Value::Array(rows))
}

/// Of as many records of the kind, how many would be usable.
fn count_interval(stripe: &Stripe) -> Value {
    let (low, high) = wilson(stripe.usable, stripe.records);
    let n = stripe.records as f64;
    ends(Some((low * n, high * n)))
}

fn median_of_part(ratios: &[f64]) -> Value {
    rounded(claims::median(ratios).value)
}

/// Median overturning intensities, a row a block, suite and measure, in the arm that figures share: the
/// median intensity at demand 1.00 with its order-statistic interval.
fn overturning(results: &Results) -> Value {
    let arm = results.plan.common();
    let mut rows = Vec::new();
    for d in results.distributions.iter().filter(|d| d.arm == arm) {
        for block in &d.blocks {
            // The last of the demand levels is overturning.
            let last = block.samples.last().map_or(&[][..], Vec::as_slice);
            let measured = claims::median(last);
            rows.push(json!({
                "suite": d.kind,
                "arm": d.arm.letter(),
                "im_kind": d.intensity.name(),
                "p_rad_s": rounded(block.p_rad_s),
                "alpha_rad": rounded(block.alpha_rad),
                "median": rounded(measured.value),
                "interval": ends(measured.interval),
            }));
        }
    }
    Value::Array(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_has_sorted_keys() {
        let mut findings = Findings::new();
        findings.insert("b".into(), json!({"z": 1, "a": 2}));
        findings.insert("a".into(), json!([1.5]));
        let expected = "{\n  \"a\": [\n    1.5\n  ],\n  \"b\": {\n    \
                        \"a\": 2,\n    \"z\": 1\n  }\n}\n";
        assert_eq!(text(&findings), expected);
    }
}
