//! The comparison of recorded suites with the embedded ones.

use indicatif::ProgressBar;
use rayon::prelude::*;
use rocking::ida::Adjust;
use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::resampling::Resampling;
use rocking_statistics::two_sample::kolmogorov_smirnov;
use rocking_statistics::{Clusters, Estimate, ExtendedSample, Range};

use super::row::{Quantiles, QuantityRow, RowGroup};
use crate::analyses::normalised;
use crate::distributions::{
    BlockSamples, Distributions, SAMPLES, suite_distributions,
};
use crate::estimates::three_quantiles;
use crate::facts::{Facts, SPECTRUM_PERIODS_S, facts};
use crate::fits::THRESHOLDS;
use crate::inference::estimate;
use crate::normality::ends;
use crate::results::StudyResults;
use rocking_common::paper::{BLOCKS, demand_index};
use rocking_common::suites::StudySuite;

/// Draws of the bootstrap.
const REPLICATES: usize = 2000;

/// All rows: both suites of the study compared with the embedded suites of the
/// same kind.
pub(super) fn comparison_rows(
    results: &StudyResults,
) -> anyhow::Result<Vec<QuantityRow>> {
    let arm = results.plan.common();
    let mut out = Vec::new();
    for embedded in StudySuite::embedded()? {
        let recorded = results.suite(embedded.kind);
        let kind = recorded.kind;
        let facts: Vec<Facts> =
            embedded.motions.iter().map(facts).collect::<Result<_, _>>()?;
        let (curves, _) = results.plan.setup.chains(
            &BLOCKS,
            &normalised(&embedded),
            &[arm],
            Adjust::RecordScaling,
            &ProgressBar::hidden(),
        )?;
        let draws = |side: &str, clusters: &Clusters| -> Vec<Vec<usize>> {
            let name = format!("study/suites/{side}/{kind}");
            Bootstrap::of_clusters(&name, 0, clusters, REPLICATES)
                .map(<[_]>::to_vec)
        };
        let pair = SuitePair {
            kind: kind.name(),
            draws: [
                draws("embedded", &embedded.clusters),
                draws("recorded", &recorded.clusters),
            ],
            clusters: recorded.clusters.clone(),
            records: [facts.len(), recorded.records.len()],
        };
        out.push(pair.row(RowGroup::Source, recorded.sha256.clone()));
        out.extend(pair.motions(&facts, &recorded.records)?);
        for own in suite_distributions(kind, &facts, &curves, arm)? {
            let other = recorded.distributions(arm, own.intensity)?;
            out.extend(pair.capacities(&own, other)?);
            out.extend(pair.accepted(&own, other));
        }
    }
    Ok(out)
}

/// The embedded and the recorded suite of one kind.
struct SuitePair {
    kind: &'static str,
    /// Records drawn once for all quantities: embedded, recorded.
    draws: [Vec<Vec<usize>>; 2],
    /// The recorded earthquakes, which are fewer than the embedded motions.
    clusters: Clusters,
    /// Number of records: embedded, recorded.
    records: [usize; 2],
}

impl SuitePair {
    fn row(&self, group: RowGroup, quantity: String) -> QuantityRow {
        let nan = f64::NAN;
        let side = |records: usize| Quantiles {
            records,
            low: nan,
            middle: nan,
            high: nan,
        };
        QuantityRow {
            suite: self.kind.into(),
            group,
            quantity,
            p_rad_s: nan,
            alpha_rad: nan,
            edp: nan,
            embedded: side(self.records[0]),
            recorded: side(self.records[1]),
            ratio: Estimate::exact(nan),
            spread: Estimate::exact(nan),
            distance: nan,
            p_value: nan,
        }
    }

    fn motions(
        &self,
        embedded: &[Facts],
        recorded: &[Facts],
    ) -> anyhow::Result<Vec<QuantityRow>> {
        let names = measures(&embedded[0]);
        (0..names.len())
            .into_par_iter()
            .map(|k| {
                let of = |facts: &[Facts]| -> Vec<f64> {
                    facts.iter().map(|f| measures(f)[k].1).collect()
                };
                let row = self.row(RowGroup::Motion, names[k].0.clone());
                self.filled(row, &of(embedded), &of(recorded))
            })
            .collect()
    }

    fn capacities(
        &self,
        embedded: &Distributions,
        recorded: &Distributions,
    ) -> anyhow::Result<Vec<QuantityRow>> {
        let both = embedded.blocks.iter().zip(&recorded.blocks);
        let cells: Vec<_> = both
            .flat_map(|(e, r)| THRESHOLDS.map(|edp| (e, r, edp)))
            .collect();
        cells
            .into_par_iter()
            .map(|(e, r, edp)| {
                let level = demand_index(edp);
                let name = embedded.intensity.name();
                let mut row = self.row(RowGroup::Capacity, name.to_owned());
                row.p_rad_s = e.p_rad_s;
                row.alpha_rad = e.alpha_rad;
                row.edp = edp;
                self.filled(row, &e.samples[level], &r.samples[level])
            })
            .collect()
    }

    fn accepted(
        &self,
        embedded: &Distributions,
        recorded: &Distributions,
    ) -> Vec<QuantityRow> {
        let mut out = Vec::new();
        for (k, kind) in SAMPLES.into_iter().enumerate() {
            for (e, r) in embedded.blocks.iter().zip(&recorded.blocks) {
                let quantity = format!("{kind}_{}", embedded.intensity.name());
                let mut row = self.row(RowGroup::Accepted, quantity);
                row.p_rad_s = e.p_rad_s;
                row.alpha_rad = e.alpha_rad;
                share(&mut row.embedded, e, k);
                share(&mut row.recorded, r, k);
                out.push(row);
            }
        }
        out
    }

    /// The row with the numbers of two samples.
    fn filled(
        &self,
        mut row: QuantityRow,
        embedded: &[f64],
        recorded: &[f64],
    ) -> anyhow::Result<QuantityRow> {
        let points = [three_quantiles(embedded)?, three_quantiles(recorded)?];
        for (side, [low, middle, high]) in
            [&mut row.embedded, &mut row.recorded].into_iter().zip(points)
        {
            (side.low, side.middle, side.high) = (low, middle, high);
        }
        let drawn = |values: &[f64], draw: &[usize]| {
            let own: Vec<f64> = draw.iter().map(|i| values[*i]).collect();
            three_quantiles(&own)
        };
        let (mut ratios, mut spreads) = (Vec::new(), Vec::new());
        for (e, r) in self.draws[0].iter().zip(&self.draws[1]) {
            let own = apart([drawn(embedded, e)?, drawn(recorded, r)?]);
            ratios.push(own.0);
            spreads.push(own.1);
        }
        let (ratio, spread) = apart(points);
        row.ratio = self.estimate(ratio, &ratios).map(libm::exp);
        row.spread = self.estimate(spread, &spreads);
        let found = kolmogorov_smirnov(
            &ExtendedSample::try_new(embedded)?,
            &ExtendedSample::try_new(recorded)?,
        );
        (row.distance, row.p_value) = (found.statistic, found.p_value);
        Ok(row)
    }

    fn estimate(&self, value: f64, replicates: &[f64]) -> Estimate {
        let how = (Resampling::Bootstrap, Range::Real, 0.95);
        estimate(&self.clusters, value, replicates, how)
    }
}

fn share(side: &mut Quantiles, block: &BlockSamples, k: usize) {
    side.middle = block.shares()[k];
    if let Some((low, high)) = block.bands[k].as_ref().and_then(ends) {
        (side.low, side.high) = (low, high);
    }
}

/// Measures of a motion by name; spectral accelerations last.
fn measures(facts: &Facts) -> Vec<(String, f64)> {
    let m = &facts.measures;
    let mut out: Vec<(String, f64)> = [
        ("pga_g", m.pga_g),
        ("pgv_m_s", m.pgv_m_s),
        ("pgv_over_pga_s", facts.velocity_ratio_s),
        ("arias_intensity_m_s", m.arias_intensity_m_s),
        ("cav_m_s", m.cav_m_s),
        ("significant_duration_5_75_s", m.significant_duration_5_75_s),
        ("significant_duration_5_95_s", m.significant_duration_5_95_s),
        ("mean_period_s", m.mean_period_s.unwrap_or(f64::INFINITY)),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .into();
    let spectrum = SPECTRUM_PERIODS_S.iter().zip(&m.spectral_acceleration_g);
    out.extend(spectrum.map(|(t, a)| (format!("sa_{t}_g"), *a)));
    out
}

/// Logarithm of the ratio of medians, and difference of dispersions, of two
/// samples with these quantiles.
fn apart(both: [[f64; 3]; 2]) -> (f64, f64) {
    let [e, r] = both.map(|[low, _, high]| 0.5 * libm::log(high / low));
    (libm::log(both[0][1] / both[1][1]), e - r)
}
