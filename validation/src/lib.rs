//! Verification and validation harness of `rocking`, and its command line.
//!
//! Everything here stands on the core's public interface alone.

pub mod cases;
pub mod cli;
pub mod engine;
pub mod files;
pub mod json;
pub mod methods;
pub mod naive;
pub mod oracles;
pub mod scene;
pub mod verdict;
