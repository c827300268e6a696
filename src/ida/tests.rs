//! Curves against each other: certified, and in lanes.

mod certified;
#[path = "../../tests/pins/compare.rs"]
mod compare;
mod integrator_pool;
mod lanes;
