//! Skipping what cannot lift a resting block, and what cannot move it enough.

/// Intervals of a record summarised by one number.
const RUN: usize = 64;

/// Largest absolute sample of each run of 64 intervals, so that a resting
/// block skips whole runs, and how fast and how far the ground still moves
/// from there on. Made once a record, shared by all levels and blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct RestIndex {
    /// Largest absolute sample of each run.
    peaks: Vec<f64>,
    /// What is left from each run on.
    left: Vec<Left<f64>>,
}

/// What is left of a record from some place on, its velocity being zero at
/// the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Left<N> {
    /// Bound of the absolute velocity.
    pub speed: N,
    /// Bound of the integral of the absolute velocity.
    pub travel: N,
}

impl Left<f64> {
    /// Of nothing.
    const NOTHING: Self = Self { speed: 0.0, travel: 0.0 };
}

impl RestIndex {
    /// Index of the samples of a record, before scaling.
    #[must_use]
    pub fn new(samples: &[f64]) -> Self {
        let intervals = samples.len().saturating_sub(1);
        let peak = |first: usize| {
            samples[first..=(first + RUN).min(intervals)]
                .iter()
                .fold(0.0_f64, |peak, x| peak.max(x.abs()))
        };
        let peaks = (0..intervals).step_by(RUN).map(peak).collect();
        let mut left = Vec::with_capacity(intervals.div_ceil(RUN));
        let (mut end, mut sum) = (0.0_f64, Left::NOTHING);
        for interval in (0..intervals).rev() {
            let [from, to] = [samples[interval], samples[interval + 1]];
            let start = end - 0.5 * (from + to);
            // The velocity is a parabola: so far from its chord at most.
            let bow = 0.125 * (to - from).abs();
            let (one, other) = (start.abs(), end.abs());
            sum.speed = sum.speed.max(one.max(other) + bow);
            sum.travel += 0.5 * (one + other) + bow;
            end = start;
            if interval.is_multiple_of(RUN) {
                left.push(sum);
            }
        }
        left.reverse();
        Self { peaks, left }
    }

    /// What is left from the run of `interval` on, in units of samples and
    /// intervals.
    #[inline(always)]
    pub(crate) fn left(&self, interval: usize) -> Left<f64> {
        *self.left.get(interval / RUN).unwrap_or(&Left::NOTHING)
    }

    /// First interval of the first run from which on little enough is left,
    /// which is known to be so from the run of `known` on; if from one run on,
    /// then from all later ones.
    #[inline(always)]
    pub(crate) fn calm_from(
        &self,
        known: usize,
        is_little: impl Fn(Left<f64>) -> bool,
    ) -> usize {
        let mut run = (known / RUN).min(self.left.len());
        while run > 0 && is_little(self.left[run - 1]) {
            run -= 1;
        }
        RUN * run
    }

    /// First interval after the run that starts at `interval`, if no sample
    /// of the run exceeds `bound`; nothing if `interval` starts no run.
    pub(crate) fn skip(&self, interval: usize, bound: f64) -> Option<usize> {
        let starts = interval.is_multiple_of(RUN);
        let low = starts && self.peaks[interval / RUN] <= bound;
        low.then_some(interval + RUN)
    }
}
