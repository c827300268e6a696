//! One step of the driver: its series and the truncation error of it.

use crate::integrator::driver::events::Event;
use crate::integrator::driver::{Advance, Driver, Flight, Step};
use crate::integrator::dynamics::{
    Drive, Dynamics, Model, curvature, sine_cosine,
};
use crate::integrator::forcing::{Forcing, Moment};
use crate::integrator::motion::BlockMotion;
use crate::integrator::screen::ScreenLeg;
use crate::integrator::taylor::{
    TaylorSeries, expand, fine, size, slope, value,
};
use crate::integrator::{SceneError, Side};
use crate::number::dispatch::Kernel;
use crate::number::{Number, Real};

/// Most halvings of a step. A part of 2^-12 is accepted as it is; the error
/// estimate includes its truncation error.
const HALVINGS: u32 = 12;

impl<N: Real, G: Forcing<N, F>, const F: usize, const HARD: usize>
    Driver<N, G, F, HARD>
{
    /// A step whose truncation error under the short series is too large: a
    /// longer series, then a shorter step.
    #[inline(never)]
    pub(super) fn advance_hard(
        &mut self,
        step: &mut Step<N>,
        length: N,
    ) -> Advance<N> {
        self.isa.run(Hard { driver: self, step, length })
    }

    /// Makes a step by a series of `LEN` coefficients, to the end of the step
    /// or to its first event. `None` if the truncation error is too large.
    #[inline(always)]
    pub(super) fn attempt<const LEN: usize>(
        &mut self,
        step: &mut Step<N>,
        length: N,
    ) -> Option<Advance<N>> {
        if self.record.accuracy.is_some() {
            return self.attempt_assessed::<LEN>(step, length);
        }
        let BlockMotion { side, u, w } = step.motion;
        let drive = self.drive(step.place, (side, u), step.at_threshold);
        let model = self.dynamics.model;
        let series: TaylorSeries<N, LEN> =
            expand(model, (u, w), length, &drive);
        self.take(step, length, &series, &drive, None)
    }

    /// [`Self::attempt`] with its decisions assessed.
    #[inline(never)]
    fn attempt_assessed<const LEN: usize>(
        &mut self,
        step: &mut Step<N>,
        length: N,
    ) -> Option<Advance<N>> {
        let isa = self.isa;
        let driver = self;
        isa.run(AssessedStepKernel::<_, _, LEN> { driver, step, length })
    }

    /// Makes a step by its series. `None` if the truncation error is too
    /// large. `left` is the truncation error of the velocity, if the step is
    /// assessed.
    #[inline(always)]
    fn take<const LEN: usize>(
        &mut self,
        step: &mut Step<N>,
        length: N,
        series: &TaylorSeries<N, LEN>,
        drive: &Drive<N, F>,
        left: Option<N>,
    ) -> Option<Advance<N>> {
        let BlockMotion { side, u, w } = step.motion;
        let TaylorSeries { c, v } = series;
        self.record.work.steps += 1;
        if !(left_by(v, length) <= self.allowed(w, length)) {
            return None;
        }
        let event = self.first_event(c);
        let (x, tau, (end_u, end_w)) = match event {
            Event::None => (N::one(), length, series.end()),
            Event::Impact(x) | Event::Overturning(x) => {
                (x, x * length, (value(c, x), value(v, x)))
            }
        };
        if let Some(left) = left {
            let left = match event {
                Event::None => left,
                _ => left * (1..LEN).fold(N::one(), |power, _| power * x),
            };
            let ends = [(u, w), (end_u, end_w)];
            let flown = self.flown(ends, tau, drive, left);
            let end_w = end_w.to_f64();
            self.assess(series, (x, tau), (&flown, end_w), step.place);
        }
        self.turning_points(series, x, (step.place, length));
        if let Some(screen) = &mut self.screen {
            let curvature = curvature(self.dynamics.model, drive);
            let size = self.dynamics.alpha + drive.f[0].abs();
            let (u, w) = (end_u, end_w);
            let last = self.fixed.then_some(v[LEN - 1]);
            let flown = ScreenLeg { tau, curvature, u, w, size, last };
            *screen = screen.fly(&flown);
        }
        if self.watched {
            self.sample_step(series, (tau, length), step.place, side);
            self.see_forces(series, &drive.f, (x, length), step.place);
        }
        step.at_threshold = false;
        step.place.offset = step.place.offset + tau;
        if let Event::Impact(_) = event {
            let before = slope(v, x) / length;
            let end = self.impact(step, -end_w, before);
            return Some(end.map_or(Advance::Bounced, Advance::Ended));
        }
        step.motion = BlockMotion { side, u: end_u, w: end_w };
        if let Event::Overturning(_) = event {
            return Some(Advance::Overturned);
        }
        if self.screen.is_some() && self.may_miss(series) {
            self.screen_turning(series);
        }
        Some(Advance::Reached)
    }

    /// The end of a flight at the place of its overturning.
    #[inline(always)]
    pub(super) fn overturned<const SIZE: usize>(
        &mut self,
        step: &Step<N>,
    ) -> Flight<N> {
        let Step { place, motion, .. } = *step;
        let margin = self.margin_beyond::<SIZE>(place, motion);
        let margin = self.assess_overturned_by_end(step, margin);
        if self.record.accuracy.is_some() {
            self.assess_beyond(place, motion);
        }
        let time_s = self.time_s(place);
        Flight::Overturned { time_s, side: motion.side, margin }
    }

    /// Drive of a step from a place, at a rotation `u` on a side; `exact`
    /// means that the forcing is exactly at the uplift threshold.
    #[inline(always)]
    pub(super) fn drive(
        &self,
        place: Moment<N>,
        (side, u): (Side, N),
        exact: bool,
    ) -> Drive<N, F> {
        let Dynamics { model, threshold, sine, cosine, .. } = self.dynamics;
        let f = self.oriented(place, side, exact);
        let start = match model {
            // Beyond pi/4 the short polynomials lose digits.
            Model::Nonlinear if u > N::ratio(785, 1000) => u.sin_cos(),
            _ => sine_cosine(model, u),
        };
        Drive::new(model, (threshold, sine, cosine), f, start)
    }

    /// Series of s a/g about a place.
    #[inline(always)]
    pub(super) fn oriented(
        &self,
        place: Moment<N>,
        side: Side,
        exact: bool,
    ) -> [N; F] {
        let mut series = self.forcing.series(place);
        if side == Side::Negative {
            series = series.map(|x| -x);
        }
        if exact {
            series[0] = -self.dynamics.threshold;
        }
        series
    }

    /// Truncation error of the velocity allowed in a step of `length` from a
    /// velocity `w`.
    #[inline(always)]
    fn allowed(&self, w: N, length: N) -> N {
        self.tolerance * self.dynamics.alpha.mul_add(length, w.abs())
    }

    /// Largest last coefficient of the velocity, per unit of the velocity,
    /// whose truncation error is allowed in a step of `length`.
    #[inline(always)]
    pub fn last_allowed(&self, length: N) -> N {
        self.tolerance / last_term(N::one(), length)
    }
}

/// A hard step, compiled for each instruction-set level.
struct Hard<'d, N, G, const F: usize, const HARD: usize> {
    driver: &'d mut Driver<N, G, F, HARD>,
    step: &'d mut Step<N>,
    length: N,
}

impl<N: Real, G: Forcing<N, F>, const F: usize, const HARD: usize> Kernel
    for Hard<'_, N, G, F, HARD>
{
    type Output = Advance<N>;

    #[inline(always)]
    fn run(self) -> Advance<N> {
        let Self { driver, step, length: mut part } = self;
        let tolerance = driver.tolerance;
        for halving in 0..=HALVINGS {
            if halving == HALVINGS {
                driver.tolerance = N::one() / N::zero();
            }
            let done = driver.attempt::<HARD>(step, part);
            driver.tolerance = tolerance;
            match done {
                // Short of the end of the step: go on from there.
                Some(Advance::Reached) if halving > 0 => {
                    return Advance::Bounced;
                }
                Some(done) => return done,
                None => part = part * N::ratio(1, 2),
            }
        }
        // Nothing bounds a motion that is not a number.
        let time_s = driver.time_s(step.place).to_f64();
        let error = SceneError::NotANumber { time_s };
        driver.record.exceeded.get_or_insert(error);
        Advance::Ended(Flight::Stopped)
    }
}

/// An assessed step, compiled for each instruction-set level. In double
/// precision it expands the longest series; the series of the step is its
/// beginning.
struct AssessedStepKernel<'d, D, N, const LEN: usize> {
    driver: D,
    step: &'d mut Step<N>,
    length: N,
}

impl<N, G, const LEN: usize, const F: usize, const HARD: usize> Kernel
    for AssessedStepKernel<'_, &mut Driver<N, G, F, HARD>, N, LEN>
where
    N: Real,
    G: Forcing<N, F>,
{
    type Output = Option<Advance<N>>;

    #[inline(always)]
    fn run(self) -> Self::Output {
        let Self { driver, step, length } = self;
        let BlockMotion { side, u, w } = step.motion;
        let drive = driver.drive(step.place, (side, u), step.at_threshold);
        let model = driver.dynamics.model;
        if LEN == HARD || N::ROUNDOFF < f64::ROUNDOFF {
            let series: TaylorSeries<N, LEN> =
                expand(model, (u, w), length, &drive);
            let mut left = surely_left_by(&series.v, length);
            if N::IS_GRADED {
                let rough = size(&series.v[fine(LEN) - 1..]);
                left = left + rough * N::from_f64(f64::EPSILON);
            }
            return driver.take(step, length, &series, &drive, Some(left));
        }
        let long: TaylorSeries<N, HARD> =
            expand(model, (u, w), length, &drive);
        let series: TaylorSeries<N, LEN> = long.beginning();
        let (end, longer) = (series.end(), long.end());
        let by_w = (longer.1 - end.1).abs();
        let by_u = (longer.0 - end.0).abs() / length;
        let most = if by_u > by_w { by_u } else { by_w };
        let left = most + surely_left_by(&long.v, length);
        driver.take(step, length, &series, &drive, Some(left))
    }
}

/// Estimated truncation error of the velocity over a step. The next
/// coefficient of the velocity is at most about a quarter of the last one
/// (1/`LEN` for the motion alone; the rest allows for strong forcing).
#[inline(always)]
fn left_by<N: Real, const LEN: usize>(v: &[N; LEN], length: N) -> N {
    last_term(v[LEN - 1].abs(), length)
}

/// Estimated truncation error of the velocity, from the size of the last
/// coefficient.
#[inline(always)]
pub(crate) fn last_term<N: Number>(last: N, length: N) -> N {
    N::ratio(1, 4) * last * length
}

/// Estimated truncation error of the velocity if the last coefficient may be
/// small by accident: under strong forcing only one coefficient in three of a
/// step from rest is large. The estimate extrapolates the envelope of the last
/// three from that of the three before.
fn surely_left_by<N: Real, const LEN: usize>(v: &[N; LEN], length: N) -> N {
    let few = (LEN / 2).min(3);
    let largest = |from: usize| {
        let part = v[from..from + few].iter();
        part.fold(0.0_f64, |most, x| most.max(x.abs().to_f64()))
    };
    let (last, before) = (largest(LEN - few), largest(LEN - 2 * few));
    let falls = (last / before).min(0.5);
    let next = N::from_f64(last * falls / (1.0 - falls));
    let left = left_by(v, length);
    if next > left { next } else { left }
}
