use super::{Eight, descent, refine};
use crate::integrator::roots;
use crate::number::Number;
use crate::number::lanes::Mask;

/// A polynomial, the same each time; exact zeros among its coefficients, and
/// ends near to zero.
fn polynomial(seed: u64) -> [f64; 6] {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut draw = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / 16_777_216.0
    };
    let mut c = [0.0; 6];
    for (k, x) in c.iter_mut().enumerate() {
        let size = 1.0 / (1 + k * k * k) as f64;
        *x = size * (2.0 * draw() - 1.0);
        if draw() < 0.15 {
            *x = 0.0;
        }
    }
    if seed % 5 < 4 {
        c[0] = c[0].abs();
    }
    if seed.is_multiple_of(7) {
        // A root within rounding, or nearly so, of the end at 1.
        let tail: f64 = c[1..].iter().sum();
        c[0] = -tail * (1.0 + 2e-11 * (draw() - 0.5));
    }
    c
}

/// The screens and roots of the scalar driver, to the last bit.
#[test]
fn lanes_decide_and_solve_as_the_scalar_root_finder() {
    let (mut ones, mut nones, mut left) = (0, 0, 0);
    for batch in 0..1000 {
        let polynomials: Vec<[f64; 6]> =
            (0..8).map(|lane| polynomial(8 * batch + lane)).collect();
        let mut lanes = [Eight::zero(); 6];
        let mut lengths = Eight::zero();
        for (lane, c) in polynomials.iter().enumerate() {
            for (k, x) in c.iter().enumerate() {
                lanes[k][lane] = *x;
            }
            // Those that were made for it end at 1.
            let seed = 8 * batch + lane as u64;
            lengths[lane] = if seed.is_multiple_of(7) { 1.0 } else { 0.7 };
        }
        let told = descent(&lanes, lengths);
        let tau = refine(&lanes, lengths, told.one);
        for (lane, c) in polynomials.iter().enumerate() {
            let length = lengths[lane];
            let begins = c[0] > 0.0;
            let positive = roots::surely_positive(c, length);
            let below = roots::ends_below(c, length);
            let none = begins && (positive || below == Some(false));
            let one = begins && !positive && below == Some(true);
            assert_eq!(told.none.at(lane), none, "{c:?}");
            assert_eq!(told.one.at(lane), one, "{c:?}");
            if one {
                let start = roots::guess(c);
                let due = roots::refine(c, 0.0, length, start);
                assert_eq!(tau[lane].to_bits(), due.to_bits(), "{c:?}");
            }
            ones += u32::from(one);
            nones += u32::from(none);
            left += u32::from(!one && !none);
        }
    }
    assert!(ones > 300 && nones > 1000 && left > 500, "{ones} {nones} {left}");
}

/// A lane that is not asked for does not keep the others.
#[test]
fn lanes_not_asked_for_are_left() {
    let c = [0.3, -1.0, 0.0].map(Eight::splat);
    let mut which = Mask::splat(false);
    which.set(3, true);
    let high = Eight::ratio(1, 1);
    assert_eq!(refine(&c, high, which)[3], 0.3);
}
