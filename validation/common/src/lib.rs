//! Common parts of the crates of the harness.

pub mod curves;
#[cfg(not(target_family = "wasm"))]
pub mod files;
pub mod findings;
pub mod json;
pub mod paper;
#[cfg(not(target_family = "wasm"))]
pub mod suites;
pub mod table;
pub mod words;
