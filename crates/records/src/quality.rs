//! Suspicions about a record that could be read.
//!
//! A remark changes nothing: samples stay as they are.

use std::borrow::Cow;
use std::cmp::Ordering::Equal;
use std::collections::BTreeMap;

use thiserror::Error;

use super::codes::coded;
use crate::record::Fallback;
use rocking::accelerogram::{Accelerogram, mean};
use rocking::stop;

pub use profile::{MemberMotion, Profile};

mod profile;

/// Range of PGA in g; outside it the unit is suspected.
const PGA_RANGE_G: (f64, f64) = (1e-4, 3.0);
/// Range of sampling intervals in s; outside it the interval is suspected.
const INTERVAL_RANGE_S: (f64, f64) = (1e-4, 0.1);
/// Consecutive samples at the peak that mean clipping.
const CLIPPED_SAMPLES: usize = 3;
/// Time (s) with the same non-zero sample that means a dead channel.
const FLAT_S: f64 = 0.5;
/// Allowed distance of a time from constant steps, over the interval.
const TIMES_OFF: f64 = 0.01;
/// Share of PGV that the velocity at the end may reach.
const END_VELOCITY: f64 = 0.1;
/// Share of PGA that the mean may reach.
const OFFSET: f64 = 0.01;
/// Time (s) of exact zeros at one end that means padding.
const PADDING_S: f64 = 1.0;
/// Correlation about the peaks above which two records are one.
const SAME_RECORDING: f64 = 0.98;
/// The most samples on each side of the peak that are compared, and the fewest
/// on both sides together.
const COMPARED_SAMPLES: usize = 512;
const LEAST_COMPARED: usize = 64;
/// Samples on each side of the peak that are compared first. The others are
/// compared only if the correlation of the first exceeds the second number.
const FEW_SAMPLES: usize = 32;
const NOT_YET_DIFFERENT: f64 = 0.8;

coded! {
    /// One suspicion, with the value that raised it.
    #[derive(Clone, Debug, PartialEq, Error)]
    #[non_exhaustive]
    pub enum Remark {
        /// PGA outside the range of records.
        #[error(
            "PGA {pga_g:.3e} g, outside {} to {} g: is the unit right?",
            PGA_RANGE_G.0,
            PGA_RANGE_G.1
        )]
        Units {
            /// PGA in g.
            pga_g: f64,
        } = "units",
        /// The peak lasts for several samples.
        #[error("{samples} consecutive samples at the peak: clipped?")]
        Clipped {
            /// Longest run at the peak.
            samples: usize,
        } = "clipped",
        /// The record is constant at a value that is not zero.
        #[error("the same sample for {duration_s:.2} s: dead channel?")]
        Flat {
            /// Longest time at one value in s.
            duration_s: f64,
        } = "flat",
        /// The velocity does not come back to zero.
        #[error(
            "velocity at the end is {:.0} % of PGV: no baseline correction?",
            share * 100.0
        )]
        EndVelocity {
            /// |v(end)| / PGV.
            share: f64,
        } = "end-velocity",
        /// The samples have a mean.
        #[error(
            "mean is {:.1} % of PGA: instrument offset? PGA is {pga_g:.3e} g, and {moving_g:.3e} g without the mean (--demean)",
            share * 100.0
        )]
        Offset {
            /// |mean| / PGA.
            share: f64,
            /// PGA in g.
            pga_g: f64,
            /// PGA without the mean in g.
            moving_g: f64,
        } = "offset",
        /// A sampling interval outside the range of recorders.
        #[error(
            "sampling interval {dt_s} s, outside {} to {} s: is it an interval, and in s?",
            INTERVAL_RANGE_S.0,
            INTERVAL_RANGE_S.1
        )]
        Interval {
            /// Sampling interval in s.
            dt_s: f64,
        } = "interval",
        /// All samples on one side of zero.
        #[error("no sample is below zero: a spectrum?")]
        OneSided = "one-sided",
        /// The sampling rate is not a whole number of samples a second.
        #[error(
            "interval {dt_s} s is {:.2} samples/s: rounded in the header?",
            1.0 / dt_s
        )]
        IntervalRounded {
            /// Sampling interval in s.
            dt_s: f64,
        } = "interval-rounded",
        /// Times that are rounded, or sums in single precision.
        #[error(
            "times lie up to {off_s:.2e} s from constant steps of {dt_s} s, which are taken: rounded, or added up in single precision?"
        )]
        Times {
            /// Sampling interval in s.
            dt_s: f64,
            /// Largest distance in s.
            off_s: f64,
        } = "times",
        /// Zeros at the ends.
        #[error(
            "exact zeros for {leading_s:.2} s at the start and {trailing_s:.2} s at the end: padded"
        )]
        Padding {
            /// At the start in s.
            leading_s: f64,
            /// At the end in s.
            trailing_s: f64,
        } = "padding",
        /// A vertical component, which rocks no block by itself.
        #[error("a vertical component: expected a horizontal one")]
        Vertical = "vertical",
        /// The sensor is in a borehole.
        #[error(
            "from a sensor in a borehole: weaker than the motion of the surface"
        )]
        Borehole = "borehole",
        /// A record of a folder or archive whose direction is not known.
        #[error(
            "neither the header nor the file's name tells the direction: horizontal? (an index says so)"
        )]
        Direction = "direction",
        /// A last line without its end, whose number may be cut.
        #[error(
            "the last line has no line end: its number is taken as written; was the file cut?"
        )]
        LastLine = "last-line",
        /// The two components of a pair differ in interval. They may differ in
        /// length: measures of a pair put zeros behind the shorter one.
        #[error("{0} has another sampling interval: no measure of the pair")]
        UnequalComponents(String) = "unequal-components",
        /// Other records with the same motion.
        #[error(
            "correlation {correlation:.3} with {other} about the peaks{}: the same recording?",
            and_others(*more)
        )]
        Duplicate {
            /// Name of the first other record.
            other: String,
            /// Absolute correlation coefficient with it.
            correlation: f64,
            /// Number of further records.
            more: usize,
        } = "duplicate",
    }
}

impl Remark {
    /// The remark on times up to `off_s` from constant steps `dt_s`, if any.
    pub(super) fn of_times(dt_s: f64, off_s: f64) -> Option<Self> {
        let near = off_s <= TIMES_OFF * dt_s;
        (!near).then_some(Self::Times { dt_s, off_s })
    }
}

fn and_others(more: usize) -> String {
    match more {
        0 => String::new(),
        1 => ", and similar with 1 other".to_owned(),
        more => format!(", and similar with {more} others"),
    }
}

/// A record to be judged beside others.
#[derive(Clone, Debug)]
pub struct RemarkInput<'a> {
    /// The record.
    pub profile: Cow<'a, Profile>,
    /// Name of its pair.
    pub pair: Option<&'a str>,
    /// Remarks of its reading.
    pub read: &'a [Remark],
    /// Values of the caller that the file does not state.
    pub given: Fallback,
}

impl<'a> RemarkInput<'a> {
    /// A record, the name of its pair, and the remarks of its reading.
    pub fn of(
        record: &Accelerogram,
        pair: Option<&'a str>,
        read: &'a [Remark],
    ) -> Self {
        let (profile, given) =
            (Cow::Owned(Profile::of(record)), Fallback::default());
        Self { profile, pair, read, given }
    }
}

/// Suspicions about the samples of one record.
///
/// ```
/// use rocking::accelerogram::Accelerogram;
/// use rocking_records::remarks;
/// let gal = Accelerogram::try_new("x", 0.01, vec![0.0, 310.0, -310.0, 0.0])?;
/// let codes: Vec<_> = remarks(&gal).iter().map(|r| r.code()).collect();
/// assert_eq!(codes, ["units"]);
/// # Ok::<(), rocking::accelerogram::AccelerogramError>(())
/// ```
pub fn remarks(record: &Accelerogram) -> Vec<Remark> {
    let mut found = Vec::new();
    let (dt_s, samples) = (record.dt_s(), record.samples_g());
    let pga_g = record.pga_g();
    if !(pga_g >= PGA_RANGE_G.0 && pga_g <= PGA_RANGE_G.1) {
        found.push(Remark::Units { pga_g });
    }
    let at_peak = longest_run(samples, |a| a.abs() == pga_g && pga_g > 0.0);
    if at_peak >= CLIPPED_SAMPLES {
        found.push(Remark::Clipped { samples: at_peak });
    }
    let duration_s = longest_run(samples, |a| a != 0.0) as f64 * dt_s;
    if duration_s >= FLAT_S {
        found.push(Remark::Flat { duration_s });
    }
    let mut sum = 0.0;
    for pair in samples.windows(2) {
        sum += pair[0] + pair[1];
    }
    let share = f64::abs(0.5 * dt_s * sum) / record.pgv_g_s();
    if share > END_VELOCITY {
        found.push(Remark::EndVelocity { share });
    }
    let mean = mean(samples);
    let share = mean.abs() / pga_g;
    if share > OFFSET {
        let peak = |peak: f64, a: &f64| peak.max((a - mean).abs());
        let moving_g = samples.iter().fold(0.0, peak);
        found.push(Remark::Offset { share, pga_g, moving_g });
    }
    let positive = samples.iter().filter(|a| **a > 0.0).count();
    if 2 * positive > samples.len() && samples.iter().all(|a| *a >= 0.0) {
        found.push(Remark::OneSided);
    }
    if !(dt_s >= INTERVAL_RANGE_S.0 && dt_s <= INTERVAL_RANGE_S.1) {
        found.push(Remark::Interval { dt_s });
    }
    let rate = 1.0 / dt_s;
    if (rate - rate.round()).abs() > 1e-6 * rate && dt_s < 1.0 {
        found.push(Remark::IntervalRounded { dt_s });
    }
    let zeros = |n: usize| n as f64 * dt_s;
    let leading = samples.iter().take_while(|a| **a == 0.0).count();
    let trailing = samples.iter().rev().take_while(|a| **a == 0.0).count();
    let (leading_s, trailing_s) = (zeros(leading), zeros(trailing));
    if leading_s >= PADDING_S || trailing_s >= PADDING_S {
        found.push(Remark::Padding { leading_s, trailing_s });
    }
    found
}

/// Longest run of equal consecutive samples for which `counts` is true.
fn longest_run(samples: &[f64], counts: impl Fn(f64) -> bool) -> usize {
    let runs = samples.chunk_by(|a, b| a == b).filter(|run| counts(run[0]));
    runs.map(<[f64]>::len).max().unwrap_or(0)
}

/// For each record, the others that seem to be the same recording, if any: the
/// index of the first, the absolute correlation with it, and their number.
///
/// Records of equal interval are compared, aligned at their peaks: 32 samples
/// on each side and, if these are alike, up to 512. Scale, sign and mean do
/// not matter.
fn duplicates(records: &[&Profile]) -> Vec<Option<(usize, f64, usize)>> {
    let motion = |i: &usize| {
        (records[*i].dt_s, records[*i].before, &records[*i].about_peak)
    };
    let mut sorted: Vec<usize> = (0..records.len()).collect();
    sorted.sort_by(|i, j| motion(i).partial_cmp(&motion(j)).unwrap_or(Equal));
    // Equal motions are compared once, whatever their number.
    let equal = sorted.chunk_by(|i, j| motion(i) == motion(j));
    let near = |group: &[usize]| records[group[0]].near_peak();
    let motions: Vec<_> = equal.map(|group| (group, near(group))).collect();
    let mut found = vec![None; records.len()];
    let mut note = |of: &[usize], by: &[usize], correlation| {
        for &i in of {
            let others = by.len() - usize::from(by.binary_search(&i).is_ok());
            let other = by[usize::from(by[0] == i)];
            let (first, with_first, count) =
                found[i].get_or_insert((other, correlation, 0));
            *count += others;
            if other < *first {
                (*first, *with_first) = (other, correlation);
            }
        }
    };
    for i in 0..motions.len() {
        stop::point();
        let (of, near) = &motions[i];
        for (by, other) in &motions[i + usize::from(of.len() == 1)..] {
            let (first, second) = (records[of[0]], records[by[0]]);
            if differ(near, other) || first.dt_s != second.dt_s {
                continue;
            }
            let correlation = correlation(first, second);
            if correlation > SAME_RECORDING {
                note(of, by, correlation);
                if of != by {
                    note(by, of, correlation);
                }
            }
        }
    }
    found
}

/// Remarks on each of several records: those of their reading, [`remarks`],
/// components of a pair that are not alike, and records that seem to be the
/// same recording.
pub fn remarks_together(records: &[RemarkInput<'_>]) -> Vec<Vec<Remark>> {
    let mut found: Vec<Vec<Remark>> = records
        .iter()
        .map(|one| [one.read, &one.profile.remarks].concat())
        .collect();
    let mut pairs: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (i, record) in records.iter().enumerate() {
        if let Some(pair) = record.pair {
            pairs.entry(pair).or_default().push(i);
        }
    }
    for (i, RemarkInput { profile, pair, .. }) in records.iter().enumerate() {
        let others = pair.map_or(&[][..], |pair| &pairs[pair]);
        let Some(&other) = others.iter().find(|j| **j != i) else { continue };
        let other = &records[other].profile;
        if profile.dt_s != other.dt_s {
            found[i].push(Remark::UnequalComponents(other.name.clone()));
        }
    }
    let profiles: Vec<_> = records.iter().map(|one| &*one.profile).collect();
    for (own, others) in found.iter_mut().zip(duplicates(&profiles)) {
        own.extend(others.map(|(first, correlation, count)| {
            let other = profiles[first].name.clone();
            Remark::Duplicate { other, correlation, more: count - 1 }
        }));
    }
    found
}

/// Number of sums that are computed side by side.
const LANES: usize = 8;

/// Motion near a peak.
struct NearPeak {
    /// Samples less their mean, of length 1.
    unit: [f32; 2 * FEW_SAMPLES],
    /// The least correlation of these samples with those of the same recording.
    least: f64,
}

/// Whether two motions are certainly too different near their peaks.
fn differ(first: &Option<NearPeak>, second: &Option<NearPeak>) -> bool {
    let (Some(first), Some(second)) = (first, second) else { return false };
    let (x, y) = (
        first.unit.as_chunks::<LANES>().0,
        second.unit.as_chunks::<LANES>().0,
    );
    let mut sums = [0.0_f32; LANES];
    for (x, y) in x.iter().zip(y) {
        for k in 0..LANES {
            sums[k] += x[k] * y[k];
        }
    }
    let sum: f32 = sums.iter().sum();
    // With a margin for single precision.
    !(f64::from(sum.abs()) > first.least.max(second.least) - 1e-4)
}

fn correlation(first: &Profile, second: &Profile) -> f64 {
    let before = first.before.min(second.before);
    let rest = |w: &Profile| w.about_peak.len() - w.before;
    let after = rest(first).min(rest(second));
    if before + after < LEAST_COMPARED {
        return 0.0;
    }
    let about = |before: usize, after: usize| {
        let part = |w: &Profile| w.before - before..w.before + after;
        let x = &first.about_peak[part(first)];
        of_samples(x, &second.about_peak[part(second)])
    };
    // A quick test, which saves most of the work.
    let few = before.min(FEW_SAMPLES) + after.min(FEW_SAMPLES);
    if few >= FEW_SAMPLES {
        let near = about(before.min(FEW_SAMPLES), after.min(FEW_SAMPLES));
        if !(near > NOT_YET_DIFFERENT) {
            return 0.0;
        }
    }
    about(before, after)
}

/// Mean of samples.
fn mean_of(samples: &[f32]) -> f64 {
    let sum = samples.iter().fold(0.0, |sum, a| sum + f64::from(*a));
    sum / samples.len() as f64
}

/// Absolute correlation of samples less their means.
fn of_samples(x: &[f32], y: &[f32]) -> f64 {
    let mut sums = [[0.0_f64; LANES]; 5];
    let mut add = |x: &[f32; LANES], y: &[f32; LANES]| {
        for k in 0..LANES {
            let (x, y) = (f64::from(x[k]), f64::from(y[k]));
            sums[0][k] += x;
            sums[1][k] += y;
            sums[2][k] += x * x;
            sums[3][k] += y * y;
            sums[4][k] += x * y;
        }
    };
    let ((xs, x_rest), (ys, y_rest)) =
        (x.as_chunks::<LANES>(), y.as_chunks::<LANES>());
    xs.iter().zip(ys).for_each(|(x, y)| add(x, y));
    let padded = |rest: &[f32]| {
        let mut lanes = [0.0; LANES];
        lanes[..rest.len()].copy_from_slice(rest);
        lanes
    };
    add(&padded(x_rest), &padded(y_rest));
    let [sx, sy, xx, yy, xy] = sums.map(|sum| sum.iter().sum::<f64>());
    let n = x.len() as f64;
    let (xx, yy) = (xx - sx * sx / n, yy - sy * sy / n);
    f64::abs(xy - sx * sy / n) / (xx * yy).sqrt()
}

#[cfg(test)]
mod tests;
