#![doc = include_str!("README.md")]
//!
//! # What to call
//!
//! | you have | you want | call |
//! |---|---|---|
//! | a block and a pulse or record | what it does | [`respond`] a [`Scene`] |
//! | the same | impacts, history, error bound | the fields of [`Observe`] |
//! | a run that may be chaotic | a fate that is sure | [`certify`](integrator::certify) |
//! | the same | 30 or 77 digits | [`respond_precise`](integrator::respond_precise) |
//! | a file of a record | the record | [`record::read`] |
//! | a folder or an index of records | a suite | [`Suite::read`](record::Suite::read) |
//! | a record and a block | demand at rising intensity | [`ida::curve`] |
//! | many of both | the same, on all cores | [`ida::curves`] |
//! | an IDA curve | capacities | [`IdaCurve::response`](ida::IdaCurve::response), [`capacity`] |
//! | capacities | a fragility with a shift | [`lognormal::fit`](statistics::lognormal::fit) |
//! | a fragility without a shift | one with it (Eqs. 5 to 7) | [`fragility::transform`] |
//! | a sample | is it lognormal? | [`lilliefors::Assessment`](statistics::lilliefors::Assessment) |
//! | a record | its intensity measures | [`intensity`] |
//! | a record and a mode of a building | the motion of a floor | [`Floor::motion`](floor::Floor::motion) |
//! | long work | an end to it before it is done | [`stop`] |
//!
//! # The chain
//!
//! Data flow one way, one module a step:
//!
//! ```text
//! record -> accelerogram -> excitation -> (block, integrator) -> ida
//!        -> capacity -> statistics, fragility
//! ```
//!
//! [`record`] reads files; an [`accelerogram`] has checked samples;
//! [`excitation`] scales it and has analytic pulses; [`block`] has geometry
//! and restitution; [`integrator`] answers a scene; [`ida`] raises the
//! intensity until the block overturns; [`capacity`] inverts that;
//! [`statistics`] and [`fragility`] do the rest.
//! `examples/fragility.rs` goes from a folder of records to a fragility in 25
//! lines.
//!
//! # Certainty
//!
//! Rocking under a long record is chaotic. [`certainty`] says what rounding
//! does to it, and what the words `clear` and `unresolved` promise.
//!
//! Equation numbers refer to Lachanas, Vamvatsikos and Dimitrakopoulos,
//! "Statistical property parameterization of simple rocking block response".
//! `ARCHITECTURE.md` in the repository is the map of the code: where a new
//! pulse, impact law or record format goes.

#![deny(missing_docs)]
// Parts of the kernel serve one feature alone.
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
