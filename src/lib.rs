#![doc = include_str!("README.md")]
//!
//! # Functions
//!
//! | input | result | function |
//! |---|---|---|
//! | a block and a pulse or record | response | [`respond`] to a [`Scene`] |
//! | the same | impacts, history, error bound | the fields of [`Observe`] |
//! | a run that may be chaotic | a fate that is sure | [`certify`](integrator::certify) |
//! | the same | 30 or 77 digits | [`respond_precise`](integrator::respond_precise) |
//! | a record and a block | demand at rising intensity | [`ida::curve`] |
//! | many of both | demand, on all cores | [`ida::curves`] |
//! | an IDA curve | capacities | [`IdaCurve::response`](ida::IdaCurve::response), [`capacity`] |
//! | long work | its end before it is done | [`stop`] |
//!
//! Data flow one way, one module a step:
//!
//! ```text
//! accelerogram -> excitation -> (block, integrator) -> ida -> capacity
//! ```
//!
//! An [`accelerogram`] has checked samples; [`excitation`] scales it and has
//! analytic pulses; [`block`] has geometry and restitution; [`integrator`]
//! answers a scene; [`ida`] raises the intensity until the block overturns;
//! [`capacity`] inverts that. [`number`] has the arithmetic, [`units`] and
//! [`names`] the spelling of units and choices.
//!
//! Rocking under a long record is chaotic. [`certainty`] says what rounding
//! does to it, and what the words `clear` and `unresolved` promise.
//!
//! Equation numbers refer to Lachanas, Vamvatsikos and Dimitrakopoulos,
//! "Statistical property parameterization of simple rocking block response".

#![deny(missing_docs)]
// Parts of the kernel serve only the feature `lanes`.
#![cfg_attr(not(feature = "lanes"), allow(dead_code, unused_imports))]

pub mod accelerogram;
pub mod block;
pub mod capacity;
pub mod excitation;
pub mod ida;
pub mod integrator;
pub mod names;
pub mod number;
pub mod stop;
pub mod units;

pub use block::{Block, Restitution};
pub use excitation::Excitation;
pub use integrator::{Observe, Response, Scene, respond};

#[doc = include_str!("certainty.md")]
///
/// In the code: [`Certificate`](crate::integrator::Certificate),
/// [`CLEARANCE`](crate::integrator::CLEARANCE),
/// [`certify`](crate::integrator::certify).
pub mod certainty {}

#[doc = include_str!("../CHANGELOG.md")]
pub mod changelog {
    /// The text of this page.
    pub const TEXT: &str = include_str!("../CHANGELOG.md");
}

/// The README's example compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
