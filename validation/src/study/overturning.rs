//! Median overturning intensities of every block, for `findings.json`.

use serde_json::{Value, json};

use super::claims::median;
use super::figures::Results;
use super::findings::{ends, rounded};

/// A row a block, suite and measure, in the arm that figures share: the
/// median intensity at demand 1.00 with its order-statistic interval.
#[must_use]
pub fn json(results: &Results) -> Value {
    let arm = results.plan.common();
    let mut rows = Vec::new();
    for d in results.distributions.iter().filter(|d| d.arm == arm) {
        for block in &d.blocks {
            // The last of the demand levels is overturning.
            let last = block.samples.last().map_or(&[][..], Vec::as_slice);
            let measured = median(last);
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
