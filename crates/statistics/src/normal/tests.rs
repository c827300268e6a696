use super::*;

/// z, Phi(z), ln Phi(z) by mpmath with 40 digits
/// (`fixtures/oracles/normal.py`).
const MPMATH: &str = rocking_fixtures::text("oracles/normal.csv");

fn rows() -> Vec<[f64; 3]> {
    let rows: Vec<_> = MPMATH
        .lines()
        .skip(1)
        .map(|line| {
            let mut fields = line.split(',').map(|f| f.parse().unwrap());
            std::array::from_fn(|_| fields.next().unwrap())
        })
        .collect();
    assert!(rows.len() > 30);
    rows
}

#[test]
fn cdf_and_its_logarithm_agree_with_mpmath() {
    for [z, p, ln_p] in rows() {
        if p > 1e-300 {
            let error = (cdf(z) / p - 1.0).abs();
            // The rounding of z/sqrt 2 is magnified by z^2.
            let bound = f64::EPSILON * (4.0 + z * z);
            assert!(error <= bound, "cdf({z}): {error:e}");
        }
        let error = (ln_cdf(z) / ln_p - 1.0).abs();
        assert!(error <= 2e-14, "ln_cdf({z}): {error:e}");
    }
}

#[test]
fn quantile_inverts_mpmath_in_the_lower_half() {
    for [z, p, _] in rows() {
        if p > 1e-300 && z < 0.3 {
            let error = (quantile(p) - z).abs();
            let bound = 4.0 * f64::EPSILON * z.abs().max(0.25);
            assert!(error <= bound, "quantile({p:e}) - {z}: {error:e}");
        }
    }
}

#[test]
fn quantile_is_odd_and_infinite_at_the_ends() {
    assert_eq!(quantile(0.25), -quantile(0.75));
    assert_eq!(quantile(1.0), f64::INFINITY);
    assert_eq!(quantile(0.0), f64::NEG_INFINITY);
    assert!(quantile(-0.1).is_nan() && quantile(f64::NAN).is_nan());
    // Just below 1/2 the result keeps its relative accuracy.
    let p = 0.5 - 1e-12;
    let expected = (p - 0.5) / pdf(0.0);
    assert!((quantile(p) / expected - 1.0).abs() < 1e-14);
}
