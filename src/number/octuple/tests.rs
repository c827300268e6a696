use super::*;
use crate::number::Real;

const MPMATH: &str = rocking_fixtures::text("oracles/octuple.csv");

/// A number from its 64 hexadecimal digits and its exponent.
fn number(text: &str) -> Octuple {
    let Some((digits, exponent)) = text.split_once('p') else {
        assert_eq!(text, "0");
        return Octuple::ZERO;
    };
    let negative = digits.starts_with('-');
    let digits = digits.trim_start_matches('-');
    let limb = |k: usize| {
        u64::from_str_radix(&digits[16 * k..16 * (k + 1)], 16).unwrap()
    };
    let limbs = [limb(3), limb(2), limb(1), limb(0)];
    Octuple { negative, exponent: exponent.parse().unwrap(), limbs }
}

fn integer(x: Octuple) -> i32 {
    x.to_f64() as i32
}

#[test]
fn operations_are_rounded_to_nearest_and_functions_to_a_few_units() {
    let mut count = 0;
    for line in MPMATH.lines().skip(1) {
        let f: Vec<&str> = line.split(',').collect();
        let (x, y) = (number(f[1]), number(f[2]));
        let expected = number(f[3]);
        // Error allowed, in roundoffs.
        let (found, allowed) = match f[0] {
            "add" => (x + y, 0.0),
            "sub" => (x - y, 0.0),
            "mul" => (x * y, 0.0),
            "div" => (x / y, 0.0),
            "ratio" => (Octuple::ratio(integer(x), integer(y)), 0.0),
            "to_f64" => (Octuple::from_f64(x.to_f64()), 0.0),
            "right_angle" => (Octuple::right_angle(), 0.0),
            "sqrt" => (x.sqrt(), 2.0),
            "sin" => (x.sin_cos().0, 4.0),
            "cos" => (x.sin_cos().1, 4.0),
            "sin_small" => (x.sin_cos_small().0, 4.0),
            "cos_small" => (x.sin_cos_small().1, 4.0),
            "exp" => (x.exp(), 4.0),
            "ln_1p" => (x.ln_1p(), 4.0),
            "asin" => (x.asin(), 4.0),
            other => panic!("unknown function {other}"),
        };
        let error = (found - expected).abs();
        let share = Octuple::from_f64(allowed * Octuple::ROUNDOFF);
        assert!(error <= expected.abs() * share, "{line}: {found:?}");
        count += 1;
    }
    assert_eq!(count, 8 * 30 + 3 * 30 + 30 + 5 * 30 + 8 * 30 + 1);
}

#[test]
fn comparison_looks_at_all_bits() {
    let one = Octuple::one();
    let unit = Octuple::from_f64(2.0 * Octuple::ROUNDOFF);
    let above = one + unit;
    assert!(above > one && above != one && one - unit < one);
    assert!(-above < -one && -one < Octuple::ZERO && -one < above);
    assert_eq!(-Octuple::ZERO, Octuple::from_f64(-0.0));
    let nan = Octuple::from_f64(f64::NAN);
    assert!(!(nan < one) && !(nan >= one) && nan != nan);
    assert!(nan.positive_part() == Octuple::ZERO);
}

/// Whatever the operations do with zeros, infinities and NaN, doubles do.
#[test]
fn zeros_infinities_and_nan_are_those_of_a_double() {
    let all = [0.0, 1.0, -1.5, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    let same = |found: Octuple, expected: f64| {
        let found = found.to_f64();
        assert!(
            found == expected || found.is_nan() && expected.is_nan(),
            "{found} instead of {expected}"
        );
    };
    for x in all {
        let wide = Octuple::from_f64(x);
        same(wide, x);
        same(-wide, -x);
        same(wide.abs(), x.abs());
        same(wide.sqrt() * wide.sqrt(), x.sqrt() * x.sqrt());
        assert_eq!(wide.exp().to_f64() > 0.0, libm::exp(x) > 0.0);
        assert_eq!(wide.sin_cos().0.is_nan(), libm::sin(x).is_nan());
        for y in all.into_iter().filter(|y| x != 0.0 || *y != 0.0) {
            let other = Octuple::from_f64(y);
            same(wide + other, x + y);
            same(wide - other, x - y);
            same(wide * other, x * y);
            assert_eq!(wide.partial_cmp(&other), x.partial_cmp(&y));
            // There is one zero.
            if y != 0.0 || x > 0.0 {
                same(wide / other, x / y);
            }
        }
    }
    let (zero, one) = (Octuple::zero(), Octuple::one());
    let infinity = one / zero;
    same(infinity, f64::INFINITY);
    same(zero / zero, f64::NAN);
    same(infinity.exp(), f64::INFINITY);
    same((-infinity).exp(), 0.0);
    same(infinity.ln_1p(), f64::INFINITY);
    same((-one).ln_1p(), f64::NEG_INFINITY);
    for x in [one + one, infinity] {
        same((-x).ln_1p(), f64::NAN);
        same(x.asin(), f64::NAN);
        same((-x).sqrt(), f64::NAN);
    }
}

#[test]
fn what_leaves_the_range_becomes_zero_or_infinite() {
    let mut x = Octuple::from_f64(2.0);
    for _ in 0..29 {
        x = x * x;
    }
    let least = Octuple::one() / x;
    // 2^(2^29) is finite, and its square is not.
    assert!(x.is_finite() && !least.is_zero());
    assert!((x * x).is_infinite() && (least * least).is_zero());
    assert_eq!(x.to_f64(), f64::INFINITY);
    assert_eq!(least.to_f64(), 0.0);
    assert_eq!(x.sqrt() * x.sqrt(), x);
    // exp(ln_1p(x)) - 1 is x but for the roundoff of the logarithm.
    let share = (x.ln_1p().exp() - x) / x;
    let bound = x.ln_1p().to_f64() * 4.0 * Octuple::ROUNDOFF;
    assert!(share.abs().to_f64() <= bound);
    for tiny in [f64::MIN_POSITIVE, 5e-324, 3e-310] {
        assert_eq!(Octuple::from_f64(tiny).to_f64(), tiny);
    }
}
