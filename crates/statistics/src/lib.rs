//! The statistics of rocking.
//!
//! | input | result | function |
//! |---|---|---|
//! | capacities | a lognormal fragility, with or without a shift | [`lognormal::fit`] |
//! | a sample | a test of lognormality | [`lilliefors::LillieforsTest`] |
//! | a sample | quantiles by named type | [`quantile`] |
//! | samples of the same records | a comparison | [`paired`] |
//! | a statistic and clusters of records | an interval | [`Clusters::estimate`] |
//! | a value and an interval | a checked pair | [`Estimate`] |
//! | a seed's name | random numbers with the same bits everywhere | [`streams`] |
//!
//! A sample is checked once, when it is made; functions that take one rely on
//! it.
//!
//! Results and names are `serde::Serialize`.

#![deny(missing_docs)]

pub mod acceptance;
mod beta;
pub mod bootstrap;
pub mod boxplot;
pub mod censored;
pub mod clusters;
pub mod estimate;
pub mod lilliefors;
pub mod lognormal;
pub mod normal;
pub mod normality;
pub mod paired;
pub mod proportion;
pub mod quantile;
pub mod regression;
pub mod resampling;
pub mod sample;
pub mod search;
pub mod streams;
pub mod two_sample;

pub use boxplot::Boxplot;
pub use censored::CensoredSample;
pub use clusters::Clusters;
pub use estimate::{Estimate, Interval, Range};
pub use lognormal::Lognormal;
pub use proportion::Proportion;
pub use quantile::QuantileType;
pub use sample::{ExtendedSample, Sample, SampleError};
