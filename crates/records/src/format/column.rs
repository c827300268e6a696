//! One value a line and no header; lines that begin with `#` are comments.
//! The comments may state the unit of the samples in brackets.
//!
//! Nothing in such a file shows that a line was dropped, doubled or changed;
//! `npts` or `sha256` of an index does. A file that ends within a number is
//! refused if the form of the number shows it.

use super::{Channel, Format, Header};
use super::{counted, csv};
use crate::error::Result;
use crate::fields::{self, Forms};
use crate::number;
use crate::text::Text;

/// Gravity in m/s2, cm/s2, ft/s2 and in/s2.
const GRAVITY: [f64; 4] = [9.81, 981.0, 32.17, 386.1];

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "column",
    files: "one column, acceleration",
    source: "your own",
    header: Header::Missing,
    is_fixed: false,
    recognises,
    read,
    ..Format::BASE
};

/// Whether the first line after comments is one number.
fn recognises(text: &Text<'_>) -> bool {
    let first = text.data().next();
    first.is_some_and(|(_, line)| number::is_number(line.trim()))
}

/// Reads the file's one channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>> {
    let (samples, forms) = fields::column(text, text.data())?;
    check_first(text, &samples, &forms)?;
    let remarks = forms.check_ended(text)?;
    let unit = csv::comments(text)?.acceleration;
    Ok(vec![Channel { remarks, ..Channel::of(None, unit, samples) }])
}

/// Refuses a first line that is a count or an interval. Also refuses a whole
/// number or gravity before an interval: some programs write a factor there.
fn check_first(text: &Text<'_>, samples: &[f64], forms: &Forms) -> Result<()> {
    let Some((&first, rest)) = samples.split_first() else { return Ok(()) };
    let mut lines = text.data();
    let (index, line) = lines.next().unwrap_or_default();
    let interval = |line: &str| counted::interval(line).is_some();
    let whole = line.trim().bytes().all(|b| b.is_ascii_digit() || b == b'+');
    let count = first == rest.len() as f64 && rest.len() > 1;
    let unlike = forms.first_differs() && first > 0.0;
    let gravity = GRAVITY.iter().any(|g| (first - g).abs() <= 1e-3 * g);
    let factor = (gravity || (whole && first > 0.0))
        && lines.next().is_some_and(|(_, line)| interval(line));
    if !(count || factor || (unlike && (whole || interval(line)))) {
        return Ok(());
    }
    let expected = "a sample, written as those on the lines below: a count, \
                    an interval or a factor belongs behind a #";
    Err(text.header(index, expected))
}
