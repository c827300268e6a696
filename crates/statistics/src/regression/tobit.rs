//! A line of values censored at a limit.

use libm::log;
use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector2, Vector3};

use super::{RegressionError, line};
use crate::lognormal::censored::Observation::{Exact, Interval};
use crate::lognormal::censored::{Point, climb};
use crate::sample::mean;

/// A line y = intercept + slope x + deviation eps, eps standard normal.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CensoredLine {
    /// Value at x = 0, in units of y.
    pub intercept: f64,
    /// Slope.
    pub slope: f64,
    /// Standard deviation of y about the line.
    pub deviation: f64,
    /// Log-likelihood.
    pub log_likelihood: f64,
}

/// The line of the highest likelihood through pairs (x, y) whose y is
/// right-censored at `limit`: a y at the limit or beyond, infinite included,
/// says only that y is not below the limit (Tobin, Econometrica 26 (1958) 24; R:
/// `survival::survreg(Surv(y, y < limit) ~ x, dist = "gaussian")`).
///
/// In (1/deviation, intercept/deviation, slope/deviation) the log-likelihood
/// is concave (Olsen, Econometrica 46 (1978) 1211), so that it has one
/// maximum. The deviation has the divisor n of maximum likelihood.
///
/// ```
/// use rocking_statistics::regression::tobit;
/// let points = [(0.0, 0.0), (1.0, 1.5), (2.0, 1.5), (3.0, f64::INFINITY)];
/// let found = tobit(&points, 2.5)?;
/// // Steeper than the line through the first three.
/// assert!(found.slope > 0.75 && found.slope < 1.0);
/// # Ok::<(), rocking_statistics::regression::RegressionError>(())
/// ```
///
/// # Errors
/// [`RegressionError`] for a number that is not finite, fewer than three pairs
/// that are not censored, and those with one x or on one line.
pub fn tobit(
    points: &[(f64, f64)],
    limit: f64,
) -> Result<CensoredLine, RegressionError> {
    let is_number = |(x, y): &(f64, f64)| x.is_finite() && !y.is_nan();
    if let Some(place) = points.iter().position(|pair| !is_number(pair)) {
        return Err(RegressionError::NotFinite { number: place + 1 });
    }
    let exact = points.iter().filter(|(_, y)| *y < limit);
    let (x, y): (Vec<f64>, Vec<f64>) = exact.copied().unzip();
    let least = line(&x, &y)?;
    if !(least.standard_error > 1e-6 * least.slope.abs()) {
        return Err(RegressionError::NoScatter);
    }
    let (centre, spread) = (mean(&x), least.residual_deviation);
    // Deviations from the line of least squares, in its standard deviation.
    let known = |(x, y): &(f64, f64)| {
        let from_line = |y| (y - least.intercept - least.slope * x) / spread;
        let own = match *y < limit {
            true => Exact(from_line(*y)),
            false => Interval(from_line(limit), f64::INFINITY, 1.0),
        };
        (x - centre, own)
    };
    let known: Vec<_> = points.iter().map(known).collect();
    // At (1, intercept, slope)/deviation: value, gradient, second derivatives.
    let at = |place: &[f64]| {
        let start = (0.0, Vector3::zeros(), Matrix3::zeros());
        known.iter().fold(start, |(value, gradient, bend), (x, own)| {
            let along = Matrix3x2::new(1.0, 0.0, 0.0, 1.0, 0.0, *x);
            let own = Point::new(&[*own], place[0], place[1] + place[2] * x);
            let [aa, ab, bb] = own.curvature;
            let own_bend = Matrix2::new(aa, ab, ab, bb);
            (
                value + own.value,
                gradient + along * Vector2::from(own.gradient),
                bend + along * own_bend * along.transpose(),
            )
        })
    };
    let steps = |(_, gradient, bend): &(f64, Vector3<f64>, Matrix3<f64>)| {
        let solved = (-bend).cholesky().map(|own| -own.solve(gradient));
        solved.map_or(vec![f64::NAN], |step| step.as_slice().to_vec())
    };
    let start = vec![1.0, 0.0, 0.0];
    let (place, found) = climb(start, at, |found| found.0, steps)?;
    let deviation = spread / place[0];
    let tilt = deviation * place[2];
    Ok(CensoredLine {
        intercept: least.intercept + deviation * place[1] - tilt * centre,
        slope: least.slope + tilt,
        deviation,
        log_likelihood: found.0 - x.len() as f64 * log(spread),
    })
}
