//! Eight lanes in whose steps something may happen, solved together.
//!
//! The decisions are those of the scalar driver and its root finder, by the
//! same operations in the same order; a lane whose step needs more than one
//! plain impact is left to them.

use crate::integrator::SMOOTH;
use crate::integrator::driver::last_term;
use crate::integrator::dynamics::{Model, drive};
use crate::integrator::pool::group::{Group, WIDTH};
use crate::integrator::pool::{Lane, SMALL, Slot};
use crate::integrator::roots::{FALLING, NEAR_END, NEWTON_LIMIT};
use crate::integrator::taylor::{expand, slope, value};
use crate::number::lanes::{Lanes, Mask};
use crate::number::{Number, Real};

type Eight = Lanes<WIDTH>;
type Which = Mask<WIDTH>;

/// Lanes gathered from the groups.
pub(super) struct Batch {
    pub lanes: [Lane; WIDTH],
    pub count: usize,
    u: Eight,
    w: Eight,
    here: Eight,
    ahead: Eight,
    offset: Eight,
    length: Eight,
    amplitude: Eight,
    whole: Eight,
    inverse: Eight,
    threshold: Eight,
    sine: Eight,
    cosine: Eight,
    peak: Eight,
    limit: Eight,
    eta: Eight,
    /// Truncation allowed per unit of p-time.
    tolerance: Eight,
}

/// What became of the lanes of a batch.
pub(super) struct Solved {
    pub lanes: [Lane; WIDTH],
    pub count: usize,
    /// Not solved: left to the scalar driver.
    pub left: Which,
    /// Not solved: for the longest series.
    pub hard: Which,
    /// An impact; the others reach the end of the sample.
    pub impact: Which,
    /// The short series was tried before the longest.
    pub again: Which,
    pub u: Eight,
    pub w: Eight,
    pub here: Eight,
    pub offset: Eight,
    pub length: Eight,
    pub amplitude: Eight,
}

/// Coefficients of rotation and velocity.
type Series<const SIZE: usize> = ([Eight; SIZE], [Eight; SIZE]);

/// The first impact of a step.
struct FirstImpact {
    /// There surely is one, at `tau`.
    found: Which,
    tau: Eight,
    /// It takes more to tell.
    unsure: Which,
}

impl Batch {
    /// Takes up to eight lanes off a list, the longest waiting first.
    #[inline(always)]
    pub fn gather<T, const LEN: usize>(
        list: &mut Vec<Lane>,
        groups: &[Group<'_>],
        slots: &[Option<Slot<'_, T, LEN>>],
    ) -> Self {
        let zero = Lanes::splat(0.0);
        let mut out = Self {
            lanes: [Lane { group: 0, lane: 0 }; WIDTH],
            count: list.len().min(WIDTH),
            u: zero,
            w: zero,
            here: zero,
            ahead: zero,
            offset: zero,
            length: zero,
            amplitude: zero,
            whole: zero,
            inverse: zero,
            threshold: zero,
            sine: zero,
            cosine: zero,
            peak: zero,
            limit: zero,
            eta: zero,
            tolerance: zero,
        };
        for (i, id) in list.drain(..out.count).enumerate() {
            out.lanes[i] = id;
            let (group, lane) = (&groups[id.group], id.lane);
            out.u[i] = group.u[lane];
            out.w[i] = group.w[lane];
            out.here[i] = group.here[lane];
            out.ahead[i] = group.ahead(lane);
            out.offset[i] = group.offset[lane];
            out.length[i] = group.length[lane];
            out.amplitude[i] = group.amplitude[lane];
            out.whole[i] = group.whole[lane];
            out.inverse[i] = group.inverse[lane];
            out.threshold[i] = group.threshold[lane];
            out.sine[i] = group.sine[lane];
            out.cosine[i] = group.cosine[lane];
            out.peak[i] = group.peak[lane];
            if let Some(slot) = &slots[id.slot()] {
                let dynamics = slot.driver.dynamics();
                out.limit[i] = dynamics.limit;
                out.eta[i] = dynamics.eta;
                out.tolerance[i] = slot.driver.tolerance();
            }
        }
        out
    }

    /// Solves the steps by series of `SIZE` coefficients, the class' own
    /// being `LEN`.
    #[inline(always)]
    pub fn solve<const LEN: usize, const SIZE: usize>(
        &self,
        model: Model,
    ) -> Solved {
        let zero = Eight::zero();
        let (all, none) = (Mask::splat(true), Mask::splat(false));
        let (h, offset) = (self.length, self.offset);
        let rate = (self.ahead - self.here) * self.inverse;
        let series = [rate.mul_add(offset, self.here), rate];
        let constants = (self.threshold, self.sine, self.cosine);
        let (a, b) = drive(model, constants, &series);
        let small = match model {
            Model::Nonlinear => self.u.sin_cos_small(),
            Model::Linearized => (self.u, Number::one()),
        };
        let (mut c, mut v): Series<SIZE> =
            expand(model, self.u, self.w, (&a, &b), small);
        // Beyond it the driver takes other functions.
        let large = match model {
            Model::Nonlinear => all.but_not(self.u.below(Lanes::splat(SMALL))),
            Model::Linearized => none,
        };
        let mut left = large;
        let allowed = self.tolerance * h;
        let again = allowed.below(last_term(v[LEN - 1].abs(), LEN, h));
        let mut hard = none;
        if SIZE > LEN {
            // Where the class' own series is enough, it is it.
            for k in LEN..SIZE {
                c[k] = again.select(c[k], zero);
                v[k] = again.select(v[k], zero);
            }
            let last = last_term(v[SIZE - 1].abs(), SIZE, h);
            left = left.or(allowed.below(last));
        } else if LEN < SMOOTH {
            hard = again;
        } else {
            left = left.or(again);
        }
        let first = self.first_impact(&c);
        left = left.or(first.unsure);
        let impact = first.found;
        let tau = impact.select(first.tau, h);
        left = left.or(self.may_turn(&c, &v, tau));
        let (end_u, end_w) = (value(&c, tau), value(&v, tau));

        // The impact, and whether the motion may come to rest after it.
        let fall = zero.below(-end_w);
        let w = self.eta * fall.select(-end_w, zero);
        let there = offset + tau;
        let f = rate.mul_add(there, self.here).abs();
        let margin = self.threshold - f;
        let scale = match model {
            Model::Nonlinear => (self.threshold - f) * self.cosine,
            Model::Linearized => self.threshold - f,
        };
        let guess = (w + w) / (scale * (Eight::one() - self.eta));
        let chatter = w
            .equals(zero)
            .or(zero.below(margin).and(guess.below(self.whole - there)));
        // A step of no length is none.
        let short = there.below(self.whole);
        let settled = chatter.or(all.but_not(short));
        left = left.or(impact.and(settled));

        let hard = hard.but_not(large);
        let left = left.but_not(hard);
        Solved {
            lanes: self.lanes,
            count: self.count,
            left,
            hard,
            impact,
            again: if SIZE > LEN { again } else { none },
            u: impact.select(zero, end_u),
            w: impact.select(w, end_w),
            here: impact.select(-self.here, self.ahead),
            offset: impact.select(there, zero),
            length: impact.select(self.whole - there, self.whole),
            amplitude: impact.select(-self.amplitude, self.amplitude),
        }
    }

    /// The first impact, as the driver and its root finder see it.
    #[inline(always)]
    fn first_impact<const SIZE: usize>(
        &self,
        c: &[Eight; SIZE],
    ) -> FirstImpact {
        let zero = Eight::zero();
        let h = self.length;
        let mut rest = zero;
        for k in (2..SIZE).rev() {
            rest = rest.mul_add(h, c[k].abs());
        }
        let rest = rest * h;
        let linear = c[1] * h;
        let spread = rest * h;
        let falling = c[1].below(zero);
        let down = falling.select(linear, zero);
        let up = falling.select(zero, linear);
        let at_base = c[0].equals(zero);
        let clear_of_base =
            spread.below(c[0] + down).or(at_base.and(rest.below(c[1])));
        let clear_of_limit = (c[0] + up + spread).below(self.limit);

        // A start on the base is divided out.
        let mut q = *c;
        for k in 0..SIZE {
            let next = if k + 1 < SIZE { c[k + 1] } else { zero };
            q[k] = at_base.select(next, c[k]);
        }
        let mut rest = zero;
        let mut steep = zero;
        for k in (2..SIZE).rev() {
            let size = q[k].abs();
            rest = rest.mul_add(h, size);
            steep = steep.mul_add(h, size * Eight::ratio(k as i32, 1));
        }
        let low = q[1].below(zero).select(q[1], zero).mul_add(h, q[0]);
        let positive = zero.below(low - rest * h * h);
        let falls = q[1].below(steep * h * Lanes::splat(FALLING));
        let end = value(&q, h);
        let size = q[0].abs() + q[1].abs() * h;
        let told = falls.and((size * Lanes::splat(NEAR_END)).below(end.abs()));
        let below = told.and(end.below(zero));

        let none = clear_of_base.or(positive).or(told.but_not(below));
        let found = below.but_not(clear_of_base.or(positive));
        let known = zero.below(q[0]).and(none.or(found));
        let sure = clear_of_limit.and(known.or(clear_of_base));
        let found = found.and(sure);
        let tau = refine(&q, h, found);
        FirstImpact { found, tau, unsure: Mask::splat(true).but_not(sure) }
    }

    /// Lanes in which the block may turn above its peak before `tau`.
    #[inline(always)]
    fn may_turn<const SIZE: usize>(
        &self,
        c: &[Eight; SIZE],
        v: &[Eight; SIZE],
        tau: Eight,
    ) -> Which {
        let zero = Eight::zero();
        let mut rest = zero;
        let mut variation = zero;
        for k in (1..SIZE).rev() {
            if k > 1 {
                rest = rest.mul_add(tau, c[k].abs());
            }
            variation = variation.mul_add(tau, v[k].abs());
        }
        let rise = zero.below(c[1]).select(c[1] * tau, zero);
        let high = c[0] + rise + rest * tau * tau;
        self.peak.below(high).but_not((variation * tau).below(v[0].abs()))
    }
}

/// The roots in (0, high) of polynomials that fall from above zero to below
/// it, by the scalar root finder's iteration.
#[inline(always)]
fn refine<const SIZE: usize>(
    q: &[Eight; SIZE],
    high: Eight,
    which: Which,
) -> Eight {
    let half = Eight::ratio(1, 2);
    let zero = Eight::zero();
    let (mut low, mut high) = (zero, high);
    let mut tau = half * (low + high);
    let mut open = which;
    for _ in 0..NEWTON_LIMIT {
        if !open.any() {
            break;
        }
        let here = value(q, tau);
        let above = zero.below(here);
        let under = here.below(zero);
        low = open.and(above).select(tau, low);
        high = open.and(under).select(tau, high);
        open = open.and(above.or(under));
        let step = here / slope(q, tau);
        let next = tau - step;
        let inside = low.below(next).and(next.below(high));
        let bound = tau.abs() * Lanes::splat(f64::NEWTON_STEP);
        let done = open.and(inside).but_not(bound.below(step.abs()));
        tau = done.select(next, tau);
        open = open.but_not(done);
        let wide =
            (high * Lanes::splat(2.0 * f64::ROUNDOFF)).below(high - low);
        let narrow = open.but_not(wide);
        tau = narrow.select(high, tau);
        open = open.and(wide);
        let next = inside.select(next, half * (low + high));
        tau = open.select(next, tau);
    }
    tau
}
