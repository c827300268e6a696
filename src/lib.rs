//! The statistics of rocking.
//!
//! A free-standing rigid block (a column, a statue, a cabinet) answers an
//! earthquake by rocking about its two base corners, and sometimes by
//! overturning. This crate integrates that motion to rounding error and
//! does the statistics on top of it. Data flow one way:
//!
//! ```text
//! record -> excitation -> (block, integrator) -> response -> IDA
//!        -> capacity -> statistics/fragility
//! ```
//!
//! A *scene* is a block, an excitation, a model and an observer: the caller
//! says what is to be recorded and pays for nothing else.
//!
//! Equation numbers refer to Lachanas, Vamvatsikos and Dimitrakopoulos,
//! "Statistical property parameterization of simple rocking block response".

pub mod block;
pub mod capacity;
pub mod excitation;
pub mod fragility;
pub mod ida;
pub mod integrator;
pub mod intensity;
pub mod number;
pub mod record;
pub mod statistics;
pub mod streams;
pub mod units;

pub use block::{Block, Restitution};
pub use excitation::Excitation;
pub use integrator::{Observe, Response, Scene, respond};

#[doc = include_str!("certainty.md")]
pub mod certainty {}

/// The README's example compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
