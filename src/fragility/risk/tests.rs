use super::*;

const MPMATH: &str = include_str!("../../../fixtures/oracles/risk.csv");

fn curve(name: &str) -> HazardCurve {
    let points: &[(f64, f64)] = match name {
        "four" => &[(0.05, 0.1), (0.2, 0.01), (0.6, 0.0008), (2.0, 0.00001)],
        "steep" => &[(0.1, 0.02), (0.4, 0.0004), (1.5, 2e-8)],
        _ => &[(0.3, 0.004), (0.9, 0.0003)],
    };
    HazardCurve::try_new(points).unwrap()
}

/// The quadrature's rounding: some thousand sums of terms of one sign, and
/// one subtraction in `covered`.
const TOLERANCE: f64 = 1e-12;

#[test]
fn frequencies_are_those_of_fine_quadrature_with_and_without_a_shift() {
    let (mut count, mut unshifted_is_off) = (0, 0);
    for line in MPMATH.lines().skip(1) {
        let (name, rest) = line.split_once(',').unwrap();
        let f: Vec<f64> =
            rest.split(',').map(|f| f.parse().unwrap()).collect();
        let hazard = curve(name);
        let fragility = Lognormal::try_new(f[0], f[1], f[2]).unwrap();
        let found = hazard.annual_frequency(&fragility);
        for (ours, expected) in [(found.low, f[4]), (found.high, f[5])] {
            let error = (ours - expected).abs();
            let bound = TOLERANCE * expected;
            assert!(error <= bound, "{line}: {ours}, {error:e}");
        }
        // Of numbers of the size of `low`.
        let error = (found.covered - f[3]).abs();
        assert!(error <= TOLERANCE * f[4], "{line}: {error:e}");
        // The lognormal of the same median and dispersion without a shift
        // is wrong by 2 % and more.
        if f[0] > 0.0 {
            let log_median = log(fragility.median());
            let wrong = Lognormal::try_new(0.0, log_median, f[2]).unwrap();
            let wrong = hazard.annual_frequency(&wrong).low;
            unshifted_is_off += u32::from((wrong - f[4]).abs() > 0.02 * f[4]);
        }
        count += 1;
    }
    assert_eq!((count, unshifted_is_off), (15, 12));
}

#[test]
fn a_power_law_and_a_lognormal_give_cornell_s_closed_form() {
    for (k, median, beta) in
        [(1.0, 0.6, 0.4), (2.0, 1.0, 0.5), (3.5, 0.3, 0.8), (8.0, 2.0, 1.1)]
    {
        let k0 = 1e-4;
        let at = |x: f64| (x, k0 * exp(-k * log(x)));
        let score = |z: f64| median * exp(beta * z);
        // Wide enough for the integrand's peak at the score -k beta; an
        // inner point breaks the quadrature where nothing changes.
        let points =
            [at(score(-k * beta - 12.0)), at(median), at(score(12.0))];
        let hazard = HazardCurve::try_new(&points).unwrap();
        let fragility = Lognormal::try_new(0.0, log(median), beta).unwrap();
        let found = hazard.annual_frequency(&fragility);
        let at_the_median = k0 * exp(-k * log(median));
        let cornell = at_the_median * exp(0.5 * k * k * beta * beta);
        let error = (found.low / cornell - 1.0).abs();
        // exp of numbers up to 100 and more loses two digits.
        assert!(error < 2e-13, "k = {k}: {error:e}");
        // The hazard at the median, without the factor for the dispersion.
        assert!((found.low / at_the_median - 1.0).abs() > 0.05);
        assert!(found.high - found.low < 1e-15 * found.low);
    }
}

#[test]
fn what_lies_beyond_the_last_point_is_bounded_and_below_the_first_told() {
    let hazard = curve("coarse");
    let certain = Lognormal::try_new(0.0, -9.0, 0.1).unwrap();
    let found = hazard.annual_frequency(&certain);
    // Every motion that the curve has does the damage.
    assert!((found.low / 0.004 - 1.0).abs() < 1e-13);
    assert!((found.covered / 0.0037 - 1.0).abs() < 1e-13);
    assert_eq!((found.high, found.first_probability), (found.low, 1.0));
    // None of them does it, and those beyond may or may not.
    let never = Lognormal::try_new(5.0, 0.0, 0.1).unwrap();
    let found = hazard.annual_frequency(&never);
    assert_eq!((found.low, found.high), (0.0, 0.0003));
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
