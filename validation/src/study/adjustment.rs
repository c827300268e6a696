//! Numbers of Figure 9: adjusted slenderness against scaled records.

use serde_json::{Value, json};

use super::StudyError;
use super::claims;
use super::figures::{Results, adjusted_boxes, adjusted_split, of_arm};
use super::findings::{ends, rounded, wilson};
use crate::draw::figures::data::Stripe;

/// Figure 9, a row a box: usable count with Wilson's 95 % interval, and
/// median; the same apart by whether the adjusted slenderness is within the
/// paper's.
///
/// # Errors
/// [`StudyError`] where a ratio cannot be computed.
pub fn json(results: &Results) -> Result<Value, StudyError> {
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
