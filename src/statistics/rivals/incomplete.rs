//! The incomplete gamma function.

use libm::{exp, lgamma, log};

/// Terms of the series and of the continued fraction, at most.
const TERMS: usize = 10_000;

/// P(a, x) and Q(a, x) = 1 - P(a, x), the regularized incomplete gamma
/// functions for a > 0 and x >= 0: the series below a + 1, Legendre's
/// continued fraction above (Abramowitz and Stegun 6.5.29, 6.5.31), in the
/// manner of Lentz.
pub(super) fn incomplete_gamma(a: f64, x: f64) -> (f64, f64) {
    if !(x > 0.0) {
        return (0.0, 1.0);
    }
    let front = exp(a * log(x) - x - lgamma(a));
    if x < a + 1.0 {
        let (mut term, mut sum) = (1.0 / a, 1.0 / a);
        for i in 1..TERMS {
            term *= x / (a + i as f64);
            sum += term;
            if term < 1e-17 * sum {
                break;
            }
        }
        let lower = (front * sum).min(1.0);
        return (lower, 1.0 - lower);
    }
    const TINY: f64 = 1e-300;
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (1.0 / TINY, 1.0 / b);
    let mut fraction = d;
    for i in 1..TERMS {
        let i = i as f64;
        let numerator = -i * (i - a);
        b += 2.0;
        d = 1.0 / (b + numerator * d);
        c = b + numerator / c;
        fraction *= c * d;
        if (c * d - 1.0).abs() < 1e-16 {
            break;
        }
    }
    let upper = (front * fraction).min(1.0);
    (1.0 - upper, upper)
}
