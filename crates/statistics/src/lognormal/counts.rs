//! Fragilities from counts: how many records of a stripe exceeded a level.

use libm::{exp, lgamma, log};

use super::censored::Observation::{self, Interval};
use super::censored::{maximise, profile_limits};
use super::{FitError, Lognormal, LognormalFit, check_shift};
use crate::Estimate;

/// The records run at one intensity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stripe {
    /// The intensity.
    pub im: f64,
    /// Number of records that exceeded the level, or overturned.
    pub exceeded: u64,
    /// Number of records run.
    pub n: u64,
}

/// A lognormal fragility fitted to counts.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CountsFit {
    /// The fit; its log-likelihood is of the binomial distributions, with
    /// their coefficients, and its size is the number of records run.
    pub fit: LognormalFit,
    /// The median with its 95 % likelihood interval; an end is open if the
    /// likelihood does not fall so far.
    pub median: Estimate,
    /// The dispersion with that interval.
    pub dispersion: Estimate,
    /// Pearson's chi-squared, sum (k - n F)^2/(n F (1 - F)): well above its
    /// degrees of freedom if records scatter more than binomially or the
    /// fragility is not lognormal.
    pub chi_squared: f64,
    /// Number of stripes less two.
    pub degrees_of_freedom: usize,
}

/// Fits a lognormal fragility above the shift to counts by maximum
/// likelihood: sum of k ln F(im) + (n - k) ln(1 - F(im)) (Baker, Earthquake
/// Spectra 31 (2015) 579, Eq. 11), which is probit regression on
/// ln(im - shift).
///
/// The intervals contain the medians, and the dispersions, whose profile
/// log-likelihood is within 1.92 of the maximum. They take the counts of
/// stripes as independent; stripes of the same records are not.
///
/// ```
/// use rocking_statistics::lognormal::{Stripe, fit_counts};
/// let stripe = |im, exceeded| Stripe { im, exceeded, n: 40 };
/// // Baker's example.
/// let counts = [
///     stripe(0.2, 0), stripe(0.3, 0), stripe(0.4, 0), stripe(0.6, 4),
///     stripe(0.7, 6), stripe(0.8, 13), stripe(0.9, 12), stripe(1.0, 16),
/// ];
/// let fitted = fit_counts(&counts, 0.0)?.fit.distribution;
/// assert!((fitted.median() - 1.076).abs() < 1e-3);
/// assert!((fitted.dispersion() - 0.429).abs() < 1e-3);
/// # Ok::<(), rocking_statistics::lognormal::FitError>(())
/// ```
///
/// # Errors
/// [`FitError::Stripe`] for a stripe that counts more than its records, or
/// lies not above the shift. If the likelihood has no maximum:
/// [`FitError::NoneExceeded`] and [`FitError::AllExceeded`] for counts of one
/// kind, [`FitError::Parted`] and [`FitError::OneMixedStripe`] if one
/// intensity separates stripes without exceedances from stripes with only
/// exceedances, [`FitError::NotRising`] for shares that do not rise with the
/// intensity.
pub fn fit_counts(
    stripes: &[Stripe],
    shift: f64,
) -> Result<CountsFit, FitError> {
    let (known, coefficients, found) = maximum(stripes, shift)?;
    let (log_mean, dispersion, value) = found;
    let distribution = Lognormal::try_new(shift, log_mean, dispersion)?;
    let [mean, deviation] = profile_limits(&known, found);
    let median =
        mean.map(|mu| if mu.is_finite() { shift + exp(mu) } else { mu });
    let chi_squared = stripes.iter().fold(0.0, |sum, stripe| {
        let (p, n) = (distribution.cdf(stripe.im), stripe.n as f64);
        let q = distribution.survival(stripe.im);
        let excess = stripe.exceeded as f64 - n * p;
        sum + excess * excess / (n * p * q)
    });
    let n = stripes.iter().map(|stripe| stripe.n as usize).sum();
    Ok(CountsFit {
        fit: LognormalFit {
            distribution,
            n,
            n_kept: n,
            log_likelihood: Some(value + coefficients),
        },
        // Either profile falls to both sides of its maximum.
        median: Estimate::inside(distribution.median(), median),
        dispersion: Estimate::inside(dispersion, deviation),
        chi_squared,
        degrees_of_freedom: stripes.len().saturating_sub(2),
    })
}

/// Only the distribution of [`fit_counts`], without intervals.
///
/// # Errors
/// As of [`fit_counts`].
pub fn fit_counts_alone(
    stripes: &[Stripe],
    shift: f64,
) -> Result<Lognormal, FitError> {
    let (_, _, (log_mean, dispersion, _)) = maximum(stripes, shift)?;
    Ok(Lognormal::try_new(shift, log_mean, dispersion)?)
}

/// Observations, the logarithm of the binomial coefficients, and the maximum
/// (log-mean, dispersion, log-likelihood).
type Maximum = (Vec<Observation>, f64, (f64, f64, f64));

/// The observations of stripes, the logarithm of their binomial
/// coefficients, and the maximum of their likelihood.
fn maximum(stripes: &[Stripe], shift: f64) -> Result<Maximum, FitError> {
    check_shift(shift)?;
    let (mut known, mut places) = (Vec::new(), Vec::new());
    // The highest intensity at which a record did not exceed the level, and
    // the lowest one at which a record did.
    let mut last_below = (f64::NEG_INFINITY, f64::NAN);
    let mut first_above = (f64::INFINITY, f64::NAN);
    let mut coefficients = 0.0;
    for (i, &Stripe { im, exceeded, n }) in stripes.iter().enumerate() {
        let known_im = im > shift && im.is_finite();
        if !(known_im && exceeded <= n && n > 0) {
            let number = i + 1;
            return Err(FitError::Stripe { number, im, exceeded, n });
        }
        let (y, stood) = (log(im - shift), n - exceeded);
        if exceeded > 0 {
            known.push(Interval(f64::NEG_INFINITY, y, exceeded as f64));
            if y < first_above.0 {
                first_above = (y, im);
            }
        }
        if stood > 0 {
            known.push(Interval(y, f64::INFINITY, stood as f64));
            if y > last_below.0 {
                last_below = (y, im);
            }
        }
        places.push(y);
        coefficients += ln_choose(n, exceeded);
    }
    let (below, above) = (last_below.1, first_above.1);
    if above.is_nan() {
        return Err(FitError::NoneExceeded);
    }
    if below.is_nan() {
        return Err(FitError::AllExceeded);
    }
    if last_below.0 == first_above.0 {
        return Err(FitError::OneMixedStripe { im: below });
    }
    if !(last_below.0 > first_above.0) {
        return Err(FitError::Parted { below, above });
    }
    if !rises(stripes, &places) {
        return Err(FitError::NotRising);
    }
    let lowest = places.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (centre, spread) = (0.5 * (lowest + highest), highest - lowest);
    let found = maximise(&known, centre, spread)?;
    Ok((known, coefficients, found))
}

/// Whether the likelihood rises with 1/dispersion from 0, at which all stripes
/// have one probability: since it is concave, it has no maximum at a positive
/// value if it does not rise there.
fn rises(stripes: &[Stripe], places: &[f64]) -> bool {
    let sum = |of: &dyn Fn(&Stripe) -> f64| {
        stripes.iter().fold(0.0, |sum, stripe| sum + of(stripe))
    };
    let share = sum(&|s| s.exceeded as f64) / sum(&|s| s.n as f64);
    let (mut rise, mut size) = (0.0, 0.0);
    for (stripe, place) in stripes.iter().zip(places) {
        let excess = stripe.exceeded as f64 - share * stripe.n as f64;
        let part = excess * (place - places[0]);
        rise += part;
        size += part.abs();
    }
    // Rounding raises equal shares by less.
    rise > 1e-12 * size
}

/// ln of the number of ways to choose k of n.
fn ln_choose(n: u64, k: u64) -> f64 {
    if k == 0 || k == n {
        return 0.0;
    }
    let ln_factorial = |n: u64| lgamma(n as f64 + 1.0);
    ln_factorial(n) - ln_factorial(k) - ln_factorial(n - k)
}
