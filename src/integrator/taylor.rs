//! One step: the Taylor polynomial of the motion about its start.

use crate::integrator::dynamics::{Drive, Model};
use crate::number::Number;

/// A loop from 1 that is written out for lanes: compilers do not unroll loops
/// of this length, and then coefficients do not stay in registers.
macro_rules! written_out {
    (1..$end:expr, |$k:ident| $body:expr) => {
        written_out!(@ $end, $k, $body, 1 2 3 4 5 6 7 8 9 10 11 12);
        for $k in if N::LANES { 13 } else { 1 }..$end {
            $body;
        }
    };
    (@ $end:expr, $k:ident, $body:expr, $($index:literal)*) => {
        $(if N::LANES && $index < $end {
            let $k: usize = $index;
            $body;
        })*
    };
}

/// Coefficients of u(tau) and of u'(tau) about the step's start, `LEN` of
/// each (order `LEN - 1` in both).
///
/// The first derivative of the velocity is A sin u - B cos u, from
/// `sine_cosine` of the start; the others are those of S - f C, and the
/// series of S = sin(u - alpha) and C = cos(u - alpha) follow from S' = u' C
/// and C' = -u' S. For Eq. 2, u'' = u - B.
#[inline(always)]
pub(crate) fn expand<N: Number, const LEN: usize, const F: usize>(
    model: Model,
    u: N,
    w: N,
    drive: &Drive<N, F>,
    sine_cosine: (N, N),
) -> ([N; LEN], [N; LEN]) {
    match model {
        Model::Nonlinear => nonlinear(u, w, drive, sine_cosine),
        Model::Linearized => linearized(u, w, drive),
    }
}

#[inline(always)]
fn nonlinear<N: Number, const LEN: usize, const F: usize>(
    u: N,
    w: N,
    drive: &Drive<N, F>,
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
    series.velocity[1] = (-drive.b).mul_add(cosine, drive.a * sine);
    series.c[2] = series.velocity[1] * N::ratio(1, 2);
    let (across, along) = (drive.sine, drive.cosine);
    series.sine[0] = (-cosine).mul_add(across, sine * along);
    series.cosine[0] = sine.mul_add(across, cosine * along);
    written_out!(1..LEN - 1, |k| series.extend(k, &drive.f));
    (series.c, series.velocity)
}

/// Series of u, u', sin(u - alpha) and cos(u - alpha).
struct Series<N, const LEN: usize> {
    c: [N; LEN],
    velocity: [N; LEN],
    sine: [N; LEN],
    cosine: [N; LEN],
}

impl<N: Number, const LEN: usize> Series<N, LEN> {
    /// Sine and cosine of order `k`, at least 1, and velocity of the next.
    #[inline(always)]
    fn extend<const F: usize>(&mut self, k: usize, f: &[N; F]) {
        // In every sum the terms that are known last come last: the sums
        // wait for nothing else.
        let Self { c, velocity, sine, cosine } = self;
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
        let mut force = sine[k];
        for j in (0..F.min(k + 1)).rev() {
            force = (-f[j]).mul_add(cosine[k - j], force);
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
    drive: &Drive<N, F>,
) -> ([N; LEN], [N; LEN]) {
    let mut c = [N::zero(); LEN];
    let mut velocity = [N::zero(); LEN];
    c[0] = u;
    c[1] = w;
    velocity[0] = w;
    let mut extend = |k: usize| {
        let force = match k {
            0 => c[0] - drive.b,
            _ if k < F => c[k] - drive.f[k],
            _ => c[k],
        };
        velocity[k + 1] = force * N::ratio(1, k as i32 + 1);
        if k + 2 < LEN {
            c[k + 2] = velocity[k + 1] * N::ratio(1, k as i32 + 2);
        }
    };
    extend(0);
    written_out!(1..LEN - 1, |k| extend(k));
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
