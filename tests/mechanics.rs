//! The mechanics in a few seconds: edges and refusals of block and integrator,
//! and what must hold for any of them. The declared cases hold the values.
//! Mutation testing runs this target first.

#[path = "mechanics/closed.rs"]
mod closed;
#[path = "compare.rs"]
mod compare;
#[path = "properties/drawn.rs"]
mod drawn;
#[path = "mechanics/endless.rs"]
mod endless;
#[path = "mechanics/ends.rs"]
mod ends;
#[path = "mechanics/engines.rs"]
mod engines;
#[path = "mechanics/lanes.rs"]
mod lanes;
#[path = "properties/mechanics.rs"]
mod properties;
#[path = "mechanics/regressions.rs"]
mod regressions;
#[path = "properties/running.rs"]
mod running;
#[path = "mechanics/thresholds.rs"]
mod thresholds;

/// A subset of the cases of `properties.rs`.
const CASES: u32 = 5;
