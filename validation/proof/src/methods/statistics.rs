//! Statistics against values from outside: certified data sets, exact and
//! published critical values, other packages, and simulated truths.

pub mod calibration;
pub mod earthquakes;
pub mod fits;
pub mod inference;
pub mod lilliefors;
pub mod risk;
pub mod shaking;
mod truths;
