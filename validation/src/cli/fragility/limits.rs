//! Values that are censored at limits of their own.

use rocking::statistics::lognormal::{
    FitError, FitMethod, LognormalFit, fit, fit_intervals,
};
use rocking::statistics::{ExtendedSample, QuantileType};

/// Values, infinite where censored, with the limits that are told.
#[derive(Clone, Debug)]
pub(in crate::cli) struct Limited {
    pub(in crate::cli) values: Vec<f64>,
    limits: Vec<Option<f64>>,
}

impl Limited {
    /// These values, and the limits of those that are censored at one.
    pub(in crate::cli) fn new(values: &[f64], limits: &[Option<f64>]) -> Self {
        Self { values: values.to_vec(), limits: limits.to_vec() }
    }

    /// Those at these places.
    pub(in crate::cli) fn at(&self, places: &[usize]) -> Self {
        let pick = |&i: &usize| (self.values[i], self.limits[i]);
        let (values, limits) = places.iter().map(pick).unzip();
        Self { values, limits }
    }

    /// Number of values with a limit of their own.
    pub(in crate::cli) fn count(&self) -> usize {
        self.limits.iter().flatten().count()
    }

    /// A quantile of the values, none where a value that is censored below
    /// it leaves it open.
    pub(in crate::cli) fn quantile(
        &self,
        quantile_type: QuantileType,
        p: f64,
    ) -> Option<f64> {
        let sample = ExtendedSample::try_new(&self.values).ok()?;
        let value = quantile_type.of_extended(&sample, p).ok()?;
        let open = self.limits.iter().flatten().any(|limit| *limit < value);
        (!open || value.is_infinite()).then_some(value)
    }

    /// The fit above the shift: by [`fit_intervals`] where a value has a
    /// limit of its own and the method takes one.
    pub(in crate::cli) fn fit(
        &self,
        shift: f64,
        method: FitMethod,
    ) -> Result<LognormalFit, FitError> {
        let sample = ExtendedSample::try_new(&self.values)
            .map_err(|_| FitError::TooFew(0))?;
        if self.count() == 0 {
            return fit(&sample, shift, method);
        }
        // Values above the cut are censored at the largest one up to it, as
        // are those that tell no limit.
        let (cut, common) = match method {
            FitMethod::MaximumLikelihood => (f64::INFINITY, None),
            FitMethod::Censored(quantile_type) => {
                let cut = quantile_type.of_extended(&sample, 0.95);
                let cut = cut.unwrap_or(f64::INFINITY);
                let kept = sample.finite().iter().filter(|x| **x <= cut);
                (cut, kept.copied().reduce(f64::max))
            }
            _ => return fit(&sample, shift, method),
        };
        let interval = |(&value, limit): (&f64, &Option<f64>)| {
            let limit = limit.filter(|limit| *limit <= cut);
            match (limit, common) {
                (Some(limit), _) => Ok((limit, f64::INFINITY)),
                (None, _) if value <= cut && value.is_finite() => {
                    Ok((value, value))
                }
                (None, Some(common)) => Ok((common, f64::INFINITY)),
                (None, None) => Err(FitError::Infinite {
                    censored: sample.censored() - self.count(),
                    n: sample.len(),
                }),
            }
        };
        let all = self.values.iter().zip(&self.limits).map(interval);
        let intervals = all.collect::<Result<Vec<_>, _>>()?;
        fit_intervals(&intervals, shift)
    }
}
