//! Units of two columns, by a header line or a comment.

use crate::error::{Fault, Result};
use crate::text::{Text, excerpt};
use rocking::units::AccelerationUnit;

/// Units of two columns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Units {
    /// Number of units of the time column in one second.
    pub(super) per_second: f64,
    /// Unit of acceleration, if it is stated.
    pub(crate) acceleration: Option<AccelerationUnit>,
}

impl Units {
    const UNSTATED: Self = Self { per_second: 1.0, acceleration: None };

    /// These units, replaced by those that `other` states.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            per_second: self.per_second.max(other.per_second),
            acceleration: other.acceleration.or(self.acceleration),
        }
    }
}

/// Units in brackets on lines that begin with `#`.
///
/// # Errors
/// [`Fault::Unit`] for a unit of acceleration that is not known.
pub(crate) fn comments(text: &Text<'_>) -> Result<Units> {
    let mut units = Units::UNSTATED;
    for (index, line) in text.lines().enumerate() {
        let Some(line) = line.strip_prefix('#') else {
            if index == 0 { continue } else { break }
        };
        let lower = line.to_ascii_lowercase();
        let named = ["acc", "a(", "a [", "a (", "unit"];
        if !named.iter().any(|name| lower.contains(name)) {
            continue;
        }
        for name in bracketed(line) {
            if let Some(unit) = AccelerationUnit::parse(name) {
                units.acceleration = Some(unit);
            } else if let Some(per_second) = per_second(name) {
                units.per_second = per_second;
            } else if is_unit(name) {
                return Err(text.on_line(index, Fault::Unit(excerpt(name))));
            }
        }
    }
    Ok(units)
}

/// Whether a text in brackets is meant as a unit of acceleration.
fn is_unit(name: &str) -> bool {
    name.contains("/s") || name.contains("s-2") || name.contains("s^-2")
}

/// Number of units of this name in one second.
fn per_second(name: &str) -> Option<f64> {
    let name = name.trim().to_ascii_lowercase();
    match name.as_str() {
        "s" | "sec" | "secs" | "second" | "seconds" => Some(1.0),
        "ms" | "msec" | "millisecond" | "milliseconds" => Some(1000.0),
        _ => None,
    }
}

/// Names of a column of times, before its unit.
const TIMES: [&str; 7] =
    ["t", "time", "times", "sec", "secs", "second", "seconds"];

/// Parts of names of columns with other quantities.
const OTHERS: [&str; 6] = ["vel", "disp", "spect", "psa", "psv", "fourier"];

/// Units of the columns that a header line names.
///
/// # Errors
/// [`Fault::Header`] for a first column that is not a time,
/// [`Fault::Quantity`] for a second column that is not an acceleration,
/// [`Fault::Unit`] and [`Fault::Interval`] for an unknown unit.
pub(super) fn header(
    text: &Text<'_>,
    index: usize,
    cells: &[&str],
) -> Result<Units> {
    let line = text.line(index).unwrap_or("");
    let (time, value) = columns(line, cells);
    let (time, time_unit) = named(&time);
    let (value, value_unit) = named(&value);
    if !TIMES.contains(&time.as_str()) {
        let expected = "a first column of times, named t or time";
        return Err(text.header(index, expected));
    }
    let spectrum = ["sa", "sv", "sd"].contains(&value.as_str());
    if spectrum || OTHERS.iter().any(|other| value.contains(other)) {
        return Err(text.quantity(index));
    }
    let in_seconds = |unit| {
        let refuse = || text.on_line(index, Fault::Interval(excerpt(unit)));
        per_second(unit).ok_or_else(refuse)
    };
    let per_second = time_unit.map_or(Ok(1.0), in_seconds)?;
    let unit = value_unit.map(|unit| text.unit(index, unit));
    let acceleration = unit.transpose()?;
    Ok(Units { per_second, acceleration })
}

/// The two names of a header line with these cells. Where blanks separate
/// them, a unit in brackets belongs to the word before.
fn columns(line: &str, cells: &[&str]) -> (String, String) {
    if let [time, value] = cells {
        let bare = |cell: &str| cell.replace('\'', "");
        return (bare(time), bare(value));
    }
    let clean = line.replace(['"', '\''], "");
    let mut words = clean.split_whitespace().peekable();
    let mut time = words.next().unwrap_or("").to_owned();
    if words.peek().is_some_and(|word| word.starts_with(['(', '['])) {
        time.push_str(words.next().unwrap_or(""));
    }
    (time, words.collect::<Vec<_>>().join(" "))
}

/// A column's name in small letters, and its unit.
fn named(column: &str) -> (String, Option<&str>) {
    let column = column.trim();
    let lower = column.to_ascii_lowercase();
    if let Some(unit) = bracketed(column).next() {
        let end = column.find(['(', '[']).unwrap_or(column.len());
        return (lower[..end].trim().to_owned(), Some(unit));
    }
    let suffixes = [
        ("_cm_s2", "cm/s2"),
        ("_m_s2", "m/s2"),
        ("_gal", "gal"),
        ("_g", "g"),
        ("_ms", "ms"),
        ("_sec", "s"),
        ("_s", "s"),
    ];
    let found = suffixes.iter().find_map(|(suffix, unit)| {
        Some((lower.strip_suffix(suffix)?.to_owned(), Some(*unit)))
    });
    found.unwrap_or((lower, None))
}

/// Texts in round or square brackets.
pub(crate) fn bracketed(text: &str) -> impl Iterator<Item = &str> {
    text.split(['(', '[']).skip(1).filter_map(|part| {
        let end = part.find([')', ']'])?;
        Some(part[..end].trim())
    })
}
