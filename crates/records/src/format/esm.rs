//! ESM and ITACA (the DYNA header, which AFAD uses today): lines
//! `KEY: value`, then one sample a line.

use super::{Channel, Format};
use crate::error::RecordError;
use crate::text::{self, Text};
use crate::{fields, keys};
use rocking::units::AccelerationUnit;

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "esm",
    files: "ESM and ITACA, AFAD since 2018",
    source: "Europe",
    is_fixed: false,
    recognises: |text| keys::has(text, ["SAMPLING_INTERVAL_S", "NDATA"]),
    read,
    ..Format::BASE
};

/// Reads the file's one channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>, RecordError> {
    let dt = keys::positive(text, "SAMPLING_INTERVAL_S", "")?;
    let count = keys::count(text, "NDATA")?;
    let (index, quantity) = keys::value(text, "DATA_TYPE")?;
    if !text::contains(quantity, "ACCELERATION")
        || text::contains(quantity, "SPECTR")
    {
        return Err(text.quantity(index));
    }
    let (index, named) = keys::value(text, "UNITS")?;
    let unit = text.unit(index, named)?;
    let is_key = |line: &str| {
        let key = line.split(':').next().unwrap_or("");
        line.contains(':')
            && key.starts_with(|c: char| c.is_ascii_uppercase())
            && !key.contains(' ')
    };
    let header = text.lines().take_while(|l| is_key(l)).count();
    let lines = text.lines().enumerate().skip(header);
    let (samples, forms) = fields::column(text, lines)?;
    let remarks = forms.check_ended(text)?;
    text.check_count(text.len() - 1, samples.len(), count)?;
    let peak = "PGA_CM/S^2";
    let gal = unit == AccelerationUnit::CentimetrePerSecondSquared;
    if gal && keys::find(text, peak).is_some_and(|(_, v)| !v.is_empty()) {
        let (_, expected) = keys::number(text, peak, "")?;
        // Files differ in the digits of header and samples.
        let allowed = 1e-4 * expected.abs() + 1e-5;
        keys::check_peak(text, &samples, expected, allowed, unit)?;
    }
    let label = keys::find(text, "STREAM").map(|(_, v)| v.to_owned());
    let (dt, unit) = (Some(dt), Some(unit));
    let rest = Channel::default();
    Ok(vec![Channel { dt, unit, samples, label, remarks, ..rest }])
}
