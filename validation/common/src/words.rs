//! Numbers and names in words for people.

use std::borrow::Cow;

/// A text that is safe on a terminal: control characters other than line break
/// and tab become escapes like `\u001b`, which JSON reads back.
///
/// ```
/// use rocking_common::words::printable;
/// assert_eq!(printable("a\n\u{1b}[31m"), "a\n\\u001b[31m");
/// ```
pub fn printable(text: &str) -> Cow<'_, str> {
    let acts = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    if !text.contains(acts) {
        return Cow::Borrowed(text);
    }
    let shown = |c: char| match acts(c) {
        true => format!("\\u{:04x}", u32::from(c)),
        false => c.to_string(),
    };
    Cow::Owned(text.chars().map(shown).collect())
}

/// A number for people: four decimals, "none" for NaN.
pub fn rounded_text(x: f64) -> String {
    if x.is_nan() { "none".into() } else { format!("{x:.4}") }
}

/// The letter of a panel: a, b, c and so on.
pub fn letter(panel: usize) -> String {
    let letter = ('a'..='z').nth(panel);
    letter.map_or_else(|| (panel + 1).to_string(), String::from)
}

/// A number rounded to `digits` significant digits.
pub fn rounded(x: f64, digits: usize) -> f64 {
    format!("{x:.0$e}", digits - 1).parse().unwrap_or(x)
}

/// A share in percent; a dash for NaN.
pub fn percent(share: f64, decimals: usize) -> String {
    if share.is_nan() {
        "–".into()
    } else {
        format!("{:.decimals$} %", 100.0 * share)
    }
}

/// The least and the largest of the finite numbers.
pub fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.filter(|x| x.is_finite()).fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |(low, high), x| {
            (if x < low { x } else { low }, if x > high { x } else { high })
        },
    )
}

/// A word with a capital first letter.
pub fn capital(word: &str) -> String {
    let mut letters = word.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

/// Rows of cells as lines: two spaces between columns, each as wide as its widest
/// cell. The cells of a column that `is_right` are aligned to the right.
///
/// ```
/// use rocking_common::words::columns;
/// let rows = [["pga", "0.5"], ["sa:1", "12"]].map(|r| r.map(String::from));
/// let rows = rows.map(Vec::from);
/// assert_eq!(columns(&rows, |k| k == 1), "pga   0.5\nsa:1   12\n");
/// ```
pub fn columns(
    rows: &[Vec<String>],
    is_right: impl Fn(usize) -> bool,
) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let wide = |k: usize| {
        let cells = rows.iter().filter_map(|row| row.get(k));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let columns: Vec<_> = (0..count).map(|k| (wide(k), is_right(k))).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&columns);
        let cells = cells.map(|(cell, &(width, is_right))| match is_right {
            true => format!("{cell:>width$}  "),
            false => format!("{cell:<width$}  "),
        });
        cells.collect::<String>().trim_end().to_owned() + "\n"
    };
    rows.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holds_significant_digits() {
        assert_eq!(rounded(0.123_456, 3), 0.123);
        assert_eq!(rounded(-98_765.0, 1), -1e5);
        assert!(rounded(f64::INFINITY, 1).is_infinite());
    }
}
