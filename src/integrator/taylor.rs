//! One step: the Taylor polynomial of the motion about its start.

use crate::integrator::dynamics::Model;
use crate::number::Number;

/// Coefficients of u(tau) and of u'(tau) about the step's start, `LEN` of
/// each (order `LEN - 1` in both), for u'' = A S(u) - B C(u) with series `a`, `b` of A, B.
///
/// The series of S = sin u and C = cos u follow from S' = u' C and
/// C' = -u' S; for Eq. 2 S = u and C = 1.
#[inline(always)]
pub(crate) fn expand<N: Number, const LEN: usize, const F: usize>(
    model: Model,
    u: N,
    w: N,
    (a, b): (&[N; F], &[N; F]),
    sin_cos: impl Fn(N) -> (N, N),
) -> ([N; LEN], [N; LEN]) {
    match model {
        Model::Nonlinear => nonlinear(u, w, (a, b), sin_cos),
        Model::Linearized => linearized(u, w, b),
    }
}

#[inline(always)]
fn nonlinear<N: Number, const LEN: usize, const F: usize>(
    u: N,
    w: N,
    (a, b): (&[N; F], &[N; F]),
    sin_cos: impl Fn(N) -> (N, N),
) -> ([N; LEN], [N; LEN]) {
    let mut c = [N::zero(); LEN];
    let mut velocity = [N::zero(); LEN];
    let mut sine = [N::zero(); LEN];
    let mut cosine = [N::zero(); LEN];
    c[0] = u;
    c[1] = w;
    velocity[0] = w;
    (sine[0], cosine[0]) = sin_cos(u);
    for k in 0..LEN - 1 {
        if k > 0 {
            let mut s = velocity[0] * cosine[k - 1];
            let mut t = velocity[0] * sine[k - 1];
            for j in 1..k {
                s = velocity[j].mul_add(cosine[k - 1 - j], s);
                t = velocity[j].mul_add(sine[k - 1 - j], t);
            }
            let share = N::ratio(1, k as i32);
            sine[k] = s * share;
            cosine[k] = -(t * share);
        }
        let mut force = a[0] * sine[k];
        force = (-b[0]).mul_add(cosine[k], force);
        for j in 1..F.min(k + 1) {
            force = a[j].mul_add(sine[k - j], force);
            force = (-b[j]).mul_add(cosine[k - j], force);
        }
        velocity[k + 1] = force * N::ratio(1, k as i32 + 1);
        if k + 2 < LEN {
            c[k + 2] = velocity[k + 1] * N::ratio(1, k as i32 + 2);
        }
    }
    (c, velocity)
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
