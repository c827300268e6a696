//! One value a line and no header; lines that begin with `#` are comments.
//! A unit that the comments state in brackets is the samples'.
//!
//! Nothing in such a file tells a line that was dropped, doubled or changed:
//! an index's `npts` or `sha256` does. A file that ends within a number is
//! refused where the number's form tells it.

use super::{Channel, Format, Header};
use super::{counted, csv};
use crate::error::RecordError;
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

/// Whether the first line that is no comment is one number.
fn recognises(text: &Text<'_>) -> bool {
    let first = text.data().next();
    first.is_some_and(|(_, line)| number::is_number(line.trim()))
}

/// Reads the file's one channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>, RecordError> {
    let (samples, forms) = fields::column(text, text.data())?;
    check_first(text, &samples, &forms)?;
    let remarks = forms.check_ended(text)?;
    let unit = csv::comments(text)?.acceleration;
    Ok(vec![Channel { unit, samples, remarks, ..Channel::default() }])
}

/// Refuses a first line that is a count or an interval, and a whole number or
/// gravity before an interval: a factor that some programs write there.
fn check_first(
    text: &Text<'_>,
    samples: &[f64],
    forms: &Forms,
) -> Result<(), RecordError> {
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
