//! COSMOS V1 and V2, and their predecessors CSMIP V1 and V2: one or more
//! channels, each with its header and with announced blocks of fixed width.
//!
//! COSMOS: `6000 acceleration pts, approx 60 secs, units=cm/sec2 (4),
//! Format=(8F10.3)`, the interval of the series in milliseconds as the 62nd
//! real header value. (The 34th is the interval of the recorder, another
//! series.) CSMIP V2: `3000 points of accel data equally spaced at .020 sec,
//! in cm/sec2. (8f10.3)`; before 1990 `POINTS OF ACCEL DATA EQUALLY SPACED AT
//! .020 SEC. (UNITS: CM/SEC/SEC)`, whose first line shows the field width.
//! CSMIP V1 (raw): `35000 Accelerogram points at 100 pts/sec in units of g.
//! Format: (8f9.6)`. Velocity and displacement blocks are passed over. A file
//! of several channels that ends after one of them shows no trace of the
//! others.
//!
//! Count, interval, duration and peak are compared with everything else that
//! the header states about them (`stated.rs`).

use super::{Channel, Format};
use crate::direction::Direction;
use crate::error::{Fault, Result};
use crate::fields::{self, FieldLayout};
use crate::number;
use crate::text::{self, Text, excerpt};
use stated::ChannelHeader;

mod stated;

/// A line that announces a block of samples.
struct SampleBlock<'a> {
    count: usize,
    quantity: &'a str,
    unit: &'a str,
    layout: FieldLayout,
    dt_s: Option<f64>,
}

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "cosmos",
    files: "COSMOS and CSMIP V1 and V2",
    source: "United States",
    azimuths: true,
    recognises: |text| {
        text::any(text.text.as_bytes(), is_s) && text.lines().any(announces)
    },
    read,
    ..Format::BASE
};

/// A letter of all three forms, which no line of numbers has.
fn is_s(byte: u8) -> bool {
    byte.eq_ignore_ascii_case(&b's')
}

fn announces(line: &str) -> bool {
    line.bytes().any(is_s)
        && (is_cosmos(line) || is_csmip(line) || is_raw(line))
}

fn is_cosmos(line: &str) -> bool {
    text::after(line, "pts").is_some()
        && text::contains(line, "units=")
        && text::contains(line, "format=")
}

fn is_csmip(line: &str) -> bool {
    text::contains(line, "data equally spaced at")
}

fn is_raw(line: &str) -> bool {
    text::contains(line, RAW_RATE) && text::contains(line, RAW_UNIT)
}

const RAW_RATE: &str = "accelerogram points at";
const RAW_UNIT: &str = "pts/sec in units of";

/// Whether the line ends a channel's samples.
fn ends_block(line: &str) -> bool {
    text::contains(line, "end-of-data") || text::contains(line, "end of data")
}

/// Reads every acceleration channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>> {
    let mut channels = Vec::new();
    let mut head = 0;
    let mut reals = Vec::new();
    let mut integers = Vec::new();
    let mut index = 0;
    while let Some(line) = text.line(index) {
        let here = index;
        index += 1;
        if text::contains(line, "integer-header values follow") {
            // Codes of the station and the sensor, which no sample needs.
            integers = numeric_header(text, here).unwrap_or_default().0;
        } else if text::contains(line, "real-header values follow") {
            (reals, index) = numeric_header(text, here)?;
        } else if ends_block(line) {
            // Its samples were read on the lines before.
            if here != head || here == 0 {
                let expected = "samples, announced before their end";
                return Err(text.header(here, expected));
            }
            head += 1;
        } else if announces(line) {
            let SampleBlock { count, quantity, unit, layout, dt_s } =
                announced(text, here)?;
            let samples;
            (samples, index) = fields::block(text, index, count, layout)?;
            after_block(text, index)?;
            let lines = head..here;
            let header = ChannelHeader { text, lines, samples: &samples };
            header.check_count()?;
            if text::contains(quantity, "acc") {
                let unit = header.unit(unit)?;
                let dt = match is_cosmos(line) {
                    true => header.of_cosmos(&reals, unit)?,
                    false => header.of_csmip(dt_s, unit)?,
                };
                let number = channels.len() + 1;
                let (label, name) = label(header.lines(), number);
                let direction = Direction::of_label(&name, true)
                    .or(|| stated::oriented(&std::mem::take(&mut integers)));
                channels.push(Channel {
                    label: Some(label),
                    direction: Some(direction),
                    ..Channel::of(dt, unit, samples)
                });
            }
            head = index;
        }
    }
    let rest = text.lines_from(head).any(|line| {
        let line = line.trim_start();
        !line.is_empty() && !line.starts_with('|')
    });
    if rest && head > 0 {
        return Err(text.at_end(Fault::Ends("samples after a header")));
    }
    if channels.is_empty() {
        let first = text.lines().position(announces);
        return Err(text.quantity(first.unwrap_or_default()));
    }
    Ok(channels)
}

/// Refuses more numbers after a block: only words may follow.
fn after_block(text: &Text<'_>, end: usize) -> Result<()> {
    match text.line(end).filter(|line| number::is_data(line)) {
        Some(line) => Err(text.no_number(end, line, "the end of the samples")),
        None => Ok(()),
    }
}

fn announced<'a>(text: &Text<'a>, index: usize) -> Result<SampleBlock<'a>> {
    let line = text.line(index).unwrap_or("");
    let header = |expected| text.header(index, expected);
    let trimmed = line.trim_start();
    let (count, rest) =
        trimmed.split_once([' ', '\t']).unwrap_or((trimmed, ""));
    let count: usize = count
        .parse()
        .map_err(|_| header("a number of samples before the quantity"))?;
    let first = || fields::layout_of(text.line(index + 1).unwrap_or(""), 0);
    let layout = layout(line).or_else(|| first().filter(|_| is_csmip(line)));
    let layout = layout.ok_or_else(|| header("a format such as (8F10.3)"))?;
    if count == 0 {
        return Err(header("a positive number of samples"));
    }
    let (quantity, unit, dt_s) = if is_cosmos(line) {
        let lower = rest.to_ascii_lowercase();
        let quantity = lower.find("pts").map_or("", |end| &rest[..end]);
        let unit = lower.find("units=").map_or("", |at| &rest[at + 6..]);
        let unit = unit.split(['(', ',']).next().unwrap_or("").trim();
        (quantity, unit.trim_end_matches('.'), None)
    } else if is_raw(line) {
        raw(text, index, rest)?
    } else {
        equally_spaced(text, index, rest)?
    };
    Ok(SampleBlock { count, quantity, unit, layout, dt_s })
}

/// Quantity, unit and interval that a line states behind its count.
type Announcement<'a> = (&'a str, &'a str, Option<f64>);

/// The announcement of CSMIP V1.
fn raw<'a>(
    text: &Text<'_>,
    index: usize,
    rest: &'a str,
) -> Result<Announcement<'a>> {
    let lower = rest.to_ascii_lowercase();
    let after = |part: &str| {
        let from = lower.find(part).map_or(rest.len(), |at| at + part.len());
        text::first_word(&rest[from..])
    };
    let unit = after(RAW_UNIT).trim_end_matches(['.', ',']);
    match number::finite(after(RAW_RATE)).filter(|rate| *rate > 0.0) {
        Some(rate) => Ok(("accel", unit, Some(1.0 / rate))),
        None => Err(text.differs(index, excerpt(rest), "a rate in points/s")),
    }
}

/// The announcement of CSMIP V2.
fn equally_spaced<'a>(
    text: &Text<'_>,
    index: usize,
    rest: &'a str,
) -> Result<Announcement<'a>> {
    let spaced = "equally spaced at";
    let at = rest.to_ascii_lowercase().find(spaced).unwrap_or(0);
    let after = rest[at + spaced.len()..].trim_start();
    let end = after.find([' ', '\t', ',']).unwrap_or(after.len());
    let seconds = after[end..].trim_start().to_ascii_lowercase();
    let dt_s = number::finite(&after[..end]);
    let dt_s = dt_s.filter(|x| *x > 0.0 && seconds.starts_with("sec"));
    if dt_s.is_none() {
        return Err(text.on_line(index, Fault::Interval(excerpt(after))));
    }
    let unit = [" in units ", " in ", "units:"].iter().find_map(|word| {
        let from = seconds.find(word)? + word.len();
        let rest = &after[after.len() - seconds.len() + from..];
        rest.split(['(', ')', ',', ' ']).find(|part| !part.is_empty())
    });
    Ok((&rest[..at], unit.unwrap_or("").trim_end_matches('.'), dt_s))
}

/// The Fortran format of one kind of number in a line: `(8F10.3)`,
/// `(8(1PE10.4E1))`; after the word `format`, or at the end.
fn layout(line: &str) -> Option<FieldLayout> {
    let open = match text::after(line, "format") {
        Some(rest) => &rest[rest.find('(')?..],
        None => &line[line.rfind('(')?..],
    };
    let format = open.trim_start_matches('(');
    let letter =
        format.find(|c: char| "FEGIfegi".contains(c)).filter(|at| *at > 0)?;
    let count = |text: &str| {
        let digits = text.split(|c: char| !c.is_ascii_digit()).next()?;
        digits.parse().ok()
    };
    let layout =
        FieldLayout::even(count(format)?, count(&format[letter + 1..])?);
    let sane = (2..=64).contains(&layout.width)
        && (1..=64).contains(&layout.per_line);
    sane.then_some(layout)
}

/// The values of the integer or real header announced on line `index`, and
/// the index of the line after it.
fn numeric_header(text: &Text<'_>, index: usize) -> Result<(Vec<f64>, usize)> {
    let line = text.line(index).unwrap_or("");
    let header = |expected| text.header(index, expected);
    let count: usize = text::first_word(line)
        .parse()
        .map_err(|_| header("a number of header values"))?;
    let layout =
        layout(line).ok_or_else(|| header("a format such as (5F15.6)"))?;
    let end = index.saturating_add(1 + count.div_ceil(layout.per_line));
    if end > text.len() {
        return Err(text.at_end(Fault::Ends("the header values")));
    }
    // Each value of a header has its own number of decimals.
    let layout = Some(layout.varied());
    let values = fields::read(text, index + 1, end, layout)?;
    if values.len() != count {
        return Err(header("as many values as the line says"));
    }
    // One more value would have shifted the values after it.
    after_block(text, end)?;
    Ok((values, end))
}

/// The channel's number with its name, and its name, by its header:
/// `Chan 1: 90 deg`, `Chan ?: 90 Deg` or `COMP N08W`.
fn label<'a>(
    mut header: impl Iterator<Item = &'a str>,
    number: usize,
) -> (String, String) {
    let named = header.find_map(|line| {
        if let Some(name) = line.strip_prefix("COMP ") {
            let name = name.split_ascii_whitespace().next()?;
            return Some((format!("{number} {name}"), name.to_owned()));
        }
        let rest = text::after(line, "chan")?.trim_start();
        let known = |c: &char| c.is_ascii_digit() || *c == '?';
        let stated = rest.chars().take_while(known).count();
        let after = rest[stated..].trim_start().strip_prefix(':')?;
        let channel = match &rest[..stated] {
            "" => return None,
            "?" => number.to_string(),
            digits => digits.to_owned(),
        };
        let name = after.split(['(', ',']).next().unwrap_or("");
        let other = |word: &&str| {
            let next = ["from", "location:", "location"];
            !next.iter().any(|other| word.eq_ignore_ascii_case(other))
        };
        let words = name.split_ascii_whitespace().take_while(other);
        let words: Vec<&str> = words.take(2).collect();
        let name = words.join(" ");
        (!words.is_empty()).then(|| (format!("{channel} {name}"), name))
    });
    named.unwrap_or_else(|| (number.to_string(), String::new()))
}
