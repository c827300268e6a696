//! AFAD's text (Turkey, until 2018): lines `KEY : value`, a line that names
//! the columns, then a line of three samples in gal for each time.
//!
//! ```text
//! STRONG GROUND MOTION RECORDS OF TURKIYE
//! NUMBER OF DATA          : 5456
//! SAMPLING INTERVAL (sec) : 0.01
//! RAW PGA VALUES (gal)    : (N-S) 0.316125 (E-W) 0.331524 (U-D) 0.363887
//!        N-S          E-W          U-D
//! ```
//!
//! The peaks of the samples, as they are written, must be those of the header.
//! AFAD's files of today are in the format of ESM.

use super::{Channel, Format, GAL};
use crate::error::{Fault, Result};
use crate::fields::one_number;
use crate::number::{self, Form};
use crate::text::{Text, excerpt};

const COUNT: &str = "NUMBER OF DATA";
const INTERVAL: &str = "SAMPLING INTERVAL (sec)";
const PEAKS: &str = "RAW PGA VALUES (gal)";
const COLUMNS: [&str; 3] = ["N-S", "E-W", "U-D"];

/// Number of lines that are searched for the names of the columns.
const HEADER_LINES: usize = 40;

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "afad",
    files: "AFAD until 2018",
    source: "Türkiye",
    recognises: |text| text.has([INTERVAL, COUNT]),
    read,
    ..Format::BASE
};

/// Reads the three components.
fn read(text: &Text<'_>) -> Result<Vec<Channel>> {
    let dt = text.positive(INTERVAL, "")?;
    let count = text.count(COUNT)?;
    let peaks = peaks(text)?;
    let is_head =
        |line: &str| line.split_ascii_whitespace().eq(COLUMNS.iter().copied());
    let head = text.lines().take(HEADER_LINES).position(is_head);
    let head = head.ok_or_else(|| {
        text.at_end(Fault::Ends("a line `N-S E-W U-D` before the samples"))
    })?;
    let columns = samples(text, head + 1)?;
    text.check_count(text.len() - 1, columns[0].len(), count)?;
    let channel = |((samples, name), peak): ((Vec<f64>, &str), f64)| {
        // Header and samples have the same decimals.
        let allowed = 1e-6 * peak.abs() + 1e-6;
        text.check_peak(&samples, peak, allowed, GAL)?;
        let label = Some(name.to_owned());
        Ok(Channel { label, ..Channel::of(dt, GAL, samples) })
    };
    columns.into_iter().zip(COLUMNS).zip(peaks).map(channel).collect()
}

/// The peaks, each after its column's name in round brackets.
fn peaks(text: &Text<'_>) -> Result<[f64; 3]> {
    let (index, found) = text.value(PEAKS)?;
    let mut words = found.split_ascii_whitespace();
    let mut peaks = [0.0; 3];
    for (peak, column) in peaks.iter_mut().zip(COLUMNS) {
        let named = words.next() == Some(format!("({column})").as_str());
        let value = words.next().and_then(number::finite);
        *peak = value.filter(|_| named).ok_or_else(|| {
            let expected = "peaks such as (N-S) 1.2 (E-W) 1.3 (U-D) 0.9";
            text.differs(index, excerpt(found), expected)
        })?;
    }
    Ok(peaks)
}

/// The numbers of one line: end, value and form of each.
type SampleRow = [(usize, f64, Form); 3];

/// The columns from the line of index `first` on. All numbers must have the
/// form of the first number, and end at the same places as on the first line.
fn samples(text: &Text<'_>, first: usize) -> Result<[Vec<f64>; 3]> {
    let mut columns = [const { Vec::new() }; 3];
    let mut before: Option<SampleRow> = None;
    for (index, line) in text.lines().enumerate().skip(first) {
        let row = row(text, index, line)?;
        let like = *before.get_or_insert(row);
        for ((column, found), first) in columns.iter_mut().zip(row).zip(like) {
            if (found.0, found.2) != (first.0, like[0].2) {
                let expected =
                    "three numbers, written as on the first line of samples";
                return Err(text.no_number(index, line, expected));
            }
            column.push(found.1);
        }
    }
    Ok(columns)
}

fn row(text: &Text<'_>, index: usize, line: &str) -> Result<SampleRow> {
    let mut row = Vec::with_capacity(COLUMNS.len());
    for word in line.split_ascii_whitespace() {
        // Both are parts of one text.
        let end = word.as_ptr() as usize - line.as_ptr() as usize + word.len();
        let (value, form) = one_number(text, index, word)?;
        row.push((end, value, form));
    }
    let expected = "three numbers, one a component";
    row.try_into().map_err(|_| text.no_number(index, line, expected))
}
