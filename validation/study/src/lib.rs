//! The whole study: 15 blocks, two suites, three intensity grids. It makes the
//! figures with their data, and the findings on the paper's statements.

pub mod analyses;
pub mod certainty;
pub mod claims;
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
