//! What figures draw of the replicates: bands, and the intervals that claims
//! are judged by.

use rayon::prelude::*;
use rocking::statistics::bootstrap::estimate;

use super::{Draws, LEVEL, Replicated, band, clipped};
use rocking_common::findings::{Measured, Tested};

impl Replicated {
    /// The central share of the replicates of every cell; none where a tenth
    /// of them or more have no value.
    #[must_use]
    pub fn percentiles(&self) -> Vec<Option<(f64, f64)>> {
        (0..self.points.len())
            .into_par_iter()
            .map(|k| {
                let values = Self::column(&self.replicates, k);
                let e = estimate(self.points[k], &values, LEVEL)?;
                (10 * e.used > 9 * e.replicates).then_some((e.low, e.high))
            })
            .collect()
    }
}

/// Each cell of a measure with the interval by which a claim on it is judged:
/// of one cell its own, of several those that hold at once.
#[must_use]
pub fn by_cell(
    draws: &Draws,
    tested: Tested,
    range: (f64, f64),
    measured: &Replicated,
) -> Vec<Measured> {
    let ends = match measured.points.as_slice() {
        [_] => measured
            .interval(0, &draws.rules, tested, LEVEL)
            .map(|(a, b, _)| (clipped(a, range), clipped(b, range)))
            .into_iter()
            .collect(),
        _ => band(draws, tested, range, measured),
    };
    let with = |(k, value): (usize, &f64)| Measured {
        value: *value,
        interval: ends.get(k).copied(),
    };
    measured.points.iter().enumerate().map(with).collect()
}
