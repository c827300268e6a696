//! The driver: rest, flight, events, end. One for every model, excitation
//! and precision.

use crate::integrator::accuracy::Accuracy;
use crate::integrator::coast::{Coast, coast};
use crate::integrator::dynamics::{Dynamics, Model, Overturning};
use crate::integrator::forcing::{Forcing, Place, Silence};
use crate::integrator::roots::first_descent;
use crate::integrator::taylor::{expand, slope, value};
use crate::integrator::{
    HistoryPoint, Impact, Observe, Outcome, Response, Scene, Side, Work,
};
use crate::number::dispatch::{Isa, Work as Dispatched};
use crate::number::{Number, Real};

/// Post-impact speed over alpha p below which an observer of events lets the
/// geometric tail of the impacts stand for the rest of them: the tail's own
/// error is of second order in it (over the square of the least downward
/// acceleration, which grazing uplifts make small).
pub(crate) fn tail_speed<N: Real>() -> f64 {
    if N::ROUNDOFF < f64::ROUNDOFF { 1e-26 } else { 1e-10 }
}

/// Truncation allowed per unit of time, in roundoffs of the slenderness
/// angle: what rounding does anyway.
const TRUNCATION_SHARE: f64 = 0.5;

/// Halvings of a step at most: 2^-12 of it is accepted as it is, and the
/// error estimate says what it leaves.
const HALVINGS: u32 = 12;

/// State of a block in motion, in units of 1/p: u = |theta| on a side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<N> {
    pub side: Side,
    pub u: N,
    pub w: N,
}

/// What a run gathers.
pub(crate) struct Record<N> {
    pub peak: N,
    pub peak_time_s: Option<N>,
    pub uplift_time_s: Option<N>,
    pub rest_time_s: Option<N>,
    pub impacts: Vec<Impact<N>>,
    pub history: Vec<HistoryPoint<N>>,
    pub work: Work,
    /// Largest |a/g| met, for the margin of a run without uplift.
    pub accuracy: Option<Accuracy>,
}

/// Steps by a series of `SIZE` coefficients, and by one of `HARD` where that
/// leaves too much; the forcing's series has `F`.
pub(crate) struct Driver<
    N,
    G,
    const SIZE: usize,
    const F: usize,
    const HARD: usize,
> {
    dynamics: Dynamics<N>,
    forcing: G,
    isa: Isa,
    record: Record<N>,
    events: bool,
    interval_s: Option<f64>,
    until_s: Option<N>,
    /// Truncation allowed per unit of p-time.
    tolerance: N,
}

/// How a flight through the excitation ended.
pub(crate) enum Flight<N> {
    /// At rest from this place on; the time (s) is when the last of the
    /// impacts has accumulated.
    Rest(Place<N>, N),
    /// Overturned.
    Overturned { time_s: N, side: Side, margin: f64 },
    /// The excitation ended in flight.
    End(Motion<N>),
    /// The observation ended in flight.
    Stopped,
}

/// Motion about to enter a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step<N> {
    pub place: Place<N>,
    /// Number of the step within its piece.
    pub index: usize,
    pub motion: Motion<N>,
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

/// How a step was left.
enum Advance<N> {
    /// At its end.
    Reached,
    /// At an impact within it.
    Bounced,
    /// The flight ended in it.
    Ended(Flight<N>),
}

/// What happened in a step.
enum Event<N> {
    None,
    Impact(N),
    Overturning(N),
}

impl<N, G, const SIZE: usize, const F: usize, const HARD: usize>
    Driver<N, G, SIZE, F, HARD>
where
    N: Real,
    G: Forcing<N, F>,
{
    #[inline(always)]
    pub fn new(dynamics: Dynamics<N>, forcing: G, isa: Isa) -> Self {
        let record = Record {
            peak: N::zero(),
            peak_time_s: None,
            uplift_time_s: None,
            rest_time_s: None,
            impacts: Vec::new(),
            history: Vec::new(),
            work: Work::default(),
            accuracy: None,
        };
        Self {
            dynamics,
            forcing,
            isa,
            record,
            events: false,
            interval_s: None,
            until_s: None,
            tolerance: dynamics.alpha
                * N::from_f64(TRUNCATION_SHARE * N::ROUNDOFF),
        }
    }

    /// Keeps the order whatever a step leaves.
    #[inline(always)]
    pub fn at_fixed_order(mut self) -> Self {
        self.tolerance = N::one() / N::zero();
        self
    }

    /// Runs the scene to its end.
    #[inline(always)]
    pub fn run(mut self, scene: &Scene<'_>, observe: &Observe) -> Response<N> {
        let mut stage = self.begin(scene, observe);
        loop {
            match stage {
                Stage::Flying(step) => stage = self.proceed(step),
                Stage::Landed(flight) => return self.conclude(&flight),
            }
        }
    }

    /// Goes to the first step in flight.
    #[inline(always)]
    pub fn begin(&mut self, scene: &Scene<'_>, observe: &Observe) -> Stage<N> {
        self.observe(observe);
        let start = Place { piece: 0, offset: N::zero() };
        if !(scene.initial_ratio > 0.0) {
            return self.uplift(start, N::zero());
        }
        let u = self.dynamics.alpha * N::from_f64(scene.initial_ratio);
        let motion = Motion { side: Side::Positive, u, w: N::zero() };
        self.record.peak = u;
        self.record.peak_time_s = Some(N::zero());
        if let Some(accuracy) = &mut self.record.accuracy {
            accuracy.start();
            let alpha = self.dynamics.alpha.to_f64();
            accuracy.peak(u.to_f64(), alpha);
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

    /// Counts steps taken elsewhere.
    #[inline(always)]
    pub fn count_steps(&mut self, steps: u64) {
        self.record.work.steps += steps;
    }

    /// Counts an impact solved elsewhere.
    #[inline(always)]
    pub fn count_impact(&mut self) {
        self.record.work.impacts += 1;
    }

    /// Truncation allowed per unit of p-time.
    #[inline(always)]
    pub fn tolerance(&self) -> N {
        self.tolerance
    }

    /// Last of `LEN` coefficients of the velocity that leaves as much as is
    /// allowed over a step of `length`.
    #[inline(always)]
    pub fn last_allowed<const LEN: usize>(&self, length: N) -> N {
        self.tolerance * length / last_term(N::one(), LEN, length)
    }

    fn observe(&mut self, observe: &Observe) {
        self.events = observe.events;
        self.interval_s = observe.history_interval_s;
        self.until_s = observe.until_s.map(N::from_f64);
        self.record.accuracy =
            observe.accuracy.then(|| Accuracy::new(N::ROUNDOFF));
    }

    /// From a place at rest to the next uplift, if there is one.
    #[inline(always)]
    fn uplift(&mut self, from: Place<N>, since_s: N) -> Stage<N> {
        let (found, scans) =
            self.forcing.exceedance(from, self.dynamics.threshold);
        self.record.work.rest_scans += scans;
        let Some(found) = found else {
            return Stage::Landed(Flight::Rest(from, since_s));
        };
        let time_s = self.time_s(found.place);
        if self.until_s.is_some_and(|until| !(time_s < until)) {
            return Stage::Landed(Flight::Stopped);
        }
        self.sample_rest(time_s);
        self.record.work.uplifts += 1;
        self.record.uplift_time_s.get_or_insert(time_s);
        if let Some(accuracy) = &mut self.record.accuracy {
            accuracy.start();
        }
        let side =
            if found.positive { Side::Negative } else { Side::Positive };
        let motion = Motion { side, u: N::zero(), w: N::zero() };
        Stage::Flying(Step {
            place: found.place,
            index: self.step_index(found.place),
            motion,
            at_threshold: found.crossing,
        })
    }

    /// One step, or a part of it, and the rest that may follow.
    #[inline(always)]
    pub fn proceed(&mut self, mut step: Step<N>) -> Stage<N> {
        match self.next(&mut step) {
            None => Stage::Flying(step),
            Some(Flight::Rest(place, time_s)) => self.uplift(place, time_s),
            Some(flight) => Stage::Landed(flight),
        }
    }

    /// One step, or the part of it up to an impact.
    #[inline(always)]
    fn next(&mut self, step: &mut Step<N>) -> Option<Flight<N>> {
        let piece = step.place.piece;
        if piece >= self.forcing.pieces() {
            return Some(Flight::End(step.motion));
        }
        let total = self.forcing.length(piece);
        let steps = self.forcing.steps();
        let mut boundary = if step.index + 1 >= steps {
            total
        } else {
            total * N::ratio(step.index as i32 + 1, steps as i32)
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
            match self.advance(step, length) {
                Advance::Reached => {}
                Advance::Bounced => return None,
                Advance::Ended(flight) => return Some(flight),
            }
        }
        if stopping {
            self.stop(step.motion);
            return Some(Flight::Stopped);
        }
        step.index += 1;
        step.place.offset = boundary;
        if step.index >= steps {
            step.index = 0;
            step.place = Place { piece: piece + 1, offset: N::zero() };
        }
        None
    }

    /// One step: to its end, or to the first event in it.
    #[inline(always)]
    fn advance(&mut self, step: &mut Step<N>, length: N) -> Advance<N> {
        self.attempt::<SIZE>(step, length)
            .unwrap_or_else(|| self.advance_hard(step, length))
    }

    /// A step of which the short series leaves too much: a longer series,
    /// then a shorter step.
    #[inline(never)]
    fn advance_hard(&mut self, step: &mut Step<N>, length: N) -> Advance<N> {
        self.isa.run(Hard { driver: self, step, length })
    }

    #[inline(always)]
    fn lengthened(&mut self, step: &mut Step<N>, length: N) -> Advance<N> {
        let mut part = length;
        for halving in 0..=HALVINGS {
            let last = halving == HALVINGS;
            let tolerance = self.tolerance;
            if last {
                self.tolerance = N::one() / N::zero();
            }
            let done = self.attempt::<HARD>(step, part);
            self.tolerance = tolerance;
            match done {
                // Short of the step's end: go on from there.
                Some(Advance::Reached) if halving > 0 => {
                    return Advance::Bounced;
                }
                Some(done) => return done,
                None => part = part * N::ratio(1, 2),
            }
        }
        // Not a number: nothing bounds the motion any more.
        Advance::Ended(Flight::Stopped)
    }

    /// A step by a series of `LEN` coefficients, unless it leaves too much.
    #[inline(always)]
    fn attempt<const LEN: usize>(
        &mut self,
        step: &mut Step<N>,
        length: N,
    ) -> Option<Advance<N>> {
        let Motion { side, u, w } = step.motion;
        let oriented = self.oriented(step.place, side, step.at_threshold);
        let (a, b) = self.dynamics.drive(&oriented);
        let (c, v): ([N; LEN], [N; LEN]) = self.expand(u, w, (&a, &b));
        let (c, v) = (&c, &v);
        self.record.work.steps += 1;
        if left_by(v, length) > self.tolerance * length {
            return None;
        }
        let event = self.first_event(c, length);
        let tau = match event {
            Event::None => length,
            Event::Impact(tau) | Event::Overturning(tau) => tau,
        };
        self.turning_points(c, v, tau, step.place);
        if self.interval_s.is_some() {
            self.sample_step(c, v, tau, step.place, side);
        }
        let (end_u, end_w) = (value(c, tau), value(v, tau));
        if self.record.accuracy.is_some() {
            let f = self.oriented(step.place, side, step.at_threshold);
            let (a, b) = self.dynamics.drive(&f);
            self.track(c, v, (a[0], b[0]), tau, (end_u, end_w));
        }
        step.at_threshold = false;
        step.place.offset = step.place.offset + tau;
        match event {
            Event::None => {
                step.motion = Motion { side, u: end_u, w: end_w };
                Some(Advance::Reached)
            }
            Event::Overturning(_) => {
                let time_s = self.time_s(step.place);
                let motion = Motion { side, u: end_u, w: end_w };
                let margin = self.margin_beyond(step.place, motion);
                Some(Advance::Ended(Flight::Overturned {
                    time_s,
                    side,
                    margin,
                }))
            }
            Event::Impact(_) => {
                let before = slope(v, tau);
                Some(
                    self.impact(step, -end_w, before)
                        .map_or(Advance::Bounced, Advance::Ended),
                )
            }
        }
    }

    /// Taylor polynomial of the motion.
    #[inline(always)]
    fn expand<const LEN: usize>(
        &self,
        u: N,
        w: N,
        drive: (&[N; F], &[N; F]),
    ) -> ([N; LEN], [N; LEN]) {
        let model = self.dynamics.model;
        let sine_cosine = match model {
            // Beyond pi/4 the short polynomials lose digits.
            Model::Nonlinear if u > N::ratio(785, 1000) => u.sin_cos(),
            Model::Nonlinear => u.sin_cos_small(),
            Model::Linearized => (u, N::one()),
        };
        expand(model, u, w, drive, sine_cosine)
    }

    /// Series of s a/g about a place.
    #[inline(always)]
    fn oriented(&self, place: Place<N>, side: Side, exact: bool) -> [N; F] {
        let mut series = self.forcing.series(place);
        if side == Side::Negative {
            series = series.map(|x| -x);
        }
        if exact {
            series[0] = -self.dynamics.threshold;
        }
        series
    }

    /// First impact or overturning in (0, length].
    #[inline(always)]
    fn first_event<const LEN: usize>(
        &self,
        c: &[N; LEN],
        length: N,
    ) -> Event<N> {
        // Bound on |u(tau) - u_0 - w_0 tau| / tau over the step.
        let mut rest = N::zero();
        for k in (2..LEN).rev() {
            rest = rest.mul_add(length, c[k].abs());
        }
        let rest = rest * length;
        let linear = c[1] * length;
        let spread = rest * length;
        let (down, up) = if c[1] < N::zero() {
            (linear, N::zero())
        } else {
            (N::zero(), linear)
        };
        let clear_of_base =
            c[0] + down > spread || (c[0] == N::zero() && c[1] > rest);
        let clear_of_limit = c[0] + up + spread < self.dynamics.limit;
        if clear_of_base && clear_of_limit {
            return Event::None;
        }
        let impact = if clear_of_base {
            None
        } else {
            first_descent(c, length, self.isa)
        };
        let overturning = if clear_of_limit {
            None
        } else {
            let mut gap = c.map(|x| -x);
            gap[0] = self.dynamics.limit - c[0];
            first_descent(&gap, length, self.isa)
        };
        match (impact, overturning) {
            (None, None) => Event::None,
            (Some(tau), None) => Event::Impact(tau),
            (None, Some(tau)) => Event::Overturning(tau),
            (Some(i), Some(o)) if i < o => Event::Impact(i),
            (Some(_), Some(o)) => Event::Overturning(o),
        }
    }

    /// Raises the peak by the turning points in (0, tau).
    #[inline(always)]
    fn turning_points<const LEN: usize>(
        &mut self,
        c: &[N; LEN],
        v: &[N; LEN],
        tau: N,
        place: Place<N>,
    ) {
        let mut rest = N::zero();
        for k in (2..LEN).rev() {
            rest = rest.mul_add(tau, c[k].abs());
        }
        let rise = if c[1] > N::zero() { c[1] * tau } else { N::zero() };
        if !(c[0] + rise + rest * tau * tau > self.record.peak) {
            return;
        }
        let mut variation = N::zero();
        for k in (1..LEN).rev() {
            variation = variation.mul_add(tau, v[k].abs());
        }
        if v[0].abs() > variation * tau {
            return;
        }
        self.raise_by_turning(c, v, tau, place);
    }

    #[inline(never)]
    fn raise_by_turning<const LEN: usize>(
        &mut self,
        c: &[N; LEN],
        v: &[N; LEN],
        tau: N,
        place: Place<N>,
    ) {
        let isa = self.isa;
        isa.run(Turning { driver: self, c, v, tau, place });
    }

    #[inline(always)]
    fn locate_turning_points<const LEN: usize>(
        &mut self,
        c: &[N; LEN],
        v: &[N; LEN],
        tau: N,
        place: Place<N>,
    ) {
        let mut at = N::zero();
        let mut v = *v;
        // At most LEN turning points lie in a step.
        for _ in 0..LEN {
            let left = tau - at;
            let first = v.iter().find(|x| **x != N::zero());
            let Some(first) = first else { return };
            let rising = *first > N::zero();
            if !rising {
                v = v.map(|x| -x);
            }
            let Some(turn) = first_descent(&v, left, self.isa) else {
                return;
            };
            if !(turn < left) {
                return;
            }
            at = at + turn;
            if rising {
                self.raise_peak(value(c, at), place, at);
            }
            if !rising {
                v = v.map(|x| -x);
            }
            shift(&mut v, turn);
            // The root itself: exactly zero, so that deflation applies.
            v[0] = N::zero();
        }
    }

    /// Counts a turning point at `u`, `tau` after a place.
    pub fn raise_peak(&mut self, u: N, place: Place<N>, tau: N) {
        self.record.work.turning_points += 1;
        if u > self.record.peak {
            self.record.peak = u;
            let offset = place.offset + tau;
            let time_s = self.time_s(Place { offset, ..place });
            self.record.peak_time_s = Some(time_s);
            if let Some(accuracy) = &mut self.record.accuracy {
                accuracy.peak(u.to_f64(), self.dynamics.alpha.to_f64());
            }
        }
    }

    /// The impact at a step's place, `speed` before it; rest if it ends
    /// there.
    #[inline(always)]
    fn impact(
        &mut self,
        step: &mut Step<N>,
        speed: N,
        before: N,
    ) -> Option<Flight<N>> {
        let speed = if speed > N::zero() { speed } else { N::zero() };
        let side = step.motion.side.flipped();
        let w = self.dynamics.eta * speed;
        self.record.work.impacts += 1;
        if self.events && speed > N::zero() {
            self.record.impacts.push(Impact {
                time_s: self.time_s(step.place),
                speed_before_rad_s: speed * self.dynamics.p,
            });
        }
        let f = self.oriented(step.place, side, false);
        if let Some(accuracy) = &mut self.record.accuracy {
            let after = -self.dynamics.restoring(f[0]).to_f64();
            let eta = self.dynamics.eta.to_f64();
            accuracy.impact(eta, speed.to_f64(), before.to_f64(), after);
        }
        step.motion = Motion { side, u: N::zero(), w };
        let left = self.forcing.length(step.place.piece) - step.place.offset;
        let time = self.chatter(&f, w, left)?;
        let time_s = self.time_s(step.place) + time / self.dynamics.p;
        let offset = step.place.offset + time;
        let piece = step.place.piece;
        Some(Flight::Rest(Place { piece, offset }, time_s))
    }

    /// Time (in 1/p) in which the impacts after one that leaves speed `w`
    /// accumulate, if they provably do within `left` while the ground stays
    /// below the uplift threshold; `f` is the forcing on the new branch.
    ///
    /// Each hop rises by at most w^2/D and lasts at most 2 w/D, D being the
    /// least downward acceleration; from hop to hop the speed falls by
    /// eta sqrt(D_max/D_min) at least.
    #[inline(always)]
    fn chatter(&self, f: &[N; F], w: N, left: N) -> Option<N> {
        let threshold = self.dynamics.threshold;
        let margin = threshold - f[0].abs();
        if w == N::zero() {
            return (!(margin < N::zero())).then_some(N::zero());
        }
        let two = N::from_f64(2.0);
        let eta = self.dynamics.eta;
        if !(margin > N::zero()) || !(eta < N::one()) {
            return None;
        }
        // Quick refusal before the proof.
        let scale = self.dynamics.restoring(-f[0].abs());
        let guess = two * w / (scale * (N::one() - eta));
        if !(guess < left) {
            return None;
        }
        self.prove(f, w, left, two * guess)
    }

    #[inline(never)]
    fn prove(&self, f: &[N; F], w: N, left: N, window: N) -> Option<N> {
        let two = N::from_f64(2.0);
        let window = if window < left { window } else { left };
        let mut drift = N::zero();
        for k in (1..F).rev() {
            drift = (drift + f[k].abs()) * window;
        }
        let least = self.dynamics.restoring(-(f[0].abs() + drift));
        if !(least > N::zero()) {
            return None;
        }
        // Eq. 1 pushes outwards by at most (1 + tan alpha) u on a hop.
        let rise = w * w / least;
        let push = (N::one() + self.dynamics.threshold) * (rise + rise);
        let least = least - push;
        if !(least > N::zero()) {
            return None;
        }
        let most = |f0: N| self.dynamics.restoring(f0 + drift) + push;
        let low = |f0: N| self.dynamics.restoring(f0 - drift) - push;
        let ratio = |f0: N| most(f0) / low(f0);
        let (here, there) = (ratio(f[0]), ratio(-f[0]));
        let worst = if here > there { here } else { there };
        let eta = self.dynamics.eta;
        let decay = eta * worst.sqrt();
        if !(decay < N::one()) {
            return None;
        }
        let bound = two * w * worst.sqrt() / (least * (N::one() - decay));
        if !(bound < window) {
            return None;
        }
        // A hop of the tail must not raise the peak.
        if !(w * w / (two * least) * worst < self.record.peak) {
            return None;
        }
        let tail = self.dynamics.alpha * N::from_f64(tail_speed::<N>());
        if self.events && !(w < tail) {
            return None;
        }
        // 2 w [1/D + eta/D'] / (1 - eta^2), D and D' on the two branches.
        let up = self.dynamics.restoring(f[0]);
        let down = self.dynamics.restoring(-f[0]);
        let hops = N::one() / up + eta / down;
        Some(two * w * hops / (N::one() - eta * eta))
    }

    /// Next turning value of |theta|/alpha beyond an overturning, minus 1;
    /// infinite if the block never turns.
    #[inline(never)]
    fn margin_beyond(&self, from: Place<N>, motion: Motion<N>) -> f64 {
        self.isa.run(Beyond { driver: self, from, motion })
    }

    #[inline(always)]
    fn turning_beyond(&self, from: Place<N>, motion: Motion<N>) -> f64 {
        if self.dynamics.overturning == Overturning::HalfPi {
            return f64::INFINITY;
        }
        let Motion { side, mut u, mut w } = motion;
        let mut offset = from.offset;
        for piece in from.piece..self.forcing.pieces() {
            let left = self.forcing.length(piece) - offset;
            let f = self.oriented(Place { piece, offset }, side, false);
            let (a, b) = self.dynamics.drive(&f);
            let (c, v): ([N; HARD], [N; HARD]) = self.expand(u, w, (&a, &b));
            if let Some(tau) = first_descent(&v, left, self.isa) {
                return self.beyond(value(&c, tau));
            }
            (u, w) = (value(&c, left), value(&v, left));
            if !(u < N::right_angle()) {
                return f64::INFINITY;
            }
            offset = N::zero();
        }
        // Beyond the saddle and moving outwards, nothing turns it back.
        f64::INFINITY
    }

    fn beyond(&self, u: N) -> f64 {
        ((u - self.dynamics.alpha) / self.dynamics.alpha).to_f64()
    }

    /// Accumulates the error of a step.
    #[inline(never)]
    fn track<const LEN: usize>(
        &mut self,
        c: &[N; LEN],
        v: &[N; LEN],
        drive: (N, N),
        tau: N,
        (u, w): (N, N),
    ) {
        let model = self.dynamics.model;
        let Some(accuracy) = &mut self.record.accuracy else { return };
        let (a, b) = (drive.0.to_f64(), drive.1.to_f64());
        let u0 = c[0].to_f64();
        let last = left_by(v, tau).to_f64();
        let tau = tau.to_f64();
        let (j, force) = match model {
            Model::Nonlinear => {
                let (s, c) = (libm::sin(u0), libm::cos(u0));
                (a * c + b * s, (a * s).abs() + (b * c).abs())
            }
            Model::Linearized => (1.0, u0.abs() + b.abs()),
        };
        // The forcing itself carries a roundoff: the threshold's size.
        let size = force + self.dynamics.threshold.to_f64();
        let unit = N::ROUNDOFF;
        let error_u = unit * u.to_f64().abs().max(u0) + last * tau;
        let speed = w.to_f64().abs().max(c[1].to_f64().abs());
        let error_w = unit * (speed + size * tau) + last;
        accuracy.step(j, tau, [error_u, error_w]);
    }

    fn time_s(&self, place: Place<N>) -> N {
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

    fn step_index(&self, place: Place<N>) -> usize {
        let steps = self.forcing.steps();
        let share = place.offset / self.forcing.length(place.piece);
        let index = share.to_f64() * steps as f64;
        (index as usize).min(steps - 1)
    }

    /// The observation stops in flight: the rotation there counts.
    fn stop(&mut self, motion: Motion<N>) {
        if motion.u > self.record.peak {
            self.record.peak = motion.u;
            self.record.peak_time_s = self.until_s;
            if let Some(accuracy) = &mut self.record.accuracy {
                let alpha = self.dynamics.alpha.to_f64();
                accuracy.peak(motion.u.to_f64(), alpha);
            }
        }
    }

    /// Zeros of a history up to a time.
    fn sample_rest(&mut self, to_s: N) {
        let Some(interval) = self.interval_s else { return };
        let mut time_s = self.record.history.len() as f64 * interval;
        while time_s <= to_s.to_f64() {
            self.record.history.push(HistoryPoint {
                time_s: N::from_f64(time_s),
                rotation_rad: N::zero(),
                velocity_rad_s: N::zero(),
            });
            time_s = self.record.history.len() as f64 * interval;
        }
    }

    /// Points of a history within a step.
    #[inline(never)]
    fn sample_step<const LEN: usize>(
        &mut self,
        c: &[N; LEN],
        v: &[N; LEN],
        tau: N,
        place: Place<N>,
        side: Side,
    ) {
        let Some(interval) = self.interval_s else { return };
        let start_s = self.time_s(place);
        let p = self.dynamics.p;
        let sign = N::from_f64(side.sign());
        loop {
            let time_s = self.record.history.len() as f64 * interval;
            let time_s = N::from_f64(time_s);
            let at = (time_s - start_s) * p;
            if !(at <= tau) {
                return;
            }
            let at = if at > N::zero() { at } else { N::zero() };
            self.record.history.push(HistoryPoint {
                time_s,
                rotation_rad: sign * value(c, at),
                velocity_rad_s: sign * (value(v, at) * p),
            });
        }
    }

    /// From the end of a flight to the answer.
    pub fn conclude(&mut self, flight: &Flight<N>) -> Response<N> {
        let alpha = self.dynamics.alpha;
        let mut margin = None;
        let mut overturned = None;
        match *flight {
            Flight::Rest(_, time_s) => {
                if self.record.work.uplifts > 0 || self.record.work.impacts > 0
                {
                    self.record.rest_time_s = Some(time_s);
                }
                let end = self.until_s.unwrap_or(self.end_s());
                self.sample_rest(end);
            }
            Flight::Stopped => {
                if let Some(until) = self.until_s {
                    self.sample_rest(until);
                }
            }
            Flight::Overturned { time_s, side, margin: beyond } => {
                margin = Some(beyond);
                overturned = Some((time_s, side));
                if let Some(accuracy) = &mut self.record.accuracy {
                    accuracy.overturned(alpha.to_f64());
                }
            }
            Flight::End(motion) => {
                let end_s = self.end_s();
                let coasting = Coast {
                    dynamics: &self.dynamics,
                    start_s: end_s,
                    events: self.events,
                    until_s: self.until_s,
                };
                let fate = coast(&coasting, motion, &mut self.record);
                margin = fate.margin;
                overturned = fate.overturned;
                if self.interval_s.is_some() {
                    self.trace(motion, end_s);
                }
            }
        }
        self.answer(overturned, margin)
    }

    /// History of the free motion after the excitation, stepped.
    #[inline(never)]
    fn trace(&mut self, motion: Motion<N>, end_s: N) {
        let silence = Silence::endless(end_s, self.dynamics.p);
        let mut free = Driver::<N, _, HARD, 1, HARD>::new(
            self.dynamics,
            silence,
            self.isa,
        );
        free.events = true;
        free.interval_s = self.interval_s;
        free.until_s = self.until_s.or_else(|| {
            // Without restitution the motion never ends: show some of it.
            let horizon = N::from_f64(60.0) / self.dynamics.p;
            (!(self.dynamics.eta < N::one())).then_some(end_s + horizon)
        });
        free.record.history = std::mem::take(&mut self.record.history);
        let mut stage = Stage::Flying(Step {
            place: Place { piece: 0, offset: N::zero() },
            index: 0,
            motion,
            at_threshold: false,
        });
        while let Stage::Flying(step) = stage {
            stage = free.proceed(step);
        }
        if let Stage::Landed(Flight::Rest(_, time_s)) = stage {
            let end = free.until_s.unwrap_or(time_s);
            free.sample_rest(end);
        }
        self.record.history = free.record.history;
    }

    fn answer(
        &mut self,
        overturned: Option<(N, Side)>,
        margin: Option<f64>,
    ) -> Response<N> {
        let alpha = self.dynamics.alpha;
        let record = &mut self.record;
        let moved = record.uplift_time_s.is_some()
            || record.peak > N::zero()
            || record.work.impacts > 0;
        let ratio = record.peak / alpha;
        let own = match self.dynamics.overturning {
            Overturning::Alpha => N::one() - ratio,
            Overturning::HalfPi => (N::right_angle() - record.peak) / alpha,
        };
        let outcome = match overturned {
            Some((time_s, side)) => Outcome::Overturned { time_s, side },
            None if moved => Outcome::Rocked { peak_ratio: ratio },
            None => Outcome::NoUplift,
        };
        let fate_margin = match margin {
            Some(beyond) if outcome.is_overturned() => beyond,
            Some(decision) => own.to_f64().min(decision),
            None => own.to_f64(),
        };
        let accuracy = record.accuracy;
        Response {
            outcome,
            peak_ratio: ratio,
            peak_time_s: record.peak_time_s,
            uplift_time_s: record.uplift_time_s,
            rest_time_s: record.rest_time_s,
            impacts: std::mem::take(&mut record.impacts),
            fate_margin,
            error_estimate: accuracy.map(|a| a.peak_error()),
            fate_error: accuracy.map(|a| a.fate_error()),
            condition_number: accuracy.map(|a| a.peak_condition()),
            work: record.work,
            history: std::mem::take(&mut record.history),
        }
    }
}

/// A hard step, compiled for each instruction-set level.
struct Hard<'d, N, G, const SIZE: usize, const F: usize, const HARD: usize> {
    driver: &'d mut Driver<N, G, SIZE, F, HARD>,
    step: &'d mut Step<N>,
    length: N,
}

impl<N, G, const SIZE: usize, const F: usize, const HARD: usize> Dispatched
    for Hard<'_, N, G, SIZE, F, HARD>
where
    N: Real,
    G: Forcing<N, F>,
{
    type Output = Advance<N>;

    #[inline(always)]
    fn run(self) -> Advance<N> {
        self.driver.lengthened(self.step, self.length)
    }
}

/// The margin of an overturning, compiled for each instruction-set level.
struct Beyond<'d, N, G, const SIZE: usize, const F: usize, const HARD: usize> {
    driver: &'d Driver<N, G, SIZE, F, HARD>,
    from: Place<N>,
    motion: Motion<N>,
}

impl<N, G, const SIZE: usize, const F: usize, const HARD: usize> Dispatched
    for Beyond<'_, N, G, SIZE, F, HARD>
where
    N: Real,
    G: Forcing<N, F>,
{
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        self.driver.turning_beyond(self.from, self.motion)
    }
}

/// Turning points of a step, compiled for each instruction-set level.
struct Turning<
    'd,
    N,
    G,
    const LEN: usize,
    const SIZE: usize,
    const F: usize,
    const HARD: usize,
> {
    driver: &'d mut Driver<N, G, SIZE, F, HARD>,
    c: &'d [N; LEN],
    v: &'d [N; LEN],
    tau: N,
    place: Place<N>,
}

impl<
    N,
    G,
    const LEN: usize,
    const SIZE: usize,
    const F: usize,
    const HARD: usize,
> Dispatched for Turning<'_, N, G, LEN, SIZE, F, HARD>
where
    N: Real,
    G: Forcing<N, F>,
{
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { driver, c, v, tau, place } = self;
        driver.locate_turning_points(c, v, tau, place);
    }
}

/// Estimate of the velocity error that a series leaves over a step: the next
/// coefficient of the velocity is at most about a quarter of its last one
/// (1/`LEN` for the motion alone; the rest allows for strong forcing).
#[inline(always)]
fn left_by<N: Real, const LEN: usize>(v: &[N; LEN], tau: N) -> N {
    last_term(v[LEN - 1].abs(), LEN, tau)
}

/// That estimate from the size of the last of `count` coefficients.
#[inline(always)]
pub(crate) fn last_term<N: Number>(last: N, count: usize, tau: N) -> N {
    let mut power = N::ratio(1, 4) * last;
    let mut base = tau;
    let mut left = count;
    while left > 0 {
        if left % 2 == 1 {
            power = power * base;
        }
        base = base * base;
        left /= 2;
    }
    power
}

/// Moves the origin of the polynomial `c` to `by`.
fn shift<N: Real>(c: &mut [N], by: N) {
    for round in 0..c.len() {
        for k in (round..c.len() - 1).rev() {
            c[k] = c[k + 1].mul_add(by, c[k]);
        }
    }
}
