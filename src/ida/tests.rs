//! Curves against each other: certified, and in lanes.

mod certified;
#[path = "../../tests/compare.rs"]
mod compare;
mod integrator_pool;
