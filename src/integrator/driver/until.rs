//! The end of observation: the events before it, and how certain they are.
//!
//! An uplift or an overturning is compared with the end as a time; a block in
//! flight at the end is compared with overturning as a rotation. Free motion
//! that the end cuts is stepped up to it. If outcome and peak are known well
//! before the end, the closed form replaces the steps.

use std::mem;

use crate::integrator::accuracy::Accuracy;
use crate::integrator::certificate::CLEARANCE;
use crate::integrator::coast::last;
use crate::integrator::driver::{Driver, Flight, Stage, Step};
use crate::integrator::forcing::{
    Exceedance, Forcing, NEAR_THRESHOLD, Shaking,
};
use crate::integrator::motion::BlockMotion;
use crate::integrator::screen::Screen;
use crate::number::Real;

/// Least time (in 1/p) from the last event of the closed form to the end of
/// observation.
const WELL_BEFORE: f64 = 1.0;

impl<N: Real, G: Forcing<N, F>, const F: usize, const HARD: usize>
    Driver<N, G, F, HARD>
{
    /// True if a time lies before the end of observation.
    #[inline(always)]
    pub(super) fn observes(&self, time_s: N) -> bool {
        self.until_s.is_none_or(|until_s| time_s < until_s)
    }

    /// A time in units of 1/p and in s.
    fn times(&self, time_s: N) -> [f64; 2] {
        [time_s * self.dynamics.p, time_s].map(Real::to_f64)
    }

    /// Stops observation in flight: the rotation there counts.
    #[inline(never)]
    pub(super) fn stop(&mut self, step: &Step<N>) {
        let Some(until_s) = self.until_s else { return };
        let BlockMotion { side, u, w } = step.motion;
        self.sample_end(until_s, [u, w].map(|x| N::from_f64(side.sign()) * x));
        let is_peak = u > self.record.peak;
        if is_peak {
            self.record.peak = u;
            self.record.peak_time_s = Some(until_s);
        }
        let left = self.dynamics.limit - u;
        let times = self.times(until_s);
        let motion = [u, w].map(Real::to_f64);
        for tracker in self.record.trackers() {
            tracker.stop(motion, left.to_f64(), is_peak, times);
        }
        if let Some(screen) = self.screen {
            let doubt = screen.end(left, self.dynamics.alpha).doubt;
            let peak = if is_peak { screen.uu } else { screen.peak };
            self.screen = Some(Screen { doubt, peak, ..screen });
        }
    }

    /// Compares an uplift with the end of observation. Only a first uplift
    /// decides something: a later one starts too slowly to be a peak.
    #[inline(never)]
    pub(super) fn assess_first_uplift(
        &mut self,
        found: &Exceedance<N>,
        time_s: N,
    ) {
        let Some(until_s) = self.until_s else { return };
        let has_moved = self.record.uplift_time_s.is_some()
            || self.record.peak > N::zero();
        if has_moved {
            return;
        }
        let between = (until_s - time_s) * self.dynamics.p;
        let between = between.abs().to_f64();
        let rate = self.forcing.series(found.place)[1].abs();
        let late = if found.crossing {
            (self.dynamics.threshold / rate).to_f64() + self.forcing.span()
        } else {
            0.0
        };
        let times = self.times(until_s);
        for tracker in self.record.trackers() {
            tracker.end_at_rest(between, late, times);
        }
        if let Some(screen) = &mut self.screen
            && !(between > NEAR_THRESHOLD * (late + times[0]))
        {
            screen.doubt = N::one() / N::zero();
        }
    }

    /// Compares an overturning at a step's place with the end of observation.
    /// Returns the rotation, over alpha, that the block passes between the two
    /// if it is less than a margin, otherwise the margin.
    #[inline(never)]
    pub(super) fn assess_overturned_by_end(
        &mut self,
        step: &Step<N>,
        margin: f64,
    ) -> f64 {
        let Some(until_s) = self.until_s else { return margin };
        let w = step.motion.w;
        let between = (until_s - self.time_s(step.place)) * self.dynamics.p;
        let times = self.times(until_s);
        for tracker in self.record.trackers() {
            let late = tracker.bound([1.0 / w.to_f64(), 0.0]);
            tracker.end(between.to_f64(), late, times);
        }
        let passed = (between * w / self.dynamics.alpha).to_f64();
        if passed < margin { passed } else { margin }
    }

    /// True if observation ends before free motion from `motion` on has surely
    /// resolved outcome and peak. Compares the end with an overturning if free
    /// motion has resolved one.
    #[inline(never)]
    pub(super) fn cuts(&mut self, motion: BlockMotion<N>) -> bool {
        let Some(until_s) = self.until_s else { return false };
        let BlockMotion { u, w, .. } = motion;
        let last = last(&self.dynamics, u, w);
        let left = (until_s - self.end_s()) * self.dynamics.p;
        let between = left.to_f64() - last.time;
        if !(between >= WELL_BEFORE) {
            return true;
        }
        let error = |a: Accuracy| a.bound(last.gradient);
        if let Some(own) = self.record.accuracy
            && !(between >= CLEARANCE * error(own))
        {
            return true;
        }
        let times = self.times(until_s);
        for tracker in self.record.trackers().filter(|_| last.overturns) {
            tracker.end(between, error(*tracker), times);
        }
        false
    }

    /// Steps through the free motion from `motion` to rest, overturning or
    /// the end of observation.
    #[inline(never)]
    pub(super) fn follow(&mut self, motion: BlockMotion<N>) -> Flight<N> {
        let mut free = self.free();
        free.until_s = self.until_s;
        free.record = mem::take(&mut self.record);
        free.screen = self.screen;
        let flight = free.fly_free(motion);
        self.record = free.record;
        self.screen = free.screen;
        flight
    }

    /// Adds the free motion that starts at `motion`, which the closed form has
    /// decided, to history and forces.
    #[inline(never)]
    pub(super) fn trace(&mut self, motion: BlockMotion<N>) {
        let end_s = self.end_s();
        let mut free = self.free();
        free.observe.events = self.observe.history_interval_s.is_some();
        free.until_s = self.until_s.or_else(|| {
            // Without restitution the motion never ends: show some of it.
            let horizon = N::from_f64(60.0) / self.dynamics.p;
            (!(self.dynamics.eta < N::one())).then_some(end_s + horizon)
        });
        free.record.history = mem::take(&mut self.record.history);
        free.record.forces = self.record.forces;
        if let Flight::Rest(_, time_s) = free.fly_free(motion) {
            let end_s = free.until_s.unwrap_or(time_s);
            free.sample_rest(end_s);
        }
        self.record.exceeded = free.record.exceeded;
        self.record.history = free.record.history;
        self.record.forces = free.record.forces;
    }

    /// A driver for the free motion after the excitation.
    fn free(&self) -> Driver<N, Shaking<N>, HARD, HARD> {
        let silence = Shaking::endless(self.end_s(), self.dynamics.p);
        let mut free = Driver::new(self.dynamics, silence, self.isa);
        free.observe = self.observe;
        free.watched = self.watched;
        free
    }
}

impl<N: Real, const LEN: usize> Driver<N, Shaking<N>, LEN, LEN> {
    /// Flies from the start to the end of the flight or to the limit of work.
    fn fly_free(&mut self, motion: BlockMotion<N>) -> Flight<N> {
        let mut stage = Stage::Flying(Step::first(motion));
        loop {
            stage = match stage {
                Stage::Landed(flight) => return flight,
                Stage::Flying(_) if self.refusal(&stage).is_some() => {
                    return Flight::Stopped;
                }
                Stage::Flying(step) => self.proceed::<LEN>(step),
            };
        }
    }
}
