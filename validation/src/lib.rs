//! Verification and validation harness of `rocking`, and its command line.
//!
//! Everything here stands on the core's public interface alone. It is built
//! in stages, each of which uses those below it alone: [`cli`], [`report`],
//! [`diff`], [`speed`], [`study`], [`draw`], [`proof`]; at the bottom
//! [`sweep`], [`surrogate`], [`suites`], [`paper`], [`curves`], [`table`],
//! [`files`], [`json`] and [`words`].

pub mod cli;
pub mod curves;
pub mod diff;
pub mod draw;
pub mod files;
pub mod findings;
pub mod json;
pub mod paper;
pub mod proof;
pub mod report;
pub mod speed;
pub mod study;
pub mod suites;
pub mod surrogate;
pub mod sweep;
pub mod table;
pub mod words;
