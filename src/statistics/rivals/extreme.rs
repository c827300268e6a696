//! The generalized extreme value distribution.

use libm::{exp, expm1, log, log1p, sinh};

use super::weibull;
use crate::statistics::lognormal::FitError;
use crate::statistics::sample::sum_of_squares;
use crate::statistics::search::golden;
use crate::statistics::{ExtendedSample, Sample};

/// Places at which the profile over the end of the support is looked at.
const PLACES: usize = 64;
/// The end comes as near as range/sinh(this) to the sample.
const REACH: f64 = 9.0;
/// An end farther off than this many ranges is no longer told from none.
const FARTHEST: f64 = 1e4;

/// F(x) = exp(-(1 + shape (x - location)/scale)^(-1/shape)) where the
/// bracket is positive; exp(-exp(-(x - location)/scale)) at shape 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ExtremeValue {
    /// Location, in units of x.
    pub location: f64,
    /// Scale, positive, in units of x.
    pub scale: f64,
    /// Shape: positive with a heavy upper tail, negative with an upper end.
    pub shape: f64,
}

impl ExtremeValue {
    /// -ln F(x).
    fn exponent(&self, x: f64) -> f64 {
        let z = (x - self.location) / self.scale;
        if self.shape == 0.0 {
            return exp(-z);
        }
        let inner = self.shape * z;
        if inner <= -1.0 {
            // Below the lower end, or above the upper one.
            return if self.shape > 0.0 { f64::INFINITY } else { 0.0 };
        }
        exp(-log1p(inner) / self.shape)
    }

    /// The distribution function.
    #[must_use]
    pub fn cdf(&self, x: f64) -> f64 {
        exp(-self.exponent(x))
    }

    /// The survival function 1 - F(x), without cancellation.
    #[must_use]
    pub fn survival(&self, x: f64) -> f64 {
        -expm1(-self.exponent(x))
    }

    /// The quantile at probability p between 0 and 1.
    #[must_use]
    pub fn quantile(&self, p: f64) -> f64 {
        let exponent = log(-log(p));
        let z = if self.shape == 0.0 {
            -exponent
        } else {
            expm1(-self.shape * exponent) / self.shape
        };
        f64::mul_add(self.scale, z, self.location)
    }
}

/// Fits a generalized extreme value distribution by maximum likelihood, and
/// gives it with its log-likelihood (Coles, An Introduction to Statistical
/// Modeling of Extreme Values, 2001, Eq. 3.2).
///
/// With a lower end it is a Frechet distribution above that end, with an
/// upper end a mirrored Weibull distribution below it: the likelihood is
/// profiled over the end, on both sides of the sample and through infinity.
/// It is unbounded where the upper end approaches the largest value, so the
/// highest *interior* maximum is taken.
///
/// ```
/// use rocking::statistics::ExtendedSample;
/// use rocking::statistics::rivals::fit_extreme_value;
/// let x = [1.1, 1.4, 1.6, 1.9, 2.1, 2.6, 3.0, 4.2];
/// let (fitted, _) = fit_extreme_value(&ExtendedSample::try_new(&x)?)?;
/// assert!(fitted.location > 1.1 && fitted.scale > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`FitError`] for censored values, values that don't vary, or
/// [`FitError::NoInteriorMaximum`].
pub fn fit_extreme_value(
    sample: &ExtendedSample,
) -> Result<(ExtremeValue, f64), FitError> {
    let n = sample.len();
    if sample.censored() > 0 {
        let censored = sample.censored();
        return Err(FitError::Infinite { censored, n });
    }
    let x = sample.sorted();
    let range = x[n - 1] - x[0];
    let distinct = Sample::try_new(x).map_or(0, |sample| sample.distinct());
    if distinct < 3 || !(range > 1e-9 * x[n - 1].abs()) {
        return Err(FitError::Degenerate);
    }
    let at = |t: f64| with_end(x, range, sinh(t));
    let value = |t: f64| at(t).1;
    let place = |i: usize| REACH * (2.0 * i as f64 / PLACES as f64 - 1.0);
    let values: Vec<f64> = (0..=PLACES).map(|i| value(place(i))).collect();
    let peak = (1..PLACES)
        .filter(|&i| values[i] > values[i - 1] && values[i] >= values[i + 1])
        .max_by(|&i, &j| values[i].total_cmp(&values[j]))
        .ok_or(FitError::NoInteriorMaximum)?;
    let (low, high) = (place(peak - 1), place(peak + 1));
    Ok(at(golden(value, low, high)))
}

/// The fit whose end lies range/w below the smallest value, for w > 0, or
/// above the largest one.
fn with_end(x: &[f64], range: f64, w: f64) -> (ExtremeValue, f64) {
    let w = if w.abs() < 1.0 / FARTHEST {
        1.0f64.copysign(w) / FARTHEST
    } else {
        w
    };
    let n = x.len();
    let distance = range / w.abs();
    let nearest = if w > 0.0 { x[0] } else { x[n - 1] };
    // ln of the distance from the end, in units of the smallest one; the
    // smallest of Frechet is the largest of Weibull's mirror.
    let sign = if w > 0.0 { -1.0 } else { 1.0 };
    let logs: Vec<f64> = x
        .iter()
        .map(|x| sign * log1p((x - nearest).abs() / distance))
        .collect();
    let spread = (sum_of_squares(&logs) / n as f64).sqrt();
    let (k, scale, own) = weibull(&logs, spread);
    let unit = n as f64 * log(distance);
    if w > 0.0 {
        // 1/x is Weibull: the Jacobian is -2 ln x.
        let sum = logs.iter().fold(0.0, |sum, y| sum + y);
        let scale = distance / scale;
        let fitted = ExtremeValue {
            location: x[0] - distance + scale,
            scale: scale / k,
            shape: 1.0 / k,
        };
        (fitted, own + 2.0 * sum - unit)
    } else {
        let scale = distance * scale;
        let fitted = ExtremeValue {
            location: x[n - 1] + distance - scale,
            scale: scale / k,
            shape: -1.0 / k,
        };
        (fitted, own - unit)
    }
}
