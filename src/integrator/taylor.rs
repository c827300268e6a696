//! One step: the Taylor polynomial of the motion about its start.

use crate::integrator::dynamics::{Drive, Model};
use crate::number::Number;

/// A loop from 1 that is unrolled for double precision, in single runs and in
/// lanes. Compilers do not unroll loops of this length, and the coefficients
/// then do not stay in registers. A single run takes 0.7 of the time at order
/// 8.
macro_rules! written_out {
    (1..$end:expr, |$k:ident| $body:expr) => {
        written_out!(@ $end, $k, $body, 1 2 3 4 5 6 7 8 9 10 11 12);
        for $k in if N::WRITTEN_OUT { 13 } else { 1 }..$end {
            $body;
        }
    };
    (@ $end:expr, $k:ident, $body:expr, $($index:literal)*) => {
        $(if N::WRITTEN_OUT && $index < $end {
            let $k: usize = $index;
            $body;
        })*
    };
}

/// Factor on a sum of positive terms in double precision that makes it a bound.
const CLOSE: f64 = 1.0 + 1e-12;

/// Number of the coefficients, of `length` of them, that need all digits if
/// the next coefficient after them is below the roundoff: the others are so
/// small that half of the digits suffice. It matters in graded arithmetic.
#[inline(always)]
pub(crate) const fn fine(length: usize) -> usize {
    let less = length.saturating_sub(6);
    if less > 3 { less } else { 3 }
}

/// Arithmetic of coefficient `order` of `length`: with all digits, or graded.
#[derive(Clone, Copy)]
struct Grade {
    is_fine: bool,
}

impl Grade {
    #[inline(always)]
    fn of<N: Number>(order: usize, length: usize) -> Self {
        Self { is_fine: !N::IS_GRADED || order < fine(length) }
    }

    /// Adds a product to a sum of products.
    #[inline(always)]
    fn add<N: Number>(self, a: N, b: N, sum: N) -> N {
        match self.is_fine {
            true => a.add_product(b, sum),
            false => a.rough_product(b, sum),
        }
    }

    /// The product of a sum of products and a number.
    #[inline(always)]
    fn times<N: Number>(self, sum: N, b: N) -> N {
        match self.is_fine {
            true => sum.ordered() * b,
            false => sum.rough_product(b, N::zero()),
        }
    }
}

/// Polynomials of a step in units of its length h: u(x h) and u'(x h) for x
/// in [0, 1], `LEN` coefficients of each (order `LEN - 1` in both).
///
/// In these units a polynomial's value at the step's end is the sum of its
/// coefficients, and the last of them is the size of the last term.
#[derive(Clone, Copy)]
pub(crate) struct TaylorSeries<N, const LEN: usize> {
    /// Rotation.
    pub c: [N; LEN],
    /// Velocity.
    pub v: [N; LEN],
}

/// The series of a step of length `h`.
///
/// With d = u - u_0, Eq. 1 reads u'' = G cos d + H sin d, where
/// G = sin(u_0 - alpha) - f cos(u_0 - alpha) and
/// H = cos(u_0 - alpha) + f sin(u_0 - alpha) are as long as the series of f;
/// their first coefficients are A sin u_0 - B cos u_0 and
/// A cos u_0 + B sin u_0. The series of sin d and 1 - cos d follow from
/// (sin d)' = u' - u' (1 - cos d) and (1 - cos d)' = u' sin d. For Eq. 2,
/// u'' = u - B.
#[inline(always)]
pub(crate) fn expand<N: Number, const LEN: usize, const F: usize>(
    model: Model,
    (u, w): (N, N),
    h: N,
    drive: &Drive<N, F>,
) -> TaylorSeries<N, LEN> {
    match model {
        Model::Nonlinear => nonlinear((u, w), h, drive),
        Model::Linearized => linearized((u, w), h, drive),
    }
}

#[inline(always)]
fn nonlinear<N: Number, const LEN: usize, const F: usize>(
    motion: (N, N),
    h: N,
    drive: &Drive<N, F>,
) -> TaylorSeries<N, LEN> {
    let Drive { a, b, start: (sine, cosine), .. } = *drive;
    let (across, along) = (drive.sine, drive.cosine);
    let sine_0 = (-cosine).mul_add(across, sine * along);
    let cosine_0 = sine.mul_add(across, cosine * along);
    let mut force = Force { even: [N::zero(); F], odd: [N::zero(); F] };
    force.even[0] = (-b).mul_add(cosine, a * sine);
    force.odd[0] = drive.f[0].mul_add(sine_0, cosine_0);
    let mut power = h;
    for j in 1..F {
        let f = drive.f[j] * power;
        force.even[j] = -(f * cosine_0);
        force.odd[j] = f * sine_0;
        power = power * h;
    }
    let mut series = TaylorSeries::begin(motion, force.even[0], h);
    let mut turn = Turn { sine: [N::zero(); LEN], fall: [N::zero(); LEN] };
    turn.sine[1] = series.c[1];
    written_out!(1..LEN - 1, |k| {
        series.extend(k, force.order(k, &turn), h);
        turn.extend(k + 1, &series, h);
    });
    series
}

#[inline(always)]
fn linearized<N: Number, const LEN: usize, const F: usize>(
    motion: (N, N),
    h: N,
    drive: &Drive<N, F>,
) -> TaylorSeries<N, LEN> {
    let mut f = drive.f;
    let mut power = h;
    for x in &mut f[1..] {
        *x = *x * power;
        power = power * h;
    }
    let mut series = TaylorSeries::begin(motion, motion.0 - drive.b, h);
    written_out!(1..LEN - 1, |k| {
        let u = series.c[k];
        series.extend(k, if k < F { u - f[k] } else { u }, h);
    });
    series
}

/// Series of G and H.
struct Force<N, const F: usize> {
    even: [N; F],
    odd: [N; F],
}

impl<N: Number, const F: usize> Force<N, F> {
    /// Coefficient `k`, at least 1, of G cos d + H sin d.
    #[inline(always)]
    fn order<const LEN: usize>(&self, k: usize, turn: &Turn<N, LEN>) -> N {
        // In every sum the terms that are known last come last: the sums
        // wait for nothing else.
        let Self { even, odd } = self;
        let grade = Grade::of::<N>(k + 1, LEN);
        let Turn { sine, fall } = turn;
        let (mut sum, known) = if k < F {
            (even[k], k)
        } else {
            let last = F - 1;
            let mut sum = odd[last] * sine[k - last];
            if k > F {
                sum = grade.add(-even[last], fall[k - last], sum);
            }
            (sum, last)
        };
        for j in (0..known).rev() {
            if k - j > 1 {
                sum = grade.add(-even[j], fall[k - j], sum);
            }
            sum = grade.add(odd[j], sine[k - j], sum);
        }
        sum
    }
}

/// Series of sin d and 1 - cos d.
struct Turn<N, const LEN: usize> {
    sine: [N; LEN],
    fall: [N; LEN],
}

impl<N: Number, const LEN: usize> Turn<N, LEN> {
    /// Coefficient `n`, at least 2, from a motion known to it.
    #[inline(always)]
    fn extend(&mut self, n: usize, series: &TaylorSeries<N, LEN>, h: N) {
        let Self { sine, fall } = self;
        let v = &series.v;
        let grade = Grade::of::<N>(n, LEN);
        let step = grade.times(h, N::ratio(1, n as i32));
        sine[n] = series.c[n];
        if n > 2 {
            let mut sum = v[n - 3] * fall[2];
            for j in 3..n {
                sum = grade.add(v[n - 1 - j], fall[j], sum);
            }
            sine[n] = match grade.is_fine {
                true => (-sum.ordered()).mul_add(step, sine[n]),
                false => (-sum).rough_product(step, sine[n]),
            };
        }
        let mut sum = v[n - 2] * sine[1];
        for j in 2..n {
            sum = grade.add(v[n - 1 - j], sine[j], sum);
        }
        fall[n] = grade.times(sum, step);
    }
}

impl<N: Number, const LEN: usize> TaylorSeries<N, LEN> {
    /// Motion to first order, from its acceleration.
    #[inline(always)]
    fn begin((u, w): (N, N), force: N, h: N) -> Self {
        let (mut c, mut v) = ([N::zero(); LEN], [N::zero(); LEN]);
        (c[0], v[0]) = (u, w);
        (c[1], v[1]) = (w * h, force * h);
        Self { c, v }
    }

    /// Motion of order `k + 1`, at least 2, from its acceleration of order
    /// `k`.
    #[inline(always)]
    fn extend(&mut self, k: usize, force: N, h: N) {
        let grade = Grade::of::<N>(k + 1, LEN);
        let step = grade.times(h, N::ratio(1, k as i32 + 1));
        self.v[k + 1] = grade.times(force, step);
        self.c[k + 1] = grade.times(self.v[k], step);
    }

    /// The first coefficients of the series.
    #[inline(always)]
    pub fn beginning<const SHORT: usize>(&self) -> TaylorSeries<N, SHORT> {
        let of = |all: &[N; LEN]| std::array::from_fn(|k| all[k]);
        TaylorSeries { c: of(&self.c), v: of(&self.v) }
    }

    /// Motion at the end of the step.
    #[inline(always)]
    pub fn end(&self) -> (N, N) {
        (total(&self.c), total(&self.v))
    }
}

/// Value at the end of the step: the coefficients' sum, small ones first but
/// for the two that are seldom known last.
#[inline(always)]
pub(crate) fn total<N: Number, const LEN: usize>(c: &[N; LEN]) -> N {
    if N::IS_GRADED {
        let one = N::one();
        let (mut rough, mut sum) = (N::zero(), N::zero());
        for x in c[fine(LEN)..].iter().rev() {
            rough = one.rough_product(*x, rough);
        }
        for x in c[2..fine(LEN)].iter().rev() {
            sum = one.add_product(*x, sum);
        }
        return c[0] + (c[1] + one.add_product(rough, sum).ordered());
    }
    let mut sum = c[2];
    for x in &c[3..] {
        sum = sum + *x;
    }
    c[0] + (c[1] + sum)
}

/// Value of the polynomial `c` at `tau`.
#[inline(always)]
pub(crate) fn value<N: Number>(c: &[N], tau: N) -> N {
    let mut sum = c[c.len() - 1];
    for k in (0..c.len() - 1).rev() {
        sum = if k < fine(c.len()) {
            sum.mul_add(tau, c[k])
        } else {
            sum.rough_product(tau, c[k])
        };
    }
    sum
}

/// Derivative of the polynomial `c` at `tau`, in graded arithmetic to half of
/// the digits.
#[inline(always)]
pub(crate) fn slope<N: Number>(c: &[N], tau: N) -> N {
    let last = c.len() - 1;
    let mut sum = c[last] * N::ratio(last as i32, 1);
    for k in (1..last).rev() {
        sum = sum.rough_product(tau, c[k] * N::ratio(k as i32, 1));
    }
    sum
}

/// Sum of the sizes of the coefficients `c`, the last first.
#[inline(always)]
pub(crate) fn size<N: Number>(c: &[N]) -> N {
    size_at(c, N::one())
}

/// Value at `tau` of the polynomial of the sizes of the coefficients `c`, in
/// graded arithmetic a close bound on it.
#[inline(always)]
pub(crate) fn size_at<N: Number>(c: &[N], tau: N) -> N {
    let mut sum = N::zero();
    for k in (0..c.len()).rev() {
        sum = sum.rough_product(tau, c[k].abs());
    }
    if N::IS_GRADED { sum * N::from_f64(CLOSE) } else { sum }
}
