//! What the tables of a sweep hold: their columns, and of what kind each is.

use super::plan::Plan;
use rocking_common::table::columns::SCHEMA_COLUMN;

/// What a file of a tile holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// A row a block, intensity measure and demand.
    Fragilities,
    /// A row a block and record: first overturning and capacities.
    Capacities,
    /// A row a level of a curve, and one for its refined end.
    Rows,
}

/// What the cells of a column are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Numbers of which many rows share each; never missing.
    Level,
    /// Numbers that hardly repeat; an empty cell is a missing one.
    Value,
    /// Whole numbers.
    Count,
    /// `true` or `false`.
    Flag,
    /// Text.
    Text,
}

use Kind::{Count, Flag, Level, Text, Value};

/// Columns that every table begins with.
const BLOCK: [(&str, Kind); 4] =
    [("id", Text), ("alpha_rad", Level), ("p_rad_s", Level), ("eta", Level)];

const FRAGILITIES: [(&str, Kind); 12] = [
    ("im", Text),
    ("demand", Level),
    ("records", Count),
    ("reached", Count),
    ("shift", Level),
    ("median", Value),
    ("dispersion", Value),
    ("median_low", Value),
    ("median_high", Value),
    ("dispersion_low", Value),
    ("dispersion_high", Value),
    ("unresolved", Count),
];

/// Those before the capacities at the plan's demands.
const CAPACITIES: [(&str, Kind); 5] = [
    ("record", Text),
    ("velocity_factor", Value),
    ("first_overturning", Value),
    ("analyses", Count),
    ("unresolved", Count),
];

const ROWS: [(&str, Kind); 6] = [
    ("record", Text),
    ("intensity_pga", Level),
    ("pga_g", Level),
    ("edp", Value),
    ("refined", Flag),
    ("resolved", Flag),
];

impl Content {
    /// All of them.
    pub const ALL: [Self; 3] =
        [Self::Fragilities, Self::Capacities, Self::Rows];

    /// What a sweep keeps.
    #[must_use]
    pub fn kept(plan: &Plan) -> Vec<Self> {
        let mut out = vec![Self::Fragilities, Self::Capacities];
        if plan.rows {
            out.push(Self::Rows);
        }
        out
    }

    /// Name in file names.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fragilities => "fragilities",
            Self::Capacities => "capacities",
            Self::Rows => "rows",
        }
    }

    /// Name and kind of each column.
    #[must_use]
    pub fn columns(self, plan: &Plan) -> Vec<(String, Kind)> {
        let own: &[(&str, Kind)] = match self {
            Self::Fragilities => &FRAGILITIES,
            Self::Capacities => &CAPACITIES,
            Self::Rows => &ROWS,
        };
        let demands = match self {
            Self::Capacities => plan.demands.as_slice(),
            Self::Fragilities | Self::Rows => &[],
        };
        let fixed = BLOCK.iter().chain(own).map(|(n, k)| ((*n).into(), *k));
        let at = demands.iter().map(|d| (format!("intensity_at_{d}"), Value));
        let schema = [(SCHEMA_COLUMN.into(), Level)];
        fixed.chain(at).chain(schema).collect()
    }
}
