//! Other arithmetic for the core's generic source: single precision, and
//! double-double with a mistake.

mod decimal;
mod rounded;
mod single;
mod wide;

pub use decimal::decimal;
pub use rounded::RoundedConstants;
pub use single::Single;
pub use wide::wide;
