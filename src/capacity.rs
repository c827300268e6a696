//! Capacities: the intensity at which a block's response reaches a level.
//!
//! A [`ResponseCurve`] is one record's EDP against IM, piecewise linear
//! between vertices, with a separate overturning intensity. It is
//! inverted level by level ([`Crossings`]) and read by stripes
//! ([`ResponseCurve::edp_at`]).

mod crossings;
mod curve;

pub use crossings::{Capacity, Crossings, InversionRule};
pub use curve::{CapacityError, ResponseCurve};

#[cfg(test)]
mod tests;
