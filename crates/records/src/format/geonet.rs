//! GeoNet (New Zealand), V1A and V2A: three components, each with 16 lines of
//! text, 40 integers (10I8), 60 reals (10F8) and samples in 10F8; V2A has
//! velocity and displacement after the acceleration.
//!
//! ```text
//! Uncorrected accelerogram 20160214_001343_NBLC_20 GNS Science
//! Number of points  26385    Duration 131.92 s
//! Raw readings in units of 1.00 mm/s/s  at intervals of 0.005 s
//! Component S14E
//! Acceleration:  Peak  -2080.5 mm/s/s at  23.28 s     RMS   145.6 mm/s/s
//! ```
//!
//! Text and numbers of the header both state count, interval and duration, and
//! must agree. The peak of the header must be the peak of the samples. Numbers
//! have as many decimals as fit into their field.

use super::{Channel, Format, GAL};
use crate::direction::Direction;
use crate::error::{Fault, RecordError, Result};
use crate::fields::{self, FieldLayout};
use crate::number;
use crate::text::{self, Text};

const TEXT_LINES: usize = 16;
const INTEGER_LINES: usize = 4;
const REAL_LINES: usize = 6;
const LAYOUT: FieldLayout = FieldLayout::even(10, 8);
const COMPONENTS: usize = 3;

/// Places in the text, from 0.
const POINTS: usize = 9;
const INTERVAL: usize = 10;
const COMPONENT: usize = 12;
const PEAK: usize = 13;

/// Places among the integers, from 1, of the numbers of samples of
/// acceleration, velocity and displacement, and of the interval (s) among the
/// reals.
const COUNTS: [usize; 3] = [34, 35, 36];
const INTERVAL_S: usize = 26;

/// mm/s2 in one cm/s2.
const PER_GAL: f64 = 10.0;

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "geonet",
    files: "GeoNet V1A and V2A",
    source: "New Zealand",
    recognises: |text| text.line(0).is_some_and(is_first),
    read,
    ..Format::BASE
};

fn is_first(line: &str) -> bool {
    text::contains(line, "corrected accelerogram")
        && text::contains(line, "GNS Science")
}

/// Reads the three components.
fn read(text: &Text<'_>) -> Result<Vec<Channel>> {
    let mut channels = Vec::with_capacity(COMPONENTS);
    let mut end = 0;
    for _ in 0..COMPONENTS {
        let channel;
        (channel, end) = component(text, end)?;
        channels.push(channel);
    }
    if end < text.len() {
        return Err(text.header(end, "three components"));
    }
    Ok(channels)
}

/// The header of the component that begins on the line of index `first`.
struct ComponentHeader<'t, 'a> {
    text: &'t Text<'a>,
    first: usize,
}

impl ComponentHeader<'_, '_> {
    /// The line of place `place` in the text.
    fn line(&self, place: usize) -> &str {
        self.text.line(self.first + place).unwrap_or("")
    }

    fn refuse(&self, place: usize, expected: &'static str) -> RecordError {
        self.text.header(self.first + place, expected)
    }

    /// The number after `word` on a line, and the text after it.
    fn after(&self, place: usize, word: &str) -> Option<(f64, &str)> {
        let rest = text::after(self.line(place), word)?.trim_start();
        let number = text::first_word(rest);
        Some((number::finite(number)?, &rest[number.len()..]))
    }

    /// The numbers of samples of acceleration, velocity and displacement.
    fn counts(&self, integers: &[f64]) -> Result<[usize; 3]> {
        let count = |place: usize| {
            let found = integers.get(place - 1).copied().unwrap_or(-1.0);
            let fine = (0.0..1e9).contains(&found);
            let line = TEXT_LINES + (place - 1) / LAYOUT.per_line;
            let expected = "numbers of samples (integers 34 to 36)";
            fine.then_some(found as usize)
                .ok_or_else(|| self.refuse(line, expected))
        };
        let [points, velocity, displacement] = COUNTS;
        let counts = [count(points)?, count(velocity)?, count(displacement)?];
        let same = |(stated, _)| stated == counts[0] as f64 && stated > 0.0;
        if self.after(POINTS, "points").is_some_and(same) {
            return Ok(counts);
        }
        Err(self.refuse(POINTS, "the number of points of integer 34"))
    }

    /// The interval (s) of `count` samples.
    fn interval(&self, reals: &[f64], count: usize) -> Result<f64> {
        let stated = self.after(INTERVAL, "intervals of");
        let stated = stated.or_else(|| self.after(INTERVAL, "at"));
        let fits = |(dt_s, unit): &(f64, &str)| {
            *dt_s > 0.0 && unit.trim_start().starts_with('s')
        };
        let Some((dt_s, _)) = stated.filter(fits) else {
            return Err(self.refuse(INTERVAL, "an interval in s"));
        };
        let same = |x: &f64| (x - dt_s).abs() <= 1e-6 * dt_s;
        if !reals.get(INTERVAL_S - 1).is_some_and(same) {
            return Err(self.refuse(INTERVAL, "the interval of real 26"));
        }
        let Some((expected_s, _)) = self.after(POINTS, "duration") else {
            return Err(self.refuse(POINTS, "a duration in s"));
        };
        let found_s = count as f64 * dt_s;
        // It counts samples or intervals, and is rounded.
        if !((found_s - expected_s).abs() <= 2.0 * dt_s + 0.01) {
            let fault = Fault::Duration { found_s, expected_s };
            return Err(self.text.on_line(self.first + POINTS, fault));
        }
        Ok(dt_s)
    }

    /// The peak acceleration in mm/s2.
    fn peak(&self) -> Result<f64> {
        let is_unit = |unit: &str| unit.trim_start().starts_with("mm/s/s");
        let raw = text::after(self.line(INTERVAL), "units");
        let readings = self.after(INTERVAL, "units of");
        let fits = |(factor, unit)| factor == 1.0 && is_unit(unit);
        if raw.is_some() && !readings.is_some_and(fits) {
            return Err(self.refuse(INTERVAL, "readings in 1.00 mm/s/s"));
        }
        let peak = self.after(PEAK, "peak").filter(|(_, unit)| {
            is_unit(unit) && text::contains(self.line(PEAK), "acceleration")
        });
        let refuse = || self.refuse(PEAK, "a peak acceleration in mm/s/s");
        peak.map(|(peak, _)| peak).ok_or_else(refuse)
    }
}

/// The component that begins on the line of index `first`, and the index of
/// the line after it.
fn component(text: &Text<'_>, first: usize) -> Result<(Channel, usize)> {
    let integers = first + TEXT_LINES;
    let reals = integers + INTEGER_LINES;
    let samples = reals + REAL_LINES;
    if text.len() <= samples {
        return Err(text.at_end(Fault::Ends("three components")));
    }
    let header = ComponentHeader { text, first };
    if !is_first(header.line(0)) {
        return Err(header.refuse(0, "the first line of a component"));
    }
    let integers = fields::read(text, integers, reals, Some(LAYOUT))?;
    let layout = LAYOUT.varied();
    let reals = fields::read(text, reals, samples, Some(layout))?;
    let counts = header.counts(&integers)?;
    let dt = header.interval(&reals, counts[0])?;
    let [points, others @ ..] = counts;
    let (mut samples, mut end) = fields::block(text, samples, points, layout)?;
    for count in others {
        (_, end) = fields::block(text, end, count, layout)?;
    }
    for sample in &mut samples {
        *sample /= PER_GAL;
    }
    let peak = header.peak()? / PER_GAL;
    // Large samples have fewer decimals than the text.
    let allowed = 1e-4 * peak.abs() + 0.06 / PER_GAL;
    text.check_peak(&samples, peak, allowed, GAL)?;
    let name = header.line(COMPONENT);
    let name = name.strip_prefix("Component").unwrap_or("").trim();
    let label = name.split("  ").next().unwrap_or("");
    let channel = Channel {
        label: text::named(label),
        direction: Some(direction(label)),
        ..Channel::of(dt, GAL, samples)
    };
    Ok((channel, end))
}

/// The direction by the component: `Up`, `Down`, or a bearing such as `N28W`,
/// `E90N` or `N`.
fn direction(component: &str) -> Direction {
    let bearing = component.starts_with(['N', 'E', 'S', 'W']);
    match Direction::of_label(component, false) {
        Direction::Unknown if bearing => Direction::Horizontal,
        direction => direction,
    }
}
