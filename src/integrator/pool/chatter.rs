//! The driver's proof that a chatter ends, in lanes: the same operations in
//! the same order.

use crate::integrator::dynamics::{Model, restoring};
use crate::number::lanes::{Mask, Simd};

/// Blocks in lanes just after an impact.
pub(super) struct ChatterLanes<V> {
    pub model: Model,
    pub threshold: V,
    pub cosine: V,
    pub eta: V,
    /// Forcing on the new side, and its rate on either.
    pub f: V,
    pub rate: V,
    /// Speed, above zero.
    pub w: V,
    /// Time to the end of the sample.
    pub left: V,
    /// Largest rotation so far.
    pub peak: V,
}

impl<V: Simd> ChatterLanes<V> {
    /// The blocks of `which` whose impacts provably accumulate within the
    /// sample, and the time that this takes.
    #[inline(always)]
    pub fn come_to_rest(&self, which: V::Mask) -> (V::Mask, V) {
        let (zero, one) = (V::zero(), V::one());
        let Self { eta, f, rate, w, left, .. } = *self;
        let size = f.abs();
        let guess = (w + w) / (self.restoring(-size) * (one - eta));
        let may = which
            .and(zero.lt(self.threshold - size))
            .and(eta.lt(one))
            .and(guess.lt(left));
        if !may.any() {
            return (may, zero);
        }
        let two = V::ratio(2, 1);
        let window = two * guess;
        let window = window.lt(left).select(window, left);
        let drift = rate.abs() * window;
        let least = self.restoring(-(size + drift));
        let ends = may.and(zero.lt(least));
        let rise = w * w / least;
        let push = (one + self.threshold) * (rise + rise);
        let least = least - push;
        let ends = ends.and(zero.lt(least));
        let here = self.unevenness(f, drift, push);
        let there = self.unevenness(-f, drift, push);
        let worst = there.lt(here).select(here, there);
        let decay = eta * worst.sqrt();
        let bound = two * w * worst.sqrt() / (least * (one - decay));
        let top = w * w / (two * least) * worst;
        let ends = ends
            .and(decay.lt(one))
            .and(bound.lt(window))
            .and(top.lt(self.peak));
        let (up, down) = (self.restoring(f), self.restoring(-f));
        let hops = one / up + eta / down;
        (ends, two * w * hops / (one - eta * eta))
    }

    /// Largest over least downward acceleration, about forcing `f`.
    #[inline(always)]
    fn unevenness(&self, f: V, drift: V, push: V) -> V {
        let most = self.restoring(f + drift) + push;
        let low = self.restoring(f - drift) - push;
        most / low
    }

    /// Downward acceleration at the base under forcing `f`.
    #[inline(always)]
    fn restoring(&self, f: V) -> V {
        restoring(self.model, self.threshold, self.cosine, f)
    }
}
