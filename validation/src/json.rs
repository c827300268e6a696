//! JSON as the command line prints it: numbers that round-trip, `"inf"` for
//! infinity, never NaN.

use serde_json::Value;

/// A number as JSON: shortest digits that read back to the same double,
/// `"inf"` or `"-inf"` for infinities, `null` for NaN.
#[must_use]
pub fn number(x: f64) -> Value {
    match serde_json::Number::from_f64(x) {
        Some(finite) => Value::Number(finite),
        None if x == f64::INFINITY => Value::from("inf"),
        None if x == f64::NEG_INFINITY => Value::from("-inf"),
        None => Value::Null,
    }
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
