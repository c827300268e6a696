//! Distribution functions and their inverses, with the same bits everywhere
//! (`libm` only). Accuracy of 1e-10 is ample: model parameters are random.

/// Regularized lower incomplete gamma function P(k, x).
fn gamma_p(k: f64, x: f64) -> f64 {
    if !(x > 0.0) {
        return 0.0;
    }
    let front = libm::exp(k * libm::log(x) - x - libm::lgamma(k));
    if x < k + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / k, 1.0 / k, k);
        while term > 1e-16 * sum {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        front * sum
    } else {
        // Modified Lentz evaluation of the continued fraction of Q.
        let mut b = x + 1.0 - k;
        let mut c = 1e300;
        let mut d = 1.0 / b;
        let mut h = d;
        for i in 1..500 {
            let an = -f64::from(i) * (f64::from(i) - k);
            b += 2.0;
            d = 1.0 / (an * d + b);
            c = b + an / c;
            h *= d * c;
            if (d * c - 1.0).abs() < 1e-15 {
                break;
            }
        }
        1.0 - front * h
    }
}

/// Quantile of the gamma distribution of shape `k` and scale 1.
pub(super) fn gamma_quantile(probability: f64, k: f64) -> f64 {
    let mut high = k + 1.0;
    while gamma_p(k, high) < probability {
        high *= 2.0;
    }
    invert(probability, high, |x| gamma_p(k, x))
}

/// Regularized incomplete beta function.
fn beta_cdf(a: f64, b: f64, x: f64) -> f64 {
    let ln_front = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b)
        + a * libm::log(x)
        + b * libm::log1p(-x);
    let front = libm::exp(ln_front);
    if x < (a + 1.0) / (a + b + 2.0) {
        front * beta_fraction(a, b, x) / a
    } else {
        1.0 - front * beta_fraction(b, a, 1.0 - x) / b
    }
}

/// Continued fraction of the incomplete beta function, modified Lentz.
fn beta_fraction(a: f64, b: f64, x: f64) -> f64 {
    let guard = |d: f64| if d.abs() < 1e-300 { 1e-300 } else { d };
    let mut c = 1.0;
    let mut d = 1.0 / guard(1.0 - (a + b) * x / (a + 1.0));
    let mut h = d;
    for m in 1..300 {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = 1.0 / guard(1.0 + even * d);
        c = guard(1.0 + even / c);
        h *= d * c;
        let odd =
            -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = 1.0 / guard(1.0 + odd * d);
        c = guard(1.0 + odd / c);
        h *= d * c;
        if (d * c - 1.0).abs() < 1e-15 {
            break;
        }
    }
    h
}

/// Quantile of the beta distribution on (0, 1).
pub(super) fn beta_quantile(probability: f64, a: f64, b: f64) -> f64 {
    invert(probability, 1.0, |x| beta_cdf(a, b, x))
}

/// Root of the rising function `cdf` = `probability` on (0, `high`), by 48
/// halvings.
fn invert(probability: f64, mut high: f64, cdf: impl Fn(f64) -> f64) -> f64 {
    let mut low = 0.0;
    for _ in 0..48 {
        let mid = 0.5 * (low + high);
        if cdf(mid) - probability < 0.0 { low = mid } else { high = mid }
    }
    0.5 * (low + high)
}

/// Quantile of the two-sided truncated exponential distribution whose
/// density is `c` exp(`b` x) from `lowest` to 0 and `c` exp(-`a` x) above.
pub(super) fn two_sided_exponential_quantile(
    probability: f64,
    (a, b, c): (f64, f64, f64),
    (lowest, highest): (f64, f64),
) -> f64 {
    let at_zero = c / b * (1.0 - libm::exp(b * lowest));
    let x = if probability < at_zero {
        libm::log(probability * b / c + libm::exp(b * lowest)) / b
    } else {
        -libm::log(1.0 - (probability - at_zero) * a / c) / a
    };
    // The published constants close the distribution to four digits only:
    // beyond, x is NaN.
    x.min(highest).max(lowest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_agree_with_published_tables() {
        // Chi-square tables: chi2(0.95, 10) = 18.307, half of it is the
        // gamma quantile of shape 5; chi2(0.05, 3) = 0.3518.
        assert!((2.0 * gamma_quantile(0.95, 5.0) - 18.307).abs() < 5e-4);
        assert!((2.0 * gamma_quantile(0.05, 1.5) - 0.351_846).abs() < 1e-6);
        // Shape 1 is the exponential distribution.
        assert!((gamma_quantile(0.45, 1.0) + libm::log(0.55)).abs() < 1e-12);
        // Beta(2, 2): F = 3 x^2 - 2 x^3, so F(1/4) = 5/32; Beta(1, n).
        assert!((beta_quantile(5.0 / 32.0, 2.0, 2.0) - 0.25).abs() < 1e-12);
        let x = beta_quantile(0.3, 1.0, 4.0);
        assert!((x - (1.0 - libm::pow(0.7, 0.25))).abs() < 1e-12);
        // F(5; 2, 4) as an F distribution, from tables: F(0.95; 4, 6) = 4.534.
        let x = beta_quantile(0.95, 2.0, 3.0);
        assert!((3.0 * x / (2.0 * (1.0 - x)) - 4.5337).abs() < 1e-3);
    }

    #[test]
    fn two_sided_exponential_is_continuous_and_bounded() {
        let (abc, ends) = ((17.095, 6.7729, 4.8512), (-2.0, 0.5));
        let q = |p| two_sided_exponential_quantile(p, abc, ends);
        // Mass below zero is c/b (1 - exp(-2 b)).
        let at_zero = 4.8512 / 6.7729 * (1.0 - libm::exp(-2.0 * 6.7729));
        assert!(q(at_zero - 1e-9).abs() < 1e-6);
        assert!(q(at_zero + 1e-9).abs() < 1e-6);
        assert!((q(0.0) + 2.0).abs() < 1e-9);
        assert!(q(1.0) <= 0.5);
    }
}
