//! Recorded accelerograms.

mod accelerogram;

pub use accelerogram::{Accelerogram, AccelerogramError};
