//! Lilliefors' test along the demand.

use rayon::prelude::*;
use rocking_common::findings::SampleCount;
use rocking_statistics::acceptance::NullBand;
use rocking_statistics::lilliefors::{
    LillieforsTable, LillieforsTest, Null, Scale,
};
use rocking_statistics::{ExtendedSample, Interval, SampleError};

/// Level of the tests.
pub const LEVEL: f64 = 0.05;

/// Lilliefors' test of ln(x - `shift`) against the table, level by level.
///
/// # Errors
/// [`SampleError`] for a level without values, or with one that is not a
/// number.
pub fn along(
    samples: &[Vec<f64>],
    shift: f64,
) -> Result<Vec<LillieforsTest>, SampleError> {
    let scale = Scale::Logarithmic { shift };
    let null = Null::Table(LillieforsTable::embedded());
    samples
        .par_iter()
        .map(|sample| {
            let sample = ExtendedSample::try_new(sample)?;
            Ok(LillieforsTest::new(&sample, scale, LEVEL, null))
        })
        .collect()
}

/// D over its critical value: lognormality is accepted up to 1. NaN if the test
/// does not apply.
pub fn over_critical(assessment: &LillieforsTest) -> f64 {
    assessment.ratio().unwrap_or(f64::NAN)
}

/// Share of the tested levels at which lognormality is accepted; NaN if no level
/// was tested.
pub fn accepted_share(assessments: &[LillieforsTest]) -> f64 {
    let decisions = assessments.iter().filter_map(LillieforsTest::exceeds);
    SampleCount::among(decisions, |exceeds| !exceeds).value
}

/// Stride of the levels that enter the null band. A denser choice does not change
/// the band.
pub const BAND_STRIDE: usize = 8;

/// Replicates of the null band.
pub const BAND_REPLICATES: u64 = 4000;

/// The levels that represent all levels in a simulation.
pub fn every<T>(levels: &[T], stride: usize) -> impl Iterator<Item = &T> {
    levels.iter().skip(stride - 1).step_by(stride)
}

/// The accepted share of capacities that are lognormal above `shift`, with the
/// dependence between levels of these samples; `None` if a capacity is infinite or
/// not above the shift.
pub fn null_band(
    samples: &[Vec<f64>],
    shift: f64,
    name: &str,
) -> Option<NullBand> {
    let levels: Vec<Vec<f64>> = every(samples, BAND_STRIDE)
        .map(|sample| sample.iter().map(|x| libm::log(x - shift)).collect())
        .collect();
    if levels.iter().flatten().any(|y| !y.is_finite()) {
        return None;
    }
    let size = samples.first()?.len();
    let (critical, _) =
        LillieforsTable::embedded().critical_value(size, LEVEL).ok()?;
    NullBand::simulate(&levels, critical, BAND_REPLICATES, name, 0).ok()
}

/// Central 95 % of a null band.
pub fn ends(band: &NullBand) -> Option<(f64, f64)> {
    band.central(0.95).map(Interval::ends)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_scores_are_accepted_and_two_clusters_are_not() {
        let scores: Vec<f64> = (1..=86)
            .map(|i| {
                let p = (f64::from(i) - 0.5) / 86.0;
                1.0 + libm::exp(rocking_statistics::normal::quantile(p))
            })
            .collect();
        let clusters: Vec<f64> = (0..86)
            .map(|i| if i < 43 { 2.0 } else { 9.0 } + f64::from(i) * 1e-3)
            .collect();
        let never = vec![f64::INFINITY; 86];
        let tests = along(&[scores, clusters, never], 1.0).expect("samples");
        let ratios: Vec<f64> = tests.iter().map(over_critical).collect();
        // D of the scores is 1/(2 n) up to the estimate of the spread.
        assert!(ratios[0] < 0.2 && ratios[1] > 2.0, "{ratios:?}");
        assert!(ratios[2].is_nan());
        assert_eq!(accepted_share(&tests), 0.5);
        assert!(accepted_share(&tests[2..]).is_nan());
        assert!(along(&[vec![f64::NAN]], 1.0).is_err());
    }

    #[test]
    fn null_band_of_one_level_in_copies_is_everything() {
        let level: Vec<f64> =
            (1..=44).map(|i| 1.0 + f64::from(i * i)).collect();
        let copies = vec![level; 40];
        // All levels are accepted together, 95 % of the time: the band
        // reaches 1 and does not shrink to it.
        let band = null_band(&copies, 1.0, "test").expect("band");
        let (low, high) = ends(&band).expect("band");
        assert!(low < 1.0 && high == 1.0, "{low} {high}");
        assert!(null_band(&copies, 2.0, "test").is_none());
    }
}
