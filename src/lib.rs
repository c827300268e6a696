//! How free-standing rigid blocks (columns, statues, cabinets) rock and
//! overturn under earthquakes, and the statistics of it.
//!
//! ```
//! use rocking::excitation::{Pulse, PulseKind};
//! use rocking::{Block, Excitation, Observe, Restitution, Scene, respond};
//!
//! // Slenderness angle 0.1 rad, frequency parameter 3 rad/s, under one sine of
//! // 1.5 m/s2 at 12 rad/s.
//! let block = Block::try_new(0.1, 3.0)?;
//! let restitution = Restitution::constant(0.92)?;
//! let amplitude = 1.5 / 9.81;
//! let sine = PulseKind::OneSine { amplitude, omega_rad_s: 12.0 };
//! let pulse = Pulse::try_new(sine)?;
//! let scene = Scene::new(block, restitution, Excitation::Pulse(&pulse));
//! let response = respond(&scene, &Observe::default())?;
//! // |theta| reaches 0.49 alpha; a 36-digit reference: 0.493881599743772889...
//! assert!((response.peak_ratio - 0.493_881_599_743_773).abs() < 1e-13);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
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
//! # Features
//!
//! Without features a block responds to pulses and to samples, in every
//! arithmetic, one IDA curve at a time ([`ida::curve`]); `libm` and
//! `thiserror` are the only dependencies.
//!
//! | feature | default | adds | dependencies |
//! |---|---|---|---|
//! | `records` | yes | [`record`]: files and suites | `sha2` |
//! | `lanes` | yes | [`ida::curves`]: SIMD, all cores | `rayon` |
//! | `statistics` | yes | [`statistics`], [`fragility`], [`streams`] | `nalgebra`, `rand`, `rayon`, `statrs` |
//! | all of these | yes | [`procedures`] | |
//! | `serde` | no | results as `Serialize`, choices by their [`names`] | `serde` |
//!
//! `serde` is off because no computation needs it.
//!
//! # What is modelled
//!
//! A planar, rigid, symmetric block on a rigid base under horizontal ground
//! acceleration: uplift, rocking about either corner, impact with a
//! coefficient of restitution, rest, overturning; Eq. 1 (nonlinear) and
//! Eq. 2 (linearized). *Not* modelled: sliding, bouncing, vertical
//! acceleration, motion out of the plane, flexible blocks or bases.
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
#![cfg_attr(
    not(all(feature = "lanes", feature = "records", feature = "statistics")),
    allow(dead_code, unused_imports)
)]

pub mod accelerogram;
pub mod block;
pub mod capacity;
pub mod excitation;
pub mod floor;
#[cfg(feature = "statistics")]
pub mod fragility;
pub mod ida;
pub mod integrator;
pub mod intensity;
pub mod names;
pub mod number;
#[cfg(all(feature = "lanes", feature = "records", feature = "statistics"))]
pub mod procedures;
#[cfg(feature = "records")]
pub mod record;
#[cfg(feature = "statistics")]
pub mod statistics;
pub mod stop;
#[cfg(feature = "statistics")]
pub mod streams;
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

/// The README's example compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
