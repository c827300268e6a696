//! Roots of a step's polynomial: isolated first, refined afterwards.
//!
//! Signs at the ends of a step say nothing about what happens inside: two
//! impacts can lie within one sample. Sign variations of the Bernstein
//! coefficients bound the number of roots (Descartes). If more than one is
//! possible, the interval is halved until each root is isolated.

use crate::integrator::taylor::{size_at, slope, value};
use crate::number::dispatch::{Isa, Kernel};
use crate::number::{Number, Real};

/// Depth at which a pair of roots that halving could not tell apart counts
/// as contact without crossing: 48 in double precision, a few bits short of
/// the type's.
fn depth<N: Real>() -> u32 {
    (-libm::ilogb(N::ROUNDOFF) - 5).unsigned_abs()
}

/// A derivative surely keeps its sign if its value at the start is below this
/// many times the largest sum of its other terms.
pub(crate) const SURELY: f64 = -1.01;

/// Share of its size below which the sign of an end is not certain.
pub(crate) const NEAR_END: f64 = 1e-11;

/// Newton's iterations at most.
pub(crate) const NEWTON_LIMIT: usize = 200;

/// Largest degree plus one of a polynomial here.
pub(crate) const MOST: usize = 64;

/// First tau in (0, length] at which the polynomial, positive just after 0,
/// ceases to be positive.
///
/// Zero leading coefficients are divided out first: a step may start on the
/// event (a simple zero after an impact, a triple one after an uplift). A
/// polynomial that is not positive just after 0 has its root at 0.
#[inline(always)]
pub(crate) fn first_descent<N: Real>(
    c: &[N],
    length: N,
    isa: Isa,
) -> Option<N> {
    let start = c.iter().position(|x| *x != N::zero())?;
    let c = &c[start..];
    if !(c[0] > N::zero()) {
        return Some(N::zero());
    }
    if surely_positive(c, length) {
        return None;
    }
    isolate(c, length, isa)
}

/// True if |c_1| L + |c_2| L^2 + ... cannot outweigh the terms that keep the
/// polynomial positive.
#[inline(always)]
pub(crate) fn surely_positive<N: Real>(c: &[N], length: N) -> bool {
    let [start, slope, ref beyond @ ..] = *c else { return true };
    let rest = size_at(beyond, length);
    let low = (-(-slope).positive_part()).mul_add(length, start);
    low - rest * length * length > N::zero()
}

/// Isolates the first root and refines it with the instructions of the level.
#[inline(never)]
fn isolate<N: Real>(c: &[N], length: N, isa: Isa) -> Option<N> {
    isa.run(Isolation { c, length })
}

struct Isolation<'c, N> {
    c: &'c [N],
    length: N,
}

impl<N: Real> Kernel for Isolation<'_, N> {
    type Output = Option<N>;

    #[inline(always)]
    fn run(self) -> Option<N> {
        let Self { c, length } = self;
        if let Some(below) = ends_below(c, length) {
            return below.then(|| refine(c, N::zero(), length, guess(c)));
        }
        let n = c.len() - 1;
        // Bernstein coefficients on [0, length]:
        // b_j = sum_{k<=j} C(j,k)/C(n,k) c_k length^k.
        let mut b = [N::zero(); MOST];
        let mut power = N::one();
        let mut binomial = N::one();
        for k in 0..=n {
            b[k] = c[k] * power / binomial;
            power = power * length;
            binomial = binomial * N::ratio((n - k) as i32, k as i32 + 1);
        }
        // Repeated sums turn scaled powers into Bernstein coefficients.
        for round in 1..=n {
            for j in (round..=n).rev() {
                b[j] = b[j] + b[j - 1];
            }
        }
        let ends = (N::zero(), N::one());
        let (low, high) = search(&mut b[..=n], ends, depth::<N>())?;
        let (low, high) = (length * low, length * high);
        // Isolation may have taken a near miss for a contact.
        let is_root = !(value(c, high) > N::zero());
        is_root.then(|| refine(c, low, high, guess(c)))
    }
}

/// Start of Newton's iteration: the root of the first three terms, corrected
/// by the next two.
#[inline(always)]
pub(crate) fn guess<N: Number>(c: &[N]) -> N {
    let [start, slope, bend, ..] = *c else { return N::zero() };
    let root = (slope * slope - N::from_f64(4.0) * start * bend).sqrt();
    let tau = (start + start) / (root - slope);
    // If a start on the event was divided out, there may be no fourth term.
    let [_, _, _, third, ref beyond @ ..] = *c else { return tau };
    let fourth = beyond.first().copied().unwrap_or(N::zero());
    let beyond = fourth.mul_add(tau, third) * (tau * tau);
    let steep =
        fourth.mul_add(N::from_f64(4.0) * tau, N::from_f64(3.0) * third);
    let steep = steep.mul_add(tau, bend + bend).mul_add(tau, slope);
    tau - beyond * tau / steep
}

/// Whether a polynomial that is positive at its start and surely falls, or is
/// surely concave, ends below zero. `None` if it may be neither, or ends too
/// near to zero to tell.
///
/// Below zero it has one root, and its ends enclose it.
#[inline(always)]
pub(crate) fn ends_below<N: Real>(c: &[N], length: N) -> Option<bool> {
    if c.len() < 3 {
        return None;
    }
    let (steep, bent) = bends(c, length);
    let falls = c[1] < steep * length * N::from_f64(SURELY);
    let twice = c[2] + c[2];
    if !(falls || twice < bent * length * N::from_f64(SURELY)) {
        return None;
    }
    let end = value(c, length);
    let size = c[0].abs() + c[1].abs() * length;
    if !(end.abs() > size * N::from_f64(NEAR_END)) {
        return None;
    }
    Some(end < N::zero())
}

/// Sizes, at `length`, of the terms that bend the derivative of a polynomial
/// and its second derivative: sums of k |c_k| length^(k-2) from k = 2, and of
/// k (k-1) |c_k| length^(k-3) from k = 3.
#[inline(always)]
pub(crate) fn bends<N: Number>(c: &[N], length: N) -> (N, N) {
    let (mut steep, mut bent) = (N::zero(), N::zero());
    for k in (2..c.len()).rev() {
        let slope = c[k].abs() * N::ratio(k as i32, 1);
        steep = steep.mul_add(length, slope);
        if k > 2 {
            bent = bent.mul_add(length, slope * N::ratio(k as i32 - 1, 1));
        }
    }
    (steep, bent)
}

/// Leftmost isolating interval in units of the whole, positive at its left
/// end.
fn search<N: Real>(
    b: &mut [N],
    (low, high): (N, N),
    depth: u32,
) -> Option<(N, N)> {
    let zero = N::zero();
    let (mut variations, mut last) = (0, None);
    for sign in b.iter().filter(|x| **x != zero).map(|x| *x > zero) {
        let before = last.replace(sign);
        variations += u32::from(before.is_some_and(|before| before != sign));
    }
    let end = b[b.len() - 1];
    let ends_here = match variations {
        0 => end == zero,
        // One crossing; positive on the left, so the right end is below.
        1 => true,
        _ if depth == 0 => !(end > zero),
        _ => false,
    };
    if ends_here || variations == 0 || depth == 0 {
        return ends_here.then_some((low, high));
    }
    // De Casteljau at the middle.
    let n = b.len() - 1;
    let half = N::ratio(1, 2);
    let mut left = [zero; MOST];
    for (k, first) in left.iter_mut().enumerate().take(n + 1) {
        *first = b[0];
        for j in 0..n - k {
            b[j] = half * (b[j] + b[j + 1]);
        }
    }
    // `b[j]` now holds the diagonal from the middle to the end.
    let middle = half * (low + high);
    search(&mut left[..=n], (low, middle), depth - 1)
        .or_else(|| search(b, (middle, high), depth - 1))
}

/// The root in [low, high] by Newton's iteration from a guess, inside a
/// bracket whose left end is positive and whose right end is not.
#[inline(always)]
pub(crate) fn refine<N: Real>(
    c: &[N],
    mut low: N,
    mut high: N,
    guess: N,
) -> N {
    let half = N::ratio(1, 2);
    let inside = guess > low && guess < high;
    let mut tau = if inside { guess } else { half * (low + high) };
    for _ in 0..NEWTON_LIMIT {
        let here = value(c, tau);
        if here > N::zero() {
            low = tau;
        } else if here < N::zero() {
            high = tau;
        } else {
            return tau;
        }
        let step = here / slope(c, tau);
        let next = tau - step;
        // A step below the last digit ends on the bracket.
        let close = step.abs() <= tau.abs() * N::from_f64(N::NEWTON_STEP);
        if close && next >= low && next <= high {
            return next;
        }
        let inside = next > low && next < high;
        let width = high - low;
        let next = if inside { next } else { half * (low + high) };
        if !(width > high * N::from_f64(2.0 * N::ROUNDOFF)) {
            return high;
        }
        tau = next;
    }
    tau
}

#[cfg(test)]
mod tests;
