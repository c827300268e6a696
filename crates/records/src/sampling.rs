//! The constant step of times that a program wrote.
//!
//! Programs write times with a fixed number of decimals or of significant
//! digits, or store them in single precision. The true time then lies within a
//! resolution of the written one. The step is one that all times of the file
//! allow. If there is none, the file is refused at the first time that
//! contradicts those before it.

use thiserror::Error;

use crate::number::{self, Form};

/// The step of times, and how far the times lie from it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Sampling {
    /// Sampling interval in s.
    pub dt_s: f64,
    /// Largest distance in s of a time from constant steps.
    pub off_s: f64,
}

/// Why times have no constant step.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Uneven {
    /// Fewer than two times.
    #[error("number of times: {0}: expected at least 2")]
    Few(usize),
    /// A time that is not finite.
    #[error("a time that is not finite: expected a number of seconds")]
    NotFinite {
        /// Index of the time, from 0.
        index: usize,
    },
    /// The last time is not after the first.
    #[error(
        "the times end at {found_s} s: expected more than {expected_s} s, at which they begin"
    )]
    Backwards {
        /// Last time in s.
        found_s: f64,
        /// First time in s.
        expected_s: f64,
    },
    /// A time that contradicts a constant step.
    #[error(
        "time {found_s} s: expected {}, a constant step from the times before{}",
        times(*found_s, *expected_s),
        if *coarse { ", or times with more digits" } else { "" }
    )]
    Step {
        /// Index of the time, from 0.
        index: usize,
        /// The time in s.
        found_s: f64,
        /// Least and largest time in s that the times before allow.
        expected_s: (f64, f64),
        /// Whether the times are too coarse to show whether one is missing.
        coarse: bool,
    },
    /// Steps that differ by more than 1 % fit the times.
    #[error(
        "steps of {least_s:.3e} to {most_s:.3e} s fit the times: expected more times, or times with more digits"
    )]
    Unresolved {
        /// Least step in s.
        least_s: f64,
        /// Largest step in s.
        most_s: f64,
    },
}

impl Uneven {
    /// Index from 0 of the time at fault, if one is.
    pub fn index(&self) -> Option<usize> {
        match self {
            Self::NotFinite { index } | Self::Step { index, .. } => {
                Some(*index)
            }
            _ => None,
        }
    }
}

/// The least and the largest time that were expected instead of a time, with
/// the digits that distinguish them.
fn times(found: f64, (least, most): (f64, f64)) -> String {
    let apart = f64::max(least - found, found - most);
    let mut scale = 1.0;
    while !(scale * apart >= 10.0) && scale < 1e17 {
        scale *= 10.0;
    }
    match [least, most].map(|time| (time * scale).round() / scale) {
        [least, most] if least == most => format!("{least} s"),
        [least, most] => format!("{least} to {most} s"),
    }
}

/// The digits with which the times of a file are written.
///
/// ```
/// use rocking_records::sampling::Digits;
/// // Five significant digits at most, and three decimals at most.
/// let digits = Digits::of(&[99.99, 99.995, 100.0, 100.01]);
/// assert_eq!(digits.resolution_s(99.995), 0.0005);
/// assert_eq!(digits.resolution_s(100.01), 0.005);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Digits {
    decimals: i32,
    significant: i32,
}

impl Digits {
    /// The most decimals that are considered: a double has fewer.
    const MOST: i32 = 18;

    /// The digits of the shortest texts that are read as these times.
    pub fn of(times: &[f64]) -> Self {
        let mut digits = Self::default();
        for time in times {
            let text = format!("{time:e}");
            if let Some((_, form)) = number::read(&text) {
                digits.add(&text, form);
            }
        }
        digits
    }

    /// Adds a time as it is written, in this form.
    pub(super) fn add(&mut self, time: &str, form: Form) {
        let (mantissa, exponent) = time.split_at(time.len() - form.exponent);
        let exponent = exponent.trim_start_matches(['e', 'E', 'd', 'D']);
        let exponent: i32 = exponent.parse().unwrap_or(0);
        let count = |n: usize| i32::try_from(n).unwrap_or(i32::MAX);
        let decimals = count(form.decimals.unwrap_or(0));
        let decimals = decimals.saturating_sub(exponent);
        let written = mantissa.trim_start_matches(['+', '-', '0', '.']);
        let significant = written.bytes().filter(u8::is_ascii_digit).count();
        self.decimals = self.decimals.max(decimals).clamp(0, Self::MOST);
        let significant = self.significant.max(count(significant));
        self.significant = significant.min(Self::MOST);
    }

    /// Half a unit in s of the last digit with which `time_s` is written: the
    /// last decimal of the file, or the last significant digit if that is
    /// coarser. A zero that a program leaves out at the end is a digit, too.
    pub fn resolution_s(self, time_s: f64) -> f64 {
        let mut per_second = power_of_ten(self.decimals);
        let most = power_of_ten(self.significant.max(1));
        while time_s.abs() * per_second >= most {
            per_second /= 10.0;
        }
        0.5 / per_second
    }
}

fn power_of_ten(exponent: i32) -> f64 {
    (0..exponent).fold(1.0, |power, _| power * 10.0)
}

/// Error of a number rounded to single precision, over the number.
const SINGLE: f64 = 1.0 / (1_u32 << 24) as f64;

/// Part of the mean step by which a time may always be off: the error of sums
/// in double precision.
const SLACK: f64 = 1e-6;

/// Part of the mean step that distinguishes a missing time from a rounded one.
const RESOLVED: f64 = 0.25;

/// Part of the step by which the steps that fit may differ.
const DETERMINED: f64 = 0.01;

/// The constant step of `times_s`; time i is written to within
/// `resolution_s(i)`.
///
/// If times are stored in single precision, each may also be the rounded sum
/// of the one before and the step. Of the steps that all times allow, the one
/// with the fewest decimals or of a whole number of times per second is taken,
/// if it is the only one of its kind; else their middle.
///
/// ```
/// use rocking_records::sampling::{Digits, interval};
/// // 128 times a second, written with three decimals.
/// let times: Vec<f64> = (0..1000)
///     .map(|i| (f64::from(i) / 128.0 * 1e3).round() / 1e3)
///     .collect();
/// let digits = Digits::of(&times);
/// let found = interval(&times, |i| digits.resolution_s(times[i]))?;
/// assert_eq!(found.dt_s, 1.0 / 128.0);
/// let gap = interval(&[0.0, 0.01, 0.03, 0.04], |_| 0.0005);
/// assert_eq!(
///     gap.unwrap_err().to_string(),
///     "time 0.03 s: expected 0.018 to 0.022 s, a constant step from the \
///      times before"
/// );
/// # Ok::<(), rocking_records::sampling::Uneven>(())
/// ```
///
/// # Errors
/// [`Uneven`] for fewer than two times, times that do not increase, a time
/// that contradicts a constant step, and times whose digits do not resolve it.
pub fn interval(
    times_s: &[f64],
    resolution_s: impl Fn(usize) -> f64,
) -> Result<Sampling, Uneven> {
    if let Some(index) = times_s.iter().position(|t| !t.is_finite()) {
        return Err(Uneven::NotFinite { index });
    }
    let (&[start, second, ..], Some(&end)) = (times_s, times_s.last()) else {
        return Err(Uneven::Few(times_s.len()));
    };
    let mean = (end - start) / (times_s.len() - 1) as f64;
    if !(mean > 0.0) {
        let (found_s, expected_s) = (end, start);
        return Err(Uneven::Backwards { found_s, expected_s });
    }
    let slack =
        |i: usize| SLACK * mean + 4.0 * f64::EPSILON * times_s[i].abs();
    let exact = match constant(times_s, slack, |_| 0.0) {
        Ok(steps) => return steps.sampling(times_s),
        Err(fault) => fault,
    };
    let written = |i: usize| resolution_s(i) * (1.0 + SLACK) + slack(i);
    if !(written(0).max(written(1)) < RESOLVED * mean) {
        let (index, found_s, expected_s) = match exact {
            Uneven::Step { index, found_s, expected_s, .. }
                if second > start =>
            {
                (index, found_s, expected_s)
            }
            _ => (1, second, (start + mean, start + mean)),
        };
        return Err(Uneven::Step { index, found_s, expected_s, coarse: true });
    }
    let fault = match constant(times_s, written, |_| 0.0) {
        Ok(steps) => return steps.sampling(times_s),
        Err(fault) => fault,
    };
    let is_single = |i: usize| {
        let time = times_s[i];
        let single = f64::from(time as f32);
        (time - single).abs() <= resolution_s(i) * (1.0 + SLACK)
    };
    if !(0..times_s.len()).all(is_single) {
        return Err(fault);
    }
    // Each sum is rounded, and so is the step that it adds.
    let mut off = 0.0;
    let drift = times_s.iter().map(|time| {
        off += SINGLE * (time.abs() + mean);
        off
    });
    let drift: Vec<f64> = drift.collect();
    let rounded = |i: usize| written(i).max(SINGLE * times_s[i].abs());
    match constant(times_s, rounded, |i| drift[i]) {
        Ok(steps) => steps.sampling(times_s),
        Err(other) if other.index() > fault.index() => Err(other),
        Err(_) => Err(fault),
    }
}

/// The least and the largest step in s that times allow.
struct Steps {
    least_s: f64,
    most_s: f64,
}

impl Steps {
    fn sampling(self, times_s: &[f64]) -> Result<Sampling, Uneven> {
        let Self { least_s, most_s } = self;
        let dt_s = self.plain();
        if !(most_s - least_s <= DETERMINED * dt_s) {
            return Err(Uneven::Unresolved { least_s, most_s });
        }
        let start = times_s[0];
        let (mut low, mut high) = (0.0_f64, 0.0_f64);
        for (i, time) in times_s.iter().enumerate() {
            let off = time - start - i as f64 * dt_s;
            (low, high) = (low.min(off), high.max(off));
        }
        Ok(Sampling { dt_s, off_s: 0.5 * (high - low) })
    }

    /// The plainest step among these: the coarser its kind, the less likely
    /// it fits by chance.
    fn plain(&self) -> f64 {
        let Self { least_s, most_s } = *self;
        let middle = 0.5 * (least_s + most_s);
        let fits = |step: f64| step >= least_s && step <= most_s;
        let decimal = (0..=Digits::MOST).find_map(|decimals| {
            let scale = power_of_ten(decimals);
            let step = (middle * scale).round() / scale;
            fits(step).then_some((1.0 / scale, step))
        });
        let whole = 1.0 / (1.0 / middle).round();
        // The first number is the distance to the next step of its kind.
        let whole = fits(whole).then_some((whole * whole, whole));
        let plain = match (decimal, whole) {
            (Some(decimal), Some(whole)) if whole.0 > decimal.0 => Some(whole),
            (decimal, whole) => decimal.or(whole),
        };
        plain
            .filter(|(apart, _)| *apart >= most_s - least_s)
            .map_or(middle, |(_, step)| step)
    }
}

/// The steps dt for which some t0 puts t0 + i dt within `allowed` of each time
/// i. Each sum of a time and the step may be off; `drift` bounds the error of
/// all sums up to a time.
fn constant(
    times_s: &[f64],
    allowed: impl Fn(usize) -> f64,
    drift: impl Fn(usize) -> f64,
) -> Result<Steps, Uneven> {
    let start = times_s[0];
    let ends = |i: usize| {
        let time = times_s[i] - start;
        (time - allowed(i), time + allowed(i))
    };
    // dt is at least each slope from an upper end to a later lower end, and
    // at most each from a lower end to a later upper end.
    let (mut rise, mut fall) =
        (Steepest::from(0.0), Steepest::from(f64::NEG_INFINITY));
    for (index, &found_s) in times_s.iter().enumerate() {
        let ((low, high), off) = (ends(index), drift(index));
        let (least, most) = (rise.slope, -fall.slope);
        rise.add(index, high - off, low - off);
        fall.add(index, -low - off, -high - off);
        if !(rise.slope <= -fall.slope) {
            let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
            for i in 0..index {
                let (steps, off) = ((index - i) as f64, off - drift(i));
                let (low, high) = ends(i);
                from = from.max(low + steps * least - off);
                to = to.min(high + steps * most + off);
            }
            let within = allowed(index);
            let expected_s = (start + from - within, start + to + within);
            let coarse = false;
            return Err(Uneven::Step { index, found_s, expected_s, coarse });
        }
    }
    Ok(Steps { least_s: rise.slope, most_s: -fall.slope })
}

/// The largest slope from a point to one that was added later.
struct Steepest {
    /// Lower hull of the points, from left to right.
    hull: Vec<(f64, f64)>,
    slope: f64,
}

impl Steepest {
    fn from(slope: f64) -> Self {
        Self { hull: Vec::new(), slope }
    }

    /// Adds a point at `x` from which slopes begin at `from`, and end at `to`.
    fn add(&mut self, x: usize, from: f64, to: f64) {
        let x = x as f64;
        let slope = |a: (f64, f64), b: (f64, f64)| (b.1 - a.1) / (b.0 - a.0);
        // Along the hull the slope to the new point rises, then falls.
        let (mut first, mut last) = (0, self.hull.len());
        while first + 1 < last {
            let middle = first.midpoint(last);
            let here = slope(self.hull[middle], (x, to));
            match slope(self.hull[middle - 1], self.hull[middle]) < here {
                true => first = middle,
                false => last = middle,
            }
        }
        if let Some(point) = self.hull.get(first) {
            self.slope = self.slope.max(slope(*point, (x, to)));
        }
        while let [.., a, b] = self.hull[..]
            && slope(a, b) >= slope(b, (x, from))
        {
            self.hull.pop();
        }
        self.hull.push((x, from));
    }
}

#[cfg(test)]
mod tests;
