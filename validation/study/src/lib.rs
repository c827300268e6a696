//! The whole study: 15 blocks, two suites, three arms of the intensity grid;
//! figures, their data, and what was found about the paper's claims.

pub mod analyses;
pub mod certainty;
pub mod claims;
pub mod contents;
mod distances;
pub mod distributions;
pub mod estimates;
pub mod facts;
pub mod figures;
pub mod findings;
mod fits;
pub mod inference;
pub mod kept;
pub mod measures;
pub mod normality;
pub mod questions;
pub mod results;
pub mod runs;
pub mod sensitivities;
mod stripes;
mod ties;
mod whole;
mod words;

pub use whole::Study;
