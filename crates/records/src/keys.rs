//! Headers of lines `key value` or `key : value`.

use super::number;
use super::text::Text;
use crate::error::{Fault, RecordError};

/// Lines among which header keys are sought.
const HEADER_LINES: usize = 80;

/// Index of the header line that begins with `key`, and what follows the
/// key and a colon.
pub(super) fn find<'a>(
    text: &Text<'a>,
    key: &str,
) -> Option<(usize, &'a str)> {
    let lines = text.lines().take(HEADER_LINES);
    lines.enumerate().find_map(|(index, line)| {
        let rest = line.trim_start().strip_prefix(key)?;
        let rest = rest.trim_start();
        Some((index, rest.strip_prefix(':').unwrap_or(rest).trim()))
    })
}

/// Whether the header has lines that begin with each of these keys.
pub(super) fn has(text: &Text<'_>, keys: [&str; 2]) -> bool {
    keys.iter().all(|key| find(text, key).is_some())
}

/// The value of `key`.
pub(super) fn value<'a>(
    text: &Text<'a>,
    key: &'static str,
) -> Result<(usize, &'a str), RecordError> {
    find(text, key).ok_or_else(|| text.at_end(Fault::Ends(key)))
}

/// The finite number at `key`, before `suffix`.
pub(super) fn number(
    text: &Text<'_>,
    key: &'static str,
    suffix: &str,
) -> Result<(usize, f64), RecordError> {
    let (index, found) = value(text, key)?;
    let digits = found.strip_suffix(suffix).unwrap_or(found).trim_end();
    let number = number::finite(digits).map(|x| (index, x));
    number.ok_or_else(|| text.header(index, "a number"))
}

/// The positive number at `key`, before `suffix`.
pub(super) fn positive(
    text: &Text<'_>,
    key: &'static str,
    suffix: &str,
) -> Result<f64, RecordError> {
    match number(text, key, suffix)? {
        (_, x) if x > 0.0 => Ok(x),
        (index, _) => Err(text.header(index, "a positive number")),
    }
}

/// The count at `key`.
pub(super) fn count(
    text: &Text<'_>,
    key: &'static str,
) -> Result<usize, RecordError> {
    let (index, found) = value(text, key)?;
    let count = found.parse().ok().filter(|n: &usize| *n > 0);
    count.ok_or_else(|| text.header(index, "a number of samples"))
}

/// The peak of `samples` against the one that the header states.
pub(super) fn check_peak(
    text: &Text<'_>,
    samples: &[f64],
    expected: f64,
    allowed: f64,
    unit: rocking::units::AccelerationUnit,
) -> Result<(), RecordError> {
    let found = samples.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()));
    let expected = expected.abs();
    if (found - expected).abs() <= allowed {
        return Ok(());
    }
    Err(text.at_end(Fault::Peak { found, expected, unit }))
}
