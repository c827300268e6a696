//! Eight lanes in whose steps something may happen, solved together.
//!
//! The decisions are those of the scalar driver and its root finder, by the
//! same operations in the same order; a lane whose step needs more than one
//! plain impact is left to them.

use crate::integrator::class::is_fixed;
use crate::integrator::driver::last_term;
use crate::integrator::dynamics::{Drive, Model, curvature};
use crate::integrator::pool::chatter::{ChatterLanes, restoring};
use crate::integrator::pool::group::LaneGroup;
use crate::integrator::pool::roots::{descent, refine};
use crate::integrator::pool::slot::Slot;
use crate::integrator::pool::waiting::{Lane, LaneQueue};
use crate::integrator::pool::{GROUPS, SAFETY, SMALL};
use crate::integrator::screen::{Landing, PROPAGATION, Screen, ScreenLeg};
use crate::integrator::taylor::{TaylorSeries, expand, total, value};
use crate::number::lanes::{Lanes, Mask, Simd, WIDTH};

/// A bit for each lane of a batch.
type Bits = u8;

/// Lanes gathered from the groups.
#[derive(Default)]
pub(super) struct LaneBatch {
    pub lanes: [Lane; WIDTH],
    pub count: usize,
    u: Lanes,
    w: Lanes,
    here: Lanes,
    ahead: Lanes,
    offset: Lanes,
    amplitude: Lanes,
    whole: Lanes,
    inverse: Lanes,
    threshold: Lanes,
    sine: Lanes,
    cosine: Lanes,
    peak: Lanes,
    limit: Lanes,
    eta: Lanes,
    alpha: Lanes,
    /// Velocity below which a block that leaves the base need not be followed.
    fastest: Lanes,
    /// The rough certificates.
    uu: Lanes,
    uw: Lanes,
    ww: Lanes,
    doubt: Lanes,
}

/// What became of the lanes of a batch.
#[derive(Default)]
pub(super) struct BatchSolution {
    pub lanes: [Lane; WIDTH],
    pub count: usize,
    /// Not solved: left to the scalar driver.
    pub left: Bits,
    /// Not solved: for the longest series.
    pub hard: Bits,
    /// An impact; the others reach the end of the sample.
    pub impact: Bits,
    /// An impact with which the block comes to rest, `rest` after it.
    pub rested: Bits,
    pub rest: Lanes,
    /// An impact after which outcome and peak are known.
    pub settled: Bits,
    /// The short series was tried before the longest.
    pub again: Bits,
    /// The block turned, at `top` after `turn`.
    pub turned: Bits,
    pub turn: Lanes,
    pub top: Lanes,
    pub u: Lanes,
    pub w: Lanes,
    pub here: Lanes,
    pub offset: Lanes,
    pub amplitude: Lanes,
    /// Speed before the impact, and the forcing on the side before it.
    speed: Lanes,
    f: Lanes,
    /// The rough certificates; their sums after impacts.
    pub uu: Lanes,
    pub uw: Lanes,
    pub ww: Lanes,
    pub doubt: Lanes,
}

/// A turning point of a step, after the part `x`.
struct TurningLanes<V: Simd> {
    /// There surely is a highest rotation, or a lowest.
    top: V::Mask,
    low: V::Mask,
    x: V,
    /// It takes more to tell.
    unsure: V::Mask,
}

/// The first impact of a step.
struct FirstImpact<V: Simd> {
    /// There surely is one, after the part `x`.
    found: V::Mask,
    x: V,
    /// It takes more to tell.
    unsure: V::Mask,
    /// Lower bound of the rotation.
    lowest: V,
}

impl LaneBatch {
    /// Takes up to eight lanes out of a queue; those beyond have no meaning.
    pub fn gather<'a, T>(
        &mut self,
        queue: &mut LaneQueue,
        groups: &mut [LaneGroup<'a>; GROUPS],
        slots: &mut [Option<Slot<'a, T>>],
    ) {
        (self.lanes, self.count) = queue.take();
        let out = self;
        let lanes = out.lanes;
        for (i, id) in lanes.iter().take(out.count).enumerate() {
            let (group, lane) = (&mut groups[id.group()], id.lane());
            out.u[i] = group.u[lane];
            out.w[i] = group.w[lane];
            out.here[i] = group.here[lane];
            out.ahead[i] = group.ahead(lane);
            out.offset[i] = group.offset[lane];
            out.amplitude[i] = group.amplitude[lane];
            out.whole[i] = group.whole[lane];
            out.inverse[i] = group.inverse[lane];
            out.threshold[i] = group.threshold[lane];
            out.sine[i] = group.sine[lane];
            out.cosine[i] = group.cosine[lane];
            out.peak[i] = group.peak[lane];
            out.limit[i] = group.limit[lane];
            out.eta[i] = group.eta[lane];
            out.alpha[i] = group.alpha[lane];
            out.uu[i] = group.uu[lane];
            out.uw[i] = group.uw[lane];
            out.ww[i] = group.ww[lane];
            out.doubt[i] = group.doubt[lane];
            let slot = slots[id.slot()].as_mut();
            out.fastest[i] =
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
        let (u, w) = (V::load(&self.u), V::load(&self.w));
        let (here, ahead) = (V::load(&self.here), V::load(&self.ahead));
        let (whole, offset) = (V::load(&self.whole), V::load(&self.offset));
        let h = whole - offset;
        let rate = (ahead - here) * V::load(&self.inverse);
        let forcing = [rate.mul_add(offset, here), rate];
        let threshold = V::load(&self.threshold);
        let cosine = V::load(&self.cosine);
        let sine = V::load(&self.sine);
        let constants = (threshold, sine, cosine);
        let drive = Drive::new(model, constants, forcing);
        let small = match model {
            Model::Nonlinear => u.sin_cos_small(),
            Model::Linearized => (u, V::one()),
        };
        let TaylorSeries { mut c, mut v }: TaylorSeries<V, SIZE> =
            expand(model, (u, w), h, &drive, small);
        // Beyond it the driver takes other functions.
        let large = match model {
            Model::Nonlinear => all.but_not(u.lt(V::from_f64(SMALL))),
            Model::Linearized => none,
        };
        let mut left = large;
        let (tolerance, alpha) =
            (V::from_f64(tolerance), V::load(&self.alpha));
        let allowed = tolerance * alpha.mul_add(h, w.abs());
        let last = last_term(v[LEN - 1].abs(), h);
        let again = allowed.lt(last);
        // What is not a number is left to the driver.
        left = left.or(last.le(allowed).or(again).not());
        let mut hard = none;
        if SIZE > LEN {
            // Where the class' own series is enough, it is it.
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
        let amplitude = V::load(&self.amplitude);
        let screen = Screen {
            uu: V::load(&self.uu),
            uw: V::load(&self.uw),
            ww: V::load(&self.ww),
            ..Screen::at_rest()
        };
        let curvature = curvature(model, &drive, small);
        let size = alpha + forcing[0].abs();
        let last = is_fixed(LEN, HARD).then_some(v[LEN - 1]);
        let fly = |tau, (u, w), out: &mut BatchSolution| {
            let flown = ScreenLeg { tau, curvature, u, w, size, last };
            let there = screen.fly(&flown);
            there.uu.store(&mut out.uu);
            there.uw.store(&mut out.uw);
            there.ww.store(&mut out.ww);
        };
        if FREE {
            out.left = left.but_not(hard).bits();
            (out.impact, out.turned) = (0, 0);
            (out.rested, out.settled) = (0, 0);
            let end_w = total(&v);
            let end_u = total(&c);
            fly(h, (end_u, end_w), out);
            end_u.store(&mut out.u);
            end_w.store(&mut out.w);
            ahead.store(&mut out.here);
            amplitude.store(&mut out.amplitude);
            zero.store(&mut out.offset);
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
        let eta = V::load(&self.eta);
        let w = eta * fall.select(-end_w, zero);
        let there = offset + x * h;
        let rest = whole - there;
        // Neither a step of no length nor an impact of no speed is one here.
        let plain = there.lt(whole).and(zero.lt(w));
        left = left.or(impact.but_not(plain));
        let peak = V::load(&self.peak);
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
        impact.select(zero, end_u).store(&mut out.u);
        impact.select(w, end_w).store(&mut out.w);
        impact.select(-here, ahead).store(&mut out.here);
        impact.select(there, zero).store(&mut out.offset);
        impact.select(-amplitude, amplitude).store(&mut out.amplitude);
    }

    /// The rough certificates after the impacts of what was solved.
    #[inline(always)]
    pub fn land<V: Simd>(&self, model: Model, out: &mut BatchSolution) {
        let (threshold, cosine) =
            (V::load(&self.threshold), V::load(&self.cosine));
        let f = V::load(&out.f);
        let landing = Landing {
            speed: V::load(&out.speed),
            before: -restoring(model, threshold, cosine, f),
            after: -restoring(model, threshold, cosine, -f),
            eta: V::load(&self.eta),
            alpha: V::load(&self.alpha),
        };
        let screen = Screen {
            uu: V::load(&out.uu),
            uw: V::load(&out.uw),
            ww: V::load(&out.ww),
            doubt: V::load(&self.doubt),
            peak: V::zero(),
        };
        let there = screen.land(&landing);
        there.doubt.store(&mut out.doubt);
        // The others have flown to the end of the sample.
        let impact = V::Mask::of(out.impact);
        impact.select(there.uu, screen.uu).store(&mut out.uu);
        impact.select(there.uw, screen.uw).store(&mut out.uw);
        impact.select(there.ww, screen.ww).store(&mut out.ww);
    }

    /// The first impact, as the driver and its root finder see it.
    #[inline(always)]
    fn first_impact<V: Simd, const SIZE: usize>(
        &self,
        c: &[V; SIZE],
    ) -> FirstImpact<V> {
        let (zero, one) = (V::zero(), V::one());
        let mut rest = zero;
        for k in (2..SIZE).rev() {
            rest = rest + c[k].abs();
        }
        let falling = c[1].lt(zero);
        let down = falling.select(c[1], zero);
        let up = falling.select(zero, c[1]);
        let at_base = c[0].eq(zero);
        let clear_of_base =
            rest.lt(c[0] + down).or(at_base.and(rest.lt(c[1])));
        let clear_of_limit = (c[0] + up + rest).lt(V::load(&self.limit));

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
        let (mut rest, mut variation) = (zero, zero);
        for k in (1..SIZE).rev() {
            if k > 1 {
                rest = rest.mul_add(x, c[k].abs());
            }
            variation = variation.mul_add(x, v[k].abs());
        }
        let rise = zero.lt(c[1]).select(c[1] * x, zero);
        let high = c[0] + rise + rest * x * x;
        let goes_on = (variation * x).lt(v[0].abs());
        let may = V::load(&self.peak).lt(high).but_not(goes_on);
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
