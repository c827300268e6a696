//! Names of records, and other texts that come from files and go into
//! results.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::fmt::{self, Write as _};

use thiserror::Error;

/// A name that a result cannot contain.
///
/// A control character breaks a line, or acts on a terminal. A text that
/// begins with `=`, `+`, `-` or `@` and is no number is a formula for a
/// spreadsheet that opens the CSV.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("name {0:?}: expected {EXPECTED}")]
pub struct NameError(String);

/// Rule for the names in results.
pub const EXPECTED: &str = "no control character, and no =, +, - or @ at the start, which makes a spreadsheet compute the cell";

/// The name of a record, or a cell of an index, if every result can contain
/// it: without a control character, and not a formula for a spreadsheet.
///
/// # Errors
/// [`NameError`] with the text.
///
/// ```
/// use rocking::accelerogram::result_name;
/// assert_eq!(result_name("RSN1_A-090"), Ok("RSN1_A-090"));
/// assert_eq!(result_name("-118.25"), Ok("-118.25"));
/// for name in ["a\nb", "\u{1b}[31m", "=1+1", "@a", "-a", "+1-1"] {
///     assert!(result_name(name).is_err(), "{name:?}");
/// }
/// ```
pub fn result_name(text: &str) -> Result<&str, NameError> {
    let computed = text.starts_with(['=', '+', '-', '@'])
        // Dashes mark an empty cell, and a number is no formula.
        && text.contains(|c: char| !matches!(c, '-' | ' '))
        && text.parse::<f64>().is_err();
    match computed || text.contains(char::is_control) {
        true => Err(NameError(text.to_owned())),
        false => Ok(text),
    }
}

/// Why names do not distinguish the records of a suite.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SuiteNameError {
    /// Two records that results could not distinguish.
    #[error("two records are named {0:?}: expected different names")]
    Same(String),
    /// A record without a name among others that have one.
    #[error(
        "record {0} has no name: expected a name for every record, or for none"
    )]
    Unnamed(usize),
}

/// The names by which results distinguish the records of a suite: those given,
/// or, if no record has one, the places `1`, `2`, ...
///
/// # Errors
/// [`SuiteNameError`] for a name that two records share, and for a record
/// without a name among others that have one.
///
/// ```
/// use rocking::accelerogram::suite_names;
/// assert_eq!(suite_names(&["a", "b"])?, ["a", "b"]);
/// assert_eq!(suite_names(&["", ""])?, ["1", "2"]);
/// assert!(suite_names(&["a", "a"]).is_err());
/// assert!(suite_names(&["a", ""]).is_err());
/// # Ok::<(), rocking::accelerogram::SuiteNameError>(())
/// ```
pub fn suite_names<'a>(
    given: &[&'a str],
) -> Result<Vec<Cow<'a, str>>, SuiteNameError> {
    let unnamed = given.iter().position(|name| name.is_empty());
    if unnamed.is_some() && given.iter().all(|name| name.is_empty()) {
        return Ok((1..=given.len()).map(|i| i.to_string().into()).collect());
    }
    if let Some(place) = unnamed {
        return Err(SuiteNameError::Unnamed(place + 1));
    }
    let mut seen = BTreeSet::new();
    match given.iter().find(|name| !seen.insert(**name)) {
        Some(name) => Err(SuiteNameError::Same((*name).to_owned())),
        None => Ok(given.iter().map(|name| Cow::Borrowed(*name)).collect()),
    }
}

/// True if the names are the places that [`suite_names`] gives to records
/// without a name.
pub fn are_places<S: AsRef<str>>(names: &[S]) -> bool {
    let is_place =
        |(i, name): (usize, &S)| name.as_ref() == (i + 1).to_string();
    !names.is_empty() && names.iter().enumerate().all(is_place)
}

/// A file's name in a message, each control character as `\u001b`.
pub struct EscapedName<'a>(pub &'a str);

impl fmt::Display for EscapedName<'_> {
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
