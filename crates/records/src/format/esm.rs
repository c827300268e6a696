//! ESM and ITACA (the DYNA header, which AFAD uses today): lines
//! `KEY: value`, then one sample a line.

use super::{Channel, Format, GAL};
use crate::error::Result;
use crate::fields;
use crate::text::{self, Text};

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "esm",
    files: "ESM and ITACA, AFAD since 2018",
    source: "Europe",
    is_fixed: false,
    recognises: |text| text.has(["SAMPLING_INTERVAL_S", "NDATA"]),
    read,
    ..Format::BASE
};

/// Reads the file's one channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>> {
    let dt = text.positive("SAMPLING_INTERVAL_S", "")?;
    let count = text.count("NDATA")?;
    let (index, quantity) = text.value("DATA_TYPE")?;
    if !text::contains(quantity, "ACCELERATION")
        || text::contains(quantity, "SPECTR")
    {
        return Err(text.quantity(index));
    }
    let (index, named) = text.value("UNITS")?;
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
    if unit == GAL && text.find(peak).is_some_and(|(_, v)| !v.is_empty()) {
        let (_, expected) = text.number(peak, "")?;
        // Files differ in the digits of header and samples.
        let allowed = 1e-4 * expected.abs() + 1e-5;
        text.check_peak(&samples, expected, allowed, unit)?;
    }
    let label = text.label("STREAM");
    Ok(vec![Channel { label, remarks, ..Channel::of(dt, unit, samples) }])
}
