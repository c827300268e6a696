//! K-NET and KiK-net ASCII: 17 lines of header, then integer counts in
//! I8,7I9 or free fields, to be multiplied by a scale factor in gal.
//!
//! The counts carry the instrument's offset; it is read as it is and shows
//! in the quality control. The header's maximum is that of the record
//! without its mean, and is checked.

use super::{Channel, Format};
use crate::error::RecordError;
use crate::number;
use crate::text::Text;
use crate::{fields, keys};
use rocking::accelerogram::mean;
use rocking::units::AccelerationUnit;

/// The key of the maximum, in two spellings.
const MAXIMUM: [&str; 2] = ["Max. Acc. (gal)", "Max Acc. (gal)"];

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "knet",
    files: "K-NET and KiK-net",
    source: "Japan",
    recognises: |text| keys::has(text, ["Scale Factor", "Sampling Freq(Hz)"]),
    read,
    ..Format::BASE
};

/// Reads the file's one channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>, RecordError> {
    let frequency_hz = keys::positive(text, "Sampling Freq(Hz)", "Hz")?;
    let duration_s = keys::positive(text, "Duration Time(s)", "")?;
    let scale = scale(text)?;
    let (memo, _) = keys::value(text, "Memo.")?;
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
    let unit = Some(AccelerationUnit::CentimetrePerSecondSquared);
    let (dt, dir) = (Some(1.0 / frequency_hz), keys::find(text, "Dir."));
    let (label, borehole) = sensor(dir.map_or("", |(_, dir)| dir));
    let rest = Channel::default();
    Ok(vec![Channel { dt, unit, samples, label, borehole, ..rest }])
}

/// Label of a sensor by the header's `Dir.`, and whether it is in a borehole.
///
/// K-NET names the direction. KiK-net numbers its six channels: 1 to 3 are
/// those of the sensor in the borehole, 4 to 6 those of the one at the
/// surface, each in the order N-S, E-W, U-D.
fn sensor(dir: &str) -> (Option<String>, bool) {
    let (label, borehole) = match dir {
        "1" => ("N-S borehole", true),
        "2" => ("E-W borehole", true),
        "3" => ("U-D borehole", true),
        "4" => ("N-S surface", false),
        "5" => ("E-W surface", false),
        "6" => ("U-D surface", false),
        word => (word, false),
    };
    ((!label.is_empty()).then(|| label.to_owned()), borehole)
}

/// The header's maximum acceleration against the samples less their mean.
fn check_maximum(text: &Text<'_>, samples: &[f64]) -> Result<(), RecordError> {
    let key = MAXIMUM.iter().find(|key| keys::find(text, key).is_some());
    let Some(key) = key else { return Ok(()) };
    let expected = keys::positive(text, key, "")?;
    let mean = mean(samples);
    let moving: Vec<f64> = samples.iter().map(|a| a - mean).collect();
    let unit = AccelerationUnit::CentimetrePerSecondSquared;
    // The mean may be that of a part, and the maximum is rounded.
    let allowed = 0.01 * expected + 0.001;
    keys::check_peak(text, &moving, expected, allowed, unit)
}

/// Gal per count: `7845(gal)/8223790`.
fn scale(text: &Text<'_>) -> Result<f64, RecordError> {
    let (index, found) = keys::value(text, "Scale Factor")?;
    let number = |part: &str| number::finite(part.trim()).filter(|x| *x > 0.0);
    let parts = found.split_once("(gal)/");
    let ratio = parts.and_then(|(a, b)| Some(number(a)? / number(b)?));
    let expected = "a scale factor such as 3920(gal)/6182761";
    ratio.ok_or_else(|| text.header(index, expected))
}
