//! Statements of a channel's header about its series, compared with the
//! series.

use std::ops::Range;

use crate::direction::Direction;
use crate::error::{Fault, RecordError, Result};
use crate::number;
use crate::text::{self, Text};
use rocking::units::AccelerationUnit;

/// Places in COSMOS's real header, from 1 (COSMOS strong-motion format 1.20,
/// Table 8).
const INTERVAL_MS: usize = 62;
const DURATION_S: usize = 63;
const PEAK: usize = 64;

/// Place in COSMOS's integer header of the sensor's orientation, from 1.
const ORIENTATION: usize = 54;

/// The null value.
const UNKNOWN: f64 = -999.0;

/// Relative difference that is allowed between a stated peak and the samples:
/// the header has three digits or more.
const PEAK_SHARE: f64 = 2e-3;

const SAME_COUNT: &str = "the number of points that announces the samples";
const SAME_INTERVAL: &str = "the interval that announces the samples";

/// The direction by COSMOS's integer header: an azimuth from 1 to 360, 400 to
/// 402 for vertical sensors, 500 to 801 for radial, transverse, longitudinal
/// and unoriented horizontal ones.
pub(super) fn oriented(integers: &[f64]) -> Direction {
    match integers.get(ORIENTATION - 1) {
        Some(400.0..=402.0) => Direction::Vertical,
        Some(1.0..=360.0 | 500.0..=801.0) => Direction::Horizontal,
        _ => Direction::Unknown,
    }
}

/// The header of a channel, and its samples.
pub(super) struct ChannelHeader<'t, 'a> {
    pub(super) text: &'t Text<'a>,
    /// Indices of the lines; the line after them announces the samples.
    pub(super) lines: Range<usize>,
    pub(super) samples: &'t [f64],
}

impl<'a> ChannelHeader<'_, 'a> {
    /// The header's lines.
    pub fn lines(&self) -> impl Iterator<Item = &'a str> {
        self.text.lines_from(self.lines.start).take(self.lines.len())
    }

    fn differs(&self, at: usize, expected: &'static str) -> RecordError {
        self.text.header(self.lines.start + at, expected)
    }

    /// The first line with `words`: its place, the text after them, and the
    /// line.
    fn after(&self, words: &str) -> Option<(usize, &'a str, &'a str)> {
        self.lines().enumerate().find_map(|(at, line)| {
            let from = line.to_ascii_lowercase().find(words)? + words.len();
            let rest = line.get(from..)?.trim_start_matches([' ', '=']);
            Some((at, rest, line))
        })
    }

    /// Refuses another number of points. The header of a corrected record also
    /// has the number of points before the correction, in capitals.
    pub fn check_count(&self) -> Result<()> {
        let raw = self.lines().next().is_some_and(|line| {
            text::contains(line.trim_start().get(..4).unwrap_or(""), "unco")
        });
        let Some((at, rest, line)) = self.after("no. of points") else {
            return Ok(());
        };
        let same = text::first_word(rest).parse() == Ok(self.samples.len());
        if same || !(raw || line.trim_start().starts_with("No. of Points")) {
            return Ok(());
        }
        Err(self.differs(at, SAME_COUNT))
    }

    /// The unit that announces the samples, or else the unit of the peak.
    pub fn unit(&self, announced: &str) -> Result<Option<AccelerationUnit>> {
        if announced.is_empty() {
            return Ok(self.peak().and_then(|(_, unit)| unit));
        }
        self.text.unit(self.lines.end, announced).map(Some)
    }

    /// CSMIP's peak of the corrected series, and its unit.
    fn peak(&self) -> Option<(f64, Option<AccelerationUnit>)> {
        let (_, rest, _) = self.after("peak acceleration")?;
        let mut words = rest.split_ascii_whitespace();
        let peak = number::finite(words.next()?)?;
        Some((peak, words.next().and_then(AccelerationUnit::parse)))
    }

    /// The interval of a CSMIP series, as the announcing line states it.
    pub fn of_csmip(
        &self,
        dt_s: Option<f64>,
        unit: Option<AccelerationUnit>,
    ) -> Result<Option<f64>> {
        let stated = "equally-spaced intervals of";
        if let (Some((at, rest, _)), Some(dt_s)) = (self.after(stated), dt_s) {
            let same = |x: f64| (x - dt_s).abs() <= 1e-6 * dt_s;
            if !number::finite(text::first_word(rest)).is_some_and(same) {
                return Err(self.differs(at, SAME_INTERVAL));
            }
        }
        if let Some((peak, _)) = self.peak().filter(|peak| peak.1 == unit) {
            self.check_peak(unit, peak)?;
        }
        Ok(dt_s)
    }

    /// The interval of a COSMOS series by its real header.
    pub fn of_cosmos(
        &self,
        reals: &[f64],
        unit: Option<AccelerationUnit>,
    ) -> Result<Option<f64>> {
        let value = |place: usize| {
            reals.get(place - 1).copied().filter(|x| *x != UNKNOWN)
        };
        let (text, announced) = (self.text, self.lines.end);
        let interval_ms = value(INTERVAL_MS);
        if let Some(ms) = interval_ms.filter(|ms| !(*ms > 0.0)) {
            let found = format!("real header value {INTERVAL_MS}: {ms}");
            let expected = "a positive interval in ms";
            return Err(text.differs(announced, found, expected));
        }
        let dt_s = interval_ms.map(|ms| ms / 1000.0);
        let line = text.line(announced).unwrap_or("");
        let approx = text::after(line, "approx")
            .and_then(|rest| text::first_word(rest).parse::<f64>().ok());
        if let Some(dt_s) = dt_s {
            let found_s = self.samples.len() as f64 * dt_s;
            // The line is rounded to seconds; the header may differ by a
            // sample.
            let stated = [(value(DURATION_S), 0.0), (approx, 1.0)];
            for (expected_s, rounded_s) in stated {
                let Some(expected_s) = expected_s else { continue };
                let allowed = rounded_s + 1.5 * dt_s + 0.01 * expected_s;
                if !((found_s - expected_s).abs() <= allowed) {
                    let fault = Fault::Duration { found_s, expected_s };
                    return Err(text.on_line(announced, fault));
                }
            }
        }
        if let Some(peak) = value(PEAK) {
            self.check_peak(unit, peak)?;
        }
        Ok(dt_s)
    }

    fn check_peak(
        &self,
        unit: Option<AccelerationUnit>,
        peak: f64,
    ) -> Result<()> {
        let Some(unit) = unit else { return Ok(()) };
        let allowed = PEAK_SHARE * peak.abs();
        self.text.check_peak(self.samples, peak, allowed, unit)
    }
}
