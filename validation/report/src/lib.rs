//! The report of a study: its page, and the files beside it.

mod answers;
mod basis;
mod credibility;
pub mod diff;
pub mod evidence;
mod findings;
pub mod head;
pub mod lab;
pub mod law;
mod ledger;
pub mod output;
mod page;
mod quantity;
pub mod scored;
mod sentences;
pub mod shaking;
pub mod speed;
pub mod stale;
pub mod timings;
mod words;

#[cfg(test)]
mod tests;
