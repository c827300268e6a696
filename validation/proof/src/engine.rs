//! The core behind its public interface.

mod core;
mod wide;

pub use self::core::{
    Core, Quotient, certify, respond, respond_at_order, respond_in,
};
pub use wide::{Precision, WideTrace};
