//! Centre of the ratios, and its equivalence to 1.

use libm::{exp, log, log1p};

use super::PairedError;
use crate::beta::{binomial_cdf, student_cdf, student_quantile};
use crate::sample::{mean, sum_of_squares};
use crate::{Estimate, ExtendedSample, Interval, normal};
use rocking::stop;

/// Equivalence of the mean of ln ratio to 0 by two one-sided t tests.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Equivalence {
    /// Margin m: the bounds are -ln(1 + m) and ln(1 + m).
    pub margin: f64,
    /// exp(mean of ln ratio), the geometric mean, with its 90 % interval.
    #[serde(
        flatten,
        serialize_with = "crate::estimate::keys::geometric_mean"
    )]
    pub geometric_mean: Estimate,
    /// One-sided p-value against a mean at or below the lower bound.
    pub p_lower: f64,
    /// One-sided p-value against a mean at or above the upper bound.
    pub p_upper: f64,
    /// The larger of the two: equivalent at level p.
    pub p_value: f64,
}

/// Two one-sided t tests (Schuirmann 1987) that the mean of ln ratio lies
/// within ln(1 + margin) of 0.
///
/// ```
/// use rocking_statistics::paired::equivalence;
/// let ratios = [0.99, 1.01, 1.0, 1.02, 0.98, 1.0];
/// assert!(equivalence(&ratios, 0.05)?.p_value < 0.01);
/// # Ok::<(), rocking_statistics::paired::PairedError>(())
/// ```
///
/// # Errors
/// [`PairedError`] for fewer than 2 ratios, ratios that don't vary, or a
/// margin that is not positive.
pub fn equivalence(
    ratios: &[f64],
    margin: f64,
) -> Result<Equivalence, PairedError> {
    let bound = bound(ratios, margin)?;
    let logs: Vec<f64> = ratios.iter().map(|r| log(*r)).collect();
    let n = logs.len() as f64;
    let centre = mean(&logs);
    let error = (sum_of_squares(&logs) / (n - 1.0) / n).sqrt();
    let t = student_quantile(n - 1.0, 0.9)
        .ok_or(PairedError::TooFew(logs.len()))?;
    if error.is_nan() || error <= 0.0 {
        return Err(PairedError::Degenerate);
    }
    let half = t * error;
    let p_lower = student_cdf(-(centre + bound) / error, n - 1.0);
    let p_upper = student_cdf((centre - bound) / error, n - 1.0);
    let interval = Interval::rising(centre - half, centre + half);
    Ok(Equivalence {
        margin,
        geometric_mean: Estimate::inside(centre, interval).map(exp),
        p_lower,
        p_upper,
        p_value: p_lower.max(p_upper),
    })
}

/// Equivalence of the median ratio to 1 by two one-sided sign tests.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct SignEquivalence {
    /// Margin m: the bounds are 1/(1 + m) and 1 + m.
    pub margin: f64,
    /// One-sided p-value against a median at or below the lower bound.
    pub p_lower: f64,
    /// One-sided p-value against a median at or above the upper bound.
    pub p_upper: f64,
    /// The larger of the two: equivalent at level p.
    pub p_value: f64,
}

/// Two one-sided exact sign tests that the median ratio lies between
/// 1/(1 + margin) and 1 + margin: free of any distribution. Ratios equal to
/// a bound count against equivalence.
///
/// # Errors
/// [`PairedError`] for fewer than 2 ratios or a margin that is not positive.
pub fn sign_equivalence(
    ratios: &[f64],
    margin: f64,
) -> Result<SignEquivalence, PairedError> {
    bound(ratios, margin)?;
    let n = ratios.len();
    let (low, high) = (1.0 / (1.0 + margin), 1.0 + margin);
    let not_above = ratios.iter().filter(|&&r| r <= low).count();
    let not_below = ratios.iter().filter(|&&r| r >= high).count();
    let p_lower = binomial_cdf(n, not_above);
    let p_upper = binomial_cdf(n, not_below);
    let p_value = p_lower.max(p_upper);
    Ok(SignEquivalence { margin, p_lower, p_upper, p_value })
}

/// Most ratios of Hodges and Lehmann's estimate, which holds all their
/// pairwise means in memory.
pub(super) const MOST: usize = 3000;

/// The median of pairwise means of ln ratio, with its interval.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct HodgesLehmann {
    /// exp of the median of the Walsh averages of ln ratio.
    #[serde(flatten, serialize_with = "crate::estimate::keys::ratio")]
    pub ratio: Estimate,
    /// Level of the interval: 0.95, or 1 - 2^(1 - n) for n = 2 to 5 ratios,
    /// whose Walsh averages reach no further.
    pub level: f64,
}

/// Hodges and Lehmann's estimate of the centre of ln ratio, as a ratio: the
/// median of the n(n + 1)/2 Walsh averages, with the interval of Wilcoxon's
/// signed rank statistic, exact for a symmetric distribution and up to 300
/// ratios, by the normal approximation beyond.
///
/// # Errors
/// [`PairedError::TooFew`] for fewer than 2 ratios, [`PairedError::TooMany`]
/// for more than 3000.
pub fn hodges_lehmann(ratios: &[f64]) -> Result<HodgesLehmann, PairedError> {
    let n = ratios.len();
    if n < 2 {
        return Err(PairedError::TooFew(n));
    }
    if n > MOST {
        return Err(PairedError::TooMany(n));
    }
    let logs: Vec<f64> = ratios.iter().map(|r| log(*r)).collect();
    let mut walsh = Vec::with_capacity(n * (n + 1) / 2);
    for (i, a) in logs.iter().enumerate() {
        stop::point();
        walsh.extend(logs[i..].iter().map(|b| 0.5 * (a + b)));
    }
    let too_few = |_| PairedError::TooFew(n);
    let sample = ExtendedSample::try_new(&walsh).map_err(too_few)?;
    let median = sample.quantile(0.5);
    let rank = signed_rank_quantile(n).max(1);
    let sorted = sample.sorted();
    let last = sorted.len() - rank;
    let interval = Interval::rising(sorted[rank - 1], sorted[last]);
    Ok(HodgesLehmann {
        ratio: Estimate::inside(median, interval).map(exp),
        level: if n < 6 { 1.0 - 1.0 / f64::from(1 << (n - 1)) } else { 0.95 },
    })
}

/// The 2.5 % quantile of Wilcoxon's signed rank statistic: the least q with
/// P(V <= q) >= 0.025.
fn signed_rank_quantile(n: usize) -> usize {
    let total = n * (n + 1) / 2;
    if n > 300 {
        let size = n as f64;
        let deviation =
            (size * (size + 1.0) * (2.0 * size + 1.0) / 24.0).sqrt();
        let half = normal::quantile(0.975) * deviation;
        return (0.5 * total as f64 - half).floor() as usize;
    }
    // V is a sum of the ranks 1 to n, each in or out with probability 1/2.
    let mut probability = vec![0.0; total + 1];
    probability[0] = 1.0;
    for rank in 1..=n {
        for v in (0..=rank * (rank + 1) / 2).rev() {
            let with = if v >= rank { probability[v - rank] } else { 0.0 };
            probability[v] = 0.5 * (probability[v] + with);
        }
    }
    let mut below = 0.0;
    probability
        .iter()
        .position(|p| {
            below += p;
            below >= 0.025
        })
        .unwrap_or(0)
}

/// ln(1 + margin), for at least 2 ratios.
fn bound(ratios: &[f64], margin: f64) -> Result<f64, PairedError> {
    if ratios.len() < 2 {
        return Err(PairedError::TooFew(ratios.len()));
    }
    if !(margin > 0.0 && margin.is_finite()) {
        return Err(PairedError::Margin(margin));
    }
    Ok(log1p(margin))
}
