//! The rule of a claim, and how many records would decide what these do not.

use rocking_common::findings::{ClaimResult, Quantifier, Region, Unit};

/// What a claim asks of its cells.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// How many of them.
    pub quantifier: Quantifier,
    /// Where they have to lie.
    pub region: Region,
    /// Unit of a cell.
    pub unit: Unit,
    /// Ends that a value cannot cross: 0 and 1 of a share.
    pub range: (f64, f64),
}

/// Records that would decide if the value stayed: an interval shrinks by the
/// root of their number, until it reaches the nearest end of the region.
pub(super) fn needed(
    n: usize,
    rule: &Rule,
    result: &ClaimResult,
) -> Option<u64> {
    let (value, low, high, end) = match rule.quantifier {
        Quantifier::One | Quantifier::All => (
            result.value,
            result.low,
            result.high,
            rule.region.nearest_end(result.value),
        ),
        Quantifier::Most | Quantifier::AlmostAll => {
            let decided = result.deciding_cell.as_ref()?.measured;
            let (low, high) = decided.interval?;
            let end = rule.region.nearest_end(decided.value);
            (decided.value, low, high, end)
        }
    };
    let half = if end > value { high - value } else { value - low };
    let factor = half / (end - value).abs();
    let needed = (n as f64 * factor * factor).ceil();
    (needed.is_finite() && needed > n as f64 && needed < 1e6)
        .then_some(needed as u64)
}
