//! The whole study: 15 blocks, two suites, three arms of the intensity grid;
//! figures, their data, and what was found about the paper's claims.

pub mod choice;
pub mod findings;
pub mod grid;
pub mod histories;
pub mod output;
pub mod stripes;
