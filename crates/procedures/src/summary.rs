//! Summary of a sample.

use rocking_statistics::boxplot::BoxplotError;
use rocking_statistics::quantile::QuantileError;
use rocking_statistics::{Boxplot, ExtendedSample, QuantileType};

/// Quantiles and boxplot of a sample.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Summary {
    /// Size of the sample, censored values included.
    pub n: usize,
    /// Number of censored (infinite) values.
    pub censored: usize,
    /// Type of all quantiles, 1 to 9.
    pub quantile_type: u8,
    /// The requested quantiles, in their order.
    pub quantiles: Vec<Quantile>,
    /// Box, notch, whiskers and outliers.
    #[serde(serialize_with = "super::or_reason")]
    pub boxplot: Result<Boxplot, BoxplotError>,
}

/// A quantile.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Quantile {
    /// The probability, in [0, 1].
    pub probability: f64,
    /// The value, in the unit of the sample; infinite if censored.
    pub value: f64,
}

/// Summarises a sample by its quantiles at `probabilities` (each in [0, 1])
/// and its boxplot.
///
/// ```
/// use rocking_procedures::summarise;
/// use rocking_statistics::{ExtendedSample, QuantileType};
/// let sample = ExtendedSample::try_new(&[1.0, 2.0, 3.0, 4.0, 20.0])?;
/// let found = summarise(&sample, &[0.5], QuantileType::default())?;
/// assert_eq!(found.quantiles[0].value, 3.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`QuantileError`] for a probability outside [0, 1].
pub fn summarise(
    sample: &ExtendedSample,
    probabilities: &[f64],
    quantile_type: QuantileType,
) -> Result<Summary, QuantileError> {
    let quantile = |&probability: &f64| {
        let value = quantile_type.extended_quantile(sample, probability)?;
        Ok(Quantile { probability, value })
    };
    let quantiles = probabilities.iter().map(quantile);
    Ok(Summary {
        n: sample.len(),
        censored: sample.censored(),
        quantile_type: quantile_type.number(),
        quantiles: quantiles.collect::<Result<_, _>>()?,
        boxplot: Boxplot::try_new(sample, quantile_type),
    })
}
