//! Maximum likelihood of a normal sample censored on the right.

use libm::log;

use super::FitError;
use crate::statistics::normal::{LN_SQRT_TWO_PI, ln_cdf};
use crate::statistics::sample::{mean, sum_of_squares};

const STEPS: usize = 100;

/// Mean and standard deviation that maximise the likelihood of ascending
/// values y, of which `censored` more are only known to exceed the last.
///
/// In a = 1/sigma and b = mu/sigma the log-likelihood
/// k ln a - sum (a y_i - b)^2/2 + m ln Phi(b - a c) is concave, so that
/// Newton's method with a halved step finds its one maximum.
pub(super) fn maximise(
    y: &[f64],
    censored: usize,
) -> Result<(f64, f64), FitError> {
    let (k, m) = (y.len() as f64, censored as f64);
    let (centre, squares) = (mean(y), sum_of_squares(y));
    let spread = (squares / k).sqrt();
    if censored == 0 {
        return Ok((centre, spread));
    }
    // Standardised: mean 0 and mean square 1 of what was observed.
    let limit = (y[y.len() - 1] - centre) / spread;
    let value = |a: f64, b: f64| {
        k * (log(a) - 0.5 * (a * a + b * b)) + m * ln_cdf(b - a * limit)
    };
    let (mut a, mut b) = (1.0, 0.0);
    let mut best = value(a, b);
    for _ in 0..STEPS {
        let z = b - a * limit;
        // Mills' ratio phi/Phi and its derivative.
        let mills = libm::exp(-0.5 * z * z - LN_SQRT_TWO_PI - ln_cdf(z));
        let slope = -mills * (z + mills);
        let gradient =
            [k * (1.0 / a - a) - m * limit * mills, m * mills - k * b];
        let aa = -k * (1.0 / (a * a) + 1.0) + m * limit * limit * slope;
        let ab = -m * limit * slope;
        let bb = -k + m * slope;
        let determinant = aa * bb - ab * ab;
        let step_a = (bb * gradient[0] - ab * gradient[1]) / determinant;
        let step_b = (aa * gradient[1] - ab * gradient[0]) / determinant;
        if step_a.abs().max(step_b.abs()) < 1e-13 {
            return Ok((centre + spread * b / a, spread / a));
        }
        let mut share = 1.0;
        loop {
            let (next_a, next_b) = (a - share * step_a, b - share * step_b);
            let next = value(next_a, next_b);
            // At the maximum the value no longer tells steps apart.
            if next_a > 0.0 && next >= best - 1e-13 * best.abs() {
                (a, b, best) = (next_a, next_b, next);
                break;
            }
            share *= 0.5;
            if share < 1e-12 {
                return Err(FitError::NotConverged(STEPS));
            }
        }
    }
    Err(FitError::NotConverged(STEPS))
}
