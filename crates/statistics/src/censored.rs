//! Values, some of them censored at individual limits.

use super::lognormal::{
    FitError, FitMethod, LognormalFit, fit, fit_intervals,
    fit_intervals_together,
};
use super::sample::SampleError;
use super::{ExtendedSample, QuantileType};

/// Values in their order, infinite if censored, with the limits that are
/// known: a record that was run up to an intensity of 3.2 and stood has the
/// limit 3.2.
///
/// ```
/// use rocking_statistics::CensoredSample;
/// let inf = f64::INFINITY;
/// let sample =
///     CensoredSample::try_new(&[1.0, inf, inf], &[None, Some(3.2), None])?;
/// assert_eq!((sample.censored(), sample.limited()), (2, 1));
/// # Ok::<(), rocking_statistics::SampleError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct CensoredSample {
    values: Vec<f64>,
    limits: Vec<Option<f64>>,
}

impl CensoredSample {
    /// These values, with the known limits of censored ones; a missing limit
    /// at the end counts as unknown.
    ///
    /// # Errors
    /// [`SampleError`] if there is no value, or one is NaN or minus infinity.
    pub fn try_new(
        values: &[f64],
        limits: &[Option<f64>],
    ) -> Result<Self, SampleError> {
        ExtendedSample::try_new(values)?;
        let limits = limits.iter().copied().chain(std::iter::repeat(None));
        let limits = limits.take(values.len()).collect();
        Ok(Self { values: values.to_vec(), limits })
    }

    /// A sample of values known by intervals (low, high): censored at `low` if
    /// `high` is infinite, else the value `high`.
    ///
    /// # Errors
    /// [`SampleError`] as of [`Self::try_new`].
    pub fn from_intervals(
        intervals: &[(f64, f64)],
    ) -> Result<Self, SampleError> {
        let limit = |(low, high): &(f64, f64)| {
            (*high, high.is_infinite().then_some(*low))
        };
        let (values, limits): (Vec<_>, Vec<_>) =
            intervals.iter().map(limit).unzip();
        Self::try_new(&values, &limits)
    }

    /// The values in their order, infinite if censored.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The known limits of censored values.
    pub fn limits(&self) -> &[Option<f64>] {
        &self.limits
    }

    /// The same values without their limits.
    pub fn extended(&self) -> ExtendedSample {
        ExtendedSample::from_valid(&self.values)
    }

    /// The values at these places, in this order.
    pub fn resample(&self, places: &[usize]) -> Self {
        let pick = |&i: &usize| (self.values[i], self.limits[i]);
        let (values, limits) = places.iter().map(pick).unzip();
        Self { values, limits }
    }

    /// The smallest value, and the sample of the values above it.
    pub fn above_smallest(&self) -> (f64, Self) {
        let least = self.values.iter().copied().fold(f64::INFINITY, f64::min);
        let above = |&i: &usize| self.values[i] > least;
        let places: Vec<usize> =
            (0..self.values.len()).filter(above).collect();
        (least, self.resample(&places))
    }

    /// Number of values.
    #[expect(clippy::len_without_is_empty, reason = "never empty")]
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Number of censored values.
    pub fn censored(&self) -> usize {
        self.values.iter().filter(|x| x.is_infinite()).count()
    }

    /// Number of censored values whose limit is known.
    pub fn limited(&self) -> usize {
        self.limits.iter().flatten().count()
    }

    /// A quantile of the values; none if it is unknown because a value is
    /// censored below it.
    pub fn quantile(
        &self,
        quantile_type: QuantileType,
        p: f64,
    ) -> Option<f64> {
        let value =
            quantile_type.extended_quantile(&self.extended(), p).ok()?;
        let open = self.limits.iter().flatten().any(|limit| *limit < value);
        (!open || value.is_infinite()).then_some(value)
    }

    /// The points of the sample's distribution: the k-th value of n at the
    /// probability (k - 1/2)/n, as [`QuantileType`] 5 has it. Values that are
    /// unknown because of censoring are left out.
    ///
    /// ```
    /// use rocking_statistics::CensoredSample;
    /// let values = [2.0, 1.0, f64::INFINITY, 1.2];
    /// let limits = [None, None, Some(1.5), None];
    /// let sample = CensoredSample::try_new(&values, &limits)?;
    /// assert_eq!(sample.points(), [(1.0, 0.125), (1.2, 0.375)]);
    /// # Ok::<(), rocking_statistics::SampleError>(())
    /// ```
    pub fn points(&self) -> Vec<(f64, f64)> {
        let n = self.len();
        let known = |(k, x): (usize, &f64)| {
            let open = self.limits.iter().flatten().any(|limit| limit < x);
            (!open).then(|| (*x, (k as f64 + 0.5) / n as f64))
        };
        let all = self.extended();
        all.finite().iter().enumerate().filter_map(known).collect()
    }

    /// The lognormal fit above the shift: by [`fit_intervals`] if a value has
    /// its own limit and the method takes one, else by [`fit`].
    ///
    /// # Errors
    /// [`FitError`] if the values make no fit.
    pub fn fit(
        &self,
        shift: f64,
        method: FitMethod,
    ) -> Result<LognormalFit, FitError> {
        let sample = ExtendedSample::try_new(&self.values)
            .map_err(|_| FitError::TooFew(0))?;
        if self.limited() == 0 {
            return fit(&sample, shift, method);
        }
        // Values above the cut are censored at the largest one up to it, as
        // are those whose limit is unknown.
        let (cut, common) = match method {
            FitMethod::MaximumLikelihood => (f64::INFINITY, None),
            FitMethod::Censored(quantile_type) => {
                let cut = quantile_type.extended_quantile(&sample, 0.95);
                let cut = cut.unwrap_or(f64::INFINITY);
                let kept = sample.finite().iter().filter(|x| **x <= cut);
                (cut, kept.copied().reduce(f64::max))
            }
            _ => return fit(&sample, shift, method),
        };
        fit_intervals(&self.intervals(cut, common)?, shift)
    }

    /// The lognormal fits of one dispersion above one shift, by maximum
    /// likelihood: [`fit_intervals_together`].
    ///
    /// # Errors
    /// [`FitError`] if the values of a sample make no fit.
    pub fn fit_together(
        all: &[Self],
        shift: f64,
    ) -> Result<Vec<LognormalFit>, FitError> {
        let known = all.iter().map(|own| own.intervals(f64::INFINITY, None));
        let known = known.collect::<Result<Vec<_>, _>>()?;
        let known: Vec<_> = known.iter().map(Vec::as_slice).collect();
        fit_intervals_together(&known, shift)
    }

    /// The values as intervals; those above `cut` are censored at `common`,
    /// as are those whose limit is unknown.
    fn intervals(
        &self,
        cut: f64,
        common: Option<f64>,
    ) -> Result<Vec<(f64, f64)>, FitError> {
        let interval = |(&value, limit): (&f64, &Option<f64>)| {
            let limit = limit.filter(|limit| *limit <= cut);
            match (limit, common) {
                (Some(limit), _) => Ok((limit, f64::INFINITY)),
                (None, _) if value <= cut && value.is_finite() => {
                    Ok((value, value))
                }
                (None, Some(common)) => Ok((common, f64::INFINITY)),
                (None, None) => Err(FitError::Infinite {
                    censored: self.censored() - self.limited(),
                    n: self.len(),
                }),
            }
        };
        self.values.iter().zip(&self.limits).map(interval).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A value censored below a quantile leaves it open, one censored at it
    /// does not.
    #[test]
    fn a_quantile_is_known_up_to_the_least_limit() {
        let values = [1.0, 2.0, 3.0, f64::INFINITY];
        let middle = |limit: f64| {
            let limits = [None, None, None, Some(limit)];
            let own = CensoredSample::try_new(&values, &limits).unwrap();
            own.quantile(QuantileType::try_new(1).unwrap(), 0.5)
        };
        assert_eq!(middle(1.9), None);
        assert_eq!(middle(2.0), Some(2.0));
        assert_eq!(middle(2.1), Some(2.0));
    }

    /// The 95 % quantile of 1 to 30 and one censored value is 29.95. A value
    /// that is censored at this cut keeps its limit. The limit of a larger
    /// value becomes the largest value below the cut.
    #[test]
    fn a_limit_at_the_cut_is_kept() {
        let mut values: Vec<f64> = (1..=30).map(f64::from).collect();
        values.push(f64::INFINITY);
        let quantile_type = QuantileType::default();
        let sample = ExtendedSample::try_new(&values).unwrap();
        let cut = quantile_type.extended_quantile(&sample, 0.95).unwrap();
        assert!((cut - 29.95).abs() < 1e-9);
        let mut limits = vec![None; 30];
        limits.push(Some(cut));
        let own = CensoredSample::try_new(&values, &limits).unwrap();
        let found = own.fit(0.0, FitMethod::Censored(quantile_type)).unwrap();
        let mut all: Vec<(f64, f64)> =
            values[..29].iter().map(|x| (*x, *x)).collect();
        all.extend([(29.0, f64::INFINITY), (cut, f64::INFINITY)]);
        assert_eq!(found, fit_intervals(&all, 0.0).unwrap());
    }
}
