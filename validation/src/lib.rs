//! Verification and validation harness of `rocking`, and its command line.
//!
//! Everything here stands on the core's public interface alone.

pub mod arithmetic;
pub mod cases;
pub mod cli;
pub mod curves;
pub mod diff;
pub mod drawing;
pub mod engine;
pub mod evidence;
pub mod export;
pub mod figures;
pub mod files;
pub mod inputs;
pub mod json;
pub mod ledger;
pub mod methods;
pub mod naive;
pub mod oracles;
pub mod remarks;
pub mod report;
pub mod scene;
pub mod speed;
pub mod study;
pub mod synthesis;
pub mod trials;
pub mod verdict;
