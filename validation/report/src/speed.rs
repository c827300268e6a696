//! Speed against error: single analyses with a reference, throughput, and
//! the timings kept in `fixtures/speed`.
//!
//! Nothing here is a result of the study: times differ from run to run, and
//! no test looks at them.

pub mod answers;
pub mod cases;
pub mod clock;
pub mod export;
pub mod many;
pub mod measured;
pub mod rest;
pub mod singles;
pub mod throughput;

#[cfg(test)]
mod tests;
