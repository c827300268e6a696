//! What figures draw of the replicates: bands, and the intervals that claims
//! are judged by.

use rayon::prelude::*;
use rocking::statistics::bootstrap::estimate;

use super::draws::{Draws, LEVEL, Replicated, Scheme};
use rocking::statistics::Proportion;
use rocking::statistics::resampling::simultaneous;
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

pub(super) fn clipped(x: f64, (low, high): (f64, f64)) -> f64 {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}

/// The band that holds all cells of a measure at once.
pub(super) fn band(
    draws: &Draws,
    tested: Tested,
    range: (f64, f64),
    own: &Replicated,
) -> Vec<(f64, f64)> {
    let band = match own.scheme {
        Scheme::Bootstrap => simultaneous(&own.points, &own.replicates, LEVEL),
        Scheme::Subsampling => {
            // Bonferroni: these cells are few.
            let count = own.points.len();
            let level = 1.0 - (1.0 - LEVEL) / count as f64;
            let ends = |k| own.interval(k, &draws.rules, tested, level);
            (0..count).map(|k| ends(k).map(|e| (e.0, e.1))).collect()
        }
        Scheme::Counted => {
            let band = Proportion::band(&own.counts, LEVEL);
            band.unwrap_or_default().into_iter().map(Some).collect()
        }
    };
    band.into_iter()
        .map(|ends| ends.unwrap_or((f64::NEG_INFINITY, f64::INFINITY)))
        .map(|(a, b)| (clipped(a, range), clipped(b, range)))
        .collect()
}
