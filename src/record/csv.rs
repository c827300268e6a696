//! Two columns, time and acceleration, with one header line or none.
//!
//! Separator: semicolon, comma, tab or blanks. A header names the columns and
//! may state their units (`time_ms`, `acc [m/s2]`); lines that begin with `#`
//! are comments, and may state units in brackets. A first column that is no
//! time is refused. The first sample counts as t = 0, whatever its time.
//! Lines dropped at either end leave no trace: an index's `npts` tells. A
//! file that ends within a number is refused where the number's form tells
//! it.

use super::fields::{Forms, one_number};
use super::number;
use super::text::Text;
use super::{Channel, Fault, RecordError};
pub(super) use header::comments;
use header::header;

mod header;

/// Whether the first or second line has two numbers.
pub(super) fn recognises(text: &Text<'_>) -> bool {
    let mut lines = text.lines().filter(|l| !l.starts_with('#'));
    let pair = |line: Option<&str>| {
        line.is_some_and(|line| {
            let parts = split(line);
            parts.len() == 2 && parts.iter().all(|p| number::is_number(p))
        })
    };
    pair(lines.next()) || pair(lines.next())
}

/// The columns of a line; of more than two, three.
fn split(line: &str) -> Vec<&str> {
    let line = line.trim();
    for separator in [';', ','] {
        if line.contains(separator) {
            return line.split(separator).map(str::trim).take(3).collect();
        }
    }
    line.split_whitespace().take(3).collect()
}

/// Reads the file's one channel.
pub(super) fn read(text: &Text<'_>) -> Result<Channel, RecordError> {
    let mut times = Vec::with_capacity(text.len());
    let mut samples = Vec::with_capacity(text.len());
    let mut decimals = 0;
    let mut forms = Forms::default();
    let mut units = comments(text)?;
    let mut head = true;
    for (index, line) in text.lines().enumerate() {
        if line.starts_with('#') {
            continue;
        }
        let parts = split(line);
        if head && !parts.iter().all(|p| number::is_number(p)) {
            units = units.and(header(text, index, line)?);
            head = false;
            continue;
        }
        head = false;
        let &[time, value] = parts.as_slice() else {
            let expected = "two numbers, time and acceleration";
            return Err(text.no_number(index, line, expected));
        };
        let (time_read, form) = one_number(text, index, time)?;
        decimals = decimals.max(places(time, form));
        times.push(time_read);
        let (sample, form) = one_number(text, index, value)?;
        forms.push(sample, form);
        samples.push(sample);
    }
    let remarks = forms.check_ended(text)?;
    let dt = step(text, &times, decimals)? / units.per_second;
    let unit = units.acceleration;
    let dt = Some(dt);
    Ok(Channel { dt, unit, samples, remarks, ..Channel::default() })
}

/// Decimal places that a written time resolves.
fn places(time: &str, form: number::Form) -> i32 {
    let digits = i32::try_from(form.decimals.unwrap_or(0)).unwrap_or(0);
    let exponent = &time[time.len() - form.exponent..];
    let power = exponent
        .trim_start_matches(['e', 'E', 'd', 'D'])
        .parse::<i32>()
        .unwrap_or(0);
    digits.saturating_sub(power).clamp(0, 18)
}

/// Index of the line of sample `i`: what is no comment, after the header if
/// there is one.
fn line_of(text: &Text<'_>, times: &[f64], i: usize) -> usize {
    let data =
        || text.lines().enumerate().filter(|(_, l)| !l.starts_with('#'));
    let header = data().count() - times.len();
    data().nth(header + i).map_or(0, |(index, _)| index)
}

/// The constant step of `times`, each rounded to `places` decimals.
///
/// Where the step itself has that many decimals, it is taken as written.
fn step(
    text: &Text<'_>,
    times: &[f64],
    places: i32,
) -> Result<f64, RecordError> {
    let (Some(&start), Some(&end)) = (times.first(), times.last()) else {
        return Err(text.at_end(Fault::Ends("time and acceleration")));
    };
    if times.len() < 2 {
        return Err(text.at_end(Fault::Ends("a second time")));
    }
    // Rounded once: products of a rounded unit are not what was written.
    let per_unit = (0..places).fold(1.0, |scale, _| scale * 10.0);
    let unit = 1.0 / per_unit;
    let mean = (end - start) / (times.len() - 1) as f64;
    let written = (mean * per_unit).round() / per_unit;
    // Rounding of the times, and of the double they are read into.
    let allowed = 0.5000001 * unit + 4.0 * f64::EPSILON * end.abs();
    let off = |dt: f64| {
        (0..times.len()).find(|&i| {
            !((times[i] - (start + i as f64 * dt)).abs() <= 2.0 * allowed)
        })
    };
    // Times without a rounding error, however few decimals they have.
    let first = times[1] - start;
    let exact = |i: usize| {
        let off = times[i] - (start + i as f64 * first);
        off.abs() <= 1e-9 * first
    };
    if (1..times.len()).all(exact) && first > 0.0 {
        return Ok(if (written - first).abs() <= 1e-9 * first {
            written
        } else {
            first
        });
    }
    if !(mean > 0.0) {
        let (found_s, expected_s) = (end, start);
        let fault = Fault::Backwards { found_s, expected_s };
        return Err(text.on_line(line_of(text, times, times.len() - 1), fault));
    }
    if !(allowed < 0.25 * mean) {
        let fault = Fault::Coarse { step_s: mean, places: places.max(0) };
        return Err(text.on_line(line_of(text, times, 1), fault));
    }
    if off(written).is_none() {
        return Ok(written);
    }
    let uneven = (1..times.len()).find(|&i| {
        !((times[i] - times[i - 1] - first).abs() <= 4.0 * allowed)
    });
    match uneven.or_else(|| off(mean)) {
        None => Ok(mean),
        Some(i) => {
            let fault = Fault::Step {
                found_s: times[i],
                expected_s: times[i - 1] + first,
            };
            Err(text.on_line(line_of(text, times, i), fault))
        }
    }
}
