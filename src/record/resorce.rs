//! RESORCE: `key : value` lines, then 5E14.7 samples with no room between.

use super::fields::{self, Layout};
use super::number::{self, Reading};
use super::text::{self, Text, excerpt};
use super::{Channel, Fault, RecordError};
use crate::units::AccelerationUnit;

const HEADER_LINES: usize = 40;
const LAYOUT: Layout = Layout { width: 14, per_line: 5 };

/// Whether the header has RESORCE's keys.
pub(super) fn recognises(text: &Text<'_>) -> bool {
    find(text, "Time Increment (s)").is_some()
        && find(text, "Number of Data").is_some()
}

fn find(text: &Text<'_>, key: &str) -> Option<usize> {
    let head = text.lines().iter().take(HEADER_LINES);
    head.into_iter().position(|line| {
        line.split(':').next().is_some_and(|k| k.trim() == key)
    })
}

/// Reads the file's one channel.
pub(super) fn read(text: &Text<'_>) -> Result<Channel, RecordError> {
    let dt = positive(text, "Time Increment (s)")?;
    let count = positive(text, "Number of Data")?;
    if count.fract() != 0.0 {
        let fault = Fault::Header {
            found: format!("{count}"),
            expected: "a number of samples",
        };
        return Err(text.at_end(fault));
    }
    let title = text
        .lines()
        .iter()
        .take(HEADER_LINES)
        .position(|line| text::contains(line, "time series in"))
        .ok_or_else(|| {
            text.at_end(Fault::Ends("a line `Acceleration time series in`"))
        })?;
    let line = text.lines()[title];
    // The database writes "Accelaration".
    if !text::contains(line, "accel") {
        return Err(text.on_line(title, Fault::Quantity(excerpt(line))));
    }
    let named = line.split_ascii_whitespace().next_back().unwrap_or("");
    let unit = AccelerationUnit::parse(named)
        .ok_or_else(|| text.on_line(title, Fault::Unit(excerpt(named))))?;
    let lines = text.lines().len();
    let samples = fields::read(text, title + 1, lines, Some(LAYOUT))?;
    text.check_count(samples.len(), count as usize)?;
    check_peak(text, &samples, unit)?;
    Ok(Channel { dt: Some(dt), unit: Some(unit), samples, label: None })
}

fn positive(text: &Text<'_>, key: &str) -> Result<f64, RecordError> {
    let Some(index) = find(text, key) else {
        return Err(text.at_end(Fault::Ends("RESORCE's header")));
    };
    let value = text.lines()[index].split(':').nth(1).unwrap_or("").trim();
    match number::read(value) {
        Reading::Finite(x, _) if x > 0.0 => Ok(x),
        _ => {
            let expected = "a positive number";
            let found = excerpt(text.lines()[index]);
            Err(text.on_line(index, Fault::Header { found, expected }))
        }
    }
}

/// The samples' peak against the header's, which has the same digits.
fn check_peak(
    text: &Text<'_>,
    samples: &[f64],
    unit: AccelerationUnit,
) -> Result<(), RecordError> {
    let key = "PGA (m/s/s)";
    if find(text, key).is_none()
        || unit != AccelerationUnit::MetrePerSecondSquared
    {
        return Ok(());
    }
    let expected = positive(text, key)?;
    let found = samples.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()));
    if (found - expected).abs() <= 1e-6 * expected {
        return Ok(());
    }
    Err(text.at_end(Fault::Peak { found, expected, unit }))
}
