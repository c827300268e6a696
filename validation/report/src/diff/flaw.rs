//! What is wrong in a file of results, and reading its numbers.

use anyhow::anyhow;
use serde_json::Value;

/// What is wrong at a place of a file.
pub fn flaw(place: &str, found: &str, expected: &str) -> anyhow::Error {
    anyhow!("{place}: found {found}, expected {expected}")
}

/// The kind of a value, in words.
pub fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "a truth value",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    }
}

/// A number, "inf", "-inf" or null.
pub fn amount(place: &str, value: &Value) -> anyhow::Result<f64> {
    let wrong = |found: &str| {
        flaw(place, found, "a number, \"inf\", \"-inf\" or null")
    };
    match value {
        Value::Null => Ok(f64::NAN),
        Value::String(text) if text == "inf" => Ok(f64::INFINITY),
        Value::String(text) if text == "-inf" => Ok(f64::NEG_INFINITY),
        Value::String(text) => Err(wrong(&format!("\"{text}\""))),
        other => other.as_f64().ok_or_else(|| wrong(kind(other))),
    }
}
