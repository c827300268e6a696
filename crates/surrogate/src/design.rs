//! Blocks that fill the range evenly.

use libm::{exp, log};

use super::{FREQUENCY_RANGE_RAD_S, SLENDERNESS_RANGE_RAD};

/// The digits of `index` in `base` mirrored at the point: in [0, 1).
fn mirrored(mut index: u64, base: u64) -> f64 {
    let (mut place, mut sum) = (1.0, 0.0);
    while index > 0 {
        place /= base as f64;
        sum += place * (index % base) as f64;
        index /= base;
    }
    sum
}

/// Alpha (rad) and p (rad/s) of a point of Halton's sequence in the bases 2
/// for ln p and 3 for alpha, over the whole range.
#[must_use]
pub fn point(index: u64) -> (f64, f64) {
    let (low, high) = FREQUENCY_RANGE_RAD_S;
    let p = low * exp(log(high / low) * mirrored(index, 2));
    let (low, high) = SLENDERNESS_RANGE_RAD;
    let alpha = low + (high - low) * mirrored(index, 3);
    (alpha, p)
}
