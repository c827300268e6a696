//! The shift as a free parameter, by profile likelihood.

use libm::{exp, log};

use super::censored::DROP;
use super::{FitError, FitMethod, LognormalFit, fit};
use crate::search::narrow;
use crate::{ExtendedSample, Interval};

/// Places at which the profile is examined, by ln(smallest - shift).
const PLACES: usize = 400;
/// The shift comes this close to the smallest value, relative to it.
const CLOSEST: f64 = 1e-8;

/// The shift that maximises the likelihood of a lognormal above it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ShiftProfile {
    /// The fit at the best shift; its log-likelihood has three parameters.
    pub fit: LognormalFit,
    /// The 95 % likelihood interval of the shift; its high end is open if the
    /// likelihood does not fall so far before it rises without bound towards
    /// the smallest value.
    pub interval: Interval,
}

/// Profile likelihood of the shift r in [0, smallest value).
///
/// The likelihood is unbounded as r approaches the smallest value, so the
/// *interior* local maximum is taken: the highest one between r = 0 and the
/// final rise. It does not always exist. The interval holds the shifts
/// whose log-likelihood is within 1.92 of it.
///
/// # Errors
/// [`FitError::NoInteriorMaximum`], or why the sample cannot be fitted.
pub fn profile_shift(
    sample: &ExtendedSample,
) -> Result<ShiftProfile, FitError> {
    let method = FitMethod::MaximumLikelihood;
    let at_zero = fit(sample, 0.0, method)?;
    let smallest = sample.sorted()[0];
    // The place t from 0 (no shift) on: smallest - r = smallest e^(-t).
    let shift = |t: f64| smallest * (1.0 - exp(-t));
    let value = |t: f64| {
        let fit = fit(sample, shift(t), method).ok();
        fit.and_then(|fit| fit.log_likelihood).unwrap_or(f64::NEG_INFINITY)
    };
    let step = -log(CLOSEST) / PLACES as f64;
    let place = |i: usize| step * i as f64;
    let values: Vec<f64> = (0..=PLACES).map(|i| value(place(i))).collect();
    let peak = (1..PLACES)
        .filter(|&i| values[i] > values[i - 1] && values[i] >= values[i + 1])
        .max_by(|&i, &j| values[i].total_cmp(&values[j]))
        .ok_or(FitError::NoInteriorMaximum)?;
    let best = golden(value, place(peak - 1), place(peak + 1));
    let limit = value(best) - DROP;
    let below = (0..peak).rev().find(|&i| values[i] < limit);
    let above = (peak + 1..=PLACES).find(|&i| values[i] < limit);
    // The shift at which the profile passes the limit.
    let passes = |outside: f64, inside: f64| {
        let goes_on = |a: f64, b: f64| (b - a).abs() > 1e-12;
        let is_below = |t: f64| value(t) < limit;
        let (a, b) = narrow(outside, inside, goes_on, is_below);
        shift(0.5 * (a + b))
    };
    let low = below.map_or(0.0, |i| passes(place(i), place(i + 1).min(best)));
    let high = above
        .map_or(f64::INFINITY, |i| passes(place(i), place(i - 1).max(best)));
    // On either side of the best place.
    let interval = Interval::rising(low, high);
    let fit = fit(sample, shift(best), method)?;
    let unshifted = at_zero.log_likelihood.unwrap_or(f64::NEG_INFINITY);
    if fit.log_likelihood.is_none_or(|value| value < unshifted) {
        return Err(FitError::NoInteriorMaximum);
    }
    Ok(ShiftProfile { fit, interval })
}

/// The place of a maximum between two places, by golden sections.
fn golden(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    const SHARE: f64 = 0.618_033_988_749_894_8;
    while high - low > 1e-9 {
        let (a, b) = (high - SHARE * (high - low), low + SHARE * (high - low));
        if f(a) < f(b) {
            low = a;
        } else {
            high = b;
        }
    }
    0.5 * (low + high)
}
