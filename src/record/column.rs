//! One value a line and no header; lines that begin with `#` are comments.
//! A unit that the comments state in brackets is the samples'.
//!
//! Nothing in such a file tells a line that was dropped, doubled or changed:
//! an index's `npts` or `sha256` does. A file that ends within a number is
//! refused where the number's form tells it.

use super::fields::{Forms, one_number};
use super::number;
use super::text::Text;
use super::{Channel, RecordError, csv};

/// Whether the first line that is no comment is one number.
pub(super) fn recognises(text: &Text<'_>) -> bool {
    text.lines()
        .find(|line| !line.starts_with('#'))
        .is_some_and(|line| number::is_number(line.trim()))
}

/// Reads the file's one channel.
pub(super) fn read(text: &Text<'_>) -> Result<Channel, RecordError> {
    let mut samples = Vec::with_capacity(text.len());
    let mut forms = Forms::default();
    for (index, line) in text.lines().enumerate() {
        if line.starts_with('#') {
            continue;
        }
        let (sample, form) = one_number(text, index, line)?;
        forms.push(sample, form);
        samples.push(sample);
    }
    check_first(text, &samples, &forms)?;
    let remarks = forms.check_ended(text)?;
    let unit = csv::comments(text)?.acceleration;
    Ok(Channel { unit, samples, remarks, ..Channel::default() })
}

/// Refuses a first line that is a count or an interval.
fn check_first(
    text: &Text<'_>,
    samples: &[f64],
    forms: &Forms,
) -> Result<(), RecordError> {
    let Some((&first, rest)) = samples.split_first() else { return Ok(()) };
    let count = first == rest.len() as f64 && rest.len() > 1;
    if !(count || (forms.first_differs() && first > 0.0)) {
        return Ok(());
    }
    let index = text.lines().position(|line| !line.starts_with('#'));
    let expected = "a sample, written as those on the lines below: a count \
                    or an interval belongs behind a #";
    Err(text.header(index.unwrap_or(0), expected))
}
