//! A dispersion that groups share, each with its own median.

use libm::{exp, log};

use crate::normal::{LN_SQRT_TWO_PI, ln_cdf};
use crate::search::{golden, narrow};

/// The dispersion, of the highest likelihood, of lognormal fragilities of
/// groups of outcomes that differ only in their medians: (intensity, whether
/// it was exceeded) of each group.
///
/// With a median for each group it is biased low. None if no group has an
/// exceedance below an intensity without one: then any small dispersion is as
/// good; or if exceedances do not become more frequent with the intensity.
///
/// ```
/// use rocking_statistics::lognormal::dispersion_within;
/// let group = [(1.0, false), (2.0, true), (3.0, false), (4.0, true)];
/// let found = dispersion_within(&[group.to_vec()]).unwrap();
/// assert!((found - 0.7238).abs() < 1e-4);
/// assert_eq!(dispersion_within(&[group[..2].to_vec()]), None);
/// ```
pub fn dispersion_within(groups: &[Vec<(f64, bool)>]) -> Option<f64> {
    // A group of one outcome fits any dispersion.
    let is_mixed = |own: &&Vec<(f64, bool)>| {
        [true, false].iter().all(|kind| own.iter().any(|o| o.1 == *kind))
    };
    let centred = |own: &Vec<(f64, bool)>| {
        let y: Vec<f64> = own.iter().map(|(im, _)| log(*im)).collect();
        let centre = y.iter().sum::<f64>() / y.len() as f64;
        let fates = own.iter().map(|one| one.1);
        y.iter().map(|y| y - centre).zip(fates).collect::<Vec<_>>()
    };
    let all: Vec<Vec<(f64, bool)>> =
        groups.iter().filter(is_mixed).map(centred).collect();
    let (mut overlaps, mut rise, mut largest) = (false, 0.0, 0.0f64);
    for own in &all {
        let of = |kind: bool| own.iter().filter(move |o| o.1 == kind);
        let first = of(true).map(|o| o.0).fold(f64::INFINITY, f64::min);
        let last = of(false).map(|o| o.0).fold(f64::NEG_INFINITY, f64::max);
        overlaps |= first < last;
        // The slope of the likelihood where 1/dispersion is 0.
        let share = of(true).count() as f64 / own.len() as f64;
        for (y, exceeded) in own {
            rise += (f64::from(u8::from(*exceeded)) - share) * y;
            largest = largest.max(y.abs());
        }
    }
    if !(overlaps && rise > 1e-12 * largest) {
        return None;
    }
    // The likelihood is concave in 1/dispersion, so it has one maximum.
    let value = |ln: f64| {
        let a = exp(ln) / largest;
        all.iter().fold(0.0, |sum, own| sum + highest(own, a))
    };
    Some(largest * exp(-golden(value, -FARTHEST, FARTHEST)))
}

/// Largest distance of the dispersion from the largest deviation, in
/// logarithms.
const FARTHEST: f64 = 15.0;

/// The highest log-likelihood of a group at 1/dispersion `a`, by halving the
/// interval that holds its median.
fn highest(own: &[(f64, bool)], a: f64) -> f64 {
    let ends = own.iter().map(|one| a * one.0);
    let low = ends.clone().fold(f64::INFINITY, f64::min) - 9.0;
    let high = ends.fold(f64::NEG_INFINITY, f64::max) + 9.0;
    // Value and slope at median b/a; the slope falls with b.
    let at = |b: f64| {
        own.iter().fold((0.0, 0.0), |(value, slope), (y, exceeded)| {
            let sign = if *exceeded { 1.0 } else { -1.0 };
            let z = sign * f64::mul_add(a, *y, -b);
            let ln_p = ln_cdf(z);
            let ratio = exp(-0.5 * z * z - LN_SQRT_TWO_PI - ln_p);
            (value + ln_p, slope - sign * ratio)
        })
    };
    let is_wide = |low: f64, high: f64| {
        high - low > 1e-9 * (1.0 + low.abs().max(high.abs()))
    };
    let (low, high) = narrow(low, high, is_wide, |b| at(b).1 > 0.0);
    at(0.5 * (low + high)).0
}
