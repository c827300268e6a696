//! K-NET and KiK-net ASCII: 17 lines of header, then integer counts in
//! I8,7I9 or free fields, to be multiplied by a scale factor in gal.
//!
//! The counts include the offset of the instrument. It is not removed, and the
//! quality control reports it. The maximum of the record without its mean must
//! be the maximum of the header.

use super::{Channel, Format, GAL};
use crate::error::Result;
use crate::fields;
use crate::number;
use crate::text::{self, Text};
use rocking::accelerogram::mean;

/// The key of the maximum, in two spellings.
const MAXIMUM: [&str; 2] = ["Max. Acc. (gal)", "Max Acc. (gal)"];

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "knet",
    files: "K-NET and KiK-net",
    source: "Japan",
    recognises: |text| text.has(["Scale Factor", "Sampling Freq(Hz)"]),
    read,
    ..Format::BASE
};

/// Reads the file's one channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>> {
    let frequency_hz = text.positive("Sampling Freq(Hz)", "Hz")?;
    let duration_s = text.positive("Duration Time(s)", "")?;
    let scale = scale(text)?;
    let (memo, _) = text.value("Memo.")?;
    let first = memo + 1;
    let infer = |missing| fields::infer(text, first, text.len(), missing);
    let layout = infer(1).or_else(|| infer(0));
    let mut samples = fields::read(text, first, text.len(), layout)?;
    let expected = frequency_hz * duration_s;
    if !(expected <= 1e9 && expected.fract() == 0.0) {
        let found = format!("{frequency_hz} Hz for {duration_s} s");
        return Err(text.differs(memo, found, "a whole number of samples"));
    }
    text.check_count(text.len() - 1, samples.len(), expected as usize)?;
    for count in &mut samples {
        *count *= scale;
    }
    check_maximum(text, &samples)?;
    let dir = text.find("Dir.").map_or("", |(_, dir)| dir);
    let (label, borehole) = sensor(dir);
    let rest = Channel::of(1.0 / frequency_hz, GAL, samples);
    Ok(vec![Channel { label: text::named(label), borehole, ..rest }])
}

/// Label of a sensor by the header's `Dir.`, and whether it is in a borehole.
///
/// K-NET names the direction. KiK-net numbers its six channels: 1 to 3 are
/// from the sensor in the borehole, 4 to 6 from the sensor at the surface,
/// each in the order N-S, E-W, U-D.
fn sensor(dir: &str) -> (&str, bool) {
    match dir {
        "1" => ("N-S borehole", true),
        "2" => ("E-W borehole", true),
        "3" => ("U-D borehole", true),
        "4" => ("N-S surface", false),
        "5" => ("E-W surface", false),
        "6" => ("U-D surface", false),
        word => (word, false),
    }
}

/// Compares the header's maximum acceleration with the samples less their
/// mean.
fn check_maximum(text: &Text<'_>, samples: &[f64]) -> Result<()> {
    let key = MAXIMUM.iter().find(|key| text.find(key).is_some());
    let Some(key) = key else { return Ok(()) };
    let expected = text.positive(key, "")?;
    let mean = mean(samples);
    let moving: Vec<f64> = samples.iter().map(|a| a - mean).collect();
    // The header may use the mean of a part, and its maximum is rounded.
    let allowed = 0.01 * expected + 0.001;
    text.check_peak(&moving, expected, allowed, GAL)
}

/// Gal per count: `7845(gal)/8223790`.
fn scale(text: &Text<'_>) -> Result<f64> {
    let (index, found) = text.value("Scale Factor")?;
    let number = |part: &str| number::finite(part.trim()).filter(|x| *x > 0.0);
    let parts = found.split_once("(gal)/");
    let ratio = parts.and_then(|(a, b)| Some(number(a)? / number(b)?));
    let expected = "a scale factor such as 3920(gal)/6182761";
    ratio.ok_or_else(|| text.header(index, expected))
}
