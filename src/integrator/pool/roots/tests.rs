use super::{descent, refine};
use crate::integrator::roots;
use crate::number::dispatch::{Isa, WithSimd};
use crate::number::lanes::{Lanes, Mask, Simd, WIDTH};

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
    if is_short(seed) {
        c[4..].fill(0.0);
    }
    c
}

/// The scalar root finder gets four coefficients, as it does of five after a
/// start on the event; lanes have zeros behind them.
fn is_short(seed: u64) -> bool {
    seed.is_multiple_of(11)
}

/// Screens and roots of polynomials over lengths.
struct Descents<'p> {
    polynomials: &'p [[f64; 6]; WIDTH],
    lengths: &'p Lanes,
}

impl WithSimd for Descents<'_> {
    type Output = (u8, u8, Lanes);

    fn run<V: Simd>(self) -> (u8, u8, Lanes) {
        let lanes: [V; 6] = std::array::from_fn(|k| {
            V::load(&Lanes(self.polynomials.map(|c| c[k])))
        });
        let lengths = V::load(self.lengths);
        let found = descent(&lanes, lengths);
        let mut tau = Lanes::splat(0.0);
        refine(&lanes, lengths, found.one).store(&mut tau);
        (found.none.bits(), found.one.bits(), tau)
    }
}

/// The screens and roots of the scalar driver, to the last bit, at every
/// level.
#[test]
fn lanes_decide_and_solve_as_the_scalar_root_finder() {
    let (mut ones, mut nones, mut left) = (0, 0, 0);
    for batch in 0..1000 {
        let seed = |lane: usize| 8 * batch + lane as u64;
        let polynomials = std::array::from_fn(|k| polynomial(seed(k)));
        // Those that were made for it end at 1.
        let lengths = Lanes(std::array::from_fn(|lane| {
            if seed(lane).is_multiple_of(7) { 1.0 } else { 0.7 }
        }));
        let work =
            || Descents { polynomials: &polynomials, lengths: &lengths };
        let found = work().run::<Lanes>();
        for level in Isa::available() {
            let (none, one, tau) = level.run_wide(work()).unwrap_or(found);
            assert_eq!((none, one), (found.0, found.1), "{}", level.name());
            for lane in (0..WIDTH).filter(|lane| one >> lane & 1 == 1) {
                let (here, due) = (tau[lane], found.2[lane]);
                assert_eq!(here.to_bits(), due.to_bits(), "{}", level.name());
            }
        }
        for (lane, c) in polynomials.iter().enumerate() {
            let length = lengths[lane];
            let c = if is_short(seed(lane)) { &c[..4] } else { c };
            let begins = c[0] > 0.0;
            let positive = roots::surely_positive(c, length);
            let below = roots::ends_below(c, length);
            let none = begins && (positive || below == Some(false));
            let one = begins && !positive && below == Some(true);
            assert_eq!(found.0 >> lane & 1 == 1, none, "{c:?}");
            assert_eq!(found.1 >> lane & 1 == 1, one, "{c:?}");
            if one {
                let start = roots::guess(c);
                let due = roots::refine(c, 0.0, length, start);
                assert_eq!(found.2[lane].to_bits(), due.to_bits(), "{c:?}");
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
    let c = [0.3, -1.0, 0.0].map(Lanes::splat);
    let high = Lanes::splat(1.0);
    assert_eq!(refine(&c, high, Mask::of(1 << 3))[3], 0.3);
}
