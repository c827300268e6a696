//! The report of a study: its page, and the files beside it.

mod answers;
mod basis;
pub mod credibility;
pub mod diff;
pub mod evidence;
pub mod findings;
pub mod head;
pub mod input;
pub mod lab;
pub mod ledger;
pub mod marked;
pub mod output;
pub mod page;
pub mod quantity;
pub mod scored;
pub mod speed;
pub mod stale;
pub mod timings;
mod verdicts;
mod words;

#[cfg(test)]
mod tests;
