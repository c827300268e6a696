//! Numbers as people read them.

/// A number for people: four decimals, "none" where there is none.
#[must_use]
pub fn rounded_text(x: f64) -> String {
    if x.is_nan() { "none".into() } else { format!("{x:.4}") }
}

/// The letter of a panel: a, b, c and so on.
#[must_use]
pub fn letter(panel: usize) -> String {
    let letter = u8::try_from(panel).ok().and_then(|i| b'a'.checked_add(i));
    match letter {
        Some(c) if c.is_ascii_lowercase() => char::from(c).to_string(),
        _ => (panel + 1).to_string(),
    }
}
