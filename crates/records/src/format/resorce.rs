//! RESORCE: `key : value` lines, then 5E14.7 samples with no room between.

use super::{Channel, Format};
use crate::error::{Fault, RecordError};
use crate::fields::{self, FieldLayout};
use crate::keys;
use crate::text::{self, Text};
use rocking::units::AccelerationUnit;

const HEADER_LINES: usize = 40;
const LAYOUT: FieldLayout = FieldLayout::even(5, 14);

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "resorce",
    files: "RESORCE",
    source: "Europe",
    recognises: |text| {
        keys::has(text, ["Time Increment (s)", "Number of Data"])
    },
    read,
    ..Format::BASE
};

/// Reads the file's one channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>, RecordError> {
    let dt = keys::positive(text, "Time Increment (s)", "")?;
    let count = keys::count(text, "Number of Data")?;
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
    if si && keys::find(text, peak).is_some() {
        let expected = keys::positive(text, peak, "")?;
        // The header has the samples' digits.
        keys::check_peak(text, &samples, expected, 1e-6 * expected, unit)?;
    }
    let label = keys::find(text, "Orientation").map(|(_, v)| v.to_owned());
    let (dt, unit) = (Some(dt), Some(unit));
    Ok(vec![Channel { dt, unit, samples, label, ..Channel::default() }])
}
