//! What figures draw of the replicates: bands, and the intervals that claims
//! are judged by.

use rayon::prelude::*;

use super::draws::{Replicates, Resamples};
use super::known::CellIntervals;
use rocking_common::findings::{LEVEL, SuiteSet};
use rocking_statistics::{Estimate, Interval, Range};

/// Level of a band that is drawn and decides nothing.
const BAND: f64 = 0.95;

impl Replicates {
    /// The central share of the replicates of every cell, wider by what few
    /// earthquakes ask; none where a tenth of them or more have no value.
    #[must_use]
    pub fn percentiles(
        &self,
        draws: &Resamples,
        tested: SuiteSet,
    ) -> Vec<Option<(f64, f64)>> {
        let clusters = draws.clusters(tested);
        (0..self.points.len())
            .into_par_iter()
            .map(|k| {
                let values = Self::column(&self.replicates, k);
                let e = clusters.estimate(self.points[k], &values, BAND)?;
                let ends = e.estimate.interval().map(Interval::ends);
                ends.filter(|_| 10 * e.used > 9 * e.replicates)
            })
            .collect()
    }
}

/// Each cell of a measure with the interval by which a claim on it is judged.
#[must_use]
pub fn by_cell(
    draws: &Resamples,
    tested: SuiteSet,
    range: Range,
    measured: &Replicates,
) -> Vec<Estimate> {
    let known = CellIntervals::new(draws, tested, range, measured);
    let count = measured.points.len();
    (0..count).map(|k| known.shown(k, known.drawn(k, LEVEL))).collect()
}
