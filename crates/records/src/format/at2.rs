//! PEER's AT2: a few lines of header, then fixed-width samples.
//!
//! Generations differ in the counting line: `NPTS=  4096, DT= .0100 SEC`
//! with or without commas, unit, filter poles and blanks, and in the oldest
//! files `4096  .0100  NPTS, DT`. Lines without a digit after the samples
//! (`*** End Data ***`) are ignored.

use super::csv::bracketed;
use super::{Channel, Format};
use crate::error::{Fault, Result};
use crate::fields;
use crate::number;
use crate::text::{self, Text, excerpt};
use rocking::units::AccelerationUnit;

/// Number of lines that are searched for the counting line.
const HEADER_LINES: usize = 20;

const COUNTING_LINE: &str = "a line like `NPTS= 4096, DT= .0100 SEC`";

/// Parts of the first lines of a file without a counting line.
const TITLES: [&str; 4] = [
    "STRONG MOTION DATABASE",
    "STRONG-MOTION DATA",
    "TIME SERIES IN UNITS OF",
    "TIME HISTORY IN UNITS OF",
];

/// Marks that may follow a unit.
const MARKS: [char; 4] = ['.', ',', ';', ':'];

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "at2",
    files: "AT2",
    source: "PEER",
    azimuths: true,
    azimuth_in_name: true,
    recognises,
    read,
    ..Format::BASE
};

/// Whether the content is AT2's.
fn recognises(text: &Text<'_>) -> bool {
    let titled = |line| TITLES.iter().any(|title| text::contains(line, title));
    counting_line(text).is_some() || text.lines().take(4).any(titled)
}

fn counting_line(text: &Text<'_>) -> Option<usize> {
    text.lines()
        .take(HEADER_LINES)
        .position(|line| text::after(line, "NPTS").is_some())
}

/// Reads the file's one channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>> {
    let Some(counting) = counting_line(text) else {
        return Err(text.at_end(Fault::Ends(COUNTING_LINE)));
    };
    let unit = unit(text, counting)?;
    let (count, dt) = counts(text, counting)?;
    let mut first = counting + 1;
    while text.line(first).is_some_and(|line| line.trim().is_empty()) {
        first += 1;
    }
    let end = text.end_of_numbers(first);
    let layout = fields::infer(text, first, end, 0);
    let samples = fields::read(text, first, end, layout)?;
    text.check_count(end - 1, samples.len(), count)?;
    let label = component(text);
    Ok(vec![Channel { label, ..Channel::of(dt, unit, samples) }])
}

/// The component. The second line has event, date, station and component.
fn component(text: &Text<'_>) -> Option<String> {
    let mut parts = text.line(1)?.rsplit(',');
    let last = parts.next()?.trim();
    let named = parts.count() >= 2 && !last.is_empty() && last.len() <= 8;
    named.then(|| last.to_owned())
}

/// The unit named before the counting line.
fn unit(text: &Text<'_>, counting: usize) -> Result<Option<AccelerationUnit>> {
    for (index, line) in text.lines().take(counting).enumerate() {
        let units = text::after(line, "UNITS");
        let Some(rest) = units.and_then(|rest| text::after(rest, "OF")) else {
            match in_unit(line) {
                Some(None) => return Err(text.quantity(index)),
                Some(unit) => return Ok(unit),
                None => continue,
            }
        };
        let title = &line[..line.len() - rest.len()];
        let other = ["VELOCITY", "DISPLACEMENT", "SPECTR"];
        if other.iter().any(|name| text::contains(title, name)) {
            return Err(text.quantity(index));
        }
        let named = text::first_word(rest).trim_end_matches(MARKS);
        let refuse = || {
            let place = line.len() - rest.trim_start().len();
            text.at(index, place, Fault::Unit(excerpt(named)))
        };
        return AccelerationUnit::parse(named).map(Some).ok_or_else(refuse);
    }
    Ok(None)
}

/// The unit of a line such as `ACCELERATION IN G`, `Accelerations (g)` or
/// `The units are (g)`; `Some(None)` for the unit of another quantity.
fn in_unit(line: &str) -> Option<Option<AccelerationUnit>> {
    let named =
        |words: &[&str]| words.iter().find_map(|word| text::after(line, word));
    let unit = |rest| {
        let word = text::after(rest, "IN");
        let word = word.and_then(|rest| rest.split_whitespace().next());
        word.or_else(|| bracketed(rest).next())
    };
    let units = ["ACCELERATION", "ACCELERATIONS", "ACC", "UNITS", "UNIT"];
    if let Some(rest) = named(&units) {
        let word = unit(rest)?.trim_end_matches(MARKS);
        return AccelerationUnit::parse(word).map(Some);
    }
    let rest = named(&["VELOCITY", "DISPLACEMENT"])?;
    let word = unit(rest)?.to_ascii_lowercase();
    let length = ["cm", "m", "in", "mm"];
    let other = word.split(['/', '.', ',']).next().unwrap_or("");
    length.contains(&other).then_some(None)
}

/// The number of samples and the sampling interval on the counting line.
fn counts(text: &Text<'_>, index: usize) -> Result<(usize, Option<f64>)> {
    let line = text.line(index).unwrap_or("");
    let after = |word| {
        let rest = text::after(line, word)?;
        Some(rest.trim_start_matches([' ', '\t', '=', ':', ',']))
    };
    let starts_number = |rest: &str| {
        rest.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
    };
    let npts = after("NPTS").unwrap_or("");
    let dt = after("DT");
    let mut values = line.split([' ', '\t', ',']).filter(|p| !p.is_empty());
    let (found, count, interval, expected) = match starts_number(npts) {
        true => (npts, read_count(npts), dt, "a number of samples"),
        // The oldest generation: values before their names.
        false => {
            let count = values.next().and_then(read_count);
            let interval = dt.map(|_| values.next().unwrap_or(""));
            (line, count, interval, COUNTING_LINE)
        }
    };
    let refuse = || text.differs(index, excerpt(found), expected);
    let count = count.ok_or_else(refuse)?;
    let dt = interval.map(read_interval).transpose();
    dt.map(|dt| (count, dt)).map_err(|fault| text.on_line(index, fault))
}

/// The count at the beginning of a text, ended by a separator.
fn read_count(rest: &str) -> Option<usize> {
    let end = rest.find([' ', '\t', ',', ';']).unwrap_or(rest.len());
    let digits = &rest[..end];
    let plain = digits.bytes().all(|b| b.is_ascii_digit());
    digits.parse().ok().filter(|_| plain)
}

/// The interval at the beginning of a text, in seconds if a unit follows.
fn read_interval(rest: &str) -> Result<f64, Fault> {
    let end = number::token_at(rest.as_bytes(), 0)
        .map_or(rest.len(), |token| token.end);
    let refuse = || Fault::Interval(excerpt(rest));
    let seconds = number::finite(&rest[..end]).filter(|x| *x > 0.0);
    let seconds = seconds.ok_or_else(refuse)?;
    let unit = rest[end..].trim_start();
    let unit = unit.split(|c: char| !c.is_alphanumeric()).next().unwrap_or("");
    let known = ["", "S", "SEC", "SECS", "SECOND", "SECONDS", "NPTS"];
    let plain = known.iter().any(|name| unit.eq_ignore_ascii_case(name));
    // If the unit is missing, a number of filter poles may follow directly.
    if plain || unit.bytes().all(|b| b.is_ascii_digit()) {
        return Ok(seconds);
    }
    Err(refuse())
}
