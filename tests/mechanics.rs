//! The mechanics in a few seconds: block and integrator against values from
//! outside, and what must hold for any of them. Mutation testing runs this
//! target alone.

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
#[path = "mechanics/names.rs"]
mod names;
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
