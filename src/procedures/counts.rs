//! Fragilities fitted to counts of stripes.

use super::ProcedureError;
use crate::statistics::Lognormal;
use crate::statistics::lognormal::{Stripe, fit_counts};

/// A lognormal fragility fitted to counts, with its likelihood intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CountsFragility {
    /// Records run, over all stripes.
    pub n: usize,
    /// The fitted distribution, in the unit of the stripes.
    pub fitted: Lognormal,
    /// Level of the intervals; they take the stripes as independent.
    pub level: f64,
    /// Median with its likelihood interval.
    pub median: LikelihoodInterval,
    /// Dispersion with its likelihood interval.
    pub dispersion: LikelihoodInterval,
    /// Log-likelihood of the binomial counts.
    pub log_likelihood: Option<f64>,
    /// Pearson's chi-squared.
    pub chi_squared: f64,
    /// Stripes less two.
    pub degrees_of_freedom: usize,
}

/// A value with the ends of its likelihood interval; an end is none where the
/// likelihood does not fall so far.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LikelihoodInterval {
    /// The value of the highest likelihood.
    pub point: f64,
    /// Lower end.
    pub low: Option<f64>,
    /// Upper end.
    pub high: Option<f64>,
}

/// Fits a lognormal fragility above `shift` to counts of exceedances, by
/// maximum likelihood; see [`fit_counts`].
///
/// # Errors
/// [`ProcedureError::Fit`] for counts that make no fit.
pub fn fit_stripes(
    stripes: &[Stripe],
    shift: f64,
) -> Result<CountsFragility, ProcedureError> {
    let found = fit_counts(stripes, shift)?;
    let fitted = found.fit.distribution;
    let interval =
        |point, (low, high)| LikelihoodInterval { point, low, high };
    Ok(CountsFragility {
        n: found.fit.n,
        fitted,
        level: 0.95,
        median: interval(fitted.median(), found.median),
        dispersion: interval(fitted.dispersion(), found.dispersion),
        log_likelihood: found.fit.log_likelihood,
        chi_squared: found.chi_squared,
        degrees_of_freedom: found.degrees_of_freedom,
    })
}
