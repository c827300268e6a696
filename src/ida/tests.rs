//! Curves against each other: certified, and in lanes.

mod certified;
mod integrator_pool;
mod lanes;
