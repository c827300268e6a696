//! A straight line through pairs: by least squares, with a random intercept
//! for each cluster of pairs, or of values censored at a limit.

mod mixed;
mod tobit;

use thiserror::Error;

pub use mixed::mixed;
pub use tobit::{CensoredLine, tobit};

use super::beta::student_cdf;
use super::lognormal::FitError;
use super::sample::mean;

/// Why pairs determine no line.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RegressionError {
    /// Fewer than three pairs.
    #[error("{0} pairs: expected at least 3")]
    TooFew(usize),
    /// Fewer than three clusters, too few for a variance between them.
    #[error("{0} earthquakes: expected at least 3")]
    TooFewClusters(usize),
    /// Different numbers of x and y.
    #[error("{x} values of x and {y} of y: expected equal numbers")]
    Lengths {
        /// Number of values of x.
        x: usize,
        /// Number of values of y.
        y: usize,
    },
    /// A value that is not a finite number.
    #[error("pair {number}: expected finite numbers")]
    NotFinite {
        /// Place of the pair, from 1.
        number: usize,
    },
    /// x takes one value only.
    #[error("the values of x are all the same: expected distinct values")]
    Constant,
    /// The pairs have no scatter.
    #[error(
        "the pairs that are not censored lie on one line: expected scatter \
         about it"
    )]
    NoScatter,
    /// The maximum of a likelihood was not found.
    #[error(transparent)]
    Likelihood(#[from] FitError),
}

/// A line y = intercept + slope x.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Line {
    /// Value at x = 0, in units of y.
    pub intercept: f64,
    /// Slope.
    pub slope: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Residual standard deviation s, within clusters if there are some.
    pub residual_deviation: f64,
    /// Standard deviation tau between clusters; none of a line by least
    /// squares.
    pub event_deviation: Option<f64>,
    /// Degrees of freedom of the slope's standard error.
    pub degrees_of_freedom: f64,
    /// P-value (two-sided) of a slope 0: Student's t at slope/standard error.
    pub p_value: f64,
    /// Number of pairs.
    pub n: usize,
}

/// The least-squares line through pairs (Draper and Smith, Applied
/// Regression Analysis, 1998, chapter 1; R: `lm(y ~ x)`): slope b = sum (x -
/// mean x)(y - mean y)/sum (x - mean x)^2, its standard error
/// s/sqrt(sum (x - mean x)^2), n - 2 degrees of freedom.
///
/// ```
/// use rocking_statistics::regression::line;
/// let found = line(&[1.0, 2.0, 3.0, 4.0], &[1.0, 3.0, 2.0, 4.0])?;
/// assert!((found.slope - 0.8).abs() < 1e-15);
/// assert!((found.p_value - 0.2).abs() < 1e-12);
/// # Ok::<(), rocking_statistics::regression::RegressionError>(())
/// ```
///
/// # Errors
/// [`RegressionError`] for fewer than three pairs, a value that is not
/// finite, or x that does not vary.
pub fn line(x: &[f64], y: &[f64]) -> Result<Line, RegressionError> {
    checked(x, y)?;
    let n = x.len();
    let (centre_x, centre_y) = (mean(x), mean(y));
    let sums = |f: &dyn Fn(f64, f64) -> f64| {
        let terms = x.iter().zip(y).map(|(x, y)| (x - centre_x, y - centre_y));
        let terms: Vec<f64> = terms.map(|(x, y)| f(x, y)).collect();
        mean(&terms) * n as f64
    };
    let squares = sums(&|x, _| x * x);
    if !(squares > 0.0) {
        return Err(RegressionError::Constant);
    }
    let slope = sums(&|x, y| x * y) / squares;
    let residual = sums(&|x, y| (y - slope * x) * (y - slope * x));
    let freedom = n as f64 - 2.0;
    let residual_deviation = (residual / freedom).sqrt();
    let standard_error = residual_deviation / squares.sqrt();
    let ratio = (slope / standard_error).abs();
    // A line without residuals has no error: its slope is 0, or is not.
    let p_value = match (standard_error > 0.0, slope == 0.0) {
        (true, _) => 2.0 * student_cdf(-ratio, freedom),
        (false, true) => 1.0,
        (false, false) => 0.0,
    };
    Ok(Line {
        intercept: centre_y - slope * centre_x,
        slope,
        standard_error,
        residual_deviation,
        event_deviation: None,
        degrees_of_freedom: freedom,
        p_value,
        n,
    })
}

/// Rejects pairs that determine no line.
fn checked(x: &[f64], y: &[f64]) -> Result<(), RegressionError> {
    let n = x.len();
    if y.len() != n {
        return Err(RegressionError::Lengths { x: n, y: y.len() });
    }
    if n < 3 {
        return Err(RegressionError::TooFew(n));
    }
    let mut pairs = x.iter().zip(y);
    if let Some(place) =
        pairs.position(|(x, y)| !(x.is_finite() && y.is_finite()))
    {
        return Err(RegressionError::NotFinite { number: place + 1 });
    }
    if x.iter().all(|value| *value == x[0]) {
        return Err(RegressionError::Constant);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Clusters;

    const ORACLE: &str = rocking_fixtures::text("oracles/regression.csv");

    #[test]
    fn lines_agree_with_scipy_and_mpmath() {
        let mut count = 0;
        for row in ORACLE.lines().skip(1) {
            let cells: Vec<&str> = row.split(',').collect();
            let list = |i: usize| -> Vec<f64> {
                cells[i].split(' ').map(|x| x.parse().unwrap()).collect()
            };
            let (x, y) = (list(0), list(1));
            let found = line(&x, &y).unwrap();
            let ours = [
                found.intercept,
                found.slope,
                found.standard_error,
                found.residual_deviation,
                found.p_value,
            ];
            for (ours, text) in ours.iter().zip(&cells[2..]) {
                let theirs: f64 = text.parse().unwrap();
                // The t distribution is good to some 1e-12; the
                // divisor n - 1 in place of n - 2 is 0.02 off.
                let error = (ours / theirs - 1.0).abs();
                assert!(error < 1e-10, "{row}: {ours}, {error:e}");
            }
            count += 1;
        }
        assert_eq!(count, 3);
    }

    /// In clusters of one size with the same values of x, the variances are
    /// those of the analysis of variance: here the means 0, 3 and 6 have the
    /// mean square 18, the rest has 1/2 = 1/(6 - 3 - 1), and tau^2 =
    /// (18 - 1/2)/2.
    #[test]
    fn a_balanced_line_has_the_deviations_of_its_mean_squares() {
        let x = [-1.0, 1.0, -1.0, 1.0, -1.0, 1.0];
        let y = [-0.5, 0.5, 2.0, 4.0, 4.5, 7.5];
        let clusters = Clusters::from_labels(["a", "a", "b", "b", "c", "c"]);
        let found = mixed(&x, &y, &clusters).unwrap();
        assert!((found.slope - 1.0).abs() < 1e-12);
        let residual = found.residual_deviation;
        assert!((residual - 0.5f64.sqrt()).abs() < 1e-6, "{residual}");
        let between = found.event_deviation.unwrap();
        assert!((between - 8.75f64.sqrt()).abs() < 1e-5, "{between}");
    }

    #[test]
    fn pairs_that_make_no_line_are_refused() {
        let refused = |x: &[f64], y: &[f64]| line(x, y).unwrap_err();
        let (one, two) = ([1.0; 3], [1.0, 2.0, 3.0]);
        assert_eq!(refused(&one, &two), RegressionError::Constant);
        assert_eq!(refused(&two[..2], &two[..2]), RegressionError::TooFew(2));
        let nan = [1.0, f64::NAN, 3.0];
        let second = RegressionError::NotFinite { number: 2 };
        assert_eq!(refused(&nan, &two), second);
        assert_eq!(refused(&two, &nan), second);
        let lengths = RegressionError::Lengths { x: 2, y: 3 };
        assert_eq!(refused(&two[..2], &two), lengths);
        let clusters = Clusters::from_labels(["a", "b", "b"]);
        let few = RegressionError::TooFewClusters(2);
        assert_eq!(mixed(&two, &two, &clusters), Err(few));
    }
}
