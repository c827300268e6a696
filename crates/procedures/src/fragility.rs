//! Fragilities from unshifted statistics: Eqs. 5 to 7.
//!
//! The paper's names: USFL is the lognormal fitted to the intensities as they
//! are (unshifted-sample-fitted lognormal), SSFL the one fitted to the
//! intensities above IM_R (shifted), both by
//! [`fit`](rocking_statistics::lognormal::fit); USFL7 is a USFL moved above
//! IM_R by Eqs. 5 and 7, here [`transform`]. A fragility's value at an
//! intensity is [`Lognormal::cdf`].

pub mod hazard;
pub mod options;
pub mod points;
pub mod risk;
pub mod total;

use libm::{exp, expm1, log, log1p};
use thiserror::Error;

use rocking_statistics::Lognormal;
use rocking_statistics::lognormal::{FitError, LognormalError, check_shift};

/// Why one of Eqs. 5 to 7, or a fragility by them, has no value.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FragilityError {
    /// Eq. 5 needs a median above the shift.
    #[error(
        "Eq. 5: median {median} with shift {shift}: expected a median above the shift"
    )]
    Median {
        /// The unshifted median.
        median: f64,
        /// The shift IM_R.
        shift: f64,
    },
    /// Eq. 6 needs both quantiles above the shift, in order.
    #[error(
        "Eq. 6: quantiles {im16} (16 %) and {im84} (84 %) with shift {shift}: expected shift < 16 % < 84 %, finite"
    )]
    Quantiles {
        /// The 16 % quantile.
        im16: f64,
        /// The 84 % quantile.
        im84: f64,
        /// The shift IM_R.
        shift: f64,
    },
    /// Eq. 7 is undefined from the point on where its denominator vanishes.
    #[error(
        "Eq. 7: undefined for c = {c} (c_max = {c_max}): expected c below ln(median/shift)/dispersion"
    )]
    Scale {
        /// The requested constant c.
        c: f64,
        /// The limit ln(median/shift)/dispersion.
        c_max: f64,
    },
    /// A constant c that is negative or not finite.
    #[error("Eq. 7: c = {0}: expected a finite, non-negative number")]
    Constant(f64),
    /// The unshifted or shifted fit that a recipe needs.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// Parameters that make no distribution.
    #[error(transparent)]
    Parameters(#[from] LognormalError),
}

/// Eq. 5: logarithmic mean above the shift, mu_s = ln(IM50 - IM_R).
///
/// `median` IM50 and `shift` IM_R >= 0 in the same units, IM50 > IM_R.
///
/// ```
/// assert_eq!(rocking_procedures::fragility::eq5(2.0, 1.0)?, 0.0);
/// # Ok::<(), rocking_procedures::fragility::FragilityError>(())
/// ```
///
/// # Errors
/// [`FragilityError::Median`] unless the median is above the shift.
pub fn eq5(median: f64, shift: f64) -> Result<f64, FragilityError> {
    check_shift(shift)?;
    if !(median > shift && median.is_finite()) {
        return Err(FragilityError::Median { median, shift });
    }
    Ok(log(median - shift))
}

/// Eq. 6: dispersion above the shift from the unshifted 16 and 84 %
/// quantiles, beta_s = [ln(IM84 - IM_R) - ln(IM16 - IM_R)]/2.
///
/// Exact for a shifted lognormal up to z(0.84) = 0.99446.
///
/// ```
/// let beta = rocking_procedures::fragility::eq6(2.0, 8.389_056_098_930_65, 1.0)?;
/// assert!((beta - 1.0).abs() < 1e-15);
/// # Ok::<(), rocking_procedures::fragility::FragilityError>(())
/// ```
///
/// # Errors
/// [`FragilityError::Quantiles`] unless IM_R < IM16 < IM84, finite.
pub fn eq6(im16: f64, im84: f64, shift: f64) -> Result<f64, FragilityError> {
    check_shift(shift)?;
    if !(shift < im16 && im16 < im84 && im84.is_finite()) {
        return Err(FragilityError::Quantiles { im16, im84, shift });
    }
    Ok(0.5 * log((im84 - shift) / (im16 - shift)))
}

/// The upper limit of c in Eq. 7, ln(IM50/IM_R)/beta_o; infinite without a
/// shift.
///
/// # Errors
/// [`FragilityError`] unless the median is above the shift and the
/// dispersion positive.
pub fn c_max(
    median: f64,
    dispersion: f64,
    shift: f64,
) -> Result<f64, FragilityError> {
    eq5(median, shift)?;
    if !(dispersion > 0.0 && dispersion.is_finite()) {
        return Err(LognormalError::Dispersion(dispersion).into());
    }
    Ok(log(median / shift) / dispersion)
}

/// Eq. 7: dispersion above the shift from the unshifted median and
/// dispersion,
/// beta_s = ln[(IM50 e^(c beta_o) - IM_R)/(IM50 e^(-c beta_o) - IM_R)]/(2c).
///
/// `c` in [0, c_max), c_max = ln(IM50/IM_R)/beta_o; at c = 0 the limit
/// beta_o IM50/(IM50 - IM_R). The value rises with c. Computed as the
/// logarithm of a ratio near 1, which keeps its digits for small c.
///
/// ```
/// use rocking_procedures::fragility::{FragilityError, eq7};
/// let limit = eq7(2.0, 0.5, 1.0, 0.0)?;
/// assert_eq!(limit, 1.0);
/// let error = eq7(2.0, 0.5, 1.0, 1.4).unwrap_err();
/// assert!(matches!(error, FragilityError::Scale { c_max, .. }
///     if (c_max - 1.386_294_361_119_89).abs() < 1e-14));
/// # Ok::<(), FragilityError>(())
/// ```
///
/// # Errors
/// [`FragilityError`] if Eq. 7 has no value; beyond c_max it contains that
/// limit.
pub fn eq7(
    median: f64,
    dispersion: f64,
    shift: f64,
    c: f64,
) -> Result<f64, FragilityError> {
    let c_max = c_max(median, dispersion, shift)?;
    if !(c >= 0.0 && c.is_finite()) {
        return Err(FragilityError::Constant(c));
    }
    let lower = median * exp(-c * dispersion) - shift;
    if !(c < c_max && lower > 0.0) {
        return Err(FragilityError::Scale { c, c_max });
    }
    if c == 0.0 {
        return Ok(dispersion * median / (median - shift));
    }
    // upper - lower = 2 IM50 sinh(c beta_o), without cancellation.
    let rise = median * (expm1(c * dispersion) - expm1(-c * dispersion));
    Ok(log1p(rise / lower) / (2.0 * c))
}

/// USFL7: an unshifted lognormal moved above the shift by Eqs. 5 and 7.
///
/// ```
/// use rocking_procedures::fragility::transform;
/// use rocking_statistics::Lognormal;
/// let usfl = Lognormal::try_new(0.0, std::f64::consts::LN_2, 0.3)?;
/// let usfl7 = transform(&usfl, 1.0, 1.0)?;
/// assert!((usfl7.median() - 2.0).abs() < 1e-15);
/// assert!(usfl7.dispersion() > 0.6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`FragilityError`] if Eq. 5 or Eq. 7 has no value, and for a distribution
/// that is shifted already.
pub fn transform(
    unshifted: &Lognormal,
    shift: f64,
    c: f64,
) -> Result<Lognormal, FragilityError> {
    if unshifted.shift() != 0.0 {
        return Err(LognormalError::Shift(unshifted.shift()).into());
    }
    let median = unshifted.median();
    let log_mean = eq5(median, shift)?;
    let dispersion = eq7(median, unshifted.dispersion(), shift, c)?;
    Ok(Lognormal::try_new(shift, log_mean, dispersion)?)
}

#[cfg(test)]
mod tests;
