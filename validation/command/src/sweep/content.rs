//! The tables of a sweep.

use super::plan::SweepPlan;
use rocking::names::named;
use rocking_common::table::columns::{
    SWEEP_CAPACITIES, SWEEP_FRAGILITIES, SWEEP_ROWS,
};

named! {
    /// Content of a tile's file.
    pub enum Content: "content" {
        /// A row a block, intensity measure and demand.
        Fragilities = "fragilities",
        /// A row a block and record: first overturning and capacities.
        Capacities = "capacities",
        /// A row a level of a curve, and one for its refined end.
        Rows = "rows",
    }
}

impl Content {
    /// Tables that a sweep keeps.
    pub fn kept(plan: &SweepPlan) -> Vec<Self> {
        let is_kept = |what: &Self| plan.rows || *what != Self::Rows;
        Self::ALL.into_iter().filter(is_kept).collect()
    }

    /// Names of the columns.
    pub fn columns(self, plan: &SweepPlan) -> Vec<String> {
        let layout = match self {
            Self::Fragilities => &SWEEP_FRAGILITIES,
            Self::Capacities => &SWEEP_CAPACITIES,
            Self::Rows => &SWEEP_ROWS,
        };
        let mut names: Vec<String> = layout.names().map(Into::into).collect();
        if self == Self::Capacities {
            let at = plan.demands.iter();
            let at = at.map(|demand| format!("intensity_at_{demand}"));
            names.splice(layout.columns.len()..layout.columns.len(), at);
        }
        names
    }
}
