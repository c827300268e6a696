//! RESORCE: `key : value` lines, then 5E14.7 samples with no room between.

use super::{Channel, Format};
use crate::error::{Fault, Result};
use crate::fields::{self, FieldLayout};
use crate::text::{self, Text};
use rocking::units::AccelerationUnit;

const HEADER_LINES: usize = 40;
const LAYOUT: FieldLayout = FieldLayout::even(5, 14);

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "resorce",
    files: "RESORCE",
    source: "Europe",
    recognises: |text| text.has(["Time Increment (s)", "Number of Data"]),
    read,
    ..Format::BASE
};

/// Reads the file's one channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>> {
    let dt = text.positive("Time Increment (s)", "")?;
    let count = text.count("Number of Data")?;
    let title = text
        .lines()
        .take(HEADER_LINES)
        .position(|line| text::contains(line, "time series in"))
        .ok_or_else(|| {
            text.at_end(Fault::Ends("a line `Acceleration time series in`"))
        })?;
    let line = text.line(title).unwrap_or("");
    // The database writes "Accelaration".
    if !text::contains(line, "accel") {
        return Err(text.quantity(title));
    }
    let named = line.split_ascii_whitespace().next_back().unwrap_or("");
    let unit = text.unit(title, named)?;
    let end = text.len();
    let samples = fields::read(text, title + 1, end, Some(LAYOUT))?;
    text.check_count(text.len() - 1, samples.len(), count)?;
    let peak = "PGA (m/s/s)";
    let si = unit == AccelerationUnit::MetrePerSecondSquared;
    if si && text.find(peak).is_some() {
        let expected = text.positive(peak, "")?;
        // The header has the samples' digits.
        text.check_peak(&samples, expected, 1e-6 * expected, unit)?;
    }
    let label = text.label("Orientation");
    Ok(vec![Channel { label, ..Channel::of(dt, unit, samples) }])
}
