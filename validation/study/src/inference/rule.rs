//! What a claim asks of its cells, and the levels that it is held to.

use rocking_common::findings::{Quantifier, Region, Unit};

/// Level of the interval of one value, and of a share of cells.
pub const LEVEL: f64 = 0.95;

/// Level of the interval of a cell among many: the region holds all of it
/// where both one-sided tests of 5 % say so.
pub const OWN: f64 = 0.9;

/// Error of a statement about many cells at once: the probability that any
/// cell is refuted wrongly, or the expected share of those wrongly shown.
pub(super) const FAMILY: f64 = 0.05;

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

/// A cell's name, and how many records are in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Where it is: `p = 3, alpha = 0.20`.
    pub at: String,
    /// Records whose values are in it.
    pub records: usize,
}
