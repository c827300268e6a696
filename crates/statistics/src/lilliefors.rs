//! Lilliefors' test of normality, calibrated by our own Monte Carlo.
//!
//! Lilliefors, "On the Kolmogorov-Smirnov test for normality with mean and
//! variance unknown", JASA 62 (1967) 399. The null distribution of D depends
//! on n alone. [`LillieforsTable`] has critical values simulated by
//! [`NullDistribution`] and p-values between them; published tables and other
//! packages' are not used.

mod assess;
pub(crate) mod fast;
mod shift;
mod simulation;
mod table;

use rocking::names::named;
use thiserror::Error;

pub use assess::{Inapplicable, LillieforsTest, Null, Scale};
pub use shift::ShiftedNull;
pub use simulation::{CriticalValue, NullDistribution};
pub use table::{LillieforsTable, TabledPValue};

use super::{Estimate, Sample, normal};

/// Why the test was rejected.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LillieforsError {
    /// Fewer values than needed: 3 for the statistic, 4 for the test.
    #[error("{found} values: expected at least {least}")]
    TooFew {
        /// Number of values.
        found: usize,
        /// Number needed.
        least: usize,
    },
    /// The values don't vary (to 1e-12 of their mean).
    #[error("the values do not vary: expected a positive standard deviation")]
    Degenerate,
    /// A sample of another size than the null distribution.
    #[error("{found} values: expected {expected}, the size simulated")]
    Size {
        /// Size of the sample.
        found: usize,
        /// Size simulated.
        expected: usize,
    },
    /// A sample that is too large for the test.
    #[error("{found} values: expected at most {expected}")]
    TooMany {
        /// Size of the sample.
        found: usize,
        /// The largest size.
        expected: usize,
    },
    /// A level outside the range of the test.
    #[error("level {level}: expected a number from {low} to {high}")]
    Level {
        /// The requested level.
        level: f64,
        /// The lowest possible one.
        low: f64,
        /// The highest possible one.
        high: f64,
    },
    /// A number of replicates out of range.
    #[error("{0} replicates: expected 100 to 100000000")]
    Replicates(u64),
    /// A pair that is not an onset and a capacity above it.
    #[error(
        "pair {number}: onset {onset}, capacity {capacity}: expected finite numbers, 0 < onset < capacity"
    )]
    Pair {
        /// Place of the pair, from 1.
        number: usize,
        /// The record's onset of rocking.
        onset: f64,
        /// The record's capacity.
        capacity: f64,
    },
    /// The model's shift exceeds its capacities too often.
    #[error(
        "{0} draws in a row with a capacity below the shift: the joint model does not hold"
    )]
    Redraws(u64),
    /// A statistic that is not positive.
    #[error("statistic {0}: expected a number above 0")]
    Statistic(f64),
}

/// Lilliefors' D and its one-sided parts.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Statistic {
    /// Size of the sample.
    pub n: usize,
    /// D, the larger of the two.
    pub d: f64,
    /// D+ = max(i/n - F_i).
    pub d_plus: f64,
    /// D- = max(F_i - (i - 1)/n).
    pub d_minus: f64,
}

impl Statistic {
    /// The statistic of a sample against the normal distribution of its own
    /// mean and standard deviation (divisor n - 1):
    /// F_i = Phi((y_(i) - m)/s). Take logarithms first for a lognormal.
    ///
    /// ```
    /// use rocking_statistics::{Sample, lilliefors::Statistic};
    /// let sample = Sample::try_new(&[1.0, 2.0, 4.0, 8.0])?;
    /// let statistic = Statistic::try_new(&sample)?;
    /// assert!(statistic.d > statistic.d_minus);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`LillieforsError`] for fewer than 3 values or values that don't
    /// vary. The test itself needs 4.
    pub fn try_new(sample: &Sample) -> Result<Self, LillieforsError> {
        let n = sample.len();
        let scores = standardised(sample, 3)?;
        let count = n as f64;
        let (mut d_plus, mut d_minus) = (f64::MIN, f64::MIN);
        for (i, z) in scores.iter().enumerate() {
            let f = normal::cdf(*z);
            d_plus = d_plus.max((i + 1) as f64 / count - f);
            d_minus = d_minus.max(f - i as f64 / count);
        }
        Ok(Self { n, d: d_plus.max(d_minus), d_plus, d_minus })
    }

    /// The largest D that n values can give,
    /// max_k [k/n - Phi(-sqrt((n - k)(n - 1)/(k n)))].
    pub fn largest(n: usize) -> f64 {
        let count = n as f64;
        (1..n).fold(0.0, |largest, k| {
            let k = k as f64;
            let z = -((count - k) * (count - 1.0) / (k * count)).sqrt();
            f64::max(largest, k / count - normal::cdf(z))
        })
    }
}

/// Ascending scores (y - m)/s of at least `least` values that vary.
pub(super) fn standardised(
    sample: &Sample,
    least: usize,
) -> Result<Vec<f64>, LillieforsError> {
    let n = sample.len();
    if n < least {
        return Err(LillieforsError::TooFew { found: n, least });
    }
    let mean = sample.mean();
    let mut deviation = (sample.sum_of_squares() / (n as f64 - 1.0)).sqrt();
    if !deviation.is_normal() {
        // Squares that overflow or underflow are those of scaled values.
        let apart = |y: &f64| (y - mean).abs();
        let unit = sample.sorted().iter().map(apart).fold(0.0, f64::max);
        let square = sample.sorted().iter().fold(0.0, |sum, y| {
            let scaled = (y - mean) / unit;
            f64::mul_add(scaled, scaled, sum)
        });
        deviation = unit * (square / (n as f64 - 1.0)).sqrt();
    }
    if !(deviation > 1e-12 * mean.abs() && deviation.is_finite()) {
        return Err(LillieforsError::Degenerate);
    }
    Ok(sample.sorted().iter().map(|y| (y - mean) / deviation).collect())
}

named! {
    /// Origin of a p-value.
    #[non_exhaustive]
    pub enum NullSource: "null distribution" {
        /// The project's own Monte Carlo table.
        Table = "table",
        /// The table, for a larger sample than it has.
        Scaled = "scaled table",
        /// The table, beyond its levels 0.99 and 0.0001: it knows that p lies
        /// beyond.
        Extrapolated = "extrapolated",
        /// A simulation of the same size.
        Simulation = "simulation",
        /// A simulation that takes the smallest value of each draw as its
        /// shift.
        SmallestValue = "simulation, smallest value as shift",
    }
}

named! {
    /// Verdict of a test at a level.
    pub enum Verdict: "verdict" {
        /// The interval of p lies below the level.
        Rejected = "rejected",
        /// The interval of p lies above the level.
        NotRejected = "not-rejected",
        /// The interval of p contains the level: more replicates are needed.
        Indeterminate = "indeterminate",
    }
}

impl Verdict {
    /// The verdict at a level, of a p-value with the interval of its Monte
    /// Carlo error.
    pub fn at_level(p_value: &Estimate, level: f64) -> Self {
        if p_value.high().is_some_and(|high| high < level) {
            Self::Rejected
        } else if p_value.low().is_some_and(|low| low > level) {
            Self::NotRejected
        } else {
            Self::Indeterminate
        }
    }
}

#[cfg(test)]
mod tests;
