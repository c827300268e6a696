//! From the bytes of a file to its records, in the format that the content
//! shows.

use std::io::Read as _;
use std::path::Path;

use rocking::accelerogram::{Accelerogram, result_name};

use crate::direction::{self, Direction};
use crate::error::{Fault, RecordError, Result};
use crate::format::{Channel, Format};
use crate::quality::Remark;
use crate::record::{Agreement, Fallback, INTERVALS_S, ReadOptions, Record};
use crate::text::{self, Text, excerpt};

/// Reads the one component of a file with content `bytes`; `file` names it
/// in messages, its stem names the accelerogram.
///
/// # Errors
/// [`RecordError`] for content of no known format, a number that is cut or
/// not finite, a count that differs from the header's, an unknown unit, a
/// missing sampling interval, an interval or unit in `options` that
/// contradicts the file, or several components.
///
/// ```
/// use rocking_records::ReadOptions;
/// use rocking::units::AccelerationUnit;
/// let options = ReadOptions {
///     dt_s: Some(0.01),
///     unit: Some(AccelerationUnit::Gravity),
///     ..ReadOptions::default()
/// };
/// let record = rocking_records::read("folder/a.txt", b"0.0\n0.1\n-0.3\n", &options)?;
/// assert_eq!(record.accelerogram.name(), "a");
/// assert_eq!(record.accelerogram.pga_g(), 0.3);
/// # Ok::<(), rocking_records::RecordError>(())
/// ```
pub fn read(
    file: &str,
    bytes: &[u8],
    options: &ReadOptions,
) -> Result<Record, RecordError> {
    settle_one(file, bytes, options)?.agreed()
}

/// As [`settle`], for a file of one component.
pub(crate) fn settle_one(
    file: &str,
    bytes: &[u8],
    options: &ReadOptions,
) -> Result<Agreement> {
    let mut records = settle(file, bytes, options, None)?;
    match records.pop() {
        Some(record) if records.is_empty() => Ok(record),
        Some(_) => Err(Fault::SeveralChannels(records.len() + 1).whole(file)),
        None => Err(Fault::Ends("an acceleration channel").whole(file)),
    }
}

/// Reads all components of a file, in the file's order.
///
/// # Errors
/// As [`read`], without the limit to one component.
pub fn read_all(
    file: &str,
    bytes: &[u8],
    options: &ReadOptions,
) -> Result<Vec<Record>, RecordError> {
    let settled = settle(file, bytes, options, None)?;
    settled.into_iter().map(Agreement::agreed).collect()
}

/// Reads all components of a file whose format is known, whatever its
/// content looks like.
///
/// # Errors
/// As [`read_all`].
///
/// ```
/// use rocking_records::{Format, ReadOptions};
/// use rocking::units::AccelerationUnit;
/// let text = b"0.1\n0.2\n";
/// let options = ReadOptions {
///     dt_s: Some(0.01),
///     unit: Some(AccelerationUnit::Gravity),
///     ..ReadOptions::default()
/// };
/// let read = |format| {
///     let format = Format::named(format).expect("a format");
///     rocking_records::read_as(format, "a", text, &options)
/// };
/// assert!(read("column").is_ok() && read("at2").is_err());
/// ```
pub fn read_as(
    format: &'static Format,
    file: &str,
    bytes: &[u8],
    options: &ReadOptions,
) -> Result<Vec<Record>, RecordError> {
    let settled = settle(file, bytes, options, Some(format))?;
    settled.into_iter().map(Agreement::agreed).collect()
}

/// Reads all components of a file, in the given format or in the format that
/// its content shows. A value of the caller applies if the file does not
/// state it.
pub(crate) fn settle(
    file: &str,
    bytes: &[u8],
    options: &ReadOptions,
    format: Option<&'static Format>,
) -> Result<Vec<Agreement>> {
    let gravity = options.gravity_m_s2;
    if !(gravity > 0.0 && gravity.is_finite()) {
        return Err(Fault::Gravity(gravity).whole(file));
    }
    if let Some(dt_s) = options.dt_s
        && !(dt_s > 0.0 && dt_s.is_finite())
    {
        return Err(Fault::Interval(dt_s.to_string()).whole(file));
    }
    let content = text::decode(file, bytes)?;
    let text = Text::new(file, &content)?;
    let format = format.or_else(|| Format::of(&text));
    let format = format.ok_or_else(|| unknown(&text))?;
    let channels = (format.read)(&text)?;
    let several = channels.len() > 1;
    channels
        .into_iter()
        .map(|channel| complete(&text, format, channel, several, options))
        .collect()
}

/// Reads the one component of the file at `path`.
///
/// # Errors
/// As [`read`], and [`Fault::Unreadable`] for a file that cannot be read.
pub fn read_file(
    path: &Path,
    options: &ReadOptions,
) -> Result<Record, RecordError> {
    let file = path.display().to_string();
    read(&file, &file_bytes(path)?, options)
}

/// Bytes of the file at `path`, or of a pipe that this process was given
/// (`/dev/fd/63`).
///
/// # Errors
/// [`Fault::Unreadable`] for a file that cannot be read, that has more than
/// 4 GiB or does not fit into memory, and for a device or a named pipe:
/// they may never end.
pub fn file_bytes(path: &Path) -> Result<Vec<u8>, RecordError> {
    let refuse = |reason: String| {
        let file = path.display().to_string();
        Fault::Unreadable(reason).whole(&file)
    };
    let failed = |error: std::io::Error| refuse(error.to_string());
    let found = std::fs::metadata(path).map_err(failed)?;
    let given = path.starts_with("/dev/fd") || path.starts_with("/proc/self");
    if !(found.is_file() || (given && !found.is_dir())) {
        let kind =
            if found.is_dir() { "a folder" } else { "a device or pipe" };
        return Err(refuse(format!("it is {kind}: expected a file")));
    }
    let long = || refuse(format!("it has more than {MOST_BYTES} bytes"));
    if found.len() > MOST_BYTES {
        return Err(long());
    }
    let mut bytes = Vec::new();
    bytes
        .try_reserve_exact(found.len() as usize + 1)
        .map_err(|error| refuse(error.to_string()))?;
    let file = std::fs::File::open(path).map_err(failed)?;
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(long());
    }
    Ok(bytes)
}

/// The largest size of a file: places in it are numbers of 32 bits.
const MOST_BYTES: u64 = u32::MAX as u64;

/// Whether the content is a record in one of the formats.
pub(crate) fn is_record(bytes: &[u8]) -> bool {
    let Ok(content) = text::decode("", bytes) else { return false };
    Text::new("", &content).is_ok_and(|text| Format::of(&text).is_some())
}

fn unknown(text: &Text<'_>) -> RecordError {
    let mut lines = text.lines().enumerate();
    let first = lines.find(|(_, line)| !line.trim().is_empty());
    let (index, line) = first.unwrap_or_default();
    let (found, all) = (excerpt(line), Format::by_name());
    let words = all.iter().map(|format| match format.content {
        "" => format.name.to_owned(),
        content => format!("{} ({content})", format.name),
    });
    let expected = words.collect::<Vec<_>>().join(", ");
    text.on_line(index, Fault::UnknownFormat { found, expected })
}

/// Name of the file at `path`, without its folder; invalid UTF-8 is replaced.
pub(crate) fn name_of(path: &Path) -> String {
    path.file_name()
        .map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// File name without folders and without its ending, unless the ending is the
/// component (K-NET's `.EW`, EMOD3D's `.090` and `.ver`).
pub(crate) fn stem(file: &str) -> &str {
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
    match name.rsplit_once('.') {
        Some((stem, end)) if !stem.is_empty() && !is_component(end) => stem,
        _ => name,
    }
}

fn is_component(end: &str) -> bool {
    let letters = end.trim_end_matches(['1', '2']);
    let azimuth = end.len() == 3 && direction::is_azimuth(end);
    azimuth || matches!(letters, "EW" | "NS" | "UD" | "ver")
}

/// Settles interval and unit between file and caller, and converts.
fn complete(
    text: &Text<'_>,
    format: &'static Format,
    channel: Channel,
    several: bool,
    options: &ReadOptions,
) -> Result<Agreement> {
    let fail = |fault: Fault| fault.whole(text.file);
    let given =
        Fallback { dt: channel.dt.is_none(), unit: channel.unit.is_none() };
    let dt = match (channel.dt, options.dt_s) {
        (Some(stated_s), Some(given_s))
            if !((stated_s - given_s).abs() <= 1e-9 * stated_s) =>
        {
            Err(fail(Fault::IntervalConflict { stated_s, given_s }))
        }
        _ => Ok(()),
    };
    let dt_s = channel.dt.or(options.dt_s);
    let dt_s = dt_s.ok_or_else(|| fail(Fault::IntervalMissing))?;
    if !(dt_s > 0.0 && dt_s.is_finite()) {
        return Err(fail(Fault::Interval(dt_s.to_string())));
    }
    if !(dt_s >= INTERVALS_S.0 && dt_s <= INTERVALS_S.1) {
        return Err(fail(Fault::IntervalRange(dt_s)));
    }
    let same_unit = match (channel.unit, options.unit) {
        (Some(stated), Some(given)) if stated != given => {
            Err(fail(Fault::UnitConflict { stated, given }))
        }
        _ => Ok(()),
    };
    let unit = channel.unit.or(options.unit);
    let unit = unit.ok_or_else(|| fail(Fault::UnitMissing))?;
    let per_gravity = unit.per_gravity(options.gravity_m_s2);
    let mut samples = channel.samples;
    for sample in &mut samples {
        *sample /= per_gravity;
    }
    // With several channels the file name gives no direction.
    let mut name = stem(text.file).to_owned();
    let label = channel.label.as_deref().unwrap_or("");
    let stated = channel.direction;
    let stated =
        stated.unwrap_or_else(|| Direction::of_label(label, format.azimuths));
    let direction = stated.or(|| match several {
        true => Direction::Unknown,
        false => Direction::of_name(&name, format.azimuth_in_name),
    });
    let mut remarks = channel.remarks;
    if direction == Direction::Vertical {
        remarks.push(Remark::Vertical);
    }
    if channel.borehole {
        remarks.push(Remark::Borehole);
    }
    if several && channel.label.is_some() {
        name = format!("{name}:{}", label.replace(' ', "_"));
    }
    let Channel { label: channel, site, borehole, .. } = channel;
    // Components of one site are a pair of that name.
    for text in std::iter::once(&name).chain(&site) {
        result_name(text).map_err(|error| fail(error.into()))?;
    }
    let accelerogram = Accelerogram::try_new(name, dt_s, samples)
        .map_err(|error| fail(error.into()))?;
    let record = Record {
        accelerogram,
        format,
        unit,
        direction,
        borehole,
        remarks,
        channel,
        site,
        given,
    };
    Ok(Agreement { record, dt, unit: same_unit })
}
