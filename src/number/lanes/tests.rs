use super::{Lanes, Mask, Simd, WIDTH};
use crate::number::dispatch::{Isa, WithSimd};

/// Numbers at which operations differ if they differ anywhere: either zero,
/// what has no order, what has no end, and what is too small or too large.
const HARD: [f64; WIDTH] =
    [0.0, -0.0, f64::NAN, f64::INFINITY, -f64::INFINITY, 5e-324, -1e308, 0.3];

/// Every operation on two numbers in each lane: numbers, then truths.
struct Everything {
    a: Lanes,
    b: Lanes,
}

impl Everything {
    fn pairs(&self) -> [[f64; 2]; WIDTH] {
        std::array::from_fn(|lane| [self.b.0[7 - lane], self.a.0[lane]])
    }
}

impl WithSimd for Everything {
    type Output = (Vec<[u64; WIDTH]>, Vec<u8>, [u64; WIDTH]);

    fn run<V: Simd>(self) -> Self::Output {
        let (a, b) = (V::load(&self.a), V::load(&self.b));
        let c = V::gather(std::array::from_fn(|lane| &self.b.0[7 - lane]));
        let (d, e) = V::gather_pairs(self.pairs().each_ref());
        let (sine, cosine) = b.sin_cos_small();
        let (less, same) = (a.lt(b), a.eq(b));
        let numbers = [
            a + b,
            a - b,
            a * b,
            a / b,
            -a,
            a.mul_add(b, c),
            a.abs(),
            a.max(b),
            a.min(b),
            a.sqrt(),
            V::ratio(1, 3),
            sine,
            cosine,
            c,
            d,
            e,
            less.select(a, c),
        ];
        let truths = [
            less,
            same,
            a.le(b),
            a.unlike(b, c),
            less.not(),
            less.and(same.not()),
            less.or(same),
            a.le(b).but_not(same),
            Mask::of(0b1010_0110),
            Mask::splat(true),
        ];
        let mut counts = [7; WIDTH];
        less.count(&mut counts);
        let bits = |x: V| {
            let mut out = Lanes::splat(0.0);
            x.store(&mut out);
            // What is not a number has no bits that matter.
            out.0.map(|x| if x.is_nan() { u64::MAX } else { x.to_bits() })
        };
        let truths = truths.map(|truth: V::Mask| {
            assert_eq!(truth.any(), truth.bits() != 0);
            truth.bits()
        });
        (numbers.map(bits).into(), truths.into(), counts)
    }
}

/// Registers do what arrays do, and arrays what numbers do alone.
#[test]
fn every_level_has_the_bits_of_numbers_alone() {
    for shift in 0..WIDTH {
        let a = Lanes(HARD);
        let mut b = HARD;
        b.rotate_left(shift);
        let work = || Everything { a, b: Lanes(b) };
        let (numbers, truths, counts) = work().run::<Lanes>();
        for lane in 0..WIDTH {
            let (x, y, z) = (a[lane], b[lane], b[7 - lane]);
            let alone = [x + y, x - y, x * y, x / y, -x, x.mul_add(y, z)];
            for (several, alone) in numbers.iter().zip(alone) {
                let several = f64::from_bits(several[lane]);
                assert!(
                    several.to_bits() == alone.to_bits()
                        || several.is_nan() && alone.is_nan(),
                    "{x} {y} {z}: {several}, alone {alone}"
                );
            }
            let truth = |k: usize| truths[k] >> lane & 1 == 1;
            let signs = x.is_sign_negative() != y.is_sign_negative()
                || z.is_sign_negative();
            assert_eq!(truth(0), x < y);
            assert_eq!(truth(1), x == y);
            assert_eq!(truth(2), x <= y);
            assert_eq!(truth(3), signs);
            assert_eq!(counts[lane], 7 + u64::from(x < y));
        }
        for level in Isa::available() {
            if let Some(other) = level.run_wide(work()) {
                let due = (numbers.clone(), truths.clone(), counts);
                assert_eq!(other, due, "{}", level.name());
            }
        }
    }
}
