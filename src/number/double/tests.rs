use super::*;

const MPMATH: &str = rocking_fixtures::text("oracles/double.csv");

fn pair(hi: &str, lo: &str) -> DoubleDouble {
    DoubleDouble { hi: hi.parse().unwrap(), lo: lo.parse().unwrap() }
}

#[test]
fn operations_agree_with_mpmath_to_30_digits() {
    let mut count = 0;
    for line in MPMATH.lines().skip(1) {
        let f: Vec<&str> = line.split(',').collect();
        let (x, y) = (pair(f[1], f[2]), pair(f[3], f[4]));
        let expected = pair(f[5], f[6]);
        let found = match f[0] {
            "add" => x + y,
            "sub" => x - y,
            "mul" => x * y,
            "div" => x / y,
            "sqrt" => x.sqrt(),
            "sin" => x.sin_cos().0,
            "cos" => x.sin_cos().1,
            "sin_small" => x.sin_cos_small().0,
            "cos_small" => x.sin_cos_small().1,
            "exp" => x.exp(),
            "ln_1p" => x.ln_1p(),
            "asin" => x.asin(),
            "ratio" => DoubleDouble::ratio(x.hi as i32, y.hi as i32),
            "right_angle" => DoubleDouble::right_angle(),
            other => panic!("unknown function {other}"),
        };
        let error = (found - expected).abs();
        let bound = expected.abs() * DoubleDouble::from_f64(1e-30);
        assert!(error <= bound, "{line}: {found:?}, off by {:e}", error.hi);
        // Normalised: the nearest double leads.
        assert_eq!(found.hi + found.lo, found.hi, "{line}");
        count += 1;
    }
    assert_eq!(count, 4 * 40 + 8 * 40 + 6 + 1);
}

#[test]
fn comparison_looks_at_both_parts() {
    let one = DoubleDouble::one();
    let above = DoubleDouble::sum(1.0, 1e-25);
    assert!(above > one && above != one);
    assert!(DoubleDouble::sum(1.0, -1e-25) < one);
    let nan = DoubleDouble::from_f64(f64::NAN);
    assert!(!(nan < one) && !(nan >= one) && nan != nan);
}

/// Where the first parts cancel, the sum of the second parts is all.
#[test]
fn what_is_left_of_a_cancelled_sum_is_exact() {
    let [a, b] = [-60, -130].map(|exponent| libm::scalbn(1.0, exponent));
    let rest = DoubleDouble::sum(1.0, a) + DoubleDouble::sum(-1.0, b);
    assert_eq!(rest, DoubleDouble { hi: a, lo: b });
}

/// ln(2^k) = k ln 2, far above 1, where the first approximation is off by
/// many roundings of the result's last digit.
#[test]
fn logarithms_of_large_powers_of_two_are_multiples_of_ln_2() {
    for k in (600..1000).step_by(7) {
        let power = DoubleDouble::sum(libm::scalbn(1.0, k), -1.0);
        let zero = DoubleDouble::zero();
        let expected = -zero.less(f64::from(k), LN_2);
        let off = (power.ln_1p() - expected) / expected;
        assert!(off.hi.abs() < 1e-31, "{k}: {:e}", off.hi);
    }
}

#[test]
fn infinities_stay_infinite_and_roots_of_negatives_are_not_numbers() {
    let one = DoubleDouble::one();
    let zero = DoubleDouble::zero();
    let infinity = one / zero;
    assert_eq!(infinity.hi, f64::INFINITY);
    assert!(one < infinity && (infinity + one).hi == f64::INFINITY);
    assert_eq!((infinity * one).hi, f64::INFINITY);
    assert_eq!((one / infinity).hi, 0.0);
    assert!((zero / zero).hi.is_nan());
    assert!((-one).sqrt().hi.is_nan());
    assert_eq!(zero.sqrt(), zero);
    assert_eq!((-one).ln_1p().hi, f64::NEG_INFINITY);
}

#[test]
fn fused_operations_round_below_the_roundoff() {
    // (1 + u)^2 - 1 - 2 u = u^2, u = 2^-60.
    let u = libm::scalbn(1.0, -60);
    let x = DoubleDouble::sum(1.0, u);
    let rest = x.mul_add(x, -DoubleDouble::sum(1.0, 2.0 * u));
    assert!((rest.hi - u * u).abs() <= DoubleDouble::ROUNDOFF);
}
