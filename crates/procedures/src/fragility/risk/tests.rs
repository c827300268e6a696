use super::*;

#[test]
fn what_lies_beyond_the_last_point_is_bounded_and_below_the_first_reported() {
    let hazard = HazardCurve::try_new(&[(0.3, 0.004), (0.9, 0.0003)]).unwrap();
    let certain = Lognormal::try_new(0.0, -9.0, 0.1).unwrap();
    let found = hazard.annual_frequency(certain);
    // Every motion that the curve has does the damage.
    assert!((found.truncation_lower / 0.004 - 1.0).abs() < 1e-13);
    assert!((found.covered / 0.0037 - 1.0).abs() < 1e-13);
    assert_eq!(
        (found.truncation_upper, found.first_probability),
        (found.truncation_lower, 1.0)
    );
    // None of them does it, and those beyond may or may not.
    let never = Lognormal::try_new(5.0, 0.0, 0.1).unwrap();
    let found = hazard.annual_frequency(never);
    assert_eq!(
        (found.truncation_lower, found.truncation_upper),
        (0.0, 0.0003)
    );
    assert_eq!((found.covered, found.first_probability), (0.0, 0.0));
}

#[test]
fn curves_that_are_none_are_refused_with_the_point() {
    let error = HazardCurve::try_new(&[(0.1, 1.0)]).unwrap_err();
    assert_eq!(error, HazardError::Points(1));
    for (points, number) in [
        ([(0.0, 1.0), (0.2, 0.5)], 1),
        ([(0.2, 1.0), (0.2, 0.5)], 2),
        ([(0.2, 1.0), (f64::NAN, 0.5)], 2),
        ([(0.2, 1.0), (f64::INFINITY, 0.5)], 2),
    ] {
        let error = HazardCurve::try_new(&points).unwrap_err();
        assert!(
            matches!(error, HazardError::Intensity { number: n, .. } if n == number)
        );
    }
    for second in [0.0, -1.0, 1.1, f64::NAN] {
        let error =
            HazardCurve::try_new(&[(0.1, 1.0), (0.2, second)]).unwrap_err();
        assert!(matches!(error, HazardError::Frequency { number: 2, .. }));
    }
}

#[test]
fn numbers_of_no_hazard_are_refused() {
    for (points, number) in [
        ([(0.1, 1.0), (0.2, 5e-324)], 2),
        ([(0.1, 1.0), (0.2, 1e-151)], 2),
        ([(0.1, 1e200), (0.2, 1.0)], 1),
        ([(1e-200, 1.0), (0.2, 0.5)], 1),
        ([(0.1, 1.0), (1e200, 0.5)], 2),
    ] {
        let error = HazardCurve::try_new(&points).unwrap_err();
        assert!(
            matches!(error, HazardError::Range { number: n, .. } if n == number),
            "{error}"
        );
    }
    let widest = [(RANGE.0, RANGE.1), (RANGE.1, RANGE.0)];
    assert!(HazardCurve::try_new(&widest).is_ok());
}

/// Integrals by mpmath, 40 digits, over 60 parts of equal ratio.
#[test]
fn a_steep_segment_is_integrated_in_parts() {
    for (from, to, (shift, log_mean, beta), expected) in [
        (
            (0.5, 1e-3),
            (0.500_01, 1e-9),
            (0.3, -1.5, 0.4),
            3.476_915_469_707_473_6e-9,
        ),
        (
            (1.0, 0.01),
            (1.5, 1e-30),
            (0.9, -1.0, 0.5),
            2.211_316_816_519_510_3e-5,
        ),
        (
            (0.2, 1.0),
            (0.6, 1e-12),
            (0.1, -1.0, 0.8),
            0.011_824_431_485_107_787,
        ),
        (
            (0.2, 1.0),
            (0.6, 1e-12),
            (0.0, -1.0, 0.8),
            0.015_376_608_572_413_912,
        ),
    ] {
        let law = Lognormal::try_new(shift, log_mean, beta).unwrap();
        let found = Segment::between(&[from, to]).integral(&law, -LAST_SCORE);
        assert!(
            (found / expected - 1.0).abs() < 1e-10,
            "{found:e} {expected}"
        );
    }
}

/// Between two neighbouring doubles, and over all of [`RANGE`].
#[test]
fn the_steepest_segments_end() {
    let above = |x: f64| x.next_up();
    let most = RANGE.1;
    for (from, to) in [
        ((0.5, most), (above(0.5), RANGE.0)),
        ((RANGE.0, most), (above(RANGE.0), RANGE.0)),
        ((RANGE.0, most), (most, RANGE.0)),
        ((0.5, 1.0), (2.0, RANGE.0)),
    ] {
        let hazard = HazardCurve::try_new(&[from, to]).unwrap();
        for shift in [0.0, 1e-300, from.0, 0.5 * (from.0 + to.0)] {
            for beta in [1e-300, 1e-3, 0.5, 10.0, 1e300] {
                let law = Lognormal::try_new(shift, -0.7, beta).unwrap();
                let found = hazard.annual_frequency(law);
                let (low, high) =
                    (found.truncation_lower, found.truncation_upper);
                let bound = from.1 * (1.0 + 1e-9);
                assert!(low >= 0.0 && high <= bound, "{shift} {beta} {low:e}");
            }
        }
    }
}

#[test]
fn contributions_add_up_to_what_the_points_cover() {
    let points = [(0.05, 0.1), (0.2, 0.01), (0.6, 8e-4), (2.0, 1e-5)];
    let hazard = HazardCurve::try_new(&points).expect("a curve");
    let fragility = Lognormal::try_new(0.15, -0.9, 0.7).expect("a law");
    let found = hazard.contributions(fragility);
    assert!(found.iter().all(|part| part.annual_frequency > 0.0));
    let parts = found.iter().map(|part| part.annual_frequency);
    let sum = parts.fold(0.0, |sum, part| sum + part);
    let covered = hazard.annual_frequency(fragility).covered;
    assert!((sum / covered - 1.0).abs() < 1e-12, "{sum} {covered}");
}

/// A shift of nothing leaves the closed form for the quadrature.
#[test]
fn the_closed_form_is_the_quadrature() {
    for (k, beta) in [(0.0, 0.5), (1.5, 0.3), (3.0, 0.9), (7.9, 1.0)] {
        for (from, to) in [(1e-3, 0.02), (0.3, 0.31), (0.5, 4.0), (3.0, 90.0)]
        {
            let end = 1e-3 * libm::pow(to / from, -k);
            let segment = Segment::between(&[(from, 1e-3), (to, end)]);
            let found = |shift| {
                let law = Lognormal::try_new(shift, 0.1, beta).expect("a law");
                segment.integral(&law, -LAST_SCORE)
            };
            let (closed, sum) = (found(0.0), found(1e-300));
            assert!((closed / sum - 1.0).abs() <= 1e-11, "{closed} {sum}");
        }
    }
}
