//! Linear and logarithmic axes with round ticks, as axes of plotters.
//!
//! plotters chooses the ticks of a linear axis. On a logarithmic axis it marks
//! nothing below the first decade: the ticks there are our own. So is the
//! mapping, because plotters takes the logarithm of the platform.

use std::ops::Range;

use plotters::coord::ranged1d::{
    BoldPoints, KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter,
};
use plotters::coord::types::RangedCoordf64;
use serde::{Deserialize, Serialize};

/// A labelled position on an axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tick {
    /// Where.
    pub at: f64,
    /// What is written there, in [`super::markup`]; may be empty.
    pub label: String,
}

/// How values go to places.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum AxisScale {
    /// Linear.
    Linear,
    /// Logarithmic.
    Logarithmic,
}

impl AxisScale {
    /// What the axis is linear in; NaN for what it cannot show.
    fn of(self, x: f64) -> f64 {
        match self {
            Self::Linear => x,
            _ if !(x > 0.0) => f64::NAN,
            Self::Logarithmic => libm::log(x),
        }
    }

    /// The value of what the axis is linear in.
    fn value(self, y: f64) -> f64 {
        match self {
            Self::Linear => y,
            Self::Logarithmic => libm::exp(y),
        }
    }
}

/// An axis: a range, ticks and a label.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    low: f64,
    high: f64,
    pub(crate) scale: AxisScale,
    /// The labelled ticks.
    pub ticks: Vec<Tick>,
    /// The unlabelled ticks.
    pub minor: Vec<f64>,
    /// The label, in [`super::markup`].
    pub title: String,
    /// Whether grid lines are wanted.
    pub grid: bool,
}

impl Axis {
    /// A linear axis of exactly this range, with about `count` ticks. A
    /// range without extent is widened.
    pub fn linear(low: f64, high: f64, count: usize) -> Self {
        let (low, high) = proper(low, high);
        Self::divided(low, high, most(count))
    }

    fn divided(low: f64, high: f64, most: usize) -> Self {
        let round = round_numbers(low, high, most);
        let digits = decimals(round[1] - round[0]);
        let tick = |at| Tick { at, label: fixed(at, digits) };
        let ticks = round.into_iter().map(tick).collect();
        Self { ticks, ..Self::new(low, high, AxisScale::Linear) }
    }

    fn new(low: f64, high: f64, scale: AxisScale) -> Self {
        let (ticks, minor, title) = (Vec::new(), Vec::new(), String::new());
        Self { low, high, scale, ticks, minor, title, grid: true }
    }

    /// A linear axis that ends at the ticks around the range.
    pub fn around(low: f64, high: f64, count: usize) -> Self {
        let (low, high) = proper(low, high);
        let round = round_numbers(low, high, most(count) - 1);
        let step = round[1] - round[0];
        let down = (low / step + 1e-6).floor() * step;
        let up = (high / step - 1e-6).ceil() * step;
        Self::divided(down, up, round.len() + 2)
    }

    /// A logarithmic axis of exactly this range; ends that are not positive
    /// become 0.1 and 10.
    pub fn logarithmic(low: f64, high: f64) -> Self {
        let (low, high) = match low > 0.0 && low.is_finite() {
            true if high > low && high.is_finite() => (low, high),
            true => (low / 2.0, low * 2.0),
            false => (0.1, 10.0),
        };
        let decades = libm::log10(high / low);
        let mut axis = Self::new(low, high, AxisScale::Logarithmic);
        if decades < 0.6 {
            axis.ticks = Self::linear(low, high, 5).ticks;
            return axis;
        }
        let first = libm::log10(low).floor() as i32;
        let last = libm::log10(high).ceil() as i32;
        let every = (f64::from(last - first) / 7.0).ceil().max(1.0) as i32;
        let inside = low * (1.0 - 1e-9)..=high * (1.0 + 1e-9);
        for decade in first..=last {
            let power = format!("10^{{{}}}", minus(&decade.to_string()));
            for digit in 1..10 {
                let at = f64::from(digit) * libm::pow(10.0, f64::from(decade));
                let is_labelled = match digit {
                    1 => decade.rem_euclid(every) == 0,
                    2 | 5 => decades < 2.2,
                    _ => false,
                };
                let label = match digit {
                    _ if first >= -2 && last <= 3 => {
                        fixed(at, usize::try_from(-decade).unwrap_or(0))
                    }
                    1 => power.clone(),
                    _ => format!("{digit}·{power}"),
                };
                match is_labelled {
                    _ if !inside.contains(&at) => {}
                    true => axis.ticks.push(Tick { at, label }),
                    false if every > 1 && digit > 1 => {}
                    false => axis.minor.push(at),
                }
            }
        }
        axis
    }

    /// An axis of names at 1, 2, 3 and so on.
    pub fn named(names: &[String]) -> Self {
        let tick =
            |(at, name): (f64, &String)| Tick { at, label: name.clone() };
        let ticks = (1..).map(f64::from).zip(names).map(tick).collect();
        let high = names.len().max(1) as f64 + 0.6;
        let axis = Self::new(0.4, high, AxisScale::Linear);
        Self { grid: false, ticks, ..axis }
    }

    /// The same with a label, in [`super::markup`].
    pub fn label(self, label: impl Into<String>) -> Self {
        Self { title: label.into(), ..self }
    }

    /// The same with these ticks in place of its own.
    pub fn with_ticks(self, ticks: Vec<Tick>) -> Self {
        Self { ticks, minor: Vec::new(), ..self }
    }

    /// Both ends.
    pub fn range(&self) -> (f64, f64) {
        (self.low, self.high)
    }

    /// Where a value lies: 0 at the lower end, 1 at the upper; NaN for what
    /// the axis cannot show.
    pub fn place(&self, x: f64) -> f64 {
        let [low, high] = [self.low, self.high].map(|x| self.scale.of(x));
        (self.scale.of(x) - low) / (high - low)
    }

    /// The value at a place.
    pub(crate) fn value(&self, place: f64) -> f64 {
        let [low, high] = [self.low, self.high].map(|x| self.scale.of(x));
        self.scale.value(place.mul_add(high - low, low))
    }
}

/// A number of points that stands for the unlabelled ticks.
pub(crate) const UNLABELLED: usize = 0;

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, x: &f64, (from, to): (i32, i32)) -> i32 {
        // What the axis cannot show lies below it.
        let (place, from) = (self.place(*x).max(-1.0), f64::from(from));
        place.mul_add(f64::from(to) - from, from).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match hint.bold_points() {
            UNLABELLED => self.minor.clone(),
            _ => self.ticks.iter().map(|tick| tick.at).collect(),
        }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, at: &f64) -> String {
        let tick = self.ticks.iter().find(|tick| tick.at == *at);
        tick.map_or(String::new(), |tick| tick.label.clone())
    }
}

/// A range with an extent that rounding does not spoil.
fn proper(low: f64, high: f64) -> (f64, f64) {
    let least = (1e-12 * low.abs().max(high.abs())).max(1e-300);
    if (least..1e300).contains(&(high - low)) {
        (low, high)
    } else if low.abs() < 1e300 {
        let half = if low.abs() < 1e-299 { 0.5 } else { 0.1 * low.abs() };
        (low - half, low + half)
    } else {
        (0.0, 1.0)
    }
}

/// The most ticks of an axis with about this many.
fn most(count: usize) -> usize {
    count.clamp(4, 13) * 3 / 2
}

/// Round numbers of a range by plotters: two at least, `most` at most.
///
/// plotters takes the logarithm of the platform. In tenths of the extent's
/// power of ten its numbers are whole: rounding there gives the same bits on
/// every machine. A hair more range keeps the ticks at both ends.
fn round_numbers(low: f64, high: f64, most: usize) -> Vec<f64> {
    let hair = 1e-7 * (high - low);
    let unit = libm::pow(10.0, libm::log10(high - low).floor() - 1.0);
    let range = (low - hair) / unit..(high + hair) / unit;
    let whole = RangedCoordf64::from(range).key_points(BoldPoints(most));
    whole.into_iter().map(|n| n.round() * unit).collect()
}

/// Decimals that a step needs.
fn decimals(step: f64) -> usize {
    // A negative number becomes 0.
    (-libm::log10(step * (1.0 + 1e-9)).floor()) as usize
}

/// A number with a true minus sign, and without one before zero.
fn fixed(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    if text.parse() == Ok(0.0) {
        return format!("{:.digits$}", 0.0);
    }
    minus(&text)
}

fn minus(text: &str) -> String {
    text.replace('-', "−")
}
