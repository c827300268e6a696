//! Lilliefors' test along the demand.

use rayon::prelude::*;
use rocking::statistics::Sample;
use rocking::statistics::acceptance::NullBand;
use rocking::statistics::lilliefors::{Statistic, Table};

/// Level of the tests.
pub const LEVEL: f64 = 0.05;

/// Lilliefors' D of ln(x - `shift`) over its critical value, level by
/// level: lognormality is accepted up to 1. NaN where the test does not
/// apply: an infinite capacity, one not above the shift, or no spread.
#[must_use]
pub fn along(samples: &[Vec<f64>], shift: f64) -> Vec<f64> {
    samples
        .par_iter()
        .map(|sample| over_critical(sample, shift).unwrap_or(f64::NAN))
        .collect()
}

fn over_critical(sample: &[f64], shift: f64) -> Option<f64> {
    let table = Table::embedded();
    let (critical, _) = table.critical_value(sample.len(), LEVEL).ok()?;
    Some(Statistic::try_new(&logarithms(sample, shift)?).ok()?.d / critical)
}

/// ln(x - `shift`) of a sample, if all of it is finite and above the shift.
#[must_use]
pub fn logarithms(sample: &[f64], shift: f64) -> Option<Sample> {
    let above = |x: &f64| *x > shift && x.is_finite();
    if !sample.iter().all(above) {
        return None;
    }
    let logs: Vec<f64> = sample.iter().map(|x| libm::log(x - shift)).collect();
    Sample::try_new(&logs).ok()
}

/// Share of the levels at which lognormality is accepted; a level at which
/// the test does not apply is none.
#[must_use]
pub fn accepted_share(over_critical: &[f64]) -> f64 {
    let accepted = over_critical.iter().filter(|r| **r <= 1.0).count();
    accepted as f64 / over_critical.len() as f64
}

/// Every so many levels enter the null band, which a denser choice does not
/// move.
const BAND_STRIDE: usize = 8;

/// Replicates of the null band.
const BAND_REPLICATES: u64 = 200;

/// Central 95 % band of the accepted share for capacities that are lognormal
/// above `shift` and as dependent from level to level as these; none where
/// a capacity is infinite or not above the shift.
#[must_use]
pub fn null_band(
    samples: &[Vec<f64>],
    shift: f64,
    name: &str,
) -> Option<(f64, f64)> {
    let levels: Vec<Vec<f64>> = samples
        .iter()
        .skip(BAND_STRIDE - 1)
        .step_by(BAND_STRIDE)
        .map(|sample| sample.iter().map(|x| libm::log(x - shift)).collect())
        .collect();
    if levels.iter().flatten().any(|y| !y.is_finite()) {
        return None;
    }
    let size = samples.first()?.len();
    let (critical, _) = Table::embedded().critical_value(size, LEVEL).ok()?;
    let band = NullBand::simulate(&levels, critical, BAND_REPLICATES, name, 0)
        .ok()?;
    let band = band.band(1.0 - LEVEL, 0.95)?;
    Some((band.low, band.high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_scores_are_accepted_and_two_clusters_are_not() {
        let scores: Vec<f64> = (1..=86)
            .map(|i| {
                let p = (f64::from(i) - 0.5) / 86.0;
                1.0 + libm::exp(rocking::statistics::normal::quantile(p))
            })
            .collect();
        let clusters: Vec<f64> = (0..86)
            .map(|i| if i < 43 { 2.0 } else { 9.0 } + f64::from(i) * 1e-3)
            .collect();
        let never = vec![f64::INFINITY; 86];
        let ratios = along(&[scores, clusters, never], 1.0);
        // D of the scores is 1/(2 n) up to the estimate of the spread.
        assert!(ratios[0] < 0.2 && ratios[1] > 2.0, "{ratios:?}");
        assert!(ratios[2].is_nan());
        assert_eq!(accepted_share(&ratios), 1.0 / 3.0);
    }

    #[test]
    fn null_band_of_one_level_in_copies_is_everything() {
        let level: Vec<f64> =
            (1..=44).map(|i| 1.0 + f64::from(i * i)).collect();
        let copies = vec![level; 40];
        // All levels are accepted together, 95 % of the time: the band
        // reaches 1 and does not shrink to it.
        let (low, high) = null_band(&copies, 1.0, "test").expect("band");
        assert!(low < 1.0 && high == 1.0, "{low} {high}");
        assert!(null_band(&copies, 2.0, "test").is_none());
    }
}
