//! Samples and what is computed from them.
//!
//! Quantiles by named type, the empirical distribution, boxplots, lognormal
//! fits, tests of normality, paired comparison and the bootstrap. A sample is
//! checked once, when it is made; what takes one relies on it.

pub mod acceptance;
pub mod bootstrap;
pub mod boxplot;
pub mod censored;
pub mod clusters;
pub mod confidence;
pub mod lilliefors;
pub mod lognormal;
mod monte_carlo;
pub mod multiple;
pub mod normal;
pub mod normality;
pub mod paired;
pub mod power;
pub mod proportion;
pub mod quantile;
pub mod regression;
pub mod resampling;
pub mod sample;
mod search;
pub mod step_down;
pub mod streams;
pub mod two_sample;

pub use boxplot::Boxplot;
pub use censored::CensoredSample;
pub use clusters::Clusters;
pub use lognormal::Lognormal;
pub use proportion::Proportion;
pub use quantile::QuantileType;
pub use sample::{ExtendedSample, Sample, SampleError};
