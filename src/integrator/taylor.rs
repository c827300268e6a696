//! One step: the Taylor polynomial of the motion about its start.

use crate::integrator::dynamics::Model;
use crate::number::Number;

/// Coefficients of u(tau) and of u'(tau) about the step's start, `LEN` of
/// each (order `LEN - 1` in both), for u'' = A S(u) - B C(u) with series `a`, `b` of A, B.
///
/// The series of S = sin u and C = cos u follow from S' = u' C and
/// C' = -u' S, from `sine_cosine` of the start; for Eq. 2 S = u and C = 1.
#[inline(always)]
pub(crate) fn expand<N: Number, const LEN: usize, const F: usize>(
    model: Model,
    u: N,
    w: N,
    (a, b): (&[N; F], &[N; F]),
    sine_cosine: (N, N),
) -> ([N; LEN], [N; LEN]) {
    match model {
        Model::Nonlinear => nonlinear(u, w, (a, b), sine_cosine),
        Model::Linearized => linearized(u, w, b),
    }
}

#[inline(always)]
fn nonlinear<N: Number, const LEN: usize, const F: usize>(
    u: N,
    w: N,
    drive: (&[N; F], &[N; F]),
    (sine, cosine): (N, N),
) -> ([N; LEN], [N; LEN]) {
    let mut series = Series {
        c: [N::zero(); LEN],
        velocity: [N::zero(); LEN],
        sine: [N::zero(); LEN],
        cosine: [N::zero(); LEN],
    };
    series.c[0] = u;
    series.c[1] = w;
    series.velocity[0] = w;
    series.sine[0] = sine;
    series.cosine[0] = cosine;
    // Written out for lanes: loops in loops of this length are not unrolled.
    macro_rules! first {
        ($($k:literal)*) => {
            $(if N::LANES && $k < LEN - 1 { series.extend($k, drive); })*
        };
    }
    first!(0 1 2 3 4 5 6 7 8 9 10 11 12);
    for k in if N::LANES { 13 } else { 0 }..LEN - 1 {
        series.extend(k, drive);
    }
    (series.c, series.velocity)
}

/// Series of u, u', sin u and cos u.
struct Series<N, const LEN: usize> {
    c: [N; LEN],
    velocity: [N; LEN],
    sine: [N; LEN],
    cosine: [N; LEN],
}

impl<N: Number, const LEN: usize> Series<N, LEN> {
    /// Sine and cosine of order `k`, velocity of the next one.
    #[inline(always)]
    fn extend<const F: usize>(
        &mut self,
        k: usize,
        (a, b): (&[N; F], &[N; F]),
    ) {
        // In every sum the terms that are known last come last: the sums
        // wait for nothing else.
        let Self { c, velocity, sine, cosine } = self;
        if k > 0 {
            let start = usize::from(k > 1);
            let mut s = velocity[start] * cosine[k - 1 - start];
            let mut t = velocity[start] * sine[k - 1 - start];
            for j in 2..k {
                s = velocity[j].mul_add(cosine[k - 1 - j], s);
                t = velocity[j].mul_add(sine[k - 1 - j], t);
            }
            if k > 1 {
                s = velocity[0].mul_add(cosine[k - 1], s);
                t = velocity[0].mul_add(sine[k - 1], t);
            }
            sine[k] = s * N::ratio(1, k as i32);
            cosine[k] = t * N::ratio(-1, k as i32);
        }
        let mut force = N::zero();
        let most = F.min(k + 1) - 1;
        for j in (0..=most).rev() {
            force = if j == most {
                a[j] * sine[k - j]
            } else {
                a[j].mul_add(sine[k - j], force)
            };
            force = (-b[j]).mul_add(cosine[k - j], force);
        }
        velocity[k + 1] = force * N::ratio(1, k as i32 + 1);
        if k + 2 < LEN {
            c[k + 2] = velocity[k + 1] * N::ratio(1, k as i32 + 2);
        }
    }
}

#[inline(always)]
fn linearized<N: Number, const LEN: usize, const F: usize>(
    u: N,
    w: N,
    b: &[N; F],
) -> ([N; LEN], [N; LEN]) {
    let mut c = [N::zero(); LEN];
    let mut velocity = [N::zero(); LEN];
    c[0] = u;
    c[1] = w;
    velocity[0] = w;
    for k in 0..LEN - 1 {
        let force = if k < F { c[k] - b[k] } else { c[k] };
        velocity[k + 1] = force * N::ratio(1, k as i32 + 1);
        if k + 2 < LEN {
            c[k + 2] = velocity[k + 1] * N::ratio(1, k as i32 + 2);
        }
    }
    (c, velocity)
}

/// Value of the polynomial `c` at `tau`.
#[inline(always)]
pub(crate) fn value<N: Number>(c: &[N], tau: N) -> N {
    let mut sum = c[c.len() - 1];
    for k in (0..c.len() - 1).rev() {
        sum = sum.mul_add(tau, c[k]);
    }
    sum
}

/// Derivative of the polynomial `c` at `tau`.
#[inline(always)]
pub(crate) fn slope<N: Number>(c: &[N], tau: N) -> N {
    let last = c.len() - 1;
    let mut sum = c[last] * N::ratio(last as i32, 1);
    for k in (1..last).rev() {
        sum = sum.mul_add(tau, c[k] * N::ratio(k as i32, 1));
    }
    sum
}
