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
//! the speed by eta and changes the side; a run for only the peak ends there
//! if nothing can change the answer (`is_settled`), and the block rests if the
//! impacts provably end within the piece (`chatter`). If the excitation ends
//! in flight, `conclude` calls `coast`, or `follow` if observation ends too
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
use crate::integrator::{Extent, Observe, Response, Scene, SceneError, Side};
use crate::number::Real;
use crate::number::dispatch::Isa;

/// Truncation error allowed in a step, in units of roundoff times
/// (|w| + alpha h): as large as the rounding error of the step.
pub(crate) const TRUNCATION_SHARE: f64 = 0.5;

/// Truncation error allowed in a step, as a share of the velocity.
pub(crate) fn tolerance<N: Real>() -> f64 {
    TRUNCATION_SHARE * N::ROUNDOFF
}

/// How a step ended.
enum Advance<N> {
    /// At its end.
    Reached,
    /// At an impact within it.
    Bounced,
    /// At overturning within it.
    Overturned,
    /// The flight ended in it.
    Ended(Flight<N>),
}

/// Makes steps by a series whose length each call names. If its truncation
/// error is too large, a series of `HARD` coefficients replaces it. The series
/// of the forcing has `F` coefficients. The short length is no parameter of
/// the type, so that code that does not depend on it is compiled once.
pub(crate) struct Driver<N, G, const F: usize, const HARD: usize> {
    pub dynamics: Dynamics<N>,
    pub forcing: G,
    isa: Isa,
    pub record: RunTrace<N>,
    pub observe: Observe,
    /// True if every step is sampled for history or forces.
    watched: bool,
    /// End of observation, s.
    until_s: Option<N>,
    /// Truncation error allowed in a step, as a share of the velocity.
    tolerance: N,
    /// True if series keep their length, whatever their truncation error.
    fixed: bool,
    /// Rough certificate.
    screen: Option<Screen<N>>,
    pub again: Again,
    /// Early-termination test; `None` if the whole run is needed.
    barrier: Option<Barrier<N>>,
    /// True if only outcome and peak are needed, or only the outcome.
    ends_early: bool,
    outcome_only: bool,
    /// First piece at which the early-termination test runs.
    pub exit_from: usize,
}

/// Whether a doubtful run is repeated with its decisions assessed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Again {
    No,
    /// The run ends as soon as it is surely doubtful.
    IfDoubtful,
    /// This run is the repetition.
    Now,
}

/// How a flight through the excitation ended.
pub(crate) enum Flight<N> {
    /// At rest from this place on; the impacts end at the time (s).
    Rest(Moment<N>, N),
    /// Overturned.
    Overturned { time_s: N, side: Side, margin: f64 },
    /// The rest of the excitation can neither overturn the block nor raise
    /// its peak.
    Settled,
    /// The excitation ended in flight.
    End(BlockMotion<N>),
    /// The observation ended in flight.
    Stopped,
    /// The run is doubtful and is repeated.
    Doubtful,
}

/// Motion at the start of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step<N> {
    pub place: Moment<N>,
    /// Number of the step within its piece.
    pub index: usize,
    pub motion: BlockMotion<N>,
    /// The forcing is exactly at the uplift threshold.
    pub at_threshold: bool,
}

impl<N: Real> Step<N> {
    /// The step at the start of the excitation.
    fn first(motion: BlockMotion<N>) -> Self {
        let place = Moment { piece: 0, offset: N::zero() };
        Self { place, index: 0, motion, at_threshold: false }
    }
}

/// State of a run between steps.
pub(crate) enum Stage<N> {
    /// In flight, about to enter a step.
    Flying(Step<N>),
    /// No step is left.
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
            record: RunTrace::default(),
            observe: Observe::default(),
            watched: false,
            until_s: None,
            tolerance: N::from_f64(tolerance::<N>()),
            fixed: false,
            screen: None,
            again: Again::No,
            barrier: None,
            ends_early: false,
            outcome_only: false,
            exit_from: 0,
        }
    }

    /// Ends as soon as the needed part of a run is known. Nothing else may be
    /// observed.
    #[inline(always)]
    pub fn for_extent(mut self, extent: Extent) -> Self {
        if extent == Extent::Whole {
            return self;
        }
        self.outcome_only = extent == Extent::Outcome;
        let matters = self.dynamics.overturning == Overturning::Alpha;
        self.barrier = matters.then(Barrier::none);
        self.ends_early = matters;
        let is_screened = N::ROUNDOFF >= f64::ROUNDOFF;
        self.screen = is_screened.then(Screen::at_rest);
        self
    }

    /// Sets the truncation error allowed in a step, as a share of the
    /// velocity. If it is infinite, the order is fixed.
    #[inline(always)]
    pub fn within(mut self, tolerance: f64) -> Self {
        self.tolerance = N::from_f64(tolerance);
        self.fixed = tolerance == f64::INFINITY;
        self
    }

    /// Runs the scene to its end; calls `see` before every step.
    #[inline(always)]
    pub fn run<const SIZE: usize>(
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
        if !(scene.initial_ratio > 0.0) {
            let start = Moment { piece: 0, offset: N::zero() };
            return self.uplift(start, N::zero());
        }
        let u = self.dynamics.alpha * N::from_f64(scene.initial_ratio);
        self.record.peak = u;
        self.record.peak_time_s = Some(N::zero());
        for tracker in self.record.trackers() {
            tracker.release(u.to_f64());
        }
        let motion = BlockMotion { side: Side::Positive, u, w: N::zero() };
        Stage::Flying(Step::first(motion))
    }

    /// The rough certificate.
    #[inline(always)]
    pub fn screen(&mut self) -> &mut Screen<N> {
        self.screen.get_or_insert_with(Screen::at_rest)
    }

    fn observe(&mut self, observe: &Observe) {
        self.observe = *observe;
        self.watched = observe.history_interval_s.is_some() || observe.forces;
        self.until_s = observe.until_s.map(N::from_f64);
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

    /// Goes from a place at rest to the next uplift, if there is one.
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

    /// Makes one step by a series of `SIZE` coefficients, or a part of it, and
    /// passes the rest that may follow.
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

    /// Goes from an impact that a lane has made, after which the block moves
    /// at `w` and comes to rest within `after` (in 1/p), to the next uplift.
    pub fn rest(&mut self, impact: Moment<N>, w: N, after: N) -> Stage<N> {
        let (place, time_s) = self.later(impact, w, after);
        self.uplift(place, time_s)
    }

    /// Place in the same piece, and time (s), of a rest that begins `after`
    /// (in 1/p) an impact after which the block moves at `w`.
    #[inline(always)]
    fn later(&mut self, place: Moment<N>, w: N, after: N) -> (Moment<N>, N) {
        let left = self.forcing.length(place.piece) - place.offset;
        let rest = |screen: Screen<N>| screen.rest(w, after, left - after);
        self.screen = self.screen.map(rest);
        let time_s = self.time_s(place) + after / self.dynamics.p;
        let offset = place.offset + after;
        (Moment { offset, ..place }, time_s)
    }

    /// Makes one step, or the part of it up to an impact.
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
            let done = self.attempt::<SIZE>(step, length);
            match done.unwrap_or_else(|| self.advance_hard(step, length)) {
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
            // The chatter has not ended in this piece, as it was sure to.
            for tracker in self.record.trackers() {
                tracker.resting = false;
            }
            step.index = 0;
            step.place = Moment { piece: piece + 1, offset: N::zero() };
        }
        None
    }

    pub fn time_s(&self, place: Moment<N>) -> N {
        if place.piece >= self.forcing.pieces() {
            return self.end_s();
        }
        self.forcing.start_s(place.piece) + place.offset / self.dynamics.p
    }

    /// End of the excitation in s.
    fn end_s(&self) -> N {
        self.forcing.pieces().checked_sub(1).map_or(N::zero(), |last| {
            self.forcing.start_s(last)
                + self.forcing.length(last) / self.dynamics.p
        })
    }

    fn step_index(&self, place: Moment<N>) -> usize {
        let steps = self.forcing.steps();
        let share = place.offset / self.forcing.length(place.piece);
        let index = share.to_f64() * steps as f64;
        (index as usize).min(steps - 1)
    }
}
