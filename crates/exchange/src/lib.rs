//! Results of [`rocking`] as texts for other programs: tables as CSV,
//! and fragilities in the formats of OpenQuake, pelicun and PACT.
//!
//! The command line and the Python package write these files, and both call
//! this crate, which returns texts and opens no files.
//!
//! ```
//! use rocking::Block;
//! use rocking::integrator::Model;
//! use rocking_procedures::ModelError;
//! use rocking_records::intensity::Intensity;
//! use rocking_statistics::Lognormal;
//! use rocking_exchange::{
//!     BlockFragility, ExchangeFormat, Id, LimitState, unit_intensity,
//! };
//! let block = Block::try_new(0.15, 3.0)?;
//! let pga = Intensity::Pga;
//! let unit_g = unit_intensity(pga, &block, Model::Nonlinear, 9.80665);
//! let fragility = Lognormal::try_new(1.0, 0.92, 0.71)?.scaled(unit_g)?;
//! let one = BlockFragility {
//!     id: Id::of(&block)?,
//!     block,
//!     eta: Some(0.92),
//!     im: "pga".parse()?,
//!     limit_states: vec![LimitState { name: "overturning".parse()?, fragility }],
//!     origin: String::from("86 capacities"),
//!     model_error: ModelError::default(),
//! };
//! let nrml = ExchangeFormat::named("nrml")?.texts(&[one])?.main;
//! assert!(nrml.contains("<fragilityFunction id=\"block_a0_15_p3\""));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![deny(missing_docs)]

pub mod columns;
mod format;
mod fragility;
pub mod ida;
pub mod read;
pub mod sample;
pub mod table;

pub use format::{ExchangeError, ExchangeFormat, Pact, Texts};
pub use fragility::{
    BlockFragility, Id, LimitState, unit_intensity, unstated_origin,
};
pub use read::FileError;
