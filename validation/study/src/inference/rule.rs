//! What a claim asks of its cells.

use rocking_common::findings::{Quantifier, Region, Unit};
use rocking_statistics::Range;

/// What a claim asks of its cells.
#[derive(Clone, Copy, Debug)]
pub struct ClaimRule {
    /// How many of them.
    pub quantifier: Quantifier,
    /// Where they have to lie.
    pub region: Region,
    /// Unit of a cell.
    pub unit: Unit,
    /// The numbers that a cell can have: from 0 to 1 for a share.
    pub range: Range,
}

/// A cell's name, and how many records are in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Where it is: `p = 3, alpha = 0.20`.
    pub at: String,
    /// Records whose values are in it.
    pub records: usize,
}
