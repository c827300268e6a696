//! Estimates in tables of the study: medians, means and quantiles.

use rocking_statistics::boxplot::median_interval;
use rocking_statistics::{Estimate, ExtendedSample, QuantileType, Range};

/// Level of the intervals.
pub(crate) const LEVEL: f64 = 0.95;

/// Median with its exact order-statistic interval. A capacity that was never
/// reached counts as infinite; NaN does not count.
pub fn median(values: &[f64]) -> Estimate {
    let there: Vec<f64> =
        values.iter().copied().filter(|x| !x.is_nan()).collect();
    let Ok(sample) = ExtendedSample::try_new(&there) else {
        return Estimate::exact(f64::NAN);
    };
    let sorted = sample.sorted();
    let n = sorted.len();
    let value = 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
    median_interval(&sample, LEVEL)
        .and_then(|i| Estimate::try_new(value, i.interval, Range::Real).ok())
        .unwrap_or(Estimate::exact(value))
}

/// Mean of the finite values among some numbers.
pub(crate) fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for x in values.into_iter().filter(|x| x.is_finite()) {
        sum += x;
        count += 1.0;
    }
    sum / count
}

/// 16, 50 and 84 % quantiles of the default type. A capacity that was never
/// reached counts as infinite.
pub(crate) fn three_quantiles(values: &[f64]) -> anyhow::Result<[f64; 3]> {
    let sample = ExtendedSample::try_new(values)?;
    let at = |p| QuantileType::default().extended_quantile(&sample, p);
    Ok([at(0.16)?, at(0.5)?, at(0.84)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_median_counts_what_was_never_reached() {
        let inf = f64::INFINITY;
        let found = median(&[1.0, inf, f64::NAN, 2.0]);
        assert_eq!(found.value(), 2.0);
        assert_eq!(median(&[1.0, inf, inf]).value(), inf);
    }
}
