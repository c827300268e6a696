//! Index of a record, by which runs skip the parts that cannot lift a block at
//! rest, and those that cannot move a block enough.
//!
//! # Proof P9
//!
//! `skip`, `left` and `sway` rest on an acceleration that is linear between
//! samples and on a ground at rest after the last one.

/// Intervals of a record summarised by one number.
pub(crate) const RUN: usize = 32;

/// Lengths of windows, in runs; each at most twice the one before.
const WINDOWS: [usize; 16] =
    [2, 3, 4, 5, 6, 7, 9, 11, 13, 17, 21, 25, 33, 41, 49, 65];

/// Largest absolute sample of each run of 32 intervals, by which a block at
/// rest skips whole runs, and bounds on the motion of the ground from each run
/// on. It is made once for a record; all levels and blocks share it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RecordIndex {
    /// Largest absolute sample of each run.
    peaks: Vec<f64>,
    /// Bounds on the motion from each run on.
    left: Vec<Remaining<f64>>,
    /// `sway[w][i]`: largest range of ground displacement in any window of
    /// length `w` that starts at run `i` or later.
    sway: Vec<Vec<f64>>,
}

/// Bounds on the motion of the ground from some place on, if its velocity is
/// zero at the end. The default is that after the last sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Remaining<N> {
    /// Bound of the absolute velocity.
    pub speed: N,
    /// Bound of the integral of the absolute velocity.
    pub travel: N,
}

/// A length of windows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Window(usize);

impl RecordIndex {
    /// Index of the samples of a record, before scaling.
    pub fn new(samples: &[f64]) -> Self {
        let intervals = samples.len().saturating_sub(1);
        let peak = |first: usize| {
            samples[first..=(first + RUN).min(intervals)]
                .iter()
                .fold(0.0_f64, |peak, x| peak.max(x.abs()))
        };
        let peaks = (0..intervals).step_by(RUN).map(peak).collect();
        let runs = intervals.div_ceil(RUN);
        let mut left = Vec::with_capacity(runs);
        let mut spans = Vec::with_capacity(runs);
        let (mut end, mut sum) = (0.0_f64, Remaining::<f64>::default());
        let mut place = 0.0;
        let mut span = Span::at(place);
        for interval in (0..intervals).rev() {
            let [from, to] = [samples[interval], samples[interval + 1]];
            let start = end - 0.5 * (from + to);
            // The velocity is a parabola, at most this far from its chord.
            let bow = 0.125 * (to - from).abs();
            let (one, other) = (start.abs(), end.abs());
            sum.speed = sum.speed.max(one.max(other) + bow);
            sum.travel += 0.5 * (one + other) + bow;
            // The displacement is at most this far from its chord.
            let bow = 0.125 * from.abs().max(to.abs());
            let last = place;
            place -= start + 0.5 * from + (to - from) / 6.0;
            span = span.and(Span::at(last).and(Span::at(place)).wider(bow));
            end = start;
            if interval.is_multiple_of(RUN) {
                left.push(sum);
                spans.push(span);
                span = Span::at(place);
            }
        }
        left.reverse();
        spans.reverse();
        Self { peaks, left, sway: sway(spans) }
    }

    /// Bounds on the motion from the run of `interval` on, in units of samples
    /// and intervals.
    #[inline(always)]
    pub(crate) fn left(&self, interval: usize) -> Remaining<f64> {
        self.left.get(interval / RUN).copied().unwrap_or_default()
    }

    /// Number of runs.
    #[inline(always)]
    pub(crate) fn runs(&self) -> usize {
        self.left.len()
    }

    /// The shortest window that contains every motion of `intervals` intervals
    /// that starts in its first run.
    #[inline(always)]
    pub(crate) fn window(intervals: f64) -> Option<Window> {
        let holds = |runs: &usize| intervals <= (RUN * (runs - 1)) as f64;
        WINDOWS.iter().position(holds).map(Window)
    }

    /// Largest range of ground displacement in a window from the run of
    /// `interval` on, in units of samples and squared intervals.
    #[inline(always)]
    pub(crate) fn sway(&self, interval: usize, Window(k): Window) -> f64 {
        *self.sway[k].get(interval / RUN).unwrap_or(&0.0)
    }

    /// First interval after the run that starts at `interval`, if no sample of
    /// the run exceeds `bound`; `None` if `interval` starts no run.
    pub(crate) fn skip(&self, interval: usize, bound: f64) -> Option<usize> {
        let starts = interval.is_multiple_of(RUN);
        let low = starts && self.peaks[interval / RUN] <= bound;
        low.then_some(interval + RUN)
    }
}

/// For each window length and first run: the largest (max - min) of the
/// ground displacement in any later window of that length.
fn sway(runs: Vec<Span>) -> Vec<Vec<f64>> {
    let mut length = 1;
    let mut spans = runs;
    let mut longer = |window: &usize| {
        // Two of the windows before, which overlap.
        let by = window - length;
        for run in 0..spans.len().saturating_sub(by) {
            spans[run] = spans[run].and(spans[run + by]);
        }
        length = *window;
        let mut most = 0.0_f64;
        let width = |span: &Span| {
            most = most.max(span.high - span.low);
            most
        };
        let mut widths: Vec<f64> = spans.iter().rev().map(width).collect();
        widths.reverse();
        widths
    };
    WINDOWS.iter().map(&mut longer).collect()
}

/// Places of the ground.
#[derive(Clone, Copy)]
struct Span {
    low: f64,
    high: f64,
}

impl Span {
    fn at(place: f64) -> Self {
        Self { low: place, high: place }
    }

    fn and(self, other: Self) -> Self {
        let (low, high) = (self.low.min(other.low), self.high.max(other.high));
        Self { low, high }
    }

    fn wider(self, by: f64) -> Self {
        Self { low: self.low - by, high: self.high + by }
    }
}

#[cfg(test)]
mod tests;
