//! Constants of the paper: blocks, gravity, restitution, stripes, demand levels,
//! intensity grids, intensity measures and sections.

use std::fmt;

use libm::sin;
use rocking::block::Block;
pub use rocking_records::intensity::Intensity;
pub use rocking_synthesis::SuiteKind;
use serde::{Deserialize, Serialize};

use rocking::names::named;

/// Frequency parameters of the paper's blocks, in rad/s.
pub const FREQUENCIES_RAD_S: [f64; 3] = [1.0, 3.0, 4.0];

/// Slenderness angles of the paper's blocks, in rad.
pub const SLENDERNESSES_RAD: [f64; 5] = [0.05, 0.10, 0.15, 0.20, 0.25];

/// The paper's coefficient of restitution, for every block.
pub const RESTITUTION: f64 = 0.92;

/// Gravity of the paper's Table 1, in m/s2.
pub const GRAVITY_M_S2: f64 = 9.81;

/// Position of the reference slenderness, 0.10 rad.
pub const REFERENCE: usize = 1;

/// Candidate levels of the stripes. A level is used if at least [`LEAST_USABLE`]
/// ratios are well defined there.
pub const STRIPES: [f64; 16] = [
    1.1, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0,
    25.0, 30.0,
];

/// Least number of well-defined ratios for a box.
pub const LEAST_USABLE: usize = 10;

/// The 15 blocks, by frequency parameter, then by slenderness.
pub const BLOCKS: [Block; 15] = {
    let mut blocks = [block(0, 0); 15];
    let mut at = 0;
    while at < blocks.len() {
        let slendernesses = SLENDERNESSES_RAD.len();
        blocks[at] = block(at / slendernesses, at % slendernesses);
        at += 1;
    }
    blocks
};

/// A block by the positions of its frequency parameter and slenderness.
const fn block(frequency: usize, slenderness: usize) -> Block {
    let alpha_rad = SLENDERNESSES_RAD[slenderness];
    match Block::try_new(alpha_rad, FREQUENCIES_RAD_S[frequency]) {
        Ok(block) => block,
        Err(_) => panic!("a block of the paper out of range"),
    }
}

/// Position of a block among the 15.
pub fn position(frequency: usize, slenderness: usize) -> usize {
    frequency * SLENDERNESSES_RAD.len() + slenderness
}

/// Small-rotation limit by Eq. 1 of a ratio to the reference
/// slenderness: (sin alpha/alpha)/(sin 0.1/0.1).
pub fn closed_form(alpha_rad: f64) -> f64 {
    let of = |alpha: f64| sin(alpha) / alpha;
    of(alpha_rad) / of(SLENDERNESSES_RAD[REFERENCE])
}

/// Demand levels of the tests: 0.005, 0.010, ... 1.000, each the double
/// nearest to its decimal.
pub fn demands() -> Vec<f64> {
    (1..=200).map(|k| f64::from(5 * k) / 1000.0).collect()
}

/// Position of a demand in [`demands`], for multiples of 0.005.
pub fn demand_index(demand: f64) -> usize {
    ((demand * 200.0).round() as usize).saturating_sub(1)
}

named! {
    /// Intensity grid.
    #[derive(PartialOrd, Ord, Hash)]
    pub enum Arm: "arm" {
        /// The paper's 0.01 g steps, not refined.
        A = "A",
        /// The paper's steps, first overturning bracket bisected.
        B = "B",
        /// Equal dimensionless steps for every slenderness, bisected.
        C = "C",
    }
}

impl Arm {
    /// Letter and meaning of the grid.
    pub fn words(self) -> &'static str {
        match self {
            Self::A => "A: steps of 0.01 g",
            Self::B => "B: steps of 0.01 g, first overturning bisected",
            Self::C => "C: steps of 0.02 in intensity, bisected",
        }
    }
}

/// A place in the paper: a section, and the table or the figures that show the
/// statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaperSection {
    /// The section.
    pub number: u8,
    /// The table or figures.
    pub shown: Exhibit,
}

/// Part of the paper that shows a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Exhibit {
    /// Only the text.
    Text,
    /// A table.
    Table(u8),
    /// A figure.
    Figure(u8),
    /// A panel of a figure.
    Panel(u8, char),
    /// Two figures.
    Figures(u8, u8),
}

impl fmt::Display for PaperSection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.number)?;
        match self.shown {
            Exhibit::Text => Ok(()),
            Exhibit::Table(n) => write!(f, ", Table {n}"),
            Exhibit::Figure(n) => write!(f, ", Figure {n}"),
            Exhibit::Panel(n, panel) => write!(f, ", Figure {n}{panel}"),
            Exhibit::Figures(a, b) => write!(f, ", Figures {a} and {b}"),
        }
    }
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
        let at = &BLOCKS[position(2, REFERENCE)];
        assert_eq!(at.frequency_rad_s(), 4.0);
        assert_eq!(at.slenderness_rad(), 0.10);
    }

    #[test]
    fn closed_form_at_the_slendernesses_of_the_paper() {
        // (sin a/a)/(sin 0.1/0.1) by Python's math.sin.
        for (alpha, expected) in [
            (0.05, 1.001_251_303_408_461_1),
            (0.15, 0.997_916_579_390_467_9),
            (0.20, 0.995_004_165_278_025_7),
            (0.25, 0.991_267_123_030_526_1),
        ] {
            let off = (closed_form(alpha) - expected).abs();
            assert!(off < 1e-15, "{alpha}: {off}");
        }
    }
}
