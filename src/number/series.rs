//! Series of the elementary functions in arithmetic wider than double.

use crate::number::{Number, Real};

/// Sum of x^k / ((first + 1) ... (first + k)) over k, by nested products.
fn series<N: Number>(x: N, first: i32, step: i32, terms: i32) -> N {
    let mut sum = N::one();
    for k in (1..=terms / step).rev() {
        let last = first + step * k;
        let factor = if step == 2 { (last - 1) * last } else { last };
        sum = N::one() + x * sum * N::ratio(1, factor);
    }
    sum
}

/// sin x = x (1 - x^2/(2 3) (1 - x^2/(4 5) (...))), and the cosine alike.
pub(super) fn sin_cos<N: Number>(x: N, terms: i32) -> (N, N) {
    let z = -(x * x);
    (x * series(z, 1, 2, terms), series(z, 0, 2, terms))
}

/// exp(x) - 1 for |x| below about a half.
pub(super) fn exp_m1<N: Number>(x: N, terms: i32) -> N {
    x * series(x, 1, 1, terms)
}

/// The arc sine, from a double y near it: sin(asin x - y) = x cos y -
/// sqrt(1 - x^2) sin y, and the arc of that small sine.
pub(super) fn asin<N: Real>(x: N, rounds: u32) -> N {
    let cosine = ((N::one() - x) * (N::one() + x)).sqrt();
    let mut y = N::from_f64(libm::asin(x.to_f64()));
    for _ in 0..rounds {
        let (s, c) = y.sin_cos();
        let step = x * c - cosine * s;
        y = y + step + step * step * step * N::ratio(1, 6);
    }
    y
}

/// Sine and cosine of an angle and that many right angles more.
pub(super) fn turned<N: Number>((s, c): (N, N), turns: f64) -> (N, N) {
    match turns.rem_euclid(4.0) {
        1.0 => (c, -s),
        2.0 => (-s, -c),
        3.0 => (-c, s),
        _ => (s, c),
    }
}
