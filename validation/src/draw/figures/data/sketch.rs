//! Figure 1.

use super::Heading;
use crate::table::{Table, number};

/// The block with its symbols, rotated about its right-hand pivot.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockSketch {
    /// The words.
    pub heading: Heading,
    /// Slenderness of the drawn block (0.25 to 0.45 reads well).
    pub alpha_rad: f64,
    /// Drawn rotation, positive (0.1 to 0.25 reads well).
    pub rotation_rad: f64,
}

impl BlockSketch {
    /// `quantity,value,unit`.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut table = Table::new(&["quantity", "value", "unit"]);
        let rows =
            [("slenderness", self.alpha_rad), ("rotation", self.rotation_rad)];
        for (name, value) in rows {
            table.row([name.into(), number(value), "rad".into()]);
        }
        table.finish()
    }
}
