//! Figures 12 and 14.

use super::Heading;
use crate::paper::{Arm, Intensity};
use crate::table::optional;
use crate::table::{Table, number};

/// Share of the demand levels at which lognormality is accepted, by block.
#[derive(Debug, Clone, PartialEq)]
pub struct AcceptedShares {
    /// The words.
    pub heading: Heading,
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// Share that a lognormal sample would give at the test's level (0.95).
    pub expected: f64,
    /// Panels row by row: a row a suite; original, then shifted.
    pub panels: Vec<SharePanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One suite, original or shifted.
#[derive(Debug, Clone, PartialEq)]
pub struct SharePanel {
    /// Suite as named in the panel's title: `ordinary`, `pulse-type`.
    pub suite: String,
    /// Number of records.
    pub records: usize,
    /// Whether IM_R was taken off before the test.
    pub shifted: bool,
    /// Every block, in each arm shown.
    pub shares: Vec<BlockShare>,
}

/// One block.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockShare {
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// Slenderness.
    pub alpha_rad: f64,
    /// Arm of the grid; the first arm's marks are filled, others open.
    pub arm: Arm,
    /// Accepted share of the levels, 0 to 1.
    pub share: f64,
    /// Central 95 % band of that share for lognormal samples whose levels
    /// are as dependent as these, where it was computed.
    pub null_band: Option<(f64, f64)>,
}

impl AcceptedShares {
    /// `panel,suite,records,im_kind,sample,arm,p_rad_s,alpha_rad,share,`
    /// `null_low,null_high`.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut table = Table::new(&[
            "panel",
            "suite",
            "records",
            "im_kind",
            "sample",
            "arm",
            "p_rad_s",
            "alpha_rad",
            "share",
            "null_low",
            "null_high",
        ]);
        for (i, panel) in self.panels.iter().enumerate() {
            for block in &panel.shares {
                let sample =
                    if panel.shifted { "shifted" } else { "original" };
                table.row([
                    super::letter(i),
                    panel.suite.clone(),
                    panel.records.to_string(),
                    self.intensity.name().into(),
                    sample.into(),
                    block.arm.letter().into(),
                    number(block.p_rad_s),
                    number(block.alpha_rad),
                    number(block.share),
                    optional(block.null_band.map(|b| b.0)),
                    optional(block.null_band.map(|b| b.1)),
                ]);
            }
        }
        table.finish()
    }
}
