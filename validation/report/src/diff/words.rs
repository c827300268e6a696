//! Numbers and names as an engineer says them.

use rocking_common::words::rounded;

/// A number with at most so many significant digits; "none" for NaN.
pub fn plain(x: f64, digits: usize) -> String {
    if x.is_nan() {
        return "none".into();
    }
    if x.is_infinite() {
        return if x > 0.0 { "inf".into() } else { "-inf".into() };
    }
    let whole = x.fract() == 0.0 && x.abs() < 1e9;
    let value = if whole { x } else { rounded(x, digits) };
    let size = value.abs();
    if value == 0.0 || (1e-4..1e9).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Two numbers with as few digits as tell them apart, three at least.
pub fn pair(old: f64, new: f64) -> (String, String) {
    let at = |digits| (plain(old, digits), plain(new, digits));
    (3..17).map(at).find(|(a, b)| a != b).unwrap_or_else(|| at(17))
}

/// A share as a percentage with its sign.
pub fn percent(share: f64) -> String {
    let sign = if share < 0.0 { "-" } else { "+" };
    format!("{sign}{} %", plain(100.0 * share.abs(), 2))
}
