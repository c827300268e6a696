//! The scalar root finder's plain cases, in lanes: the same operations in
//! the same order.

use crate::integrator::roots::{NEAR_END, NEWTON_LIMIT, SURELY, bends, guess};
use crate::integrator::taylor::{size_at, slope, value};
use crate::number::Real;
use crate::number::lanes::{Mask, Simd};

/// First descents of polynomials over a length, if they are certain.
pub(super) struct Descent<T> {
    /// Lanes without a descent.
    pub none: T,
    /// Lanes with one descent.
    pub one: T,
    /// Lanes whose polynomial falls all the way.
    pub falls: T,
}

/// First descents that need no isolation.
#[inline(always)]
pub(super) fn descent<V: Simd, const SIZE: usize>(
    q: &[V; SIZE],
    length: V,
) -> Descent<V::Mask> {
    let zero = V::zero();
    let rest = size_at(&q[2..], length);
    let (steep, bent) = bends(q, length);
    let begins = zero.lt(q[0]);
    let falling = q[1].lt(zero).select(q[1], zero);
    let low = falling.mul_add(length, q[0]);
    let positive = zero.lt(low - rest * length * length);

    let falls = q[1].lt(steep * length * V::from_f64(SURELY));
    let twice = q[2] + q[2];
    let concave = twice.lt(bent * length * V::from_f64(SURELY));
    let end = value(q, length);
    let size = q[0].abs() + q[1].abs() * length;
    let clear = (size * V::from_f64(NEAR_END)).lt(end.abs());
    let certain = falls.or(concave).and(clear);
    let below = certain.and(end.lt(zero));
    Descent {
        none: begins.and(positive.or(certain.but_not(below))),
        one: begins.and(below).but_not(positive),
        falls,
    }
}

/// The roots in (0, high) of polynomials that have one.
#[inline(always)]
pub(super) fn refine<V: Simd, const SIZE: usize>(
    q: &[V; SIZE],
    high: V,
    which: V::Mask,
) -> V {
    let half = V::ratio(1, 2);
    let zero = V::zero();
    let (mut low, mut high) = (zero, high);
    let guess = guess(q);
    let inside = low.lt(guess).and(guess.lt(high));
    let mut tau = inside.select(guess, half * (low + high));
    let mut open = which;
    for _ in 0..NEWTON_LIMIT {
        if !open.any() {
            break;
        }
        let here = value(q, tau);
        let above = zero.lt(here);
        let under = here.lt(zero);
        low = open.and(above).select(tau, low);
        high = open.and(under).select(tau, high);
        open = open.and(above.or(under));
        let step = here / slope(q, tau);
        let next = tau - step;
        let bound = tau.abs() * V::from_f64(f64::NEWTON_STEP);
        let close = step.abs().le(bound);
        let within = low.le(next).and(next.le(high));
        let done = open.and(close).and(within);
        tau = done.select(next, tau);
        open = open.but_not(done);
        let wide = (high * V::from_f64(2.0 * f64::ROUNDOFF)).lt(high - low);
        tau = open.but_not(wide).select(high, tau);
        open = open.and(wide);
        let inside = low.lt(next).and(next.lt(high));
        let next = inside.select(next, half * (low + high));
        tau = open.select(next, tau);
    }
    tau
}

#[cfg(test)]
mod tests;
