//! BRI (Building Research Institute, Japan), `.ac`: a line for the record,
//! then for each channel a line and its samples in 8F10.3, in cm/s2.
//!
//! `1993/01/15 20:06:08   3 100 15700 KSR: Kushiro` states channels, samples
//! per second and samples per channel; `063-GL` in a channel's line is an
//! azimuth and a place in or under the building. The peak behind it is
//! checked.

use super::{Channel, Format, GAL};
use crate::direction::Direction;
use crate::error::{Fault, Result};
use crate::fields::{self, FieldLayout};
use crate::keys::check_peak;
use crate::number;
use crate::text::Text;

const LAYOUT: FieldLayout = FieldLayout::even(8, 10);

/// The contents of the first line.
struct FirstLine<'a> {
    event: String,
    channels: usize,
    per_second: usize,
    count: usize,
    station: &'a str,
}

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "bri",
    files: "BRI `.ac`",
    source: "Japan",
    azimuths: true,
    recognises: |text| head(text).is_some(),
    read,
    ..Format::BASE
};

fn head<'a>(text: &Text<'a>) -> Option<FirstLine<'a>> {
    let line = text.line(0)?;
    let mut words = line.split_ascii_whitespace();
    let (date, time) = (words.next()?, words.next()?);
    let shape = |word: &str, mark: u8, length: usize| {
        let known = |b: u8| b.is_ascii_digit() || b == mark;
        word.len() == length
            && word.bytes().all(known)
            && word.bytes().filter(|b| *b == mark).count() == 2
    };
    let mut count = || words.next()?.parse().ok().filter(|n: &usize| *n > 0);
    let (channels, per_second, count) = (count()?, count()?, count()?);
    let station = words.next().unwrap_or("").trim_end_matches(':');
    let event = format!("{date} {time}");
    let known = shape(date, b'/', 10) && shape(time, b':', 8);
    known.then_some(FirstLine { event, channels, per_second, count, station })
}

/// Reads every channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>> {
    let head = head(text).ok_or_else(|| {
        text.header(0, "a date, a time and three counts of channels, samples")
    })?;
    let rows = head.count.div_ceil(LAYOUT.per_line);
    let mut channels = Vec::new();
    let mut index = 1;
    while let Some(line) = text.line(index) {
        if channels.len() == head.channels {
            let expected = "the end of the last channel";
            return Err(text.no_number(index, line, expected));
        }
        channels.push(channel(text, &head, index, rows)?);
        index += rows + 1;
    }
    if channels.len() < head.channels {
        return Err(text.at_end(Fault::Ends("a line for the next channel")));
    }
    Ok(channels)
}

/// Reads the channel whose line has index `index`.
fn channel(
    text: &Text<'_>,
    head: &FirstLine<'_>,
    index: usize,
    rows: usize,
) -> Result<Channel> {
    let line = text.line(index).unwrap_or("");
    let label = line.get(..10).unwrap_or(line).trim();
    let peak = number::finite(line.get(10..20).unwrap_or("").trim());
    let named = !label.is_empty() && !label.contains('.');
    let peak = peak.filter(|_| named).ok_or_else(|| {
        text.header(index, "a channel's name and peak in 10 characters each")
    })?;
    let first = index + 1;
    let end = first.saturating_add(rows).min(text.len());
    let samples = fields::read(text, first, end, Some(LAYOUT))?;
    text.check_count(end - 1, samples.len(), head.count)?;
    // The peak has the digits of the samples.
    check_peak(&samples, peak, 1.5e-3, GAL)
        .map_err(|fault| text.on_line(index, fault))?;
    let (azimuth, place) = label.split_once('-').unwrap_or((label, ""));
    let known = !head.station.is_empty() && !place.is_empty();
    let site = format!("{} {} {place}", head.event, head.station);
    Ok(Channel {
        label: Some(label.to_owned()),
        site: Some(site).filter(|_| known),
        direction: Some(Direction::of_label(azimuth, true)),
        ..Channel::of(1.0 / head.per_second as f64, GAL, samples)
    })
}
