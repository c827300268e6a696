//! A number with its interval and unit.

use serde::{Deserialize, Serialize};

use crate::json::nine;

/// A number, and its interval where there is one: of 95 %, and in a claim of
/// [`LEVEL`](super::LEVEL).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Measured {
    /// The value; NaN where there are no data.
    pub value: f64,
    /// The interval.
    pub interval: Option<(f64, f64)>,
}

impl Measured {
    /// A value that is not a sample's: counted or computed exactly.
    #[must_use]
    pub fn exact(value: f64) -> Self {
        Self { value, interval: None }
    }
}

/// [`Measured`] as it is written.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(with = "nine")]
    value: f64,
    #[serde(with = "nine", default = "none", skip_serializing_if = "is_none")]
    low: f64,
    #[serde(with = "nine", default = "none", skip_serializing_if = "is_none")]
    high: f64,
}

/// What stands for an end that is not there.
fn none() -> f64 {
    f64::NAN
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands it so")]
fn is_none(x: &f64) -> bool {
    x.is_nan()
}

impl From<Measured> for Written {
    fn from(Measured { value, interval }: Measured) -> Self {
        let (low, high) = interval.unwrap_or((f64::NAN, f64::NAN));
        Self { value, low, high }
    }
}

impl TryFrom<Written> for Measured {
    type Error = String;

    fn try_from(
        Written { value, low, high }: Written,
    ) -> Result<Self, String> {
        let interval = match (low.is_nan(), high.is_nan()) {
            (true, true) => None,
            _ if low <= high => Some((low, high)),
            _ => {
                return Err(format!(
                    "low {low}, high {high}: expected rising numbers, or \
                     neither"
                ));
            }
        };
        Ok(Self { value, interval })
    }
}

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
