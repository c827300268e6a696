//! Quantiles by named type, safe with infinities.

use std::fmt;

use thiserror::Error;

use super::{ExtendedSample, Sample};

/// Why a quantile or its type was rejected.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum QuantileError {
    /// A probability outside [0, 1].
    #[error("probability {0}: expected a number in [0, 1]")]
    Probability(f64),
    /// A type that is not 1 to 9.
    #[error("quantile type {0}: expected a whole number from 1 to 9")]
    Type(u8),
}

/// The nine sample quantiles of Hyndman and Fan, "Sample quantiles in
/// statistical packages", The American Statistician 50 (1996) 361.
///
/// Type 5 is the default here, as in MATLAB (`prctile`, `quantile`,
/// `boxplot`); type 7 is the default of R and NumPy.
///
/// ```
/// use rocking_statistics::{QuantileType, Sample};
/// let sample = Sample::try_new(&[1.0, 2.0, 3.0, 4.0])?;
/// let type_5 = QuantileType::default();
/// assert_eq!(type_5.quantile(&sample, 0.25)?, 1.5);
/// assert_eq!(QuantileType::try_new(7)?.quantile(&sample, 0.25)?, 1.75);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QuantileType(u8);

impl Default for QuantileType {
    fn default() -> Self {
        Self(5)
    }
}

impl fmt::Display for QuantileType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

impl QuantileType {
    /// The type of this number, 1 to 9.
    ///
    /// # Errors
    /// [`QuantileError::Type`] for another number.
    pub fn try_new(number: u8) -> Result<Self, QuantileError> {
        if !(1..=9).contains(&number) {
            return Err(QuantileError::Type(number));
        }
        Ok(Self(number))
    }

    /// The number, 1 to 9.
    pub fn number(self) -> u8 {
        self.0
    }

    /// Quantile of a finite sample at probability p in [0, 1].
    ///
    /// # Errors
    /// [`QuantileError::Probability`] outside [0, 1].
    pub fn quantile(
        self,
        sample: &Sample,
        p: f64,
    ) -> Result<f64, QuantileError> {
        self.of_sorted(sample.sorted(), p)
    }

    /// Quantile of a sample with censored values at probability p in [0, 1]:
    /// infinite exactly if an infinite value has positive weight.
    ///
    /// # Errors
    /// [`QuantileError::Probability`] outside [0, 1].
    pub fn extended_quantile(
        self,
        sample: &ExtendedSample,
        p: f64,
    ) -> Result<f64, QuantileError> {
        self.of_sorted(sample.sorted(), p)
    }

    /// [`Self::extended_quantile`], if it is finite.
    pub(crate) fn finite_quantile(
        self,
        sample: &ExtendedSample,
        p: f64,
    ) -> Option<f64> {
        let value = self.extended_quantile(sample, p).ok();
        value.filter(|x| x.is_finite())
    }

    fn of_sorted(self, sorted: &[f64], p: f64) -> Result<f64, QuantileError> {
        self.by_rank(sorted.len(), |rank| sorted[rank], p)
    }

    /// (1 - g) x_(j) + g x_(j+1), with j + g = n p + m; m by the type. As in
    /// R, g within a few rounding errors of a whole number is that number,
    /// so that a weight of zero never touches its neighbour. `value` gives
    /// x_(j) of the `count` values for j - 1.
    pub(crate) fn by_rank(
        self,
        count: usize,
        value: impl Fn(usize) -> f64,
        p: f64,
    ) -> Result<f64, QuantileError> {
        if !(0.0..=1.0).contains(&p) {
            return Err(QuantileError::Probability(p));
        }
        let n = count as f64;
        // From type 4 on, of the plotting position (k - a)/(n + 1 - a - b).
        let (a, b) = match self.0 {
            4 => (0.0, 1.0),
            5 => (0.5, 0.5),
            6 => (0.0, 0.0),
            7 => (1.0, 1.0),
            8 => (1.0 / 3.0, 1.0 / 3.0),
            _ => (0.375, 0.375),
        };
        let position = match self.0 {
            1 | 2 => n * p,
            3 => n * p - 0.5,
            _ => a + p * (n + 1.0 - a - b),
        };
        let fuzz = 4.0 * f64::EPSILON * position.abs().max(1.0);
        let j = (position + fuzz).floor();
        let remainder = position - j;
        let exact = remainder.abs() <= fuzz;
        let weight = match self.0 {
            1 => f64::from(u8::from(!exact)),
            2 => 0.5 * f64::from(1 + u8::from(!exact)),
            3 => f64::from(u8::from(!(exact && j % 2.0 == 0.0))),
            _ if exact => 0.0,
            _ => remainder,
        };
        let at = |rank: f64| value(rank.clamp(1.0, n) as usize - 1);
        let (low, high) = (at(j), at(j + 1.0));
        Ok(if weight <= 0.0 || low == high {
            low
        } else if weight >= 1.0 || high == f64::INFINITY {
            high
        } else {
            f64::mul_add(weight, high, (1.0 - weight) * low)
        })
    }
}

#[cfg(test)]
mod tests;
