use super::*;

#[test]
fn eq7_rises_with_c_from_its_limit_to_infinity() {
    let limit = eq7(1.9, 0.6, 1.0, 0.0).unwrap();
    assert!((limit - 0.6 * 1.9 / 0.9).abs() < 1e-15);
    let end = c_max(1.9, 0.6, 1.0).unwrap();
    let mut last = limit;
    for k in 1..=20 {
        let value = eq7(1.9, 0.6, 1.0, end * f64::from(k) / 20.5).unwrap();
        assert!(value > last);
        last = value;
    }
    assert!(eq7(1.9, 0.6, 1.0, end * (1.0 - 1e-14)).unwrap() > 10.0);
    for c in [end * (1.0 + 1e-15), 2.0 * end] {
        let error = eq7(1.9, 0.6, 1.0, c).unwrap_err();
        assert_eq!(error, FragilityError::Scale { c, c_max: end });
    }
}

#[test]
fn eq7_with_c_one_is_eq6_at_the_lognormal_quantiles() {
    let (m, b, r) = (2.2, 0.4, 1.0);
    let (low, high) = (m * exp(-b), m * exp(b));
    let difference = eq7(m, b, r, 1.0).unwrap() - eq6(low, high, r).unwrap();
    assert!(difference.abs() < 1e-15);
    // Without a shift nothing changes, for any c.
    assert!((eq7(m, b, 0.0, 3.0).unwrap() - b).abs() < 1e-15);
    assert_eq!(c_max(m, b, 0.0), Ok(f64::INFINITY));
}

#[test]
fn domains_are_refused_with_what_was_found() {
    let (median, shift) = (0.9, 1.0);
    let expected = FragilityError::Median { median, shift };
    assert_eq!(eq5(median, shift), Err(expected));
    assert_eq!(eq7(median, 0.5, shift, 1.0), Err(expected));
    assert!(eq5(1.0, 1.0).is_err() && eq5(f64::NAN, 1.0).is_err());
    assert!(eq5(1.0, -0.1).is_err() && eq5(1.0, f64::NAN).is_err());
    assert!(eq6(1.0, 2.0, 1.0).is_err() && eq6(3.0, 2.0, 1.0).is_err());
    assert!(eq6(2.0, f64::INFINITY, 1.0).is_err());
    for c in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(eq7(2.0, 0.5, 1.0, c).is_err());
    }
    for beta in [0.0, -0.5, f64::NAN] {
        assert!(eq7(2.0, beta, 1.0, 1.0).is_err());
    }
}
