//! A group of lanes in flight, stepped together.
//!
//! # Proof P6
//!
//! `free_of_events` rests on bounds of u'' and u''' under Eqs. 1 and 2 and a
//! forcing that is linear in time.

use crate::integrator::class::is_fixed;
use crate::integrator::driver::Stage;
use crate::integrator::dynamics::{Drive, Model, curvature, sine_cosine};
use crate::integrator::pool::slot::Slot;
use crate::integrator::pool::{SAFETY, SMALL};
use crate::integrator::screen::{PROPAGATION, Screen, ScreenLeg};
use crate::integrator::taylor::{TaylorSeries, expand};
use crate::number::lanes::{Lanes, Mask, Simd, WIDTH};

/// Share of its start above which a rotation that sinks surely ends above the
/// base.
const STAYS: f64 = 1e-9;

/// Motions of blocks in lanes.
#[derive(Default)]
pub(super) struct LaneMotion {
    pub u: Lanes,
    pub w: Lanes,
    /// Forcing at the start of the sample, on the side of the rotation.
    pub here: Lanes,
    /// Start of the step within the sample.
    pub offset: Lanes,
    /// Amplitude with the sign of the side.
    pub amplitude: Lanes,
    /// The rough certificates.
    pub uu: Lanes,
    pub uw: Lanes,
    pub ww: Lanes,
    pub doubt: Lanes,
}

impl LaneMotion {
    /// Copies a lane of other motions.
    #[inline(always)]
    pub fn copy(&mut self, to: usize, from: &Self, lane: usize) {
        self.u[to] = from.u[lane];
        self.w[to] = from.w[lane];
        self.here[to] = from.here[lane];
        self.offset[to] = from.offset[lane];
        self.amplitude[to] = from.amplitude[lane];
        self.uu[to] = from.uu[lane];
        self.uw[to] = from.uw[lane];
        self.ww[to] = from.ww[lane];
        self.doubt[to] = from.doubt[lane];
    }

    /// The rough certificates.
    #[inline(always)]
    pub fn screen<V: Simd>(&self) -> Screen<V> {
        Screen {
            uu: V::load(&self.uu),
            uw: V::load(&self.uw),
            ww: V::load(&self.ww),
            doubt: V::load(&self.doubt),
            peak: V::zero(),
        }
    }

    /// Sets the covariances of the rough certificates to those of `screen` in
    /// the lanes of `which`, to those of `other` elsewhere.
    #[inline(always)]
    pub fn set_covariance<V: Simd>(
        &mut self,
        which: V::Mask,
        screen: &Screen<V>,
        other: &Screen<V>,
    ) {
        which.select(screen.uu, other.uu).store(&mut self.uu);
        which.select(screen.uw, other.uw).store(&mut self.uw);
        which.select(screen.ww, other.ww).store(&mut self.ww);
    }
}

/// Constants of the runs in lanes, or nearly so.
#[derive(Default)]
pub(super) struct LaneConstants {
    /// Length of the sample, and one over it.
    pub whole: Lanes,
    pub inverse: Lanes,
    pub threshold: Lanes,
    pub sine: Lanes,
    pub cosine: Lanes,
    /// Largest rotation at a turning point so far.
    pub peak: Lanes,
    pub limit: Lanes,
    pub eta: Lanes,
    pub alpha: Lanes,
}

impl LaneConstants {
    /// Copies a lane of other constants.
    #[inline(always)]
    pub fn copy(&mut self, to: usize, from: &Self, lane: usize) {
        self.whole[to] = from.whole[lane];
        self.inverse[to] = from.inverse[lane];
        self.threshold[to] = from.threshold[lane];
        self.sine[to] = from.sine[lane];
        self.cosine[to] = from.cosine[lane];
        self.peak[to] = from.peak[lane];
        self.limit[to] = from.limit[lane];
        self.eta[to] = from.eta[lane];
        self.alpha[to] = from.alpha[lane];
    }
}

/// Motion and constants of the runs in the lanes of a group.
#[derive(Default)]
pub(super) struct LaneGroup<'a> {
    pub motion: LaneMotion,
    pub fixed: LaneConstants,
    /// Largest last coefficient of the velocity whose truncation error is
    /// allowed, in units of |w| + `least`.
    last: Lanes,
    least: Lanes,
    /// Rotation that a free step may not reach.
    ceiling: Lanes,
    /// Largest |u - alpha| up to it.
    tilt: Lanes,
    /// Rotation above which a lowest rotation decides nothing.
    low: Lanes,
    pub samples: [&'a [f64]; WIDTH],
    /// Sample at the end of the step.
    pub next: [u64; WIDTH],
    /// Sample at the end of the first step in the lane.
    first: [u64; WIDTH],
    /// Steps made in the lane beside one for each sample.
    pub extra: [u64; WIDTH],
    /// Impacts in the lane.
    pub impacts: [u64; WIDTH],
    /// Impacts in the lane beyond which the run is refused.
    pub most: [u64; WIDTH],
    /// First sample from which the early-termination test is worth its time.
    pub exit_from: [u64; WIDTH],
    /// Lanes whose side differs from that of their first step, a bit each.
    pub turned: u8,
    /// Lanes that fly; the others are empty or wait.
    pub active: u8,
}

impl<'a> LaneGroup<'a> {
    /// Sample ahead of a lane, scaled; not a number beyond the record.
    #[inline(always)]
    pub fn ahead(&self, lane: usize) -> f64 {
        let sample = self.samples[lane].get(self.next[lane] as usize);
        sample.map_or(f64::NAN, |sample| *sample * self.motion.amplitude[lane])
    }

    /// Piece of the record in which a lane is.
    #[inline(always)]
    pub fn piece(&self, lane: usize) -> usize {
        self.next[lane] as usize - 1
    }

    /// Velocity below which a block that leaves the base in a lane need not
    /// be followed; not positive if there is none.
    #[inline(always)]
    pub fn fastest<T>(&mut self, lane: usize, slot: &mut Slot<'a, T>) -> f64 {
        if self.next[lane] <= self.exit_from[lane] {
            return 0.0;
        }
        self.exit_from[lane] = slot.exit_from();
        if self.next[lane] <= self.exit_from[lane] {
            return 0.0;
        }
        slot.driver.fastest(self.piece(lane))
    }

    /// Gives a lane's rough certificate to its run.
    #[inline(always)]
    pub fn hand_screen<T>(&self, lane: usize, slot: &mut Slot<'a, T>) {
        let screen = slot.driver.screen();
        let LaneMotion { uu, uw, ww, doubt, .. } = &self.motion;
        (screen.uu, screen.uw, screen.ww) = (uu[lane], uw[lane], ww[lane]);
        screen.doubt = doubt[lane];
    }

    /// Gives a lane's motion back to its run.
    #[inline(always)]
    pub fn release<T>(&mut self, lane: usize, slot: &mut Slot<'a, T>) {
        let steps = self.next[lane] - self.first[lane] + self.extra[lane];
        let work = &mut slot.driver.record.work;
        work.steps += steps;
        work.impacts += self.impacts[lane];
        self.hand_screen(lane, slot);
        self.samples[lane] = &[];
        self.active &= !(1 << lane);
        let Stage::Flying(step) = &mut slot.stage else { return };
        step.place.piece = self.piece(lane);
        step.place.offset = self.motion.offset[lane];
        step.motion.u = self.motion.u[lane];
        step.motion.w = self.motion.w[lane];
        if self.turned >> lane & 1 == 1 {
            step.motion.side = step.motion.side.flipped();
        }
    }

    /// Takes a run in flight into a lane.
    #[inline(always)]
    pub fn load<T>(&mut self, lane: usize, slot: &mut Slot<'a, T>) {
        let screen = *slot.driver.screen();
        let (driver, Stage::Flying(step)) = (&slot.driver, &slot.stage) else {
            return;
        };
        let (dynamics, forcing) = (&driver.dynamics, &driver.forcing);
        let h = forcing.step();
        let amplitude = forcing.record.amplitude() * step.motion.side.sign();
        let samples = forcing.record.samples();
        let piece = step.place.piece;
        (self.motion.u[lane], self.motion.w[lane]) =
            (step.motion.u, step.motion.w);
        self.turned &= !(1 << lane);
        self.motion.here[lane] = samples[piece] * amplitude;
        self.motion.amplitude[lane] = amplitude;
        self.motion.offset[lane] = step.place.offset;
        self.fixed.whole[lane] = h;
        self.fixed.inverse[lane] = forcing.inverse;
        self.fixed.threshold[lane] = dynamics.threshold;
        self.fixed.sine[lane] = dynamics.sine;
        self.fixed.cosine[lane] = dynamics.cosine;
        self.samples[lane] = samples;
        self.next[lane] = piece as u64 + 1;
        self.first[lane] = piece as u64 + 1;
        (self.extra[lane], self.impacts[lane]) = (0, 0);
        let most = driver.observe.work_limit.impacts;
        self.most[lane] = most.saturating_sub(driver.record.work.impacts);
        self.exit_from[lane] = driver.exit_from as u64;
        self.last[lane] = driver.last_allowed(h) / SAFETY;
        self.least[lane] = dynamics.alpha * h;
        let ceiling = dynamics.limit.min(SMALL);
        self.ceiling[lane] = ceiling;
        self.tilt[lane] = dynamics.alpha.max(ceiling - dynamics.alpha);
        self.fixed.peak[lane] = driver.record.peak;
        self.fixed.limit[lane] = dynamics.limit;
        self.fixed.eta[lane] = dynamics.eta;
        self.fixed.alpha[lane] = dynamics.alpha;
        self.low[lane] = dynamics.alpha * PROPAGATION * SAFETY;
        (self.motion.uu[lane], self.motion.uw[lane]) = (screen.uu, screen.uw);
        (self.motion.ww[lane], self.motion.doubt[lane]) =
            (screen.ww, screen.doubt);
        self.active |= 1 << lane;
    }

    /// Makes one step, to the end of the sample, in every lane that is clear
    /// of events. Returns, one bit each, the lanes that made none, and those
    /// of them that meet no event but need a longer series.
    #[inline(always)]
    pub fn step<V: Simd, const LEN: usize, const HARD: usize>(
        &mut self,
        model: Model,
    ) -> (u8, u8) {
        let mut places = [&f64::NAN; WIDTH];
        for (place, (samples, next)) in
            places.iter_mut().zip(self.samples.iter().zip(self.next))
        {
            *place = samples.get(next as usize).unwrap_or(&f64::NAN);
        }
        let ahead = V::gather(places) * V::load(&self.motion.amplitude);
        let (u, w) = (V::load(&self.motion.u), V::load(&self.motion.w));
        let here = V::load(&self.motion.here);
        let rate = (ahead - here) * V::load(&self.fixed.inverse);
        let offset = V::load(&self.motion.offset);
        let h = V::load(&self.fixed.whole) - offset;
        let forcing = [rate.mul_add(offset, here), rate];
        let LaneConstants { threshold, sine, cosine, .. } = &self.fixed;
        let constants = (V::load(threshold), V::load(sine), V::load(cosine));
        let start = sine_cosine(model, u);
        let drive = Drive::new(model, constants, forcing, start);
        let series: TaylorSeries<V, LEN> = expand(model, (u, w), h, &drive);
        let end = series.end();
        let free = self.free_of_events(forcing, ahead, h, end);
        let size = w.abs() + V::load(&self.least);
        let enough = series.v[LEN - 1].abs().lt(V::load(&self.last) * size);
        let active = V::Mask::of(self.active);
        let clear = active.and(free).and(enough);
        clear.select(end.0, u).store(&mut self.motion.u);
        clear.select(end.1, w).store(&mut self.motion.w);
        let screen = self.motion.screen();
        let flown = ScreenLeg {
            tau: h,
            curvature: curvature(model, &drive),
            u: end.0,
            w: end.1,
            size: V::load(&self.fixed.alpha) + forcing[0].abs(),
            last: is_fixed(LEN, HARD).then_some(series.v[LEN - 1]),
        };
        let there = screen.fly(&flown);
        self.motion.set_covariance(clear, &there, &screen);
        clear.select(ahead, here).store(&mut self.motion.here);
        clear.select(V::zero(), offset).store(&mut self.motion.offset);
        clear.count(&mut self.next);
        let lanes = self.active & !clear.bits();
        self.active = clear.bits();
        (lanes, lanes & free.bits())
    }

    /// Lanes in which a step under forcing `f`, which ends at `ahead`, to
    /// `end` meets no base, no limit, and no turning point above the peak.
    ///
    /// With |u''| = |sin(u - alpha) - f cos(u - alpha)| below M, the rotation
    /// lies within M h^2/8 of its chord; with
    /// |u'''| = |u' (cos(u - alpha) + f sin(u - alpha)) - f' cos(u - alpha)|
    /// below N, so does the velocity within N h^2/8. (Eq. 2 has less of
    /// either.) Were the limit passed, M would grow by less than is passed.
    #[inline(always)]
    fn free_of_events<V: Simd>(
        &self,
        [f, rate]: [V; 2],
        ahead: V,
        h: V,
        end: (V, V),
    ) -> V::Mask {
        let (u, w) = (V::load(&self.motion.u), V::load(&self.motion.w));
        let eighth = h * V::from_f64(0.125 * SAFETY);
        // Linear in time, so largest at an end.
        let push = f.abs().max(ahead.abs());
        let tilt = V::load(&self.tilt);
        let bend = push + tilt;
        let turn = bend * h;
        let sag = turn * eighth;
        let speed = w.abs();
        let stiff = push.mul_add(tilt, V::one());
        let bent = (speed + turn).mul_add(stiff, rate.abs());
        let bow = bent * (h * eighth);

        // A start below the base is not free.
        let turns = w.unlike(end.1, u);
        let goes_on = bow.lt(speed.min(end.1.abs())).but_not(turns);
        // By more than the root finder's rounding.
        let stays = (u * V::from_f64(STAYS)).lt(end.0);
        // One that sinks and may turn: nor low enough for its lowest rotation
        // to decide anything.
        let dips = w.lt(V::zero()).but_not(goes_on);
        let low = dips.select(sag + V::load(&self.low), sag);
        let above_base = low.lt(u.min(end.0)).or(goes_on.and(stays));
        let top = u.max(end.0) + sag;
        let below_limit = top.lt(V::load(&self.ceiling));
        let below_peak = top.lt(V::load(&self.fixed.peak)).or(goes_on);
        above_base.and(below_limit).and(below_peak)
    }
}
