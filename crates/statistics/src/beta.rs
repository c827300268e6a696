//! The incomplete beta function, and what is found by it: quantiles of the beta
//! distribution, Student's t, binomial probabilities. Only `libm` is called, so
//! that all platforms have the same bits.

use std::f64::consts::TAU;

use libm::{exp, lgamma, log, log1p};

use crate::normal;

/// Relative steps at which iterations end, after ten at most as a rule.
const STEP: f64 = 4.0 * f64::EPSILON;

/// The error of Stirling's formula: ln Gamma(z) = (z - 1/2) ln z - z +
/// ln(2 pi)/2 + this.
fn stirling_error(z: f64) -> f64 {
    /// Bernoulli's numbers B_2k/(2k (2k - 1)), the highest first.
    const SERIES: [f64; 6] = [
        -691.0 / 360_360.0,
        1.0 / 1188.0,
        -1.0 / 1680.0,
        1.0 / 1260.0,
        -1.0 / 360.0,
        1.0 / 12.0,
    ];
    if z < 10.0 {
        return lgamma(z) - (z - 0.5) * log(z) + z - 0.5 * log(TAU);
    }
    let per_square = 1.0 / (z * z);
    SERIES.iter().fold(0.0, |sum, next| sum * per_square + next) / z
}

/// x^a y^b/B(a, b) for y = 1 - x, without the difference of large logarithms.
fn powers(a: f64, b: f64, x: f64, y: f64) -> f64 {
    let (sum, apart) = (a + b, x * b - y * a);
    // ln(x/mean), near the mean or far from it.
    let ln_ratio = |x: f64, a: f64, apart: f64| match apart / a {
        near if near.abs() < 0.5 => log1p(near),
        _ => log(x * (sum / a)),
    };
    let correction =
        stirling_error(sum) - stirling_error(a) - stirling_error(b);
    let ln = a * ln_ratio(x, a, apart) + b * ln_ratio(y, b, -apart);
    (a / sum * b / TAU).sqrt() * exp(ln + correction)
}

/// Probabilities below and above x of the beta distribution (a, b), for
/// y = 1 - x; the smaller one has its own relative precision.
fn tails(a: f64, b: f64, x: f64, y: f64) -> (f64, f64) {
    if x * (a + b) > a {
        let above = tail(b, a, y, x);
        return (1.0 - above, above);
    }
    let below = tail(a, b, x, y);
    (below, 1.0 - below)
}

/// The probability below x, up to the mean, by the continued fraction of
/// Didonato and Morris (ACM TOMS 18, 1992, Eq. 9), in Lentz's ratios.
fn tail(a: f64, b: f64, x: f64, y: f64) -> f64 {
    let rest = 1.0 + a * y - b * x;
    let mut fraction = a * rest / (a + 1.0);
    let (mut above, mut below) = (fraction, 0.0);
    for k in 1..1_000_000 {
        let n = f64::from(k);
        let (w, s) = (n * (b - n) * x, a + 2.0 * n - 1.0);
        let part = (a + n - 1.0) / s * ((a + b + n - 1.0) / s) * w * x;
        let whole =
            n + w / s + (a + n) / (a + 1.0 + 2.0 * n) * (rest + n * (1.0 + y));
        above = whole + part / above;
        below = 1.0 / (whole + part * below);
        let change = above * below;
        fraction *= change;
        if !((change - 1.0).abs() > f64::EPSILON) {
            break;
        }
    }
    powers(a, b, x, y) / fraction
}

/// Quantile of the beta distribution (a, b) at p, by Newton's iteration between
/// bounds. NaN for parameters that are not positive, and for p outside (0, 1).
pub(crate) fn quantile(a: f64, b: f64, p: f64) -> f64 {
    if !(a > 0.0 && b > 0.0 && p > 0.0 && p < 1.0) {
        return f64::NAN;
    }
    let (mut low, mut high, mut x) = (0.0, 1.0, a / (a + b));
    for _ in 0..200 {
        let (below, above) = tails(a, b, x, 1.0 - x);
        let excess = if p < 0.5 { below - p } else { 1.0 - p - above };
        *(if excess > 0.0 { &mut high } else { &mut low }) = x;
        let density = powers(a, b, x, 1.0 - x) / (x * (1.0 - x));
        let before = x;
        x -= excess / density;
        if !(x > low && x < high) {
            x = 0.5 * (low + high);
        }
        if !((x - before).abs() > STEP * x) {
            break;
        }
    }
    x
}

/// P(|T| > t) of Student's distribution, t not negative, and how much it falls
/// if t grows by a small share of itself.
fn student_outside(t: f64, freedom: f64) -> (f64, f64) {
    // Infinitely many, of the normal distribution, differ by 1e-9.
    let freedom = if freedom > 1e9 { 1e9 } else { freedom };
    let (a, b, sum) = (0.5 * freedom, 0.5, freedom + t * t);
    let (x, y) = (freedom / sum, t * t / sum);
    (tails(a, b, x, y).0, 2.0 * powers(a, b, x, y))
}

/// P(T <= t) of Student's distribution.
pub(crate) fn student_cdf(t: f64, freedom: f64) -> f64 {
    let outside = 0.5 * student_outside(t.abs(), freedom).0;
    if t > 0.0 { 1.0 - outside } else { outside }
}

/// The t with P(|T| <= t) = `level`; `None` if the degrees of freedom are not
/// positive.
///
/// Newton's iteration from the normal quantile below it: P(|T| > t) is convex,
/// so that the iteration rises to the root.
pub(crate) fn student_quantile(freedom: f64, level: f64) -> Option<f64> {
    let mut t = normal::quantile(0.5 + 0.5 * level);
    for _ in 0..200 {
        let (outside, fall) = student_outside(t, freedom);
        let share = (outside - (1.0 - level)) / fall;
        t += t * share;
        if !(share.abs() > STEP) {
            break;
        }
    }
    Some(t).filter(|t| t.is_finite() && freedom > 0.0)
}

/// P(B <= k) for B binomial (n, 1/2), k below n.
pub(crate) fn binomial_cdf(n: usize, k: usize) -> f64 {
    if k >= n {
        return 1.0;
    }
    // Half of all outcomes; the fraction would give 0.5 to fifteen digits.
    if 2 * k + 1 == n {
        return 0.5;
    }
    tails((n - k) as f64, (k + 1) as f64, 0.5, 0.5).0
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use libm::{atan, expm1, pow, sin};

    use super::*;

    #[track_caller]
    fn near(found: f64, expected: f64) {
        let error = (found / expected - 1.0).abs();
        assert!(error < 2e-13, "{found:e}, not {expected:e}: {error:e}");
    }

    #[test]
    fn quantiles_are_those_of_closed_forms() {
        for p in [1e-6, 0.025, 0.3, 0.5, 0.8, 0.975, 0.999] {
            for a in [0.2, 1.0, 2.5, 44.0, 1e5] {
                near(quantile(a, 1.0, p), pow(p, 1.0 / a));
                near(quantile(1.0, a, p), -expm1(log1p(-p) / a));
            }
            let x = sin(0.5 * PI * p);
            near(quantile(0.5, 0.5, p), x * x);
            let x = quantile(2.0, 2.0, p);
            near(x * x * (3.0 - 2.0 * x), p);
            let other = 1.0 - quantile(81.2, 3.7, 1.0 - p);
            assert!((quantile(3.7, 81.2, p) - other).abs() < 1e-13);
        }
        assert!(quantile(f64::NAN, 1.0, 0.5).is_nan());
        assert!(quantile(1.0, 1.0, f64::NAN).is_nan());
    }

    #[test]
    fn students_distribution_is_that_of_closed_forms() {
        for t in [1e-3, 0.4, 1.0, 1.96, 7.0, 300.0] {
            let root = f64::sqrt(2.0 + t * t);
            near(student_cdf(-t, 1.0), atan(1.0 / t) / PI);
            near(student_cdf(-t, 2.0), 1.0 / (root * (root + t)));
            near(student_cdf(t, 2.0), 0.5 + 0.5 * t / root);
        }
        for level in [0.01, 0.5, 0.9, 0.95, 0.999] {
            let two = level * f64::sqrt(2.0 / (1.0 - level * level));
            near(student_quantile(2.0, level).unwrap(), two);
            let z = normal::quantile(0.5 + 0.5 * level);
            let many = student_quantile(f64::INFINITY, level).unwrap();
            assert!((many / z - 1.0).abs() < 1e-8, "{level} {many} {z}");
            // Cornish and Fisher's expansion.
            let more = z * (z * z + 1.0) / 4e7;
            near(student_quantile(1e7, level).unwrap(), z + more);
            let t = student_quantile(11.3, level).unwrap();
            near(2.0 * student_cdf(-t, 11.3), 1.0 - level);
        }
        assert!(student_cdf(f64::NAN, 2.0).is_nan());
        assert_eq!(student_quantile(f64::NAN, 0.9), None);
        assert_eq!(student_quantile(0.0, 0.9), None);
    }

    #[test]
    fn binomial_probabilities_are_sums() {
        for n in 1..60 {
            let (mut sum, mut term) = (0.0, pow(0.5, n as f64));
            for k in 0..=n {
                sum += term;
                term *= (n - k) as f64 / (k + 1) as f64;
                near(binomial_cdf(n, k), sum);
            }
        }
    }
}
