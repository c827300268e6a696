//! Numbers of the data files in JSON, with infinities. The command line prints
//! `null` for an infinite number or NaN, like `json!`.

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;

use crate::words;

/// A number of a data file, with all its digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extended(pub f64);

impl Serialize for Extended {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        extended(self.0).serialize(to)
    }
}

impl<'de> Deserialize<'de> for Extended {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        nine::deserialize(from).map(Self)
    }
}

/// A number in the form of data files: `"inf"` or `"-inf"` for infinities,
/// `null` for NaN.
pub fn extended(x: f64) -> Value {
    match Value::from(x) {
        Value::Null if x == f64::INFINITY => Value::from("inf"),
        Value::Null if x == f64::NEG_INFINITY => Value::from("-inf"),
        finite => finite,
    }
}

/// A number rounded to nine significant digits: as many as a bound supports, and
/// enough for a comparison.
pub fn rounded(x: f64) -> Value {
    extended(words::rounded(x, 9))
}

/// Numbers of nine significant digits in serialized types, in the form of
/// [`rounded`].
pub mod nine {
    use serde::de::Error as _;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use serde_json::Value;

    /// Writes a number.
    ///
    /// # Errors
    /// The serializer's.
    pub fn serialize<S: Serializer>(
        x: &f64,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        super::rounded(*x).serialize(to)
    }

    /// Reads a number.
    ///
    /// # Errors
    /// For anything but a number, `"inf"`, `"-inf"` or `null`.
    pub fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<f64, D::Error> {
        let found = Value::deserialize(from)?;
        let number = match &found {
            Value::Null => Some(f64::NAN),
            Value::String(text) if text == "inf" => Some(f64::INFINITY),
            Value::String(text) if text == "-inf" => Some(f64::NEG_INFINITY),
            other => other.as_f64(),
        };
        number.ok_or_else(|| {
            let expected = "a number, \"inf\", \"-inf\" or null";
            D::Error::custom(format!("found {found}, expected {expected}"))
        })
    }
}
