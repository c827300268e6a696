use super::*;

/// The curves of `validation/proof/cases/inversion.toml`.
fn curve(vertices: &[(f64, f64)], overturning: Option<f64>) -> ResponseCurve {
    ResponseCurve::try_new(vertices, overturning).unwrap()
}

fn e2() -> ResponseCurve {
    curve(
        &[
            (1.0, 0.0),
            (1.1, 0.2),
            (1.2, 0.5),
            (1.3, 0.3),
            (1.4, 0.15),
            (1.5, 0.4),
            (1.6, 0.8),
        ],
        Some(1.7),
    )
}

fn e7() -> ResponseCurve {
    curve(&[(1.0, 0.0), (1.2, 0.4), (1.4, 0.2), (1.6, 0.1)], None)
}

fn close(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() < 4e-15
}

#[test]
fn a_record_that_never_reaches_the_level_is_censored() {
    let censored = Capacity::Censored { above: 1.6 };
    for rule in
        [InversionRule::Median, InversionRule::First, InversionRule::Monotone]
    {
        assert_eq!(e7().capacity(0.5, rule), Ok(censored));
    }
    let median = e7().capacity(0.3, InversionRule::Median).unwrap();
    assert!(close(median.im(), 1.3));
    // The infinite length below the level is censored too: up to 1.6 the
    // curve lies below the level but for 0.15.
    let monotone = e7().capacity(0.3, InversionRule::Monotone).unwrap();
    let Capacity::Censored { above } = monotone else {
        panic!("{monotone:?}");
    };
    assert!(close(above, 1.45));
}

#[test]
fn scaling_moves_intensities_only() {
    let scaled = e2().scaled(2.0).unwrap();
    let capacity = scaled.capacity(0.18, InversionRule::Last).unwrap();
    assert!(close(capacity.im(), 2.824));
    assert_eq!(scaled.overturning_im(), Some(3.4));
    assert!(e2().scaled(0.0).is_err() && e2().scaled(f64::NAN).is_err());
}

#[test]
fn stripes_are_infinite_from_the_first_overturning_on() {
    let curve = e2();
    assert_eq!(curve.edp_at(1.0), Some(0.0));
    assert!(close(curve.edp_at(1.15).unwrap(), 0.35));
    assert_eq!(curve.edp_at(1.2), Some(0.5));
    assert_eq!(curve.edp_at(1.65), None);
    assert_eq!(curve.edp_at(1.7), Some(f64::INFINITY));
    assert_eq!(curve.edp_at(9.0), Some(f64::INFINITY));
    assert_eq!(e7().edp_at(9.0), None);
    assert_eq!(e7().edp_at(f64::NAN), None);
}

#[test]
fn bad_curves_are_refused_with_what_was_found() {
    let refused = |vertices: &[(f64, f64)], overturning| {
        ResponseCurve::try_new(vertices, overturning).unwrap_err()
    };
    assert_eq!(refused(&[], None), CapacityError::Empty);
    assert_eq!(refused(&[(1.0, 0.1)], None), CapacityError::FirstEdp(0.1));
    let error = refused(&[(1.0, 0.0), (1.0, 0.2)], None);
    assert!(matches!(error, CapacityError::Intensity { number: 2, .. }));
    let error = refused(&[(1.0, 0.0), (1.1, f64::INFINITY)], None);
    assert!(matches!(error, CapacityError::Edp { number: 2, .. }));
    let error = refused(&[(1.0, 0.0), (f64::NAN, 0.1)], None);
    assert!(matches!(error, CapacityError::Intensity { number: 2, .. }));
    for overturning in [0.5, 1.0, f64::INFINITY, f64::NAN] {
        let error = refused(&[(1.0, 0.0)], Some(overturning));
        assert!(matches!(error, CapacityError::Overturning { .. }));
    }
    assert!(e2().crossings(0.0).is_err() && e2().crossings(f64::NAN).is_err());
}
