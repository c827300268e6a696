//! Skipping what cannot lift a resting block.

/// Intervals of a record summarised by one number.
const RUN: usize = 64;

/// Largest absolute sample of each run of 64 intervals, so that a resting
/// block skips whole runs. Made once a record, shared by all levels and
/// blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct RestIndex(Vec<f64>);

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
        Self((0..intervals).step_by(RUN).map(peak).collect())
    }

    /// First interval after the run that starts at `interval`, if no sample
    /// of the run exceeds `bound`; nothing if `interval` starts no run.
    pub(crate) fn skip(&self, interval: usize, bound: f64) -> Option<usize> {
        let starts = interval.is_multiple_of(RUN);
        let low = starts && self.0[interval / RUN] <= bound;
        low.then_some(interval + RUN)
    }
}
