//! Numbers as people read them.

/// A number for people: four decimals, "none" where there is none.
#[must_use]
pub fn rounded_text(x: f64) -> String {
    if x.is_nan() { "none".into() } else { format!("{x:.4}") }
}
