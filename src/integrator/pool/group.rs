//! A group of lanes in flight, stepped together.

use crate::integrator::Side;
use crate::integrator::driver::Stage;
use crate::integrator::dynamics::{Drive, Model};
use crate::integrator::pool::{SAFETY, SMALL, Slot};
use crate::integrator::taylor::{expand, value};
use crate::number::Number;
use crate::number::lanes::{Lanes, Mask};

/// Share of its start above which a rotation that sinks surely ends above the
/// base.
const STAYS: f64 = 1e-9;

/// Lanes stepped at once.
pub(super) const WIDTH: usize = 8;

/// Motion and constants of the runs in the lanes of a group.
pub(super) struct Group<'a> {
    pub u: Lanes<WIDTH>,
    pub w: Lanes<WIDTH>,
    /// Forcing at the start of the sample, on the side of the rotation.
    pub here: Lanes<WIDTH>,
    /// Start of the step within the sample.
    pub offset: Lanes<WIDTH>,
    /// Length of the step.
    pub length: Lanes<WIDTH>,
    /// Amplitude with the sign of the side.
    pub amplitude: Lanes<WIDTH>,
    /// Length of the sample, and one over it.
    pub whole: Lanes<WIDTH>,
    pub inverse: Lanes<WIDTH>,
    pub threshold: Lanes<WIDTH>,
    pub sine: Lanes<WIDTH>,
    pub cosine: Lanes<WIDTH>,
    /// Largest last coefficient of the velocity that leaves little enough, in
    /// units of |w| + `least`.
    last: Lanes<WIDTH>,
    least: Lanes<WIDTH>,
    /// Rotation that nothing may reach.
    ceiling: Lanes<WIDTH>,
    /// Largest rotation at a turning point so far.
    pub peak: Lanes<WIDTH>,
    pub side: [Side; WIDTH],
    pub samples: [&'a [f64]; WIDTH],
    /// Sample at the end of the step.
    pub next: [u64; WIDTH],
    /// Sample at the end of the first step here.
    first: [u64; WIDTH],
    /// Steps taken here beside one for each sample.
    pub extra: [u64; WIDTH],
    /// Impacts here.
    pub impacts: [u64; WIDTH],
    /// Lanes that fly; the others are empty or wait.
    active: Mask<WIDTH>,
}

/// Lanes that did not take a step, a bit each; those in which the series
/// leaves too much and nothing happens have another bit, `WIDTH` above.
pub(super) type Parked = u64;

impl<'a> Group<'a> {
    pub fn idle() -> Self {
        let zero = Lanes::splat(0.0);
        Self {
            u: zero,
            w: zero,
            here: zero,
            offset: zero,
            length: zero,
            amplitude: zero,
            whole: zero,
            inverse: zero,
            threshold: zero,
            sine: zero,
            cosine: zero,
            last: zero,
            least: zero,
            ceiling: zero,
            peak: zero,
            side: [Side::Positive; WIDTH],
            samples: [&[]; WIDTH],
            next: [0; WIDTH],
            first: [0; WIDTH],
            extra: [0; WIDTH],
            impacts: [0; WIDTH],
            active: Mask::splat(false),
        }
    }

    /// True when no lane flies.
    #[inline(always)]
    pub fn is_idle(&self) -> bool {
        !self.active.any()
    }

    /// Lets a lane fly.
    #[inline(always)]
    pub fn resume(&mut self, lane: usize) {
        self.active.set(lane, true);
    }

    /// Sample ahead of a lane, scaled; not a number beyond the record.
    #[inline(always)]
    pub fn ahead(&self, lane: usize) -> f64 {
        let sample = self.samples[lane].get(self.next[lane] as usize);
        sample.map_or(f64::NAN, |sample| *sample * self.amplitude[lane])
    }

    /// Gives a lane's motion back to its run.
    #[inline(always)]
    pub fn release<T, const LEN: usize>(
        &mut self,
        lane: usize,
        slot: &mut Slot<'a, T, LEN>,
    ) {
        let steps = self.next[lane] - self.first[lane] + self.extra[lane];
        slot.driver.count_steps(steps);
        slot.driver.count_impacts(self.impacts[lane]);
        self.samples[lane] = &[];
        self.active.set(lane, false);
        let Stage::Flying(step) = &mut slot.stage else { return };
        step.place.piece = self.next[lane] as usize - 1;
        step.place.offset = self.offset[lane];
        step.motion.u = self.u[lane];
        step.motion.w = self.w[lane];
        step.motion.side = self.side[lane];
    }

    /// Takes a run in flight into a lane.
    #[inline(always)]
    pub fn load<T, const LEN: usize>(
        &mut self,
        lane: usize,
        slot: &Slot<'a, T, LEN>,
    ) {
        let (driver, Stage::Flying(step)) = (&slot.driver, &slot.stage) else {
            return;
        };
        let dynamics = driver.dynamics();
        let forcing = driver.forcing();
        let h = forcing.step();
        let amplitude = forcing.amplitude() * step.motion.side.sign();
        let samples = forcing.samples();
        let piece = step.place.piece;
        (self.u[lane], self.w[lane]) = (step.motion.u, step.motion.w);
        self.side[lane] = step.motion.side;
        self.here[lane] = samples[piece] * amplitude;
        self.amplitude[lane] = amplitude;
        self.offset[lane] = step.place.offset;
        self.length[lane] = h - step.place.offset;
        self.whole[lane] = h;
        self.inverse[lane] = forcing.inverse();
        self.threshold[lane] = dynamics.threshold;
        (self.sine[lane], self.cosine[lane]) = dynamics.sine_cosine();
        self.samples[lane] = samples;
        self.next[lane] = piece as u64 + 1;
        self.first[lane] = piece as u64 + 1;
        (self.extra[lane], self.impacts[lane]) = (0, 0);
        self.last[lane] = driver.last_allowed::<LEN>(h) / SAFETY;
        self.least[lane] = dynamics.alpha * h;
        self.ceiling[lane] = dynamics.limit.min(SMALL);
        self.peak[lane] = driver.peak();
        self.active.set(lane, true);
    }

    /// One step, to the end of the sample, in every lane that is clear of
    /// events.
    #[inline(always)]
    pub fn step<const LEN: usize>(&mut self, model: Model) -> Parked {
        let mut ahead = Lanes::splat(0.0);
        for lane in 0..WIDTH {
            let sample = self.samples[lane].get(self.next[lane] as usize);
            ahead[lane] = *sample.unwrap_or(&f64::NAN);
        }
        let ahead = ahead * self.amplitude;
        let rate = (ahead - self.here) * self.inverse;
        let series = [rate.mul_add(self.offset, self.here), rate];
        let constants = (self.threshold, self.sine, self.cosine);
        let drive = Drive::new(model, constants, series);
        let small = match model {
            Model::Nonlinear => self.u.sin_cos_small(),
            Model::Linearized => (self.u, Number::one()),
        };
        let (c, v): ([_; LEN], [_; LEN]) =
            expand(model, self.u, self.w, &drive, small);
        let h = self.length;
        let end = (value(&c, h), value(&v, h));
        let free = self.free_of_events(model, &drive, ahead, end);
        let size = self.w.abs() + self.least;
        let enough = v[LEN - 1].abs().below(self.last * size);
        let clear = self.active.and(free).and(enough);
        self.u = clear.select(end.0, self.u);
        self.w = clear.select(end.1, self.w);
        self.here = clear.select(ahead, self.here);
        self.offset = clear.select(Number::zero(), self.offset);
        self.length = clear.select(self.whole, self.length);
        for (next, count) in self.next.iter_mut().zip(clear.count()) {
            *next += count;
        }
        let stopped = self.active.but_not(clear);
        self.active = clear;
        stopped.bits_with(free)
    }

    /// Lanes in which the step to `end` meets no base, no limit, and no
    /// turning point above the peak.
    ///
    /// With |u''| below M and |u'''| below N, the rotation lies within
    /// M tau^2/2 of its tangent at the start and within M h^2/8 of its chord,
    /// and the velocity within N h^2/8 of its own.
    #[inline(always)]
    fn free_of_events(
        &self,
        model: Model,
        drive: &Drive<Lanes<WIDTH>, 2>,
        ahead: Lanes<WIDTH>,
        end: (Lanes<WIDTH>, Lanes<WIDTH>),
    ) -> Mask<WIDTH> {
        let h = self.length;
        let zero = Lanes::splat(0.0);
        // |A| sin u + |B| below the ceiling; both are linear in time.
        let constants = (self.threshold, self.sine, self.cosine);
        let last = Drive::new(model, constants, [ahead]);
        let pull = drive.a.abs().max(last.a.abs());
        let push = drive.b.abs().max(last.b.abs());
        let bend = pull.mul_add(self.ceiling, push);
        let turn = bend * h * Lanes::splat(SAFETY);
        let sag = turn * h * Lanes::splat(0.125);
        let spread = sag * Lanes::splat(4.0);
        // |w| (|A| + |B| sin u) + |f'|, with |w| below its own bound.
        let speed = self.w.abs();
        let stiff = push.mul_add(self.ceiling, pull);
        let bent = (speed + turn).mul_add(stiff, drive.f[1].abs());
        let bow = bent * (h * h) * Lanes::splat(0.125 * SAFETY);

        let linear = self.u + self.w * h;
        let (low, high) = (linear - spread, linear + spread);
        let rises = bow.below(self.w.min(end.1));
        let sinks = self.w.max(end.1).below(-bow);
        // By more than the root finder's rounding.
        let stays = (self.u * Lanes::splat(STAYS)).below(end.0);
        let above_base = zero
            .below(low)
            .or(sag.below(self.u.min(end.0)))
            .or(rises)
            .or(sinks.and(stays));
        let below_limit =
            high.below(self.ceiling).and(self.u.below(self.ceiling));
        let below_peak = (self.u.max(end.0) + sag)
            .below(self.peak)
            .or(turn.below(speed))
            .or(rises)
            .or(sinks);
        let outside = self.u.below(zero);
        above_base.and(below_limit).and(below_peak).but_not(outside)
    }
}
