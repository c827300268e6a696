//! The report of a study: its page, and the files beside it.

mod answers;
pub mod credibility;
pub mod evidence;
pub mod input;
pub mod ledger;
pub mod output;
pub mod page;
mod plain;
pub mod stale;
pub mod timings;
pub mod whole;

pub use whole::Study;

#[cfg(test)]
mod tests;
