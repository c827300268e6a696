//! The report's figures: each a pure function from a typed data struct to an
//! SVG, with the CSV of the same numbers.
//!
//! Nothing here integrates or fits: the structs of [`data`] arrive filled.

pub mod data;
