//! Names of records, and other texts that come from files and go into
//! results.

use std::fmt::{self, Write as _};

use thiserror::Error;

/// A name that a result cannot carry as it is.
///
/// A control character breaks a line, or acts on a terminal. A text that
/// begins with `=`, `+`, `-` or `@` and is no number is a formula for a
/// spreadsheet that opens the CSV.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("name {0:?}: expected {EXPECTED}")]
pub struct NameError(String);

/// What every result can carry.
pub(crate) const EXPECTED: &str = "no control character, and no =, +, - or @ at the start, which makes a spreadsheet compute the cell";

/// The name of a record, or a cell of an index, if every result can carry
/// it: without a control character, and no formula for a spreadsheet.
///
/// # Errors
/// [`NameError`] with the text.
///
/// ```
/// use rocking::record::result_name;
/// assert_eq!(result_name("RSN1_A-090"), Ok("RSN1_A-090"));
/// assert_eq!(result_name("-118.25"), Ok("-118.25"));
/// for name in ["a\nb", "\u{1b}[31m", "=1+1", "@a", "-a", "+1-1"] {
///     assert!(result_name(name).is_err(), "{name:?}");
/// }
/// ```
pub fn result_name(text: &str) -> Result<&str, NameError> {
    let computed = text.starts_with(['=', '+', '-', '@'])
        // A dash stands for nothing, and a number for itself.
        && text.contains(|c: char| !matches!(c, '-' | ' '))
        && text.parse::<f64>().is_err();
    match computed || text.contains(char::is_control) {
        true => Err(NameError(text.to_owned())),
        false => Ok(text),
    }
}

/// A file's name in a message, each control character as `\u001b`.
pub(crate) struct Escaped<'a>(pub(crate) &'a str);

impl fmt::Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for c in self.0.chars() {
            match c.is_control() {
                true => write!(f, "\\u{:04x}", u32::from(c))?,
                false => f.write_char(c)?,
            }
        }
        Ok(())
    }
}
