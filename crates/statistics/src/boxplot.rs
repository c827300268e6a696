//! Notched boxplots, with an exact interval of the median beside the notch.

use thiserror::Error;

use super::beta::binomial_cdf;
use super::{ExtendedSample, Interval, QuantileType};

/// The upper quartile falls on a censored value: there is no boxplot.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("upper quartile is infinite: {censored} of {n} values are infinite")]
#[non_exhaustive]
pub struct BoxplotError {
    /// Number of infinite values.
    pub censored: usize,
    /// Size of the sample.
    pub n: usize,
}

/// A boxplot: quartiles, whiskers, outliers and McGill's notch.
///
/// Quartiles by the named type (5 for MATLAB's). Whiskers end at the most
/// extreme datum within 1.5 IQR of the box (closed); outliers lie strictly
/// beyond. The notch, median +- 1.57 IQR/sqrt(n) (McGill, Tukey and Larsen,
/// The American Statistician 32 (1978) 12), is built so that two notches that
/// do not overlap are evidence at about 5 %; it covers a single median in
/// about 91 % of samples and is *not* its 95 % interval. That one is
/// [`median_interval`].
///
/// ```
/// use rocking_statistics::{Boxplot, ExtendedSample, QuantileType};
/// let sample = ExtendedSample::try_new(&[1.0, 2.0, 3.0, 4.0, 20.0])?;
/// let boxplot = Boxplot::try_new(&sample, QuantileType::default())?;
/// assert_eq!((boxplot.q1, boxplot.median, boxplot.q3), (1.75, 3.0, 8.0));
/// assert_eq!((boxplot.whisker_low, boxplot.whisker_high), (1.0, 4.0));
/// assert_eq!(boxplot.outliers, [20.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct Boxplot {
    /// Size of the sample.
    pub n: usize,
    /// Lower quartile.
    pub q1: f64,
    /// Median.
    pub median: f64,
    /// Upper quartile.
    pub q3: f64,
    /// Lower end of McGill's notch.
    pub notch_low: f64,
    /// Upper end of McGill's notch.
    pub notch_high: f64,
    /// Lowest datum not below q1 - 1.5 IQR.
    pub whisker_low: f64,
    /// Highest datum not above q3 + 1.5 IQR.
    pub whisker_high: f64,
    /// Data beyond the whiskers, ascending; censored ones are infinite.
    pub outliers: Vec<f64>,
    /// Exact order-statistic interval of the median; none for n < 6.
    pub median_interval: Option<MedianInterval>,
}

/// An interval of the median between two order statistics.
#[derive(
    Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize,
)]
#[non_exhaustive]
pub struct MedianInterval {
    /// Between the values of the two.
    #[serde(flatten)]
    pub interval: Interval,
    /// Rank of the lower one, from 1; the upper one's is n + 1 minus it.
    pub rank: usize,
    /// Coverage for a continuous distribution, at least the requested level.
    pub coverage: f64,
}

impl Boxplot {
    /// Boxplot of a sample; infinite values are outliers.
    ///
    /// # Errors
    /// [`BoxplotError`] if the box itself is infinite.
    pub fn try_new(
        sample: &ExtendedSample,
        quantile_type: QuantileType,
    ) -> Result<Self, BoxplotError> {
        let infinite =
            BoxplotError { censored: sample.censored(), n: sample.len() };
        let at = |p| quantile_type.finite_quantile(sample, p).ok_or(infinite);
        let (q1, median, q3) = (at(0.25)?, at(0.5)?, at(0.75)?);
        let iqr = q3 - q1;
        let half = 1.57 * iqr / (sample.len() as f64).sqrt();
        let (fence_low, fence_high) = (q1 - 1.5 * iqr, q3 + 1.5 * iqr);
        let sorted = sample.sorted();
        let first = sorted.partition_point(|&x| x < fence_low);
        let end = sorted.partition_point(|&x| x <= fence_high);
        Ok(Self {
            n: sample.len(),
            q1,
            median,
            q3,
            notch_low: median - half,
            notch_high: median + half,
            whisker_low: sorted[first],
            whisker_high: sorted[end - 1],
            outliers: [&sorted[..first], &sorted[end..]].concat(),
            median_interval: median_interval(sample, 0.95),
        })
    }
}

/// The shortest symmetric pair of order statistics that covers the median of a
/// continuous distribution with at least probability `level`; `None` if the
/// range of the sample does not.
///
/// The interval (x_(k), x_(n+1-k)) covers with probability
/// 1 - 2 P(B <= k - 1), B binomial (n, 1/2).
///
/// ```
/// use rocking_statistics::{ExtendedSample, boxplot::median_interval};
/// let values: Vec<f64> = (1..=86).map(f64::from).collect();
/// let sample = ExtendedSample::try_new(&values)?;
/// let interval = median_interval(&sample, 0.95).unwrap();
/// assert_eq!(interval.interval.ends(), (34.0, 53.0));
/// assert!((interval.coverage - 0.960).abs() < 5e-4);
/// # Ok::<(), rocking_statistics::SampleError>(())
/// ```
pub fn median_interval(
    sample: &ExtendedSample,
    level: f64,
) -> Option<MedianInterval> {
    let n = sample.len();
    let coverage = |k: usize| 1.0 - 2.0 * binomial_cdf(n, k - 1);
    let rank = (1..=n.div_ceil(2)).rev().find(|&k| coverage(k) >= level)?;
    let sorted = sample.sorted();
    Some(MedianInterval {
        interval: Interval::rising(sorted[rank - 1], sorted[n - rank]),
        rank,
        coverage: coverage(rank),
    })
}

#[cfg(test)]
mod tests;
