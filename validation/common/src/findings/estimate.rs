//! Estimates in data files.

use rocking_statistics::estimate::EstimateError;
use rocking_statistics::{Estimate, Interval, Range};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::json::{nine, rounded};

/// The keys of an estimate: `value`, and `low` and `high` if there is an
/// interval.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    #[serde(with = "nine")]
    value: f64,
    #[serde(with = "nine", default = "none", skip_serializing_if = "is_none")]
    low: f64,
    #[serde(with = "nine", default = "none", skip_serializing_if = "is_none")]
    high: f64,
}

/// The number of a missing end.
fn none() -> f64 {
    f64::NAN
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands it so")]
fn is_none(x: &f64) -> bool {
    x.is_nan()
}

impl From<&Estimate> for Keys {
    fn from(estimate: &Estimate) -> Self {
        let (low, high) = estimate.ends();
        Self { value: estimate.value(), low, high }
    }
}

impl TryFrom<Keys> for Estimate {
    type Error = EstimateError;

    fn try_from(keys: Keys) -> Result<Self, EstimateError> {
        let Keys { value, low, high } = keys;
        if low.is_nan() && high.is_nan() {
            return Ok(Self::exact(value));
        }
        // The unit of the quantity, not its range, is in the file.
        Self::try_new(value, Interval::try_new(low, high)?, Range::Real)
    }
}

/// Writes an estimate.
///
/// # Errors
/// The serializer's.
pub fn serialize<S: Serializer>(
    estimate: &Estimate,
    to: S,
) -> Result<S::Ok, S::Error> {
    Keys::from(estimate).serialize(to)
}

/// Reads an estimate.
///
/// # Errors
/// If the shape is another one, or the ends do not rise.
pub fn deserialize<'de, D: Deserializer<'de>>(
    from: D,
) -> Result<Estimate, D::Error> {
    Keys::deserialize(from)?.try_into().map_err(D::Error::custom)
}

/// A list of estimates.
pub mod list {
    use crate::findings::estimate::*;

    /// Writes a list.
    ///
    /// # Errors
    /// The serializer's.
    pub fn serialize<S: Serializer>(
        estimates: &[Estimate],
        to: S,
    ) -> Result<S::Ok, S::Error> {
        to.collect_seq(estimates.iter().map(Keys::from))
    }

    /// Reads a list.
    ///
    /// # Errors
    /// If the shape is another one, or the ends do not rise.
    pub fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Vec<Estimate>, D::Error> {
        let all = Vec::<Keys>::deserialize(from)?.into_iter();
        let all = all.map(Estimate::try_from).collect::<Result<_, _>>();
        all.map_err(D::Error::custom)
    }
}

/// An estimate whose ends are always written: `null` without an interval.
pub mod complete {
    use crate::findings::estimate::*;

    pub use crate::findings::estimate::deserialize;

    /// Writes an estimate.
    ///
    /// # Errors
    /// The serializer's.
    pub fn serialize<S: Serializer>(
        estimate: &Estimate,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        let Keys { value, low, high } = estimate.into();
        let all = [("value", value), ("low", low), ("high", high)];
        to.collect_map(all.map(|(key, x)| (key, rounded(x))))
    }
}
