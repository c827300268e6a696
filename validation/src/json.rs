//! JSON numbers: those of the command line, which every reader holds as
//! numbers, and those of the data files, which tell infinity.

use serde_json::{Value, json};

use crate::words;

/// A number as the command line prints it: shortest digits that read back to
/// the same double, `null` where it is infinite or not a number.
#[must_use]
pub fn number(x: f64) -> Value {
    serde_json::Number::from_f64(x).map_or(Value::Null, Value::Number)
}

/// A number that may be missing.
#[must_use]
pub fn optional(x: Option<f64>) -> Value {
    x.map_or(Value::Null, number)
}

/// A list of numbers.
#[must_use]
pub fn numbers(values: &[f64]) -> Value {
    Value::Array(values.iter().copied().map(number).collect())
}

/// A number as data files hold it: `"inf"` or `"-inf"` for infinities,
/// `null` for NaN.
#[must_use]
pub fn extended(x: f64) -> Value {
    match number(x) {
        Value::Null if x == f64::INFINITY => Value::from("inf"),
        Value::Null if x == f64::NEG_INFINITY => Value::from("-inf"),
        finite => finite,
    }
}

/// A list of numbers as data files hold it.
#[must_use]
pub fn all_extended(values: &[f64]) -> Value {
    Value::Array(values.iter().copied().map(extended).collect())
}

/// A number rounded to nine significant digits: what a bound supports, and
/// no more than a reader compares.
#[must_use]
pub fn rounded(x: f64) -> Value {
    extended(words::rounded(x, 9))
}

/// The two ends of an interval, or null.
#[must_use]
pub fn ends(interval: Option<(f64, f64)>) -> Value {
    interval.map_or(Value::Null, |(a, b)| json!([rounded(a), rounded(b)]))
}
