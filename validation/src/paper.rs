//! What the study looks at: blocks, stripes, demand levels.

use rocking::block::{Block, BlockError};

/// Frequency parameters of the paper's blocks, in rad/s.
pub const FREQUENCIES_RAD_S: [f64; 3] = [1.0, 3.0, 4.0];

/// Slenderness angles of the paper's blocks, in rad.
pub const SLENDERNESSES_RAD: [f64; 5] = [0.05, 0.10, 0.15, 0.20, 0.25];

/// Position of the reference slenderness, 0.10 rad.
pub const REFERENCE: usize = 1;

/// Stripe levels on offer; those are used at which at least
/// [`LEAST_USABLE`] ratios are well defined.
pub const STRIPES: [f64; 16] = [
    1.1, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0,
    25.0, 30.0,
];

/// Least number of well-defined ratios for a box.
pub const LEAST_USABLE: usize = 10;

/// The 15 blocks, by frequency parameter, then by slenderness.
///
/// # Errors
/// None in practice: all angles and frequencies are in range.
pub fn blocks() -> Result<Vec<Block>, BlockError> {
    FREQUENCIES_RAD_S
        .iter()
        .flat_map(|p| SLENDERNESSES_RAD.iter().map(|a| Block::try_new(*a, *p)))
        .collect()
}

/// Position of a block among the 15.
#[must_use]
pub fn position(frequency: usize, slenderness: usize) -> usize {
    frequency * SLENDERNESSES_RAD.len() + slenderness
}

/// Demand levels of the tests: 0.005, 0.010, ... 1.000, each the double
/// nearest to its decimal.
#[must_use]
pub fn demands() -> Vec<f64> {
    (1..=200).map(|k| f64::from(5 * k) / 1000.0).collect()
}

/// Position of a demand in [`demands`], for multiples of 0.005.
#[must_use]
pub fn demand_index(demand: f64) -> usize {
    ((demand * 200.0).round() as usize).saturating_sub(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn demands_hold_the_paper_s_thresholds_exactly() {
        let levels = demands();
        assert_eq!((levels[0], levels[199]), (0.005, 1.0));
        for threshold in [0.15, 0.35, 0.5, 1.0] {
            assert_eq!(levels[demand_index(threshold)], threshold);
        }
    }

    #[test]
    fn blocks_are_ordered_by_frequency_then_slenderness() {
        let blocks = blocks().expect("blocks");
        assert_eq!(blocks.len(), 15);
        let at = &blocks[position(2, REFERENCE)];
        assert_eq!(at.frequency_rad_s(), 4.0);
        assert_eq!(at.slenderness_rad(), 0.10);
    }
}
