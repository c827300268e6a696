//! Shapiro and Wilk's W by Royston's algorithm.

use libm::{exp, log};

use super::NormalityTest;
use crate::lilliefors::{LillieforsError, standardised};
use crate::{Estimate, Sample, normal};

/// Largest size that the approximation was fitted for.
pub(super) const LARGEST: usize = 5000;

/// Shapiro and Wilk's W with its p-value: Royston, "Remark AS R94", Applied
/// Statistics 44 (1995) 547.
///
/// ```
/// use rocking_statistics::{Sample, normality::shapiro_wilk};
/// let sample = Sample::try_new(&[1.0, 2.0, 4.0, 8.0, 16.0, 32.0])?;
/// assert!(shapiro_wilk(&sample)?.statistic < 0.9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`LillieforsError`] for fewer than 4 or more than 5000 values, or values
/// that don't vary.
pub fn shapiro_wilk(
    sample: &Sample,
) -> Result<NormalityTest, LillieforsError> {
    let scores = standardised(sample, 4)?;
    let (found, expected) = (scores.len(), LARGEST);
    if found > expected {
        return Err(LillieforsError::TooMany { found, expected });
    }
    let deficit = deficit(&weights(scores.len()), &scores);
    let statistic = 1.0 - deficit;
    let p_value = Estimate::exact(p_value(scores.len(), deficit));
    Ok(NormalityTest { statistic, p_value })
}

/// 1 - W of ascending scores.
pub(super) fn deficit(weights: &[f64], scores: &[f64]) -> f64 {
    let n = scores.len() as f64;
    let contrast = weights
        .iter()
        .zip(scores.iter().zip(scores.iter().rev()))
        .fold(0.0, |sum, (a, (low, high))| f64::mul_add(*a, high - low, sum));
    // The scores' sum of squares is n - 1. The weights' is 1, to rounding.
    let norm = 2.0 * weights.iter().fold(0.0, |s, a| f64::mul_add(*a, *a, s));
    let root = (norm * (n - 1.0)).sqrt();
    (root - contrast) * (root + contrast) / (root * root)
}

/// The positive half of the coefficients a_i, from the outermost.
pub(super) fn weights(n: usize) -> Vec<f64> {
    let count = n as f64;
    let m: Vec<f64> = (1..=n / 2)
        .map(|i| -normal::quantile((i as f64 - 0.375) / (count + 0.25)))
        .collect();
    let square = 2.0 * m.iter().fold(0.0, |s, x| f64::mul_add(*x, *x, s));
    let norm = square.sqrt();
    let u = 1.0 / count.sqrt();
    let outer = polynomial(
        &[0.0, 0.221157, -0.147981, -2.07119, 4.434685, -2.706056],
        u,
    ) + m[0] / norm;
    let mut weights = vec![outer];
    let (mut rest, mut share) =
        (square - 2.0 * m[0] * m[0], 1.0 - 2.0 * outer * outer);
    if n > 5 {
        let next = polynomial(
            &[0.0, 0.042981, -0.293762, -1.752461, 5.682633, -3.582633],
            u,
        ) + m[1] / norm;
        weights.push(next);
        rest -= 2.0 * m[1] * m[1];
        share -= 2.0 * next * next;
    }
    let factor = (rest / share).sqrt();
    weights.extend(m.iter().skip(weights.len()).map(|x| x / factor));
    weights
}

/// p-value of 1 - W.
fn p_value(n: usize, deficit: f64) -> f64 {
    let count = n as f64;
    let y = log(deficit);
    let (y, mean, deviation) = if n <= 11 {
        let gamma = polynomial(&[-2.273, 0.459], count);
        if y >= gamma {
            return 0.0;
        }
        (
            -log(gamma - y),
            polynomial(&[0.544, -0.39978, 0.025054, -6.714e-4], count),
            exp(polynomial(&[1.3822, -0.77857, 0.062767, -0.0020322], count)),
        )
    } else {
        let x = log(count);
        (
            y,
            polynomial(&[-1.5861, -0.31082, -0.083751, 0.0038915], x),
            exp(polynomial(&[-0.4803, -0.082676, 0.0030302], x)),
        )
    };
    normal::survival((y - mean) / deviation)
}

/// A polynomial by its coefficients, the constant first.
pub(super) fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |s, c| f64::mul_add(s, x, *c))
}
