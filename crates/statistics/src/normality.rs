//! Tests of normality beside Lilliefors', which is the weakest of them.
//!
//! Anderson-Darling and Cramer-von Mises for estimated mean and standard
//! deviation (Stephens' case 3), and Shapiro-Wilk.

mod battery;
mod shapiro_wilk;

use libm::exp;

pub use battery::Battery;
use shapiro_wilk::polynomial;
pub use shapiro_wilk::shapiro_wilk;

use super::lilliefors::{LillieforsError, standardised};
use super::{Estimate, Interval, Sample, normal};

/// A statistic and its p-value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct NormalityTest {
    /// The statistic, not modified for the sample's size.
    pub statistic: f64,
    /// Its p-value. By a published approximation: without an interval, or
    /// with one from 0 if the approximation ends at it. By simulation:
    /// (b + 1)/(N + 1), with the 95 % Clopper-Pearson interval.
    pub p_value: Estimate,
}

/// A p-value at which the approximation ends: the true one is lower.
fn upper_bound(p: f64) -> Estimate {
    Estimate::inside(p, Interval::rising(0.0, p))
}

/// Anderson-Darling's A^2 = -n - (1/n) sum (2i - 1)
/// [ln F_i + ln(1 - F_(n+1-i))].
///
/// p by D'Agostino and Stephens, "Goodness-of-fit techniques" (1986), table
/// 4.9, in A^2 (1 + 0.75/n + 2.25/n^2); not below 3.7e-24, where the
/// approximation ends.
///
/// ```
/// use rocking_statistics::{Sample, normality::anderson_darling};
/// let sample = Sample::try_new(&[1.0, 2.0, 4.0, 8.0, 16.0, 32.0])?;
/// let test = anderson_darling(&sample)?;
/// assert!(test.p_value.value() > 0.05 && test.p_value.value() < 0.2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`LillieforsError`] for fewer than 4 values or values that don't vary.
pub fn anderson_darling(
    sample: &Sample,
) -> Result<NormalityTest, LillieforsError> {
    let scores = standardised(sample, 4)?;
    let n = scores.len() as f64;
    let statistic = a2(&scores);
    let a = statistic * (1.0 + 0.75 / n + 2.25 / (n * n));
    let p_value = if a < 0.2 {
        Estimate::exact(1.0 - exp(polynomial(&[-13.436, 101.14, -223.73], a)))
    } else if a < 0.34 {
        Estimate::exact(1.0 - exp(polynomial(&[-8.318, 42.796, -59.938], a)))
    } else if a < 0.6 {
        Estimate::exact(exp(polynomial(&[0.9177, -4.279, -1.38], a)))
    } else if a < 10.0 {
        Estimate::exact(exp(polynomial(&[1.2937, -5.709, 0.0186], a)))
    } else {
        upper_bound(3.7e-24)
    };
    Ok(NormalityTest { statistic, p_value })
}

/// Cramer-von Mises' W^2 = 1/(12 n) + sum [F_i - (2i - 1)/(2n)]^2.
///
/// p by the same table in W^2 (1 + 0.5/n); not below 7.37e-10.
///
/// # Errors
/// [`LillieforsError`] for fewer than 4 values or values that don't vary.
pub fn cramer_von_mises(
    sample: &Sample,
) -> Result<NormalityTest, LillieforsError> {
    let scores = standardised(sample, 4)?;
    let n = scores.len() as f64;
    let statistic = w2(&scores);
    let w = statistic * (1.0 + 0.5 / n);
    let p_value = if w < 0.0275 {
        Estimate::exact(1.0 - exp(polynomial(&[-13.953, 775.5, -12542.61], w)))
    } else if w < 0.051 {
        Estimate::exact(1.0 - exp(polynomial(&[-5.903, 179.546, -1515.29], w)))
    } else if w < 0.092 {
        Estimate::exact(exp(polynomial(&[0.886, -31.62, 10.897], w)))
    } else if w < 1.1 {
        Estimate::exact(exp(polynomial(&[1.111, -34.242, 12.832], w)))
    } else {
        upper_bound(7.37e-10)
    };
    Ok(NormalityTest { statistic, p_value })
}

/// A^2 of ascending scores.
fn a2(scores: &[f64]) -> f64 {
    let n = scores.len() as f64;
    let sum = scores.iter().zip(scores.iter().rev()).enumerate().fold(
        0.0,
        |sum, (i, (low, high))| {
            let weight = (2 * i + 1) as f64;
            let logs = normal::ln_cdf(*low) + normal::ln_cdf(-high);
            f64::mul_add(weight, logs, sum)
        },
    );
    -n - sum / n
}

/// W^2 of ascending scores.
fn w2(scores: &[f64]) -> f64 {
    let n = scores.len() as f64;
    scores.iter().enumerate().fold(1.0 / (12.0 * n), |sum, (i, z)| {
        let gap = normal::cdf(*z) - (2 * i + 1) as f64 / (2.0 * n);
        f64::mul_add(gap, gap, sum)
    })
}

#[cfg(test)]
mod tests;
