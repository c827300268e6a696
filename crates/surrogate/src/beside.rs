//! What else lies between a surface and a site: the choice of records, and
//! recorded motions for the embedded ones.

use libm::log;
use rocking_statistics::{QuantileType, Sample, normal};
use serde::{Deserialize, Serialize};

use super::blocks::rows;
use super::{Fitted, SHIFT, Size, Surface, Surrogate, SurrogateError};
use rocking_synthesis::SuiteKind;

/// The study's blocks under embedded and recorded motions.
const COMPARED: &str = rocking_fixtures::text("comparison/suites.csv");

/// Probabilities at which recorded intensities are known.
const PROBABILITIES: [f64; 3] = [0.16, 0.50, 0.84];

/// Half the 95 % interval that the choice of records leaves, the median over
/// the unseen blocks: bootstrap of the records of an embedded suite.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Sampling {
    /// Of the median, relative.
    #[serde(rename = "median_relative")]
    pub median: f64,
    /// Of the dispersion, relative.
    #[serde(rename = "beta_relative")]
    pub dispersion: f64,
    /// Of the probability at the median.
    pub probability: f64,
}

impl Surrogate {
    /// What the choice of records leaves open of a suite's blocks.
    ///
    /// # Errors
    /// [`SurrogateError`] for no block of the suite.
    pub fn sampling(
        &self,
        suite: SuiteKind,
    ) -> Result<Sampling, SurrogateError> {
        let own = || self.unseen.iter().filter(|b| b.suite == suite);
        let half = |low: f64, high: f64| 0.5 * (high - low);
        let middle = |values: Vec<f64>| {
            let sample = Sample::try_new(&values)?;
            // The median exists at every size.
            let median = QuantileType::default().quantile(&sample, 0.5);
            Ok::<f64, SurrogateError>(median.unwrap_or(f64::NAN))
        };
        let median = |b: &Fitted| half(b.median_low, b.median_high) / b.median;
        let dispersion = |b: &Fitted| {
            half(b.dispersion_low, b.dispersion_high) / b.dispersion
        };
        let probability = |b: &Fitted| -> Result<f64, SurrogateError> {
            let own = b.lognormal()?;
            Ok(half(own.cdf(b.median_low), own.cdf(b.median_high)))
        };
        Ok(Sampling {
            median: middle(own().map(median).collect())?,
            dispersion: middle(own().map(dispersion).collect())?,
            probability: middle(
                own().map(probability).collect::<Result<_, _>>()?,
            )?,
        })
    }
}

/// A block's overturning intensities, such as PGA/(g tan alpha), under
/// recorded motions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recorded {
    /// The suite.
    pub suite: SuiteKind,
    /// Slenderness angle.
    pub alpha_rad: f64,
    /// Frequency parameter.
    pub p_rad_s: f64,
    /// The 16, 50 and 84 % quantiles of the sample.
    pub quantiles: [f64; 3],
    /// The median under the embedded suite.
    pub embedded: f64,
}

/// A row of the comparison of suites; other columns are not read.
#[derive(Deserialize)]
struct Compared {
    suite: SuiteKind,
    group: String,
    quantity: String,
    p_rad_s: Option<f64>,
    alpha_rad: Option<f64>,
    edp: Option<f64>,
    embedded: Option<f64>,
    recorded_low: Option<f64>,
    recorded: Option<f64>,
    recorded_high: Option<f64>,
}

impl Recorded {
    /// The study's blocks under 86 ordinary and 44 pulse-type recorded
    /// motions: those of the committed comparison of suites, in the measure
    /// of this name.
    ///
    /// ```
    /// use rocking_surrogate::Recorded;
    /// assert_eq!(Recorded::kept("pga")?.len(), 30);
    /// assert!(Recorded::kept("sa:1")?.is_empty());
    /// # Ok::<(), rocking_surrogate::SurrogateError>(())
    /// ```
    ///
    /// # Errors
    /// [`SurrogateError::Table`] with the line for a table of another form.
    pub fn kept(im: &str) -> Result<Vec<Self>, SurrogateError> {
        let expected = "a table `suites.csv` of `rocking study`";
        let mut out = Vec::new();
        for (line, row) in rows::<Compared>("suites.csv", COMPARED, expected)?
        {
            let overturns = row.edp == Some(1.0) && row.quantity == im;
            if row.group != "capacity" || !overturns {
                continue;
            }
            let known = || {
                let (low, high) = (row.recorded_low?, row.recorded_high?);
                Some(Self {
                    suite: row.suite,
                    alpha_rad: row.alpha_rad?,
                    p_rad_s: row.p_rad_s?,
                    quantiles: [low, row.recorded?, high],
                    embedded: row.embedded?,
                })
            };
            out.push(known().ok_or_else(|| SurrogateError::Table {
                place: format!("suites.csv:{line}"),
                found: "a block without its quantiles".into(),
                expected,
            })?);
        }
        Ok(out)
    }
}

/// How far a surface is from recorded motions, whose own sampling error is
/// in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ToRecorded {
    /// Blocks that were compared.
    pub blocks: usize,
    /// Of the median, relative.
    #[serde(rename = "median_relative")]
    pub median: Size,
    /// Largest difference in probability at the recorded 16, 50 and 84 %
    /// intensities of a block.
    pub probability: Size,
}

impl Surface {
    /// The error at blocks under recorded motions of its kind.
    ///
    /// # Errors
    /// [`SurrogateError`] for a block outside the range.
    pub fn to_recorded(
        &self,
        blocks: &[Recorded],
    ) -> Result<ToRecorded, SurrogateError> {
        let mut errors = ToRecorded::default();
        for block in blocks.iter().filter(|b| b.suite == self.suite) {
            let found = self.at(block.alpha_rad, block.p_rad_s)?;
            let off = |(x, p): (&f64, f64)| {
                let score =
                    (log(x - SHIFT) - found.log_mean()) / found.dispersion();
                (normal::cdf(score) - p).abs()
            };
            let pairs = block.quantiles.iter().zip(PROBABILITIES);
            let largest = pairs.map(off).fold(0.0, f64::max);
            errors.median.add(found.median() / block.quantiles[1] - 1.0);
            errors.probability.add(largest);
            errors.blocks += 1;
        }
        errors.median.finish(errors.blocks);
        errors.probability.finish(errors.blocks);
        Ok(errors)
    }
}
