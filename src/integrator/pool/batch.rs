//! Eight lanes whose steps may meet an event, solved together.
//!
//! The decisions are those of the scalar driver and its root finder, by the
//! same operations in the same order. A lane whose step needs more than one
//! plain impact is left to the scalar driver.

use crate::integrator::class::is_fixed;
use crate::integrator::driver::last_term;
use crate::integrator::dynamics::{
    Drive, Model, curvature, restoring, sine_cosine,
};
use crate::integrator::pool::chatter::ChatterLanes;
use crate::integrator::pool::group::{LaneConstants, LaneGroup, LaneMotion};
use crate::integrator::pool::roots::{descent, refine};
use crate::integrator::pool::slot::Slot;
use crate::integrator::pool::waiting::{Lane, LaneQueue};
use crate::integrator::pool::{GROUPS, SAFETY, SMALL};
use crate::integrator::screen::{Landing, PROPAGATION, ScreenLeg};
use crate::integrator::taylor::{
    TaylorSeries, expand, size, size_at, total, value,
};
use crate::number::lanes::{Lanes, Mask, Simd, WIDTH};

/// A bit for each lane of a batch.
type Bits = u8;

/// Lanes gathered from the groups.
#[derive(Default)]
pub(super) struct LaneBatch {
    pub lanes: [Lane; WIDTH],
    pub count: usize,
    motion: LaneMotion,
    fixed: LaneConstants,
    ahead: Lanes,
    /// Velocity below which a block that leaves the base need not be followed.
    fastest: Lanes,
}

/// Result of a batch.
#[derive(Default)]
pub(super) struct BatchSolution {
    pub lanes: [Lane; WIDTH],
    pub count: usize,
    /// Lanes not solved: left to the scalar driver.
    pub left: Bits,
    /// Lanes not solved: for the longest series.
    pub hard: Bits,
    /// Lanes with an impact; the others reach the end of the sample.
    pub impact: Bits,
    /// Lanes whose block comes to rest `rest` after the impact.
    pub rested: Bits,
    pub rest: Lanes,
    /// Lanes whose outcome and peak are known after the impact.
    pub settled: Bits,
    /// Lanes that tried the short series before the longest.
    pub again: Bits,
    /// Lanes whose block turned, at `top` after `turn`.
    pub turned: Bits,
    pub turn: Lanes,
    pub top: Lanes,
    /// Motion after the step.
    pub motion: LaneMotion,
    /// Speed before the impact, and the forcing on the side before it.
    speed: Lanes,
    f: Lanes,
}

/// A turning point of a step, after the part `x`.
struct TurningLanes<V: Simd> {
    /// Lanes with a sure highest rotation, or a sure lowest one.
    top: V::Mask,
    low: V::Mask,
    x: V,
    /// Lanes that the scalar driver must decide.
    unsure: V::Mask,
}

/// The first impact of a step.
struct FirstImpact<V: Simd> {
    /// Lanes with a sure impact, after the part `x`.
    found: V::Mask,
    x: V,
    /// Lanes that the scalar driver must decide.
    unsure: V::Mask,
    /// Lower bound of the rotation.
    lowest: V,
}

impl LaneBatch {
    /// Takes up to eight lanes out of a queue; unused entries have no meaning.
    pub fn gather<'a, T>(
        &mut self,
        queue: &mut LaneQueue,
        groups: &mut [LaneGroup<'a>; GROUPS],
        slots: &mut [Option<Slot<'a, T>>],
    ) {
        (self.lanes, self.count) = queue.take();
        for (i, id) in self.lanes.iter().take(self.count).enumerate() {
            let (group, lane) = (&mut groups[id.group()], id.lane());
            self.motion.copy(i, &group.motion, lane);
            self.fixed.copy(i, &group.fixed, lane);
            self.ahead[i] = group.ahead(lane);
            let slot = slots[id.slot()].as_mut();
            self.fastest[i] =
                slot.map_or(0.0, |slot| group.fastest(lane, slot));
        }
    }

    /// Solves the steps by series of `SIZE` coefficients. The class' own
    /// length is `LEN`, its longest `HARD`. The truncation error is at most
    /// `tolerance` as a share of the velocity. `FREE` skips the search for
    /// events: the caller knows that there is none.
    #[inline(always)]
    pub fn solve<
        V: Simd,
        const LEN: usize,
        const HARD: usize,
        const SIZE: usize,
        const FREE: bool,
    >(
        &self,
        model: Model,
        tolerance: f64,
        out: &mut BatchSolution,
    ) {
        let zero = V::zero();
        let (all, none) = (V::Mask::splat(true), V::Mask::splat(false));
        let (u, w) = (V::load(&self.motion.u), V::load(&self.motion.w));
        let (here, ahead) = (V::load(&self.motion.here), V::load(&self.ahead));
        let (whole, offset) =
            (V::load(&self.fixed.whole), V::load(&self.motion.offset));
        let h = whole - offset;
        let rate = (ahead - here) * V::load(&self.fixed.inverse);
        let forcing = [rate.mul_add(offset, here), rate];
        let threshold = V::load(&self.fixed.threshold);
        let cosine = V::load(&self.fixed.cosine);
        let sine = V::load(&self.fixed.sine);
        let constants = (threshold, sine, cosine);
        let start = sine_cosine(model, u);
        let drive = Drive::new(model, constants, forcing, start);
        let TaylorSeries { mut c, mut v }: TaylorSeries<V, SIZE> =
            expand(model, (u, w), h, &drive);
        // Beyond this rotation the driver uses other functions.
        let large = match model {
            Model::Nonlinear => all.but_not(u.lt(V::from_f64(SMALL))),
            Model::Linearized => none,
        };
        let mut left = large;
        let (tolerance, alpha) =
            (V::from_f64(tolerance), V::load(&self.fixed.alpha));
        let allowed = tolerance * alpha.mul_add(h, w.abs());
        let last = last_term(v[LEN - 1].abs(), h);
        let again = allowed.lt(last);
        // NaN is left to the driver.
        left = left.or(last.le(allowed).or(again).not());
        let mut hard = none;
        if SIZE > LEN {
            // Lanes for which the series of the class is enough keep it.
            for k in LEN..SIZE {
                c[k] = again.select(c[k], zero);
                v[k] = again.select(v[k], zero);
            }
            let last = last_term(v[SIZE - 1].abs(), h);
            left = left.or(last.le(allowed).not());
        } else if LEN < HARD {
            hard = again;
        } else {
            left = left.or(again);
        }
        out.lanes = self.lanes;
        out.count = self.count;
        out.again = if SIZE > LEN { again.bits() } else { 0 };
        hard = hard.but_not(large);
        out.hard = hard.bits();
        let amplitude = V::load(&self.motion.amplitude);
        let screen = self.motion.screen::<V>();
        screen.doubt.store(&mut out.motion.doubt);
        let curvature = curvature(model, &drive);
        let size = alpha + forcing[0].abs();
        let last = is_fixed(LEN, HARD).then_some(v[LEN - 1]);
        let fly = |tau, (u, w), out: &mut BatchSolution| {
            let flown = ScreenLeg { tau, curvature, u, w, size, last };
            let there = screen.fly(&flown);
            out.motion.set_covariance(all, &there, &screen);
        };
        if FREE {
            out.left = left.but_not(hard).bits();
            (out.impact, out.turned) = (0, 0);
            (out.rested, out.settled) = (0, 0);
            let end_w = total(&v);
            let end_u = total(&c);
            fly(h, (end_u, end_w), out);
            end_u.store(&mut out.motion.u);
            end_w.store(&mut out.motion.w);
            ahead.store(&mut out.motion.here);
            amplitude.store(&mut out.motion.amplitude);
            zero.store(&mut out.motion.offset);
            return;
        }

        let first = self.first_impact(&c);
        left = left.or(first.unsure);
        let impact = first.found;
        let x = impact.select(first.x, V::one());
        let low = V::from_f64(PROPAGATION * SAFETY) * alpha;
        let near = first.lowest.lt(low).but_not(impact);
        let turning = self.turning(&c, &v, x, near);
        left = left.or(turning.unsure);
        let end_w = impact.select(value(&v, x), total(&v));
        let end_u = impact.select(value(&c, x), total(&c));
        fly(x * h, (end_u, end_w), out);
        let turn = value(&c, turning.x);
        // Near the base a lowest rotation decides something.
        left = left.or(turning.low.but_not(low.lt(turn)));

        // The impact, and whether the motion comes to rest after it.
        let fall = zero.lt(-end_w);
        let eta = V::load(&self.fixed.eta);
        let w = eta * fall.select(-end_w, zero);
        let there = offset + x * h;
        let rest = whole - there;
        // The driver makes steps of no length and impacts of no speed.
        let plain = there.lt(whole).and(zero.lt(w));
        left = left.or(impact.but_not(plain));
        let peak = V::load(&self.fixed.peak);
        let raised = turning.top.and(peak.lt(turn));
        let peak = raised.select(turn, peak);
        let settled = w.lt(V::load(&self.fastest)).but_not(raised);
        out.settled = impact.and(settled).bits();
        let f = rate.mul_add(there, here);
        fall.select(-end_w, zero).store(&mut out.speed);
        f.store(&mut out.f);
        let impacted = ChatterLanes {
            model,
            threshold,
            cosine,
            eta,
            f: -f,
            rate,
            w,
            left: rest,
            peak,
        };
        let (rested, after) = impacted.come_to_rest(impact.and(plain));
        out.rested = rested.bits();
        after.store(&mut out.rest);

        out.left = left.but_not(hard).bits();
        out.impact = impact.bits();
        out.turned = turning.top.bits();
        (turning.x * h).store(&mut out.turn);
        turn.store(&mut out.top);
        impact.select(zero, end_u).store(&mut out.motion.u);
        impact.select(w, end_w).store(&mut out.motion.w);
        impact.select(-here, ahead).store(&mut out.motion.here);
        impact.select(there, zero).store(&mut out.motion.offset);
        impact.select(-amplitude, amplitude).store(&mut out.motion.amplitude);
    }

    /// Adds the impacts of a solution to its rough certificates.
    #[inline(always)]
    pub fn land<V: Simd>(&self, model: Model, out: &mut BatchSolution) {
        let (threshold, cosine) =
            (V::load(&self.fixed.threshold), V::load(&self.fixed.cosine));
        let f = V::load(&out.f);
        let landing = Landing {
            speed: V::load(&out.speed),
            before: -restoring(model, threshold, cosine, f),
            after: -restoring(model, threshold, cosine, -f),
            eta: V::load(&self.fixed.eta),
            alpha: V::load(&self.fixed.alpha),
        };
        let screen = out.motion.screen();
        let there = screen.land(&landing);
        // The others have flown to the end of the sample.
        let impact = V::Mask::of(out.impact);
        let doubt = impact.select(there.doubt, screen.doubt);
        doubt.store(&mut out.motion.doubt);
        out.motion.set_covariance(impact, &there, &screen);
    }

    /// The first impact, as the driver and its root finder see it.
    #[inline(always)]
    fn first_impact<V: Simd, const SIZE: usize>(
        &self,
        c: &[V; SIZE],
    ) -> FirstImpact<V> {
        let (zero, one) = (V::zero(), V::one());
        let rest = size(&c[2..]);
        let falling = c[1].lt(zero);
        let down = falling.select(c[1], zero);
        let up = falling.select(zero, c[1]);
        let at_base = c[0].eq(zero);
        let clear_of_base =
            rest.lt(c[0] + down).or(at_base.and(rest.lt(c[1])));
        let clear_of_limit = (c[0] + up + rest).lt(V::load(&self.fixed.limit));

        // A start on the base is divided out.
        let mut q = *c;
        for k in 0..SIZE {
            let next = if k + 1 < SIZE { c[k + 1] } else { zero };
            q[k] = at_base.select(next, c[k]);
        }
        let descent = descent(&q, one);
        let none = clear_of_base.or(descent.none);
        let sure = clear_of_limit.and(none.or(descent.one));
        let found = sure.but_not(none);
        let x = refine(&q, one, found);
        // At the vertex of the first three terms, if they have one.
        let vertex = c[1] * c[1] / c[2] * V::from_f64(0.25 * SAFETY);
        let drop = zero.lt(c[2]).select(vertex.min(-down), -down);
        let lowest = c[0] - drop - (rest - c[2].abs());
        FirstImpact { found, x, unsure: sure.not(), lowest }
    }

    /// A turning point in the part (0, `x`) that may be above the peak, or,
    /// in lanes that are `near` the base, a lowest rotation.
    #[inline(always)]
    fn turning<V: Simd, const SIZE: usize>(
        &self,
        c: &[V; SIZE],
        v: &[V; SIZE],
        x: V,
        near: V::Mask,
    ) -> TurningLanes<V> {
        let zero = V::zero();
        let (rest, variation) = (size_at(&c[2..], x), size_at(&v[1..], x));
        let rise = zero.lt(c[1]).select(c[1] * x, zero);
        let high = c[0] + rise + rest * x * x;
        let goes_on = (variation * x).lt(v[0].abs());
        let may = V::load(&self.fixed.peak).lt(high).but_not(goes_on);
        let sinking = v[0].lt(zero);
        let dips = near.and(sinking).but_not(goes_on);
        let asked = may.or(dips);
        if !asked.any() {
            return TurningLanes { top: may, low: may, x: zero, unsure: may };
        }
        // Only a velocity that falls all the way, or rises, turns just once.
        let mut q = *v;
        for k in 0..SIZE {
            q[k] = sinking.select(-v[k], v[k]);
        }
        let descent = descent(&q, x);
        let found = asked.and(descent.one).and(dips.or(sinking.not()));
        let turn = refine(&q, x, found);
        let found = found.and(turn.lt(x));
        let (top, low) = (found.but_not(sinking), found.and(sinking));
        // One that sinks may turn upwards, and if so does not turn back.
        let none = descent.none.or(top).or(sinking.and(descent.falls));
        let unsure = may.but_not(none);
        let unsure = unsure.or(dips.but_not(descent.none.or(low)));
        TurningLanes { top, low, x: turn, unsure }
    }
}
