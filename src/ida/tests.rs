//! Curves against each other: certified, and in lanes.

mod certified;
mod lanes;
mod responses;
