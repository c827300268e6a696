//! One value a line and no header; lines that begin with `#` are comments.
//!
//! Nothing in such a file tells a line that was dropped, doubled or changed:
//! an index's `npts` or `sha256` does. A file that ends within a line is
//! refused.

use super::number::{self, Form, Reading};
use super::text::{Text, excerpt};
use super::{Channel, Fault, RecordError};

/// Whether the first line that is no comment is one number.
pub(super) fn recognises(text: &Text<'_>) -> bool {
    text.lines()
        .find(|line| !line.starts_with('#'))
        .is_some_and(|line| number::is_number(line.trim()))
}

/// Reads the file's one channel.
pub(super) fn read(text: &Text<'_>) -> Result<Channel, RecordError> {
    let mut samples = Vec::with_capacity(text.len());
    for (index, line) in text.lines().enumerate() {
        if line.starts_with('#') {
            continue;
        }
        samples.push(one_number(text, index, line)?.0);
    }
    text.check_ended()?;
    Ok(Channel { dt: None, unit: None, samples, label: None })
}

/// The number that a line or a field of it is, and its form.
pub(super) fn one_number(
    text: &Text<'_>,
    index: usize,
    found: &str,
) -> Result<(f64, Form), RecordError> {
    let found = found.trim();
    match number::read(found) {
        Reading::Finite(value, form) => Ok((value, form)),
        Reading::NotFinite => {
            Err(text.on_line(index, Fault::NotFinite(excerpt(found))))
        }
        Reading::Other => {
            let expected = "a number".to_owned();
            let fault = Fault::Number { found: excerpt(found), expected };
            Err(text.on_line(index, fault))
        }
    }
}
