//! What all crates of the harness share.

pub mod curves;
pub mod files;
pub mod findings;
pub mod json;
pub mod paper;
pub mod suites;
pub mod table;
pub mod words;
