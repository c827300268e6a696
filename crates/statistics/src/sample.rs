//! Samples, checked once.

use thiserror::Error;

use super::QuantileType;
use rocking::stop;

/// Why values are not a valid sample.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SampleError {
    /// No value at all.
    #[error("empty sample: expected at least one value")]
    Empty,
    /// A value that is not a finite number.
    #[error(
        "value {number} of the sample is {value}: expected a finite number"
    )]
    NotFinite {
        /// Place in the order given, from 1.
        number: usize,
        /// What stood there.
        value: f64,
    },
    /// A value that is neither finite nor plus infinity.
    #[error(
        "value {number} of the sample is {value}: expected a number, or inf for a censored one"
    )]
    NotExtended {
        /// Place in the order given, from 1.
        number: usize,
        /// What stood there.
        value: f64,
    },
}

/// At least one value, all finite, kept in ascending order.
///
/// ```
/// use rocking_statistics::Sample;
/// let sample = Sample::try_new(&[2.0, 1.0])?;
/// assert_eq!(sample.sorted(), [1.0, 2.0]);
/// assert!(Sample::try_new(&[1.0, f64::INFINITY]).is_err());
/// # Ok::<(), rocking_statistics::SampleError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    sorted: Vec<f64>,
}

impl Sample {
    /// A sample of these values, in any order.
    ///
    /// # Errors
    /// [`SampleError`] if there is no value or one is not finite.
    pub fn try_new(values: &[f64]) -> Result<Self, SampleError> {
        if let Some(i) = values.iter().position(|x| !x.is_finite()) {
            let (number, value) = (i + 1, values[i]);
            return Err(SampleError::NotFinite { number, value });
        }
        Ok(Self { sorted: sort(values)? })
    }

    /// A sample of values that are known to be finite, at least one.
    pub(super) fn from_finite(mut values: Vec<f64>) -> Self {
        values.sort_unstable_by(f64::total_cmp);
        Self { sorted: values }
    }

    /// The values in ascending order.
    pub fn sorted(&self) -> &[f64] {
        &self.sorted
    }

    /// Number of values, at least 1.
    #[expect(clippy::len_without_is_empty, reason = "never empty")]
    pub fn len(&self) -> usize {
        self.sorted.len()
    }

    /// Number of distinct values.
    pub fn distinct(&self) -> usize {
        self.sorted.chunk_by(|a, b| a == b).count()
    }

    /// Size of the largest group of equal values.
    pub fn largest_tie(&self) -> usize {
        let ties = self.sorted.chunk_by(|a, b| a == b);
        ties.map(<[f64]>::len).fold(0, usize::max)
    }

    /// Arithmetic mean, from a compensated sum.
    pub fn mean(&self) -> f64 {
        mean(&self.sorted)
    }

    /// Sum of squared deviations from the mean.
    pub fn sum_of_squares(&self) -> f64 {
        sum_of_squares(&self.sorted)
    }
}

/// At least one value, each finite or plus infinity (censored: a record that
/// never reached the level, a block that overturned), in ascending order.
///
/// ```
/// use rocking_statistics::ExtendedSample;
/// let sample = ExtendedSample::try_new(&[f64::INFINITY, 1.0])?;
/// assert_eq!(sample.finite(), [1.0]);
/// assert_eq!(sample.len(), 2);
/// # Ok::<(), rocking_statistics::SampleError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ExtendedSample {
    sorted: Vec<f64>,
    finite: usize,
}

impl ExtendedSample {
    /// A sample of these values, in any order.
    ///
    /// # Errors
    /// [`SampleError`] if there is no value, or one is NaN or minus
    /// infinity.
    pub fn try_new(values: &[f64]) -> Result<Self, SampleError> {
        let is_valid = |x: &f64| *x > f64::NEG_INFINITY;
        if let Some(i) = values.iter().position(|x| !is_valid(x)) {
            let (number, value) = (i + 1, values[i]);
            return Err(SampleError::NotExtended { number, value });
        }
        sort(values).map(Self::from_sorted)
    }

    /// A sample of values that are known to make one.
    pub(super) fn from_valid(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        Self::from_sorted(sorted)
    }

    fn from_sorted(sorted: Vec<f64>) -> Self {
        let finite = sorted.partition_point(|x| x.is_finite());
        Self { sorted, finite }
    }

    /// All values in ascending order, infinite ones last.
    pub fn sorted(&self) -> &[f64] {
        &self.sorted
    }

    /// The finite values in ascending order.
    pub fn finite(&self) -> &[f64] {
        &self.sorted[..self.finite]
    }

    /// Number of values, infinite ones included; at least 1.
    #[expect(clippy::len_without_is_empty, reason = "never empty")]
    pub fn len(&self) -> usize {
        self.sorted.len()
    }

    /// Number of infinite values.
    pub fn censored(&self) -> usize {
        self.sorted.len() - self.finite
    }

    /// Quantile of type 5 at probability p in [0, 1], infinite if censored
    /// values have a weight in it; NaN outside.
    pub fn quantile(&self, p: f64) -> f64 {
        let value = QuantileType::default().extended_quantile(self, p);
        value.unwrap_or(f64::NAN)
    }
}

/// Values whose sorting takes long enough to be stopped.
const LONG: usize = 1 << 20;

fn sort(values: &[f64]) -> Result<Vec<f64>, SampleError> {
    if values.is_empty() {
        return Err(SampleError::Empty);
    }
    let mut sorted = values.to_vec();
    if sorted.len() < LONG {
        sorted.sort_unstable_by(f64::total_cmp);
    } else {
        sorted.sort_unstable_by(|a, b| {
            stop::point();
            a.total_cmp(b)
        });
    }
    Ok(sorted)
}

/// Mean of a non-empty slice, from a compensated sum in order (Neumaier,
/// ZAMM 54 (1974) 39).
pub(crate) fn mean(values: &[f64]) -> f64 {
    let (sum, rest) = values.iter().fold((0.0, 0.0), |(s, c), &x| {
        let next: f64 = s + x;
        let lost = if f64::abs(s) >= x.abs() {
            (s - next) + x
        } else {
            (x - next) + s
        };
        (next, c + lost)
    });
    (sum + rest) / values.len() as f64
}

/// Sum of squared deviations from the mean, corrected for its rounding.
pub(crate) fn sum_of_squares(values: &[f64]) -> f64 {
    let m = mean(values);
    let (square, linear) = values.iter().fold((0.0, 0.0), |(s, l), x| {
        let d = x - m;
        (f64::mul_add(d, d, s), l + d)
    });
    square - linear * linear / values.len() as f64
}

#[cfg(test)]
mod tests;
