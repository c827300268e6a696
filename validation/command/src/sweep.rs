//! Many blocks over one suite, in tiles that any number of tasks work off:
//! plan once, run anywhere, merge.
//!
//! A *tile* is some blocks with all records of the suite, since every
//! statistic is over the records of one block: a tile ends in fragilities,
//! and merging puts tiles in the plan's order. The bytes do not depend on
//! the number of tasks, their order, or what was interrupted: a tile is
//! written whole or not at all, and names the plan and its own sum.

mod content;
mod merge;
mod plan;
mod tile;

pub use content::Content;
pub use merge::merge;
pub use plan::{
    LevelSteps, SCHEMA, SweepBlock, SweepFolder, SweepPlan, TILE_CURVES,
};
pub use tile::{left, run};

#[cfg(test)]
mod tests;
