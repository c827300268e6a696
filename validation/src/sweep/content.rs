//! What the tables of a sweep hold.

use super::plan::Plan;
use rocking_common::table::columns::{
    SCHEMA_COLUMN, SWEEP_CAPACITIES, SWEEP_FRAGILITIES, SWEEP_ROWS,
};
use rocking_common::words::named;

named! {
    /// What a file of a tile holds.
    pub enum Content {
        /// A row a block, intensity measure and demand.
        Fragilities = "fragilities",
        /// A row a block and record: first overturning and capacities.
        Capacities = "capacities",
        /// A row a level of a curve, and one for its refined end.
        Rows = "rows",
    }
}

impl Content {
    /// What a sweep keeps.
    #[must_use]
    pub fn kept(plan: &Plan) -> Vec<Self> {
        let mut out = vec![Self::Fragilities, Self::Capacities];
        if plan.rows {
            out.push(Self::Rows);
        }
        out
    }

    /// Name of each column, and what its cells are in the registry.
    #[must_use]
    pub fn columns(self, plan: &Plan) -> Vec<(String, &'static str)> {
        let (layout, demands) = match self {
            Self::Fragilities => (&SWEEP_FRAGILITIES, &[][..]),
            Self::Capacities => (&SWEEP_CAPACITIES, &plan.demands[..]),
            Self::Rows => (&SWEEP_ROWS, &[][..]),
        };
        let own = layout.columns.iter();
        let own = own.map(|column| (column.name.into(), column.cells));
        let at = demands.iter();
        let at = at.map(|d| (format!("intensity_at_{d}"), "number"));
        let schema = [(SCHEMA_COLUMN.into(), "level")];
        own.chain(at).chain(schema).collect()
    }
}
