//! The units of findings.

use serde::{Deserialize, Serialize};

/// Unit of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Unit {
    /// A number without dimension.
    #[serde(rename = "1")]
    One,
    /// A number of things.
    #[serde(rename = "count")]
    Count,
    /// A part of a whole, from 0 to 1.
    #[serde(rename = "share")]
    Share,
    /// A difference of two shares, from -1 to 1, in percentage points when
    /// shown.
    #[serde(rename = "points")]
    Points,
    /// A distance of curves or histories, or a difference of two.
    #[serde(rename = "distance")]
    Distance,
    /// A probability, or a difference of two.
    #[serde(rename = "probability")]
    Probability,
}
