//! The fused multiply-add in plain doubles, where there is no instruction (wasm)
//! or the platform's function is wrong (MinGW): `libm` takes a fifth longer.
//!
//! Boldo and Melquiond, "Emulation of FMA and correctly rounded sums: proved
//! algorithms using rounding to odd" (IEEE Transactions on Computers 57,
//! 2008, Fig. 5). The proof needs that nothing overflows and that the error of
//! the product is a double; outside that range `libm` is called.

/// Largest factor that Dekker's product may split: 2^990.
const LARGEST_FACTOR: f64 = f64::from_bits((990 + 1023) << 52);
/// Largest product and addend: 2^1000, so that no sum overflows.
const LARGEST: f64 = f64::from_bits((1000 + 1023) << 52);
/// Least product: its error is a multiple of 2^-960 2^-106, which is a
/// double.
const LEAST: f64 = f64::from_bits((1023 - 960) << 52);

/// `a * b + c` with one rounding, the bits of [`f64::mul_add`].
///
/// It stays a function: inlined at every place, it would make modules large.
#[inline(never)]
#[cfg_attr(not(any(target_family = "wasm", windows)), allow(dead_code))]
pub fn mul_add(a: f64, b: f64, c: f64) -> f64 {
    let product = a * b;
    let factors = a.abs() < LARGEST_FACTOR && b.abs() < LARGEST_FACTOR;
    let product_fits = (LEAST..LARGEST).contains(&product.abs());
    if factors && product_fits && c.abs() < LARGEST {
        let low = error_of_product(a, b, product);
        let (above, below) = two_sum(c, low);
        let (high, middle) = two_sum(product, above);
        return high + sum_to_odd(below, middle);
    }
    // If a factor is zero, nothing is rounded before the sum.
    if a == 0.0 || b == 0.0 {
        return product + c;
    }
    library(a, b, c)
}

/// The call of `libm`, out of line.
#[cold]
#[inline(never)]
fn library(a: f64, b: f64, c: f64) -> f64 {
    libm::fma(a, b, c)
}

/// The error of a product, by Dekker's halves of the factors.
#[inline(always)]
fn error_of_product(a: f64, b: f64, product: f64) -> f64 {
    let (a_high, a_low) = halves(a);
    let (b_high, b_low) = halves(b);
    a_low * b_low
        - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)
}

/// A double as a sum of two with 26 bits each (Veltkamp).
#[inline(always)]
fn halves(x: f64) -> (f64, f64) {
    let scaled = x * 134_217_729.0;
    let high = scaled - (scaled - x);
    (high, x - high)
}

/// A sum and its error (Knuth).
#[inline(always)]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// The sum if it is a double, otherwise its odd neighbour.
#[inline(always)]
fn sum_to_odd(a: f64, b: f64) -> f64 {
    let (sum, error) = two_sum(a, b);
    let bits = sum.to_bits();
    if error == 0.0 || bits & 1 == 1 {
        return sum;
    }
    let outward = (error > 0.0) == (sum > 0.0);
    f64::from_bits(if outward { bits + 1 } else { bits - 1 })
}

#[cfg(test)]
mod tests {
    use std::hint::black_box;

    use super::mul_add;

    #[track_caller]
    fn same(a: f64, b: f64, c: f64) {
        let (ours, due) = (mul_add(a, b, c), black_box(a).mul_add(b, c));
        let equal = ours.to_bits() == due.to_bits();
        assert!(
            equal || (ours.is_nan() && due.is_nan()),
            "{a:e} * {b:e} + {c:e}: {ours:e}, not {due:e}"
        );
    }

    /// `count` triples of random bits (SplitMix64).
    fn triples(count: usize, mut each: impl FnMut([u64; 3])) {
        let mut state = 0_u64;
        let mut draw = || {
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (state ^ state >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ z >> 31
        };
        for _ in 0..count {
            each([draw(), draw(), draw()]);
        }
    }

    /// A double with the sign and fraction of `bits` and an exponent.
    fn with_exponent(bits: u64, exponent: i64) -> f64 {
        let exponent = (exponent + 1023).clamp(0, 2046) as u64;
        f64::from_bits(bits & !(0x7ff << 52) | exponent << 52)
    }

    #[test]
    fn bits_of_any_three_doubles() {
        triples(1_000_000, |[a, b, c]| {
            same(f64::from_bits(a), f64::from_bits(b), f64::from_bits(c));
        });
    }

    /// The addend near the product or its error, over all exponents; short
    /// fractions make ties.
    #[test]
    fn bits_where_product_and_addend_meet() {
        let mut k = 0_i64;
        triples(2_000_000, |[a, b, c]| {
            k += 1;
            let of_product = k % 2110 - 1080;
            let split = (a >> 3) as i64 % 900;
            let apart = (c >> 5) as i64 % 230 - 115;
            let short = match k / 2110 % 4 {
                0 => !0 << 27,
                1 => !0 << 50,
                _ => !0,
            };
            let a = with_exponent(a & short, of_product / 2 - split);
            let b = with_exponent(b & short, of_product / 2 + split);
            let c = with_exponent(c & short, of_product + apart);
            same(a, b, c);
            // Cancellation down to the error of the product, and beside it.
            same(a, b, -(a * b));
            same(a, b, f64::from_bits((-(a * b)).to_bits() ^ 1));
        });
    }

    #[test]
    fn bits_at_the_ends_of_the_range() {
        let ends = [
            0.0,
            f64::from_bits(1),
            f64::from_bits(0x000f_ffff_ffff_ffff),
            f64::MIN_POSITIVE,
            super::LEAST,
            f64::EPSILON,
            0.5,
            1.0 - 0.5 * f64::EPSILON,
            1.0,
            1.0 + f64::EPSILON,
            3.0,
            super::LARGEST_FACTOR,
            super::LARGEST,
            f64::MAX,
            f64::INFINITY,
            f64::NAN,
        ];
        let ends = ends.map(|x| [x, -x]).concat();
        for a in &ends {
            for b in &ends {
                for c in &ends {
                    same(*a, *b, *c);
                }
            }
        }
    }
}
