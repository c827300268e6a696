//! Two columns, time and acceleration, with or without a header line.
//!
//! Separator: semicolon, comma, tab or blanks. A header names the columns and
//! may state their units (`time_ms`, `acc [m/s2]`). Lines that begin with `#`
//! are comments, and may state units in brackets. Cells may be quoted. The
//! first column must be a time; only pandas may write the number of the row
//! before it, under no name or `index`. The first sample counts as t = 0,
//! whatever its time. Lines dropped at either end leave no trace; `npts` of an
//! index shows them. A file that ends within a number is refused if the form
//! of the number shows it.

use super::{Channel, Format, Header};
use crate::error::{Fault, Result};
use crate::fields::{Forms, one_number};
use crate::number;
use crate::quality::Remark;
use crate::sampling::{self, Digits, Sampling};
use crate::text::Text;
use header::header;
pub(super) use header::{bracketed, comments};

mod header;

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "csv",
    files: "two columns, time and acceleration",
    source: "your own",
    content: "time, acceleration",
    header: Header::NoCount,
    is_fixed: false,
    recognises,
    read,
    ..Format::BASE
};

/// Whether the first or second line has two numbers.
fn recognises(text: &Text<'_>) -> bool {
    let mut lines = text.data().map(|(_, line)| line);
    let numbers = |line: &str, count: usize| {
        let parts = split(line);
        parts.len() == count && are_numbers(&parts)
    };
    let Some(first) = lines.next() else { return false };
    let columns = if is_numbered(first) { 3 } else { 2 };
    numbers(first, 2) || lines.next().is_some_and(|l| numbers(l, columns))
}

fn are_numbers(parts: &[&str]) -> bool {
    parts.iter().all(|part| number::is_number(part))
}

/// The cells of a line, without quotes; at most the first four.
fn split(line: &str) -> Vec<&str> {
    let line = line.trim();
    for separator in [';', ','] {
        if line.contains(separator) {
            let mut quoted = false;
            let cells = line.split(|c| {
                quoted ^= c == '"';
                c == separator && !quoted
            });
            return cells.map(bare).take(4).collect();
        }
    }
    line.split_whitespace().map(bare).take(4).collect()
}

/// A cell without its quotes.
fn bare(cell: &str) -> &str {
    let cell = cell.trim();
    let inner = cell.strip_prefix('"').and_then(|c| c.strip_suffix('"'));
    inner.map_or(cell, str::trim)
}

/// Whether a header line begins with the column in which pandas numbers the
/// rows.
fn is_numbered(line: &str) -> bool {
    let names = ["", "index", "unnamed: 0"];
    let parts = split(line);
    parts.len() == 3 && names.contains(&&*parts[0].to_ascii_lowercase())
}

/// Reads the file's one channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>> {
    let mut times = Vec::with_capacity(text.len());
    let mut samples = Vec::with_capacity(text.len());
    let mut digits = Digits::default();
    let mut forms = Forms::default();
    let mut units = comments(text)?;
    let mut head = true;
    let mut numbered = false;
    for (index, line) in text.data() {
        let parts = split(line);
        if std::mem::take(&mut head) && !are_numbers(&parts) {
            numbered = is_numbered(line);
            let named = &parts[usize::from(numbered)..];
            units = units.and(header(text, index, named)?);
            continue;
        }
        let before = usize::from(numbered).min(parts.len());
        let (number, cells) = parts.split_at(before);
        let row = times.len();
        if let [number] = number
            && number.parse() != Ok(row)
        {
            let expected = format!("{row}, the row's number");
            return Err(text.no_number(index, number, &expected));
        }
        let &[time, value] = cells else {
            let expected = "two numbers, time and acceleration";
            return Err(text.no_number(index, line, expected));
        };
        let (time_read, form) = one_number(text, index, time)?;
        digits.add(time, form);
        times.push(time_read);
        let (sample, form) = one_number(text, index, value)?;
        forms.push(sample, form);
        samples.push(sample);
    }
    if times.len() < 2 {
        return Err(text.at_end(Fault::Ends("a second time")));
    }
    let mut remarks = forms.check_ended(text)?;
    let resolution_s =
        |i: usize| digits.resolution_s(times[i]) / units.per_second;
    let times_s: Vec<f64> =
        times.iter().map(|time| time / units.per_second).collect();
    let found = sampling::interval(&times_s, resolution_s);
    let Sampling { dt_s, off_s, .. } = found.map_err(|fault| {
        let line = |index| line_of(text, &times, index);
        let line = fault.index().map_or(text.len() - 1, line);
        text.on_line(line, fault.into())
    })?;
    remarks.extend(Remark::of_times(dt_s, off_s));
    let unit = units.acceleration;
    Ok(vec![Channel { remarks, ..Channel::of(dt_s, unit, samples) }])
}

/// Index of the line of sample `i`, after comments and the header.
fn line_of(text: &Text<'_>, times: &[f64], i: usize) -> usize {
    let header = text.data().count() - times.len();
    text.data().nth(header + i).map_or(0, |(index, _)| index)
}
