//! USGS SMC: 11 lines of text, 48 integers (8I10), 50 reals (5E15.7),
//! comments, then samples in 8E10.4, in cm/s2.
//!
//! The text names event, station and component. The largest and the least
//! sample must be the reals 30 and 32.

use super::{Channel, Format, GAL};
use crate::error::{Fault, Result};
use crate::fields::{self, FieldLayout};
use crate::text::{self, Text};

const TEXT_LINES: usize = 11;
const INTEGERS: FieldLayout = FieldLayout::even(8, 10);
const INTEGER_LINES: usize = 6;
const REALS: FieldLayout = FieldLayout::even(5, 15);
const REAL_LINES: usize = 10;
const SAMPLES: FieldLayout = FieldLayout::even(8, 10);

/// Above the known real values: the null value is 1.7e38.
const NULL: f64 = 1e38;

const KINDS: [&str; 6] = [
    "1 UNCORRECTED ACCELEROGRAM",
    "2 CORRECTED ACCELEROGRAM",
    "3 VELOCITY",
    "4 DISPLACEMENT",
    "5 RESPONSE SPECTRA",
    "6 FOURIER AMPLITUDE SPECTRA",
];

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "smc",
    files: "SMC",
    source: "USGS",
    azimuths: true,
    recognises: |text| is_one_of(text, &KINDS),
    read,
    ..Format::BASE
};

/// Whether the first line names one of `kinds`.
fn is_one_of(text: &Text<'_>, kinds: &[&str]) -> bool {
    let line = text.line(0).unwrap_or("");
    let line = line.trim_start().to_ascii_uppercase();
    kinds.iter().any(|kind| line.starts_with(kind))
}

/// Reads the file's one channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>> {
    if !is_one_of(text, &KINDS[..2]) {
        return Err(text.quantity(0));
    }
    let reals = TEXT_LINES + INTEGER_LINES;
    let comments = reals + REAL_LINES;
    if text.len() <= comments {
        return Err(text.at_end(Fault::Ends("27 header lines and samples")));
    }
    let integers = fields::read(text, TEXT_LINES, reals, Some(INTEGERS))?;
    let count = |place: usize| {
        let value = integers[place - 1];
        // The null value is -32768.
        let fine = (0.0..1e9).contains(&value) && value.fract() == 0.0;
        fine.then_some(value as usize).ok_or_else(|| {
            let index = TEXT_LINES + (place - 1) / INTEGERS.per_line;
            let found = format!("integer {place} is {value}");
            let expected = "a number of comments (16) or samples (17)";
            text.differs(index, found, expected)
        })
    };
    if integers.len() != INTEGER_LINES * INTEGERS.per_line {
        return Err(text.on_line(reals - 1, Fault::Ends("48 integers")));
    }
    let first = comments.saturating_add(count(16)?);
    let expected = count(17)?;
    let reals = fields::read(text, reals, comments, Some(REALS))?;
    let dt = interval(text, &reals)?;
    if first >= text.len() {
        return Err(text.at_end(Fault::Count { found: 0, expected }));
    }
    let samples = fields::read(text, first, text.len(), Some(SAMPLES))?;
    text.check_count(text.len() - 1, samples.len(), expected)?;
    check_peak(text, &samples, &reals)?;
    let (label, site) = component(text);
    Ok(vec![Channel { label, site, ..Channel::of(dt, GAL, samples) }])
}

/// Compares the peak with the largest and the least sample in the header.
fn check_peak(text: &Text<'_>, samples: &[f64], reals: &[f64]) -> Result<()> {
    let known = |place: usize| {
        reals.get(place - 1).copied().filter(|x| x.abs() < NULL)
    };
    let (Some(largest), Some(least)) = (known(30), known(32)) else {
        return Ok(());
    };
    let expected = largest.abs().max(least.abs());
    // Samples have four digits.
    text.check_peak(samples, expected, 1e-3 * expected, GAL)
}

/// The component, and event with station, by the lines `1989 10 18 ...` and
/// `station = San Francisco component= up`.
fn component(text: &Text<'_>) -> (Option<String>, Option<String>) {
    let head = || text.lines().take(TEXT_LINES);
    let Some((station, name)) = head().find_map(|line| {
        let (station, name) = line.split_once("component=")?;
        let station = station.trim_start().strip_prefix("station =")?;
        Some((station.trim(), name.trim()))
    }) else {
        return (None, None);
    };
    let event = head().nth(3).unwrap_or("");
    let words = |text: &str| {
        text.split_ascii_whitespace().collect::<Vec<_>>().join(" ")
    };
    let site = format!("{} {}", words(event), words(station));
    (text::named(name), Some(site))
}

/// The interval from the second real value, samples per second.
fn interval(text: &Text<'_>, reals: &[f64]) -> Result<f64> {
    match reals.get(1) {
        // The null value is 1.7e38.
        Some(&rate) if rate > 0.0 && rate < 1e6 => Ok(1.0 / rate),
        found => {
            let index = TEXT_LINES + INTEGER_LINES;
            let found =
                found.map_or_else(String::new, |rate| format!("{rate:e}"));
            let expected = "a positive number of samples per second";
            let fault = Fault::Header { found, expected };
            Err(text.at(index, REALS.width, fault))
        }
    }
}
