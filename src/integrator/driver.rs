//! The driver: rest, flight, events, end. One for every model, excitation
//! and precision.
//!
//! A run for one scene: `respond` checks the scene and calls `run::run`, which
//! picks forcing and series and enters `Driver::run` through `Isa::run`.
//! `Driver::begin` finds the first uplift (`uplift`, `Forcing::exceedance`),
//! or releases the block. `proceed` makes one step: `attempt` expands its
//! series; if the series leaves too much (`left_by`), `advance_hard` takes the
//! longest one and then halves the step. `first_event` finds the first impact
//! or overturning, and `turning_points` raises the peak. `impact` multiplies
//! the speed by eta and changes the side; a run for the peak alone ends there
//! if nothing can change the answer (`is_settled`), and the block rests if the
//! impacts provably end within the piece (`chatter`). If the excitation ends
//! in flight, `conclude` calls `coast`, or `follow` where observation ends too
//! early for it (`cuts`). `answer` makes the `Response`. If its rough estimate
//! (`doubt`) is not small, `Solver::respond` runs once more with every
//! decision assessed; the first run ends at the impact that makes this sure
//! (`Flight::Doubtful`).

mod decisions;
mod ending;
mod events;
mod forces;
mod impact;
mod limit;
mod step;
mod until;

pub use forces::Forces;
pub(crate) use step::last_term;

use crate::integrator::accuracy::Accuracy;
use crate::integrator::barrier::Barrier;
use crate::integrator::dynamics::{Dynamics, Overturning};
use crate::integrator::forcing::{Forcing, Moment, NEAR_THRESHOLD};
use crate::integrator::motion::{BlockMotion, RunTrace};
use crate::integrator::screen::Screen;
use crate::integrator::{
    Observe, Response, Scene, SceneError, Side, WorkLimit,
};
use crate::number::Real;
use crate::number::dispatch::Isa;

/// Truncation error allowed in a step, in units of roundoff times
/// (|w| + alpha h): what rounding does anyway.
const TRUNCATION_SHARE: f64 = 0.5;

/// Truncation allowed in a step, as a share of the velocity.
pub(crate) fn tolerance<N: Real>() -> f64 {
    TRUNCATION_SHARE * N::ROUNDOFF
}

/// How a step was left.
enum Advance<N> {
    /// At its end.
    Reached,
    /// At an impact within it.
    Bounced,
    /// Overturning within it: the step stands there.
    Overturned,
    /// The flight ended in it.
    Ended(Flight<N>),
}

/// Steps by a series whose length each call names, and by one of `HARD`
/// coefficients where that leaves too much; the forcing's series has `F`.
/// The short length is no part of the type: what does not depend on it is
/// compiled once.
pub(crate) struct Driver<N, G, const F: usize, const HARD: usize> {
    dynamics: Dynamics<N>,
    forcing: G,
    isa: Isa,
    record: RunTrace<N>,
    events: bool,
    interval_s: Option<f64>,
    /// A history or forces are asked for: each step is looked into.
    watched: bool,
    until_s: Option<N>,
    limit: WorkLimit,
    /// Truncation allowed in a step, as a share of the velocity.
    tolerance: N,
    /// Whether series keep their length, whatever their truncation error.
    fixed: bool,
    /// Rough certificate, where nothing but outcome and peak is asked for.
    screen: Option<Screen<N>>,
    /// Whether a run that is doubtful is made again.
    again: Again,
    /// Where it is asked whether what is left can change outcome or peak.
    barrier: Option<Barrier<N>>,
    /// Nothing but outcome and peak is asked for.
    ends_early: bool,
    /// First piece in which it is asked whether that matters.
    exit_from: usize,
}

/// Whether a run that is doubtful is made again, its decisions assessed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Again {
    No,
    /// It ends where it is surely doubtful.
    IfDoubtful,
    /// It is the one made again.
    Now,
}

/// How a flight through the excitation ended.
pub(crate) enum Flight<N> {
    /// At rest from this place on; the time (s) is when the last of the
    /// impacts has accumulated.
    Rest(Moment<N>, N),
    /// Overturned.
    Overturned { time_s: N, side: Side, margin: f64 },
    /// Nothing that the excitation has left can overturn the block or raise
    /// its peak.
    Settled,
    /// The excitation ended in flight.
    End(BlockMotion<N>),
    /// The observation ended in flight.
    Stopped,
    /// The run is doubtful, and is made again.
    Doubtful,
}

/// Motion about to enter a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step<N> {
    pub place: Moment<N>,
    /// Number of the step within its piece.
    pub index: usize,
    pub motion: BlockMotion<N>,
    /// The forcing is exactly at the uplift threshold.
    pub at_threshold: bool,
}

/// Where a run stands between steps.
pub(crate) enum Stage<N> {
    /// In flight, about to enter a step.
    Flying(Step<N>),
    /// Nothing is left to step.
    Landed(Flight<N>),
}

impl<N: Real, G: Forcing<N, F>, const F: usize, const HARD: usize>
    Driver<N, G, F, HARD>
{
    #[inline(always)]
    pub fn new(dynamics: Dynamics<N>, forcing: G, isa: Isa) -> Self {
        Self {
            dynamics,
            forcing,
            isa,
            record: RunTrace::empty(),
            events: false,
            interval_s: None,
            watched: false,
            until_s: None,
            limit: WorkLimit::default(),
            tolerance: N::from_f64(tolerance::<N>()),
            fixed: false,
            screen: None,
            again: Again::No,
            barrier: None,
            ends_early: false,
            exit_from: 0,
        }
    }

    /// One that may be made again.
    pub fn again(mut self, again: Again) -> Self {
        self.again = again;
        self
    }

    /// Ends as soon as outcome and peak are known, which nothing but them may
    /// be asked for.
    #[inline(always)]
    pub fn for_peak(mut self) -> Self {
        let matters = self.dynamics.overturning == Overturning::Alpha;
        self.barrier = matters.then(Barrier::none);
        self.ends_early = matters;
        self.screen = Some(Screen::at_rest());
        self
    }

    /// [`Self::for_peak`], if that is asked for.
    pub fn for_peak_if(self, asked: bool) -> Self {
        if asked { self.for_peak() } else { self }
    }

    /// With a truncation allowed in a step, as a share of the velocity. If
    /// it is infinite, the order is fixed.
    #[inline(always)]
    pub fn within(mut self, tolerance: f64) -> Self {
        self.tolerance = N::from_f64(tolerance);
        self.fixed = tolerance == f64::INFINITY;
        self
    }

    /// Runs the scene to its end.
    #[inline(always)]
    pub fn run<const SIZE: usize>(
        self,
        scene: &Scene<'_>,
        observe: &Observe,
    ) -> Result<Response<N>, SceneError> {
        self.run_seen::<SIZE>(scene, observe, |_, _| {})
    }

    /// [`Self::run`]; `see` is shown every step before it is made.
    #[inline(always)]
    pub fn run_seen<const SIZE: usize>(
        mut self,
        scene: &Scene<'_>,
        observe: &Observe,
        see: impl Fn(&Self, &Step<N>),
    ) -> Result<Response<N>, SceneError> {
        let mut stage = self.begin(scene, observe);
        loop {
            if let Some(error) = self.refusal(&stage) {
                return Err(error);
            }
            match stage {
                Stage::Flying(step) => {
                    see(&self, &step);
                    stage = self.proceed::<SIZE>(step);
                }
                Stage::Landed(flight) => {
                    return self.within_limit(&flight);
                }
            }
        }
    }

    /// Goes to the first step in flight.
    #[inline(always)]
    pub fn begin(&mut self, scene: &Scene<'_>, observe: &Observe) -> Stage<N> {
        self.observe(observe);
        self.record.forces = observe.forces.then(|| Forces::at_rest(scene));
        let start = Moment { piece: 0, offset: N::zero() };
        if !(scene.initial_ratio > 0.0) {
            return self.uplift(start, N::zero());
        }
        let u = self.dynamics.alpha * N::from_f64(scene.initial_ratio);
        let motion = BlockMotion { side: Side::Positive, u, w: N::zero() };
        self.record.peak = u;
        self.record.peak_time_s = Some(N::zero());
        for tracker in self.record.trackers() {
            tracker.release(u.to_f64());
        }
        Stage::Flying(Step {
            place: start,
            index: 0,
            motion,
            at_threshold: false,
        })
    }

    #[inline(always)]
    pub fn dynamics(&self) -> &Dynamics<N> {
        &self.dynamics
    }

    #[inline(always)]
    pub fn forcing(&self) -> &G {
        &self.forcing
    }

    /// Largest rotation so far at a turning point.
    #[inline(always)]
    pub fn peak(&self) -> N {
        self.record.peak
    }

    /// The rough certificate.
    #[inline(always)]
    pub fn screen(&mut self) -> &mut Screen<N> {
        self.screen.get_or_insert_with(Screen::at_rest)
    }

    /// First piece in which it is asked whether what is left matters.
    #[inline(always)]
    pub fn exit_from(&self) -> u64 {
        self.exit_from as u64
    }

    /// Counts steps taken elsewhere.
    #[inline(always)]
    pub fn count_steps(&mut self, steps: u64) {
        self.record.work.steps += steps;
    }

    /// Counts impacts solved elsewhere.
    #[inline(always)]
    pub fn count_impacts(&mut self, impacts: u64) {
        self.record.work.impacts += impacts;
    }

    fn observe(&mut self, observe: &Observe) {
        self.events = observe.events;
        self.interval_s = observe.history_interval_s;
        self.watched = self.interval_s.is_some() || observe.forces;
        self.until_s = observe.until_s.map(N::from_f64);
        self.limit = observe.work_limit;
        if observe.accuracy {
            let alpha = self.dynamics.alpha.to_f64();
            let own = Accuracy::of_arithmetic(N::ROUNDOFF, alpha);
            let wide = N::ROUNDOFF < f64::ROUNDOFF;
            self.record.accuracy = Some(own);
            self.record.inputs = wide.then(|| Accuracy::of_inputs(alpha));
            self.barrier.get_or_insert_with(Barrier::none);
        }
        let is_screened = self.again == Again::Now || !observe.accuracy;
        if is_screened && N::ROUNDOFF >= f64::ROUNDOFF {
            self.screen.get_or_insert_with(Screen::at_rest);
        }
    }

    /// From a place at rest to the next uplift, if there is one.
    #[inline(always)]
    fn uplift(&mut self, from: Moment<N>, since_s: N) -> Stage<N> {
        if self.is_settled(from.piece, N::zero()) {
            return Stage::Landed(Flight::Settled);
        }
        let (found, scan) =
            self.forcing.exceedance(from, self.dynamics.threshold);
        self.record.work.rest_scans += scan.pieces;
        for tracker in self.record.trackers() {
            tracker.at_rest(scan.nearest.to_f64(), since_s.to_f64());
        }
        if let Some(screen) = &mut self.screen
            && !(scan.nearest > N::from_f64(NEAR_THRESHOLD))
        {
            screen.doubt = N::one() / N::zero();
        }
        let Some(found) = found else {
            return Stage::Landed(Flight::Rest(from, since_s));
        };
        self.screen = self.screen.map(Screen::start);
        let time_s = self.time_s(found.place);
        self.assess_first_uplift(&found, time_s);
        if !self.observes(time_s) {
            return Stage::Landed(Flight::Rest(from, since_s));
        }
        self.sample_rest(time_s);
        self.record.work.uplifts += 1;
        self.record.uplift_time_s.get_or_insert(time_s);
        for tracker in self.record.trackers() {
            tracker.start();
        }
        let side =
            if found.positive { Side::Negative } else { Side::Positive };
        let motion = BlockMotion { side, u: N::zero(), w: N::zero() };
        Stage::Flying(Step {
            place: found.place,
            index: self.step_index(found.place),
            motion,
            at_threshold: found.crossing,
        })
    }

    /// One step by a series of `SIZE` coefficients, or a part of it, and the
    /// rest that may follow.
    #[inline(always)]
    pub fn proceed<const SIZE: usize>(
        &mut self,
        mut step: Step<N>,
    ) -> Stage<N> {
        match self.next::<SIZE>(&mut step) {
            None => Stage::Flying(step),
            Some(Flight::Rest(place, time_s)) => self.uplift(place, time_s),
            Some(flight) => Stage::Landed(flight),
        }
    }

    /// From an impact elsewhere that leaves a speed, after which the block
    /// comes to rest within `after` (in 1/p), to the next uplift.
    pub fn rest(&mut self, impact: Moment<N>, w: N, after: N) -> Stage<N> {
        let (place, time_s) = self.later(impact, w, after);
        self.uplift(place, time_s)
    }

    /// Where in the same piece, and when (s), a block has come to rest some
    /// time (in 1/p) after an impact that leaves a speed.
    #[inline(always)]
    fn later(&mut self, place: Moment<N>, w: N, after: N) -> (Moment<N>, N) {
        let left = self.forcing.length(place.piece) - place.offset;
        let rest = |screen: Screen<N>| screen.rest(w, after, left - after);
        self.screen = self.screen.map(rest);
        let time_s = self.time_s(place) + after / self.dynamics.p;
        let offset = place.offset + after;
        (Moment { offset, ..place }, time_s)
    }

    /// One step, or the part of it up to an impact.
    #[inline(always)]
    fn next<const SIZE: usize>(
        &mut self,
        step: &mut Step<N>,
    ) -> Option<Flight<N>> {
        let piece = step.place.piece;
        if piece >= self.forcing.pieces() {
            return Some(Flight::End(step.motion));
        }
        let total = self.forcing.length(piece);
        let steps = self.forcing.steps();
        let next = step.index + 1;
        let mut boundary = if next == steps {
            total
        } else {
            total * N::ratio(next as i32, steps as i32)
        };
        let mut stopping = false;
        if let Some(until) = self.until_s {
            let left = (until - self.forcing.start_s(piece)) * self.dynamics.p;
            if !(left > boundary) {
                boundary = left;
                stopping = true;
            }
        }
        let length = boundary - step.place.offset;
        if length > N::zero() {
            match self.advance::<SIZE>(step, length) {
                Advance::Reached => {}
                Advance::Bounced => return None,
                Advance::Overturned => {
                    return Some(self.overturned::<SIZE>(step));
                }
                Advance::Ended(flight) => return Some(flight),
            }
        }
        if stopping {
            self.stop(step);
            return Some(Flight::Stopped);
        }
        step.index = next;
        step.place.offset = boundary;
        if next == steps {
            // What was sure to end in this piece has not.
            for tracker in self.record.trackers() {
                tracker.rest_surely(false);
            }
            step.index = 0;
            step.place = Moment { piece: piece + 1, offset: N::zero() };
        }
        None
    }

    pub fn time_s(&self, place: Moment<N>) -> N {
        let pieces = self.forcing.pieces();
        if place.piece >= pieces {
            return self.end_s();
        }
        self.forcing.start_s(place.piece) + place.offset / self.dynamics.p
    }

    /// End of the excitation in s.
    fn end_s(&self) -> N {
        match self.forcing.pieces() {
            0 => N::zero(),
            n => {
                self.forcing.start_s(n - 1)
                    + self.forcing.length(n - 1) / self.dynamics.p
            }
        }
    }

    fn step_index(&self, place: Moment<N>) -> usize {
        let steps = self.forcing.steps();
        let share = place.offset / self.forcing.length(place.piece);
        let index = share.to_f64() * steps as f64;
        (index as usize).min(steps - 1)
    }
}
