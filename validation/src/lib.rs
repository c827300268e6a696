//! Verification and validation harness of `rocking`, and its command line.
//!
//! Everything here stands on the core's public interface alone.

pub mod cli;
pub mod drawing;
pub mod figures;
pub mod files;
pub mod json;
pub mod report;
