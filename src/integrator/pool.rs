//! Chains of analyses under records, several at a time.
//!
//! A lane holds a chain, whose scenes follow one another, so that nothing is
//! computed above the scene that ends it. Whole samples in free flight are
//! stepped in all lanes at once; a lane in which something may happen within
//! the sample takes that one step alone, by the scalar driver. Operations
//! and their order are the same either way, and so are the bits.

use crate::excitation::Excitation;
use crate::integrator::driver::{Driver, Stage, last_term};
use crate::integrator::dynamics::{Dynamics, Model, drive};
use crate::integrator::forcing::{RecordForcing, steps_of};
use crate::integrator::taylor::{expand, value};
use crate::integrator::{
    GUARD, LONG, LONG_STEP, Observe, Response, SHORT, SHORT_STEP, SMOOTH,
    Scene,
};
use crate::number::Number;
use crate::number::dispatch::{Isa, Work};
use crate::number::lanes::Lanes;

/// Lanes stepped at once.
const WIDTH: usize = 8;

/// Rotation to which the short sine and cosine are used.
const SMALL: f64 = 0.785;

/// Share by which the screens of the lanes are on the safe side: what they
/// pass, the scalar screens or its root finder pass too.
const SAFETY: f64 = 1.001;

/// Analyses under a record that follow one another.
pub(crate) trait Chain<'a> {
    /// The next scene; none at the end of the chain.
    fn next(&mut self) -> Option<Scene<'a>>;

    /// Takes the response of the scene given last.
    fn settle(&mut self, response: &Response);
}

/// What the scenes of a pool have in common: the length of the series.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Class {
    /// Eq. 1, steps to [`SHORT_STEP`].
    Short,
    /// Eq. 1, steps to [`LONG_STEP`].
    Long,
    /// Eq. 1, longer steps.
    Smooth,
    /// Eq. 2.
    Linearized,
}

impl Class {
    /// The class of scenes of a model under records at a step of `length`
    /// (in 1/p); none where a sample takes more than one step.
    pub fn of(model: Model, length: f64) -> Option<Self> {
        match model {
            _ if steps_of(length) > 1 => None,
            Model::Linearized => Some(Self::Linearized),
            Model::Nonlinear if length <= SHORT_STEP * GUARD => {
                Some(Self::Short)
            }
            Model::Nonlinear if length <= LONG_STEP * GUARD => {
                Some(Self::Long)
            }
            Model::Nonlinear => Some(Self::Smooth),
        }
    }
}

/// Runs chains of one class to their ends: `take` gives the next one,
/// `done` receives it when it has ended.
pub(crate) fn run<'a, C: Chain<'a>>(
    class: Class,
    isa: Isa,
    take: impl FnMut() -> Option<C>,
    done: impl FnMut(C),
) {
    let model = match class {
        Class::Linearized => Model::Linearized,
        Class::Short | Class::Long | Class::Smooth => Model::Nonlinear,
    };
    match class {
        Class::Short => {
            isa.run(Pool::<_, _, SHORT> { model, isa, take, done });
        }
        Class::Long => {
            isa.run(Pool::<_, _, LONG> { model, isa, take, done });
        }
        Class::Smooth | Class::Linearized => {
            isa.run(Pool::<_, _, SMOOTH> { model, isa, take, done });
        }
    }
}

/// Chains and how they are run, compiled for each instruction-set level.
struct Pool<T, D, const LEN: usize> {
    model: Model,
    isa: Isa,
    take: T,
    done: D,
}

impl<'a, C, T, D, const LEN: usize> Work for Pool<T, D, LEN>
where
    C: Chain<'a>,
    T: FnMut() -> Option<C>,
    D: FnMut(C),
{
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
        let mut lanes = States::idle();
        let mut slots: [Option<Slot<'a, C, LEN>>; WIDTH] =
            std::array::from_fn(|_| None);
        let mut step = Stepped {
            clear: [false; WIDTH],
            c: [Lanes::splat(0.0); LEN],
            v: [Lanes::splat(0.0); LEN],
        };
        loop {
            let mut busy = false;
            for (lane, slot) in slots.iter_mut().enumerate() {
                if step.clear[lane] {
                    busy = true;
                    continue;
                }
                lanes.release(lane, slot);
                if self.prepare(slot, &step.lane(lane)) {
                    lanes.load(lane, slot);
                    busy = true;
                }
            }
            if !busy {
                return;
            }
            step = lanes.fly::<LEN>(self.model);
        }
    }
}

/// A step of all lanes.
struct Stepped<const LEN: usize> {
    /// Lanes that took it.
    clear: [bool; WIDTH],
    c: [Lanes<WIDTH>; LEN],
    v: [Lanes<WIDTH>; LEN],
}

impl<const LEN: usize> Stepped<LEN> {
    /// Coefficients in a lane.
    #[inline(always)]
    fn lane(&self, lane: usize) -> ([f64; LEN], [f64; LEN]) {
        let (mut c, mut v) = ([0.0; LEN], [0.0; LEN]);
        for k in 0..LEN {
            (c[k], v[k]) = (self.c[k][lane], self.v[k][lane]);
        }
        (c, v)
    }
}

impl<'a, C, T, D, const LEN: usize> Pool<T, D, LEN>
where
    C: Chain<'a>,
    T: FnMut() -> Option<C>,
    D: FnMut(C),
{
    /// Takes the step that a lane could not, expanded as `(c, v)`, and what
    /// follows, up to the next step for a lane; false when no chain is left.
    #[inline(always)]
    fn prepare(
        &mut self,
        slot: &mut Option<Slot<'a, C, LEN>>,
        (c, v): &([f64; LEN], [f64; LEN]),
    ) -> bool {
        let mut stuck = true;
        loop {
            let Some(Slot { chain, driver, stage }) = slot else {
                let Some(chain) = (self.take)() else { return false };
                *slot = self.begin(chain);
                stuck = false;
                continue;
            };
            match stage {
                Stage::Flying(step)
                    if !stuck
                        && !step.at_threshold
                        && step.place.offset < driver.forcing().step() =>
                {
                    return true;
                }
                Stage::Flying(step) => {
                    let known = stuck && step.motion.u <= SMALL;
                    let known = known.then_some((c, v));
                    *stage = driver.proceed(*step, known);
                    stuck = false;
                }
                Stage::Landed(flight) => {
                    let response = driver.conclude(flight);
                    chain.settle(&response);
                    *slot =
                        slot.take().and_then(|slot| self.begin(slot.chain));
                }
            }
        }
    }

    /// Starts the next scene of a chain, or ends the chain.
    fn begin(&mut self, mut chain: C) -> Option<Slot<'a, C, LEN>> {
        let found = chain.next().and_then(|scene| match scene.excitation {
            Excitation::Record(record) => {
                record.index().map(|index| (scene, record, index))
            }
            Excitation::Pulse(_) | Excitation::Free => None,
        });
        let Some((scene, record, index)) = found else {
            (self.done)(chain);
            return None;
        };
        let Scene { block, restitution, model, overturning, .. } = scene;
        let dynamics = Dynamics::new(&block, restitution, model, overturning);
        let forcing =
            RecordForcing::new(record, index, block.frequency_rad_s());
        let mut driver = Driver::new(dynamics, forcing, self.isa);
        let stage = driver.begin(&scene, &Observe::default());
        Some(Slot { chain, driver, stage })
    }
}

/// A chain in its lane.
struct Slot<'a, C, const LEN: usize> {
    chain: C,
    driver: Driver<f64, RecordForcing<'a, f64>, LEN, 2, SMOOTH>,
    stage: Stage<f64>,
}

/// Motion and constants of the runs in the lanes; the samples of an idle
/// lane are empty, which lets nothing pass.
struct States<'a> {
    u: Lanes<WIDTH>,
    w: Lanes<WIDTH>,
    /// Forcing at the start of the sample, on the side of the rotation.
    here: Lanes<WIDTH>,
    /// Start of the step within the sample.
    offset: Lanes<WIDTH>,
    /// Length of the step.
    length: Lanes<WIDTH>,
    /// Amplitude with the sign of the side.
    amplitude: Lanes<WIDTH>,
    /// Length of the sample, and one over it.
    whole: Lanes<WIDTH>,
    inverse: Lanes<WIDTH>,
    threshold: Lanes<WIDTH>,
    sine: Lanes<WIDTH>,
    cosine: Lanes<WIDTH>,
    screens: Screens,
    samples: [&'a [f64]; WIDTH],
    /// Sample at the end of the step.
    next: [usize; WIDTH],
}

/// What a step is held against.
struct Screens {
    /// Largest last coefficient of the velocity that leaves little enough.
    last: Lanes<WIDTH>,
    /// Truncation allowed per unit of p-time.
    tolerance: Lanes<WIDTH>,
    /// Largest last coefficient of the longest series.
    smooth_last: Lanes<WIDTH>,
    /// Rotation that nothing may reach.
    ceiling: Lanes<WIDTH>,
    /// Largest rotation at a turning point so far.
    peak: Lanes<WIDTH>,
}

impl<'a> States<'a> {
    fn idle() -> Self {
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
            screens: Screens {
                last: zero,
                tolerance: zero,
                smooth_last: zero,
                ceiling: zero,
                peak: zero,
            },
            samples: [&[]; WIDTH],
            next: [0; WIDTH],
        }
    }

    /// Gives a lane's motion back to its slot and leaves the lane idle.
    #[inline(always)]
    fn release<C, const LEN: usize>(
        &mut self,
        lane: usize,
        slot: &mut Option<Slot<'a, C, LEN>>,
    ) {
        self.samples[lane] = &[];
        let Some(Slot { stage: Stage::Flying(step), .. }) = slot else {
            return;
        };
        let piece = self.next[lane] - 1;
        step.place.piece = piece;
        step.place.offset = self.offset[lane];
        (step.motion.u, step.motion.w) = (self.u[lane], self.w[lane]);
    }

    /// Takes a slot in flight, at the start of a sample, into a lane.
    #[inline(always)]
    fn load<C, const LEN: usize>(
        &mut self,
        lane: usize,
        slot: &Option<Slot<'a, C, LEN>>,
    ) {
        let Some(Slot { driver, stage: Stage::Flying(step), .. }) = slot
        else {
            return;
        };
        let dynamics = driver.dynamics();
        let forcing = driver.forcing();
        let h = forcing.step();
        let amplitude = forcing.amplitude() * step.motion.side.sign();
        let samples = forcing.samples();
        let piece = step.place.piece;
        (self.u[lane], self.w[lane]) = (step.motion.u, step.motion.w);
        self.here[lane] = samples[piece] * amplitude;
        self.amplitude[lane] = amplitude;
        self.offset[lane] = step.place.offset;
        self.length[lane] = h - step.place.offset;
        self.whole[lane] = h;
        self.inverse[lane] = forcing.inverse();
        self.threshold[lane] = dynamics.threshold;
        (self.sine[lane], self.cosine[lane]) = dynamics.sine_cosine();
        self.samples[lane] = samples;
        self.next[lane] = piece + 1;
        let ceiling = dynamics.limit.min(SMALL);
        let screens = &mut self.screens;
        screens.last[lane] = driver.last_allowed::<LEN>(h) / SAFETY;
        screens.tolerance[lane] = driver.tolerance();
        screens.smooth_last[lane] = driver.last_allowed::<SMOOTH>(h) / SAFETY;
        screens.ceiling[lane] = ceiling;
        screens.peak[lane] = driver.peak();
    }

    /// Steps all lanes, sample by sample, while every one is clear of
    /// events; tells which were in the last step, which the others did not
    /// take.
    #[inline(always)]
    fn fly<const LEN: usize>(&mut self, model: Model) -> Stepped<LEN> {
        loop {
            let step = self.step(model);
            if step.clear.contains(&false) {
                return step;
            }
        }
    }

    /// One step, to the end of the sample, in every lane that is clear of
    /// events.
    #[inline(always)]
    fn step<const LEN: usize>(&mut self, model: Model) -> Stepped<LEN> {
        let mut ahead = Lanes::splat(f64::NAN);
        for lane in 0..WIDTH {
            if let Some(sample) = self.samples[lane].get(self.next[lane]) {
                ahead[lane] = *sample;
            }
        }
        let ahead = ahead * self.amplitude;
        let rate = (ahead - self.here) * self.inverse;
        let series = [rate.mul_add(self.offset, self.here), rate];
        let constants = (self.threshold, self.sine, self.cosine);
        let (a, b) = drive(model, constants, &series);
        let small = match model {
            Model::Nonlinear => self.u.sin_cos_small(),
            Model::Linearized => (self.u, Number::one()),
        };
        let (c, v): ([_; LEN], [_; LEN]) =
            expand(model, self.u, self.w, (&a, &b), small);
        let h = self.length;
        let free = self.free_of_events((&a, &b));
        let mut clear = [false; WIDTH];
        let mut hard = [false; WIDTH];
        for lane in 0..WIDTH {
            let enough = v[LEN - 1][lane].abs() < self.screens.last[lane];
            clear[lane] = free[lane] & enough;
            hard[lane] = free[lane] & !enough;
        }
        let (mut u, mut w) = (value(&c, h), value(&v, h));
        if LEN < SMOOTH && hard.contains(&true) {
            // The driver takes the longest series next, where this one
            // surely leaves too much.
            let (long_c, long_v): ([_; SMOOTH], [_; SMOOTH]) =
                expand(model, self.u, self.w, (&a, &b), small);
            let (long_u, long_w) = (value(&long_c, h), value(&long_v, h));
            for lane in 0..WIDTH {
                if !hard[lane] {
                    continue;
                }
                let allowed = self.screens.tolerance[lane] * h[lane];
                let mut last = [0.0; LEN];
                last[LEN - 1] = v[LEN - 1][lane];
                let too_much = last_term(&last, h[lane]) > allowed;
                let enough = long_v[SMOOTH - 1][lane].abs()
                    < self.screens.smooth_last[lane];
                if too_much && enough {
                    clear[lane] = true;
                    (u[lane], w[lane]) = (long_u[lane], long_w[lane]);
                }
            }
        }
        for lane in 0..WIDTH {
            if clear[lane] {
                self.u[lane] = u[lane];
                self.w[lane] = w[lane];
                self.here[lane] = ahead[lane];
                self.offset[lane] = 0.0;
                self.length[lane] = self.whole[lane];
                self.next[lane] += 1;
            }
        }
        Stepped { clear, c, v }
    }

    /// Lanes in which the step meets no base, no limit, and no turning point
    /// above the peak: with |u''| below a bound M, u(tau) lies within
    /// M tau^2/2 of u_0 + w_0 tau, and the velocity within M tau of w_0.
    #[inline(always)]
    fn free_of_events(
        &self,
        (a, b): (&[Lanes<WIDTH>; 2], &[Lanes<WIDTH>; 2]),
    ) -> [bool; WIDTH] {
        let (h, screens) = (self.length, &self.screens);
        // |A| sin u + |B| below the ceiling.
        let pull = a[1].abs().mul_add(h, a[0].abs()) * screens.ceiling;
        let bend = b[0].abs() + b[1].abs().mul_add(h, pull);
        let turn = bend * h * Lanes::splat(SAFETY);
        let spread = turn * h * Lanes::splat(0.5);
        let linear = self.u + self.w * h;
        let (low, high) = (linear - spread, linear + spread);
        let mut free = [false; WIDTH];
        for lane in 0..WIDTH {
            let start = self.u[lane];
            let high = if start > high[lane] { start } else { high[lane] };
            free[lane] = (start >= 0.0)
                & (low[lane] > 0.0)
                & (high < screens.ceiling[lane])
                & ((high < screens.peak[lane])
                    | (self.w[lane].abs() > turn[lane]));
        }
        free
    }
}
