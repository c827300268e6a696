//! A line through pairs that come in clusters: random intercepts.

use libm::{exp, log, log1p};
use nalgebra::{Matrix2, Vector2};

use super::{Line, RegressionError, checked};
use crate::beta::student_cdf;
use crate::clusters::Clusters;
use crate::sample::mean;
use crate::search::golden;

/// One cluster: its size, its sums of products within, and those of its
/// means times its size, of the columns 1, x and of y.
struct Group {
    size: f64,
    within: Products,
    between: Products,
}

/// X'X, X'y and y'y.
#[derive(Clone, Copy)]
struct Products {
    xx: Matrix2<f64>,
    xy: Vector2<f64>,
    yy: f64,
}

/// Generalised least squares at a ratio of variances.
struct Solution {
    /// X'WX, W the inverse covariance in units of the residual variance.
    information: Matrix2<f64>,
    coefficients: Vector2<f64>,
    residual_variance: f64,
    /// Restricted log-likelihood, but for a constant.
    likelihood: f64,
}

impl Group {
    fn new(members: &[usize], x: &[f64], y: &[f64]) -> Self {
        let pick = |values: &[f64]| -> Vec<f64> {
            members.iter().map(|&i| values[i]).collect()
        };
        let (x, y) = (pick(x), pick(y));
        let (centre_x, centre_y) = (mean(&x), mean(&y));
        let sum = |f: &dyn Fn(f64, f64) -> f64| {
            let pairs = x.iter().zip(&y);
            pairs.fold(0.0, |sum, (x, y)| sum + f(x - centre_x, y - centre_y))
        };
        let size = members.len() as f64;
        let column = Vector2::new(1.0, centre_x);
        Self {
            size,
            within: Products {
                xx: Matrix2::new(0.0, 0.0, 0.0, sum(&|x, _| x * x)),
                xy: Vector2::new(0.0, sum(&|x, y| x * y)),
                yy: sum(&|_, y| y * y),
            },
            between: Products {
                xx: size * column * column.transpose(),
                xy: size * centre_y * column,
                yy: size * centre_y * centre_y,
            },
        }
    }

    /// Ratio of the weight of a mean to the weight of a deviation within.
    fn weight(&self, ratio: f64) -> f64 {
        1.0 / f64::mul_add(self.size, ratio, 1.0)
    }
}

fn solve(groups: &[Group], n: f64, ratio: f64) -> Option<Solution> {
    let mut all =
        Products { xx: Matrix2::zeros(), xy: Vector2::zeros(), yy: 0.0 };
    let mut determinant = 0.0;
    for group in groups {
        let weight = group.weight(ratio);
        all.xx += group.within.xx + weight * group.between.xx;
        all.xy += group.within.xy + weight * group.between.xy;
        all.yy += weight.mul_add(group.between.yy, group.within.yy);
        determinant += log1p(group.size * ratio);
    }
    let coefficients = all.xx.try_inverse()? * all.xy;
    let freedom = n - 2.0;
    let residual_variance = (all.yy - coefficients.dot(&all.xy)) / freedom;
    let likelihood = -0.5
        * (freedom * log(residual_variance)
            + determinant
            + log(all.xx.determinant()));
    let information = all.xx;
    Some(Solution { information, coefficients, residual_variance, likelihood })
}

/// The line through pairs of which those of one cluster share a random
/// intercept: y = intercept + slope x + u_g + e, u_g of variance tau^2 and e
/// of variance s^2, all normal. Without shared clusters it is the
/// least-squares [`line`](super::line).
///
/// The variances maximise the restricted likelihood (REML); the coefficients
/// are those of generalised least squares. The p-value is from Student's t
/// with the degrees of freedom 2 V^2/var(V) of Satterthwaite, V the variance
/// of the slope, from the expected information of the two variances
/// (Abrahamson and Youngs, BSSA 82 (1992) 505; Kenward and Roger, Biometrics
/// 53 (1997) 983; statsmodels: `MixedLM`; R: `lmerTest`).
///
/// ```
/// use rocking_statistics::Clusters;
/// use rocking_statistics::regression::mixed;
/// let clusters = Clusters::from_labels(["a", "a", "b", "b", "c", "d"]);
/// let (x, y) = ([1., 1., 2., 2., 3., 4.], [0.9, 1.2, 2.5, 2.3, 2.6, 4.1]);
/// let found = mixed(&x, &y, &clusters)?;
/// assert!(found.event_deviation.is_some_and(|tau| tau > 0.0));
/// assert!(found.degrees_of_freedom < 4.0);
/// # Ok::<(), rocking_statistics::regression::RegressionError>(())
/// ```
///
/// # Errors
/// [`RegressionError`] as of [`line`](super::line), and for fewer than three
/// clusters.
pub fn mixed(
    x: &[f64],
    y: &[f64],
    clusters: &Clusters,
) -> Result<Line, RegressionError> {
    if clusters.is_singletons() {
        return super::line(x, y);
    }
    checked(x, y)?;
    if clusters.count() < 3 {
        return Err(RegressionError::TooFewClusters(clusters.count()));
    }
    let n = x.len() as f64;
    let (centre_x, centre_y) = (mean(x), mean(y));
    let x: Vec<f64> = x.iter().map(|x| x - centre_x).collect();
    let y: Vec<f64> = y.iter().map(|y| y - centre_y).collect();
    let groups: Vec<Group> = (0..clusters.count())
        .map(|g| Group::new(clusters.members(g), &x, &y))
        .collect();
    let at = |ratio| solve(&groups, n, ratio);
    let likelihood =
        |ratio| at(ratio).map_or(f64::NEG_INFINITY, |found| found.likelihood);
    let value = |place: f64| likelihood(exp(place));
    // ln(tau^2/s^2) from 1e-4 to 1e4, in steps of which the best is refined.
    let places: Vec<f64> = (-18..=18).map(|k| 0.5 * f64::from(k)).collect();
    let best = places.iter().copied().fold(f64::NAN, |best, place| {
        if value(place) <= value(best) { best } else { place }
    });
    let ratio = exp(golden(value, best - 0.5, best + 0.5));
    let is_zero = likelihood(0.0) >= likelihood(ratio);
    let ratio = if is_zero { 0.0 } else { ratio };
    let found = at(ratio).ok_or(RegressionError::Constant)?;
    let covariance = found.information.try_inverse();
    let unit = covariance.ok_or(RegressionError::Constant)?;
    let variance = found.residual_variance * unit[(1, 1)];
    let standard_error = variance.sqrt();
    let (slope, residual) =
        (found.coefficients[1], found.residual_variance.sqrt());
    let degrees_of_freedom = freedom(&groups, ratio, &unit);
    if !(degrees_of_freedom > 0.0) {
        return Err(RegressionError::Constant);
    }
    let t = (slope / standard_error).abs();
    Ok(Line {
        intercept: centre_y + found.coefficients[0] - slope * centre_x,
        slope,
        standard_error,
        residual_deviation: residual,
        event_deviation: Some(residual * ratio.sqrt()),
        degrees_of_freedom,
        p_value: 2.0 * student_cdf(-t, degrees_of_freedom),
        n: x.len(),
    })
}

/// Satterthwaite's degrees of freedom of the slope, from the expected
/// information of s^2 and tau^2, in units of s^2.
///
/// With S the inverse covariance, V_1 = I and V_2 the clusters' matrix of
/// ones, P = S - S X F X'S, F the covariance of the coefficients: the
/// information is tr(P V_i P V_j)/2, and dF/dV_i = F X'S V_i S X F. All
/// matrices have the eigenspaces of the clusters' means and deviations.
fn freedom(groups: &[Group], ratio: f64, covariance: &Matrix2<f64>) -> f64 {
    // Eigenvalues (within, between) of V_1 and V_2 in a cluster.
    let own = |size: f64| [(1.0, 1.0), (0.0, size)];
    let mut first = [Matrix2::zeros(); 2];
    let mut second = [[Matrix2::zeros(); 2]; 2];
    let mut traces = [[0.0; 2]; 2];
    for group in groups {
        let weight = group.weight(ratio);
        let values = own(group.size);
        for (i, (within, between)) in values.into_iter().enumerate() {
            first[i] += within * group.within.xx
                + weight * weight * between * group.between.xx;
            for (j, other) in values.into_iter().enumerate() {
                let (w, b) = (within * other.0, between * other.1);
                let squared = weight * weight * b;
                traces[i][j] += (group.size - 1.0).mul_add(w, squared);
                second[i][j] +=
                    w * group.within.xx + squared * weight * group.between.xx;
            }
        }
    }
    let information = Matrix2::from_fn(|i, j| {
        let once = (covariance * second[i][j]).trace();
        let twice = covariance * first[i] * covariance * first[j];
        0.5 * (traces[i][j] - 2.0 * once + twice.trace())
    });
    let slope =
        Vector2::from_fn(|i, _| (covariance * first[i] * covariance)[(1, 1)]);
    let known = information.try_inverse().unwrap_or_else(Matrix2::zeros);
    let variance = covariance[(1, 1)];
    2.0 * variance * variance / slope.dot(&(known * slope))
}
