//! The engine of `reports/lab.html`: a question as JSON, an answer as JSON.
//!
//! The page runs this crate as WebAssembly. The gate runs the same functions
//! natively and compares the bits.

#![deny(missing_docs)]

mod abi;
mod bits;
mod block;
mod case;
mod question;

pub use question::answer;
