//! Two-parameter rivals of the lognormal, on the same scale.
//!
//! Weibull, Frechet and gamma distributions above a given shift, fitted by
//! maximum likelihood, with log-likelihoods in x that can be compared with
//! [`Lognormal::log_likelihood`](super::Lognormal::log_likelihood).

mod extreme;
mod incomplete;

use libm::{exp, expm1, lgamma, log};

pub use extreme::{ExtremeValue, fit_extreme_value};

use super::lognormal::{FitError, shifted_finite};
use super::sample::{mean, sum_of_squares};
use super::{ExtendedSample, Sample};
use crate::names::named;

/// A family of distributions above a shift.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Family {
    /// F = 1 - exp(-(x/scale)^shape).
    Weibull,
    /// F = exp(-(x/scale)^-shape).
    Frechet,
    /// Density x^(shape-1) e^(-x/scale) / (Gamma(shape) scale^shape).
    Gamma,
}

named!(Family, "family of distributions", {
    Weibull = "Weibull",
    Frechet = "Frechet",
    Gamma = "gamma",
});

/// A fitted rival, in x - shift.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RivalFit {
    /// The family.
    pub family: Family,
    /// Shape, positive.
    pub shape: f64,
    /// Scale, in units of x.
    pub scale: f64,
    /// Log-likelihood in x.
    pub log_likelihood: f64,
    /// Size of the sample.
    pub n: usize,
}

impl RivalFit {
    /// F and 1 - F at x - shift.
    #[must_use]
    pub fn both(&self, excess: f64) -> (f64, f64) {
        if !(excess > 0.0) {
            return (0.0, 1.0);
        }
        let ratio = excess / self.scale;
        match self.family {
            Family::Weibull => {
                let exponent = exp(self.shape * log(ratio));
                (-expm1(-exponent), exp(-exponent))
            }
            Family::Frechet => {
                let exponent = exp(-self.shape * log(ratio));
                (exp(-exponent), -expm1(-exponent))
            }
            Family::Gamma => incomplete::incomplete_gamma(self.shape, ratio),
        }
    }
}

/// Fits a family above the shift by maximum likelihood to a sample without
/// censored values.
///
/// ```
/// use rocking::statistics::ExtendedSample;
/// use rocking::statistics::rivals::{Family, fit};
/// let sample = ExtendedSample::try_new(&[1.0, 2.0, 3.0, 4.0, 5.0])?;
/// let weibull = fit(&sample, 0.0, Family::Weibull)?;
/// assert!((weibull.shape - 2.29).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`FitError`] for censored values, values not above the shift, or values
/// that don't vary.
pub fn fit(
    sample: &ExtendedSample,
    shift: f64,
    family: Family,
) -> Result<RivalFit, FitError> {
    let n = sample.len();
    if sample.censored() > 0 {
        let censored = sample.censored();
        return Err(FitError::Infinite { censored, n });
    }
    let logs = shifted_finite(sample, shift)?;
    let spread = (sum_of_squares(&logs) / n as f64).sqrt();
    let distinct = Sample::try_new(&logs).map_or(0, |s| s.distinct());
    if distinct < 2 || spread.is_nan() || spread <= 1e-12 {
        return Err(FitError::Degenerate);
    }
    let sum = mean(&logs) * n as f64;
    let (shape, scale, log_likelihood) = match family {
        Family::Weibull => weibull(&logs, spread),
        Family::Frechet => {
            // 1/x is Weibull.
            let mirrored: Vec<f64> = logs.iter().map(|y| -y).collect();
            let (shape, scale, value) = weibull(&mirrored, spread);
            (shape, 1.0 / scale, value - 2.0 * sum)
        }
        Family::Gamma => gamma(&logs, spread),
    };
    Ok(RivalFit { family, shape, scale, log_likelihood, n })
}

/// Shape, scale and log-likelihood of a Weibull distribution of exp(y).
fn weibull(y: &[f64], spread: f64) -> (f64, f64, f64) {
    let (n, centre) = (y.len() as f64, mean(y));
    let highest = y.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // Sums of weights e^(k (y - highest)), without and with y.
    let sums = |k: f64| {
        y.iter().fold((0.0, 0.0), |(weights, weighted), y| {
            let w = exp(k * (y - highest));
            (weights + w, f64::mul_add(w, y - centre, weighted))
        })
    };
    let shape = rising_root(
        |k| {
            let (weights, weighted) = sums(k);
            weighted / weights - 1.0 / k
        },
        1.0 / spread,
    );
    let ln_scale = highest + log(sums(shape).0 / n) / shape;
    // At the maximum the sum of (x/scale)^shape is n.
    let density = log(shape) - shape * ln_scale + (shape - 1.0) * centre;
    (shape, exp(ln_scale), n * (density - 1.0))
}

/// Shape, scale and log-likelihood of a gamma distribution of exp(y).
fn gamma(y: &[f64], spread: f64) -> (f64, f64, f64) {
    let (n, centre) = (y.len() as f64, mean(y));
    // ln of the mean of x over its geometric mean, from exp(y - centre).
    let sum = y.iter().fold(0.0, |sum, y| sum + exp(y - centre));
    let gap = log(sum / n);
    let shape =
        rising_root(|k| digamma(k) - log(k) + gap, 1.0 / (spread * spread));
    let ln_scale = gap + centre - log(shape);
    let density =
        (shape - 1.0) * centre - shape * ln_scale - lgamma(shape) - shape;
    (shape, exp(ln_scale), n * density)
}

/// The positive root of a rising function, to the last bits: brackets by
/// doubling from a guess, then halves.
fn rising_root(f: impl Fn(f64) -> f64, guess: f64) -> f64 {
    let (mut low, mut high) = (guess, guess);
    while f(low) > 0.0 && low > 1e-12 {
        low *= 0.5;
    }
    while f(high) < 0.0 && high < 1e12 {
        high *= 2.0;
    }
    loop {
        let middle = 0.5 * (low + high);
        if !(middle > low && middle < high) {
            return middle;
        }
        if f(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// The digamma function for x > 0: recurrence up to 12, then its asymptotic
/// series (first neglected term 1e-17).
fn digamma(mut x: f64) -> f64 {
    let mut shift = 0.0;
    while x < 12.0 {
        shift -= 1.0 / x;
        x += 1.0;
    }
    let w = 1.0 / (x * x);
    let series = [
        -1.0 / 12.0,
        691.0 / 32760.0,
        -1.0 / 132.0,
        1.0 / 240.0,
        -1.0 / 252.0,
        1.0 / 120.0,
        -1.0 / 12.0,
    ]
    .iter()
    .fold(0.0, |sum: f64, c| w * (sum + c));
    shift + log(x) - 0.5 / x + series
}

#[cfg(test)]
mod tests;
