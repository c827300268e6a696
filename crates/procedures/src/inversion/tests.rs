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

#[test]
fn stripes_and_inversion_agree_where_no_curve_turns_back() {
    let straight = curve(&[(1.0, 0.0), (2.0, 0.9)], Some(2.1));
    let curves = [straight.clone(), straight.scaled(1.3).unwrap()];
    for level in [0.1, 0.5, 1.0] {
        let gap = inversion_discrepancy(&curves, level, InversionRule::Median);
        assert_eq!(gap, Ok(0.0));
    }
}

#[test]
fn stripes_and_inversion_differ_where_one_does() {
    // E2 at 0.18 exceeds from 1.09 to 1.38 and from 1.412 on; its median
    // point is 1.38, its first 1.09. E7 at 0.18 exceeds from 1.09 to 1.44.
    let curves = [e2(), e7()];
    let by = |rule| inversion_discrepancy(&curves, 0.18, rule).unwrap();
    // Up to 1.38 both exceed and neither capacity is reached.
    assert_eq!(by(InversionRule::Median), 1.0);
    // Past 1.44 E7 stands below the level again, for ever.
    assert_eq!(by(InversionRule::First), 0.5);
    assert!(inversion_discrepancy(&[], 0.5, InversionRule::First).is_err());
}
