//! Decisions of a run, each compared with the error of the state.

use crate::integrator::ImpactError;
use crate::integrator::accuracy::{Accuracy, HopStep, Leg, NearBase};
use crate::integrator::certificate::{CLEARANCE, Decision, LARGEST_ERROR};
use crate::integrator::coast::{gap, gap_gradient};
use crate::integrator::driver::Driver;
use crate::integrator::driver::events::next_turning;
use crate::integrator::driver::impact::Chatter;
use crate::integrator::dynamics::{Drive, Dynamics, Model};
use crate::integrator::forcing::{Forcing, LONGEST_STEP, Moment};
use crate::integrator::motion::{BlockMotion, RunTrace};
use crate::integrator::screen::PROPAGATION;
use crate::integrator::taylor::{TaylorSeries, expand, size, value};
use crate::number::Real;

/// Ratio of a rotation beyond overturning to its error at which the search
/// ends.
const FAR_BEYOND: f64 = 1e4;

/// Coefficients of a forcing that is linear within a piece.
const LINEAR: usize = 2;

/// Most pieces over which small hops are followed at rest.
const MOST_PIECES: usize = 64;

/// Relative slack of bounds that are taken in double precision.
const SLACK: f64 = 1e-14;

impl<N: Real> RunTrace<N> {
    /// The trackers of errors.
    pub fn trackers(&mut self) -> impl Iterator<Item = &mut Accuracy> {
        self.accuracy.iter_mut().chain(&mut self.inputs)
    }
}

impl<N: Real, G: Forcing<N, F>, const F: usize, const HARD: usize>
    Driver<N, G, F, HARD>
{
    /// Propagates the errors over the part (0, `x`) of a step from a place, of
    /// length `tau`, and notes the decisions of the flight: that the block
    /// does not touch its base and does not reach overturning.
    #[inline(always)]
    pub(super) fn assess<const LEN: usize>(
        &mut self,
        series: &TaylorSeries<N, LEN>,
        (x, tau): (N, N),
        (flown, end_w): (&Leg, f64),
        place: Moment<N>,
    ) {
        let end = Moment { offset: place.offset + tau, ..place };
        let time_s = self.time_s(end).to_f64();
        let mut worst = 0.0_f64;
        let hop = HopStep {
            tau: flown.tau,
            end: time_s * self.dynamics.p.to_f64(),
            end_s: time_s,
            f: [flown.f, flown.rate.mul_add(flown.tau, flown.f)],
            rate: flown.rate,
            threshold: flown.threshold,
            cosine: self.dynamics.cosine.to_f64(),
            eta: self.dynamics.eta.to_f64(),
            w: end_w,
        };
        for tracker in self.record.trackers() {
            if tracker.hops.is_some() {
                tracker.hop(&hop);
                worst = worst.max(CLEARANCE * tracker.error());
                continue;
            }
            tracker.step(flown);
            worst = worst.max(CLEARANCE * tracker.fly(time_s));
        }
        if self.may_turn_near(series, x.to_f64(), worst) {
            self.assess_turnings(series, x, time_s);
        }
    }

    /// True if a turning point of a step may lie within the error of the base,
    /// of overturning, or of the peak.
    fn may_turn_near<const LEN: usize>(
        &self,
        series: &TaylorSeries<N, LEN>,
        x: f64,
        error: f64,
    ) -> bool {
        let TaylorSeries { c, v } = series;
        let (mut rest, mut variation) = (0.0, 0.0);
        for k in (1..LEN).rev() {
            if k > 1 {
                rest = rest * x + c[k].abs().to_f64();
            }
            variation = variation * x + v[k].abs().to_f64();
        }
        let [u, w] = [c[0], c[1]].map(Real::to_f64);
        let rest = rest * x * x;
        let slack = error + SLACK * (u + w.abs() + rest);
        if v[0].to_f64().abs() > variation * x * (1.0 + SLACK) {
            return false;
        }
        let low = u + (w * x).min(0.0) - rest;
        let high = u + (w * x).max(0.0) + rest;
        let peak = self.record.peak.to_f64();
        let limit = self.dynamics.limit.to_f64();
        !(low > slack && high + slack < peak && high + slack < limit)
    }

    /// A motion [u, w] near the base.
    fn near_base(&self, [u, w]: [f64; 2], time_s: f64) -> NearBase {
        let Dynamics { threshold, p, eta, .. } = self.dynamics;
        let [most, p, eta] = [threshold + threshold, p, eta].map(Real::to_f64);
        NearBase { u, w, time: time_s * p, most, eta }
    }

    #[inline(always)]
    fn assess_turnings<const LEN: usize>(
        &mut self,
        series: &TaylorSeries<N, LEN>,
        x: N,
        time_s: f64,
    ) {
        let limit = self.dynamics.limit;
        let mut v = series.v;
        let mut at = N::zero();
        for _ in 0..LEN {
            let next = next_turning(&mut v, x - at, self.isa);
            let Some((turn, rising)) = next else { return };
            at = at + turn;
            let u = value(&series.c, at);
            let below = (limit - u).to_f64();
            let u = u.to_f64();
            let near = self.near_base([u, 0.0], time_s);
            for tracker in self.record.trackers() {
                let error = tracker.error();
                if rising {
                    tracker.reach(u, error);
                    let decision = Decision::Overturning;
                    tracker.decide(decision, below, error, time_s);
                } else if u >= CLEARANCE * error
                    || F > LINEAR
                    || !tracker.hops_begin(&near)
                {
                    tracker.decide(Decision::Contact, u, error, time_s);
                }
            }
        }
    }

    /// True if a step that sinks may turn near the base.
    #[inline(always)]
    pub(super) fn may_miss<const LEN: usize>(
        &self,
        series: &TaylorSeries<N, LEN>,
    ) -> bool {
        let TaylorSeries { c, v } = series;
        if !(v[0] < N::zero()) {
            return false;
        }
        let low = self.dynamics.alpha * N::from_f64(PROPAGATION);
        if c[0] + c[1] > low + size(&c[2..]) {
            return false;
        }
        !(v[0].abs() > size(&v[1..]))
    }

    /// Adds the first lowest rotation of a step to the rough certificate.
    #[inline(never)]
    pub(super) fn screen_turning<const LEN: usize>(
        &mut self,
        series: &TaylorSeries<N, LEN>,
    ) {
        let mut v = series.v;
        let next = next_turning(&mut v, N::one(), self.isa);
        let (Some(screen), Some((x, _))) = (self.screen, next) else { return };
        let alpha = self.dynamics.alpha;
        let lowest = value(&series.c, x);
        if lowest > alpha * N::from_f64(PROPAGATION) {
            return;
        }
        self.screen = Some(screen.miss(lowest));
    }

    /// Adds free motion to the rough certificate. `before` is the peak before
    /// it; energy carries the error to a higher peak.
    pub(super) fn screen_coast(&mut self, before: N) {
        let alpha = self.dynamics.alpha;
        let peak = self.record.peak;
        if let Some(screen) = &mut self.screen
            && peak > before
        {
            let slope = (alpha - peak) / alpha;
            screen.peak = (screen.uu + screen.ww) / (slope * slope);
        }
    }

    /// The rough certificate at the end of a run. `margin` is that of its last
    /// decision, if there is one; a block that stands has kept a distance of
    /// at least `own` from overturning. Both are ratios to alpha.
    pub(super) fn screened(
        &self,
        margin: Option<f64>,
        own: Option<f64>,
    ) -> Option<f64> {
        let mut screen = self.screen?;
        let alpha = self.dynamics.alpha;
        if let Some(margin) = margin {
            screen = screen.end(alpha * N::from_f64(margin), alpha);
        }
        if own.is_some() {
            screen = screen.stand(alpha);
        }
        // At least this part of it is the error over the whole of alpha.
        let near = PROPAGATION / own.unwrap_or(1.0);
        let doubt = screen.doubt.to_f64();
        Some((doubt * near.mul_add(near, 1.0)).sqrt())
    }

    /// Input of [`Accuracy::step`] for a step of length `tau` between two
    /// motions (u, w), with the truncation error `left` of the velocity.
    pub(super) fn flown(
        &self,
        [from, to]: [(N, N); 2],
        tau: N,
        drive: &Drive<N, F>,
        left: N,
    ) -> Leg {
        let (a, b) = (drive.a.to_f64(), drive.b.to_f64());
        let (u0, w0) = (from.0.to_f64(), from.1.to_f64());
        let (u, w, tau) = (to.0.to_f64(), to.1.to_f64(), tau.to_f64());
        let (curvature, size, acceleration) = match self.dynamics.model {
            Model::Nonlinear => {
                let (s, c) = (libm::sin(u0), libm::cos(u0));
                let size = (a * s).abs() + (b * c).abs();
                (a * c + b * s, size, a * s - b * c)
            }
            Model::Linearized => (1.0, u0.abs() + b.abs(), u0 - b),
        };
        let threshold = self.dynamics.threshold.to_f64();
        let rate = drive.f.get(1).map_or(0.0, |rate| rate.to_f64());
        let shift = rate * self.forcing.span();
        // The forcing itself has a roundoff of the size of the threshold.
        let size = size + threshold + shift.abs();
        Leg {
            tau,
            curvature,
            sizes: [u.abs().max(u0.abs()), w.abs().max(w0.abs()) + size * tau],
            left: left.to_f64(),
            threshold,
            f: drive.f[0].to_f64(),
            rate,
            shift,
            w: w0,
            force: acceleration,
        }
    }

    /// Notes an impact at `speed`. `before` is the acceleration u'' just
    /// before the impact and `f` the forcing on the new branch. Returns bounds
    /// on the errors of the impact.
    #[inline(never)]
    pub(super) fn assess_impact(
        &mut self,
        place: Moment<N>,
        speed: N,
        before: N,
        f: &[N; F],
    ) -> Option<ImpactError> {
        let time_s = self.time_s(place).to_f64();
        let after = -self.dynamics.restoring(f[0]);
        let accelerations = [before, after].map(Real::to_f64);
        let eta = self.dynamics.eta.to_f64();
        let near = self.near_base([0.0, speed.to_f64()], time_s);
        let note = |tracker: &mut Accuracy| {
            if let Some(hops) = tracker.hops {
                tracker.resting |= self.rests_within(place, hops.speed, f);
                return [f64::INFINITY; 2];
            }
            let before = *tracker;
            let speed = speed.to_f64();
            let errors = tracker.impact(eta, speed, accelerations, time_s);
            let is_lost = before.certificate.is_clear()
                && !tracker.certificate.is_clear();
            if F <= LINEAR && is_lost {
                let after = std::mem::replace(tracker, before);
                if tracker.hops_begin(&near) {
                    return [f64::INFINITY; 2];
                }
                *tracker = after;
            }
            tracker.resting |=
                !tracker.resting && self.surely_rests(place, speed, errors, f);
            errors
        };
        let mut own = self.record.accuracy?;
        let mut inputs = self.record.inputs;
        let [late, met] = note(&mut own);
        inputs.as_mut().map(note);
        (self.record.accuracy, self.record.inputs) = (Some(own), inputs);
        let p = self.dynamics.p.to_f64();
        let is_known = own.certificate.is_clear() && own.hops.is_none();
        is_known.then(|| ImpactError {
            time_s: late / p + 2.0 * N::ROUNDOFF * time_s,
            speed_rad_s: met * p,
        })
    }

    /// True if the impacts after one at `speed` surely end in a rest within
    /// the piece, given the errors of its time and speed.
    fn surely_rests(
        &self,
        place: Moment<N>,
        speed: f64,
        errors: [f64; 2],
        f: &[N; F],
    ) -> bool {
        let [late, met] = errors.map(|error| CLEARANCE * error);
        if !(late.is_finite() && met.is_finite()) {
            return false;
        }
        let w = self.dynamics.eta * N::from_f64(speed + met);
        let left = self.forcing.length(place.piece) - place.offset;
        let late = N::from_f64(late);
        let mut shift = N::zero();
        for k in (1..F).rev() {
            shift = (shift + f[k].abs()) * late;
        }
        let mut f = *f;
        f[0] = if f[0] < N::zero() { f[0] - shift } else { f[0] + shift };
        let chatter = self.accumulation(&f, w, left - late);
        chatter.is_some_and(|chatter| self.is_below_peak(&chatter))
    }

    /// True if hops of at most a speed surely end in a rest within the piece of
    /// a place, with the forcing `f` there.
    fn rests_within(&self, at: Moment<N>, speed: f64, f: &[N; F]) -> bool {
        let left = self.forcing.length(at.piece) - at.offset;
        self.accumulation(f, N::from_f64(speed), left).is_some()
    }

    /// Follows small hops, while the computed motion rests from a place on, up
    /// to the next uplift or to the end of all hops.
    fn hop_at_rest(&self, tracker: &mut Accuracy, from: Moment<N>) {
        let Dynamics { threshold, cosine, eta, .. } = self.dynamics;
        let [threshold, cosine, eta] =
            [threshold, cosine, eta].map(Real::to_f64);
        let mut place = from;
        for _ in 0..MOST_PIECES {
            let f = self.forcing.series(place);
            let Some(hops) = tracker.hops else { return };
            if self.rests_within(place, hops.speed, &f) {
                tracker.resting = true;
                return;
            }
            let tau = self.forcing.length(place.piece) - place.offset;
            let rate = f.get(1).map_or(0.0, |rate| rate.to_f64());
            let f = [f[0], value(&f, tau)].map(Real::to_f64);
            let next = Moment { piece: place.piece + 1, offset: N::zero() };
            let end_s = self.time_s(next).to_f64();
            let end = end_s * self.dynamics.p.to_f64();
            let (tau, w) = (tau.to_f64(), 0.0);
            tracker.hop(&HopStep {
                tau,
                end,
                end_s,
                f,
                rate,
                threshold,
                cosine,
                eta,
                w,
            });
            let lifts = f[1].abs() > threshold;
            if lifts || next.piece >= self.forcing.pieces() {
                return;
            }
            place = next;
        }
        tracker.lose_hops(self.time_s(place).to_f64());
    }

    /// Notes a rest at the end of a chatter that begins at a place with an
    /// impact, with some error, from a speed to another.
    #[inline(never)]
    pub(super) fn assess_rest(
        &mut self,
        from: Moment<N>,
        chatter: &Chatter<N>,
        (speed, w): (N, N),
        impact: Option<ImpactError>,
        time_s: N,
    ) {
        let (rest_s, p) = (time_s.to_f64(), self.dynamics.p.to_f64());
        let near = self.near_base([0.0, w.to_f64()], rest_s);
        let speed = speed.to_f64() * p;
        let rest = |tracker: &mut Accuracy| {
            let may_hop = !tracker.resting && F <= LINEAR;
            if may_hop && (tracker.hops.is_some() || tracker.hops_begin(&near))
            {
                self.hop_at_rest(tracker, from);
            }
            tracker.rest(rest_s);
        };
        let mut trackers = (self.record.accuracy, self.record.inputs);
        trackers.0.iter_mut().chain(&mut trackers.1).for_each(rest);
        (self.record.accuracy, self.record.inputs) = trackers;
        let after = chatter.time.to_f64() / p;
        let spread = chatter.spread.to_f64().abs();
        self.record.rest_error_s = impact.map(|impact| {
            let longer = after * (spread + impact.speed_rad_s / speed);
            impact.time_s + longer + 2.0 * N::ROUNDOFF * rest_s
        });
    }

    /// Notes whether outcome and peak are final for a block that leaves its
    /// base at `w`: they are if `w` is surely below `fastest`.
    #[inline(never)]
    pub(super) fn assess_settled(&mut self, w: N, fastest: N) {
        let room = (fastest - w).to_f64();
        for tracker in self.record.trackers() {
            if room > CLEARANCE * tracker.bound([0.0, 1.0]) {
                tracker.settled = true;
            }
        }
    }

    /// Notes an overturning by the ratio of the rotation beyond its limit to
    /// the error there.
    #[inline(never)]
    pub(super) fn assess_beyond(
        &mut self,
        from: Moment<N>,
        motion: BlockMotion<N>,
    ) {
        let time_s = self.time_s(from).to_f64();
        let p = self.dynamics.p.to_f64();
        let mut own = self.record.accuracy;
        let mut inputs = self.record.inputs;
        if let Some(own) = &own {
            let late = own.bound([1.0 / motion.w.to_f64(), 0.0]) / p;
            let late = late + 2.0 * N::ROUNDOFF * time_s;
            self.record.overturning_error_s = Some(late);
        }
        for tracker in own.iter_mut().chain(&mut inputs) {
            let ratio = self.clearance_beyond(from, motion, *tracker);
            tracker.decide(Decision::Overturning, ratio, 1.0, time_s);
        }
        (self.record.accuracy, self.record.inputs) = (own, inputs);
    }

    /// Largest ratio of the rotation beyond its limit to the error there,
    /// until the block turns, has fallen as far as gravity drives it, or its
    /// error is no longer small.
    fn clearance_beyond(
        &self,
        from: Moment<N>,
        motion: BlockMotion<N>,
        mut tracker: Accuracy,
    ) -> f64 {
        let limit = self.dynamics.limit;
        let small = LARGEST_ERROR * self.dynamics.alpha.to_f64();
        let below = N::right_angle() + N::right_angle();
        let BlockMotion { side, mut u, mut w } = motion;
        let Moment { mut piece, mut offset } = from;
        let mut best = 0.0;
        while piece < self.forcing.pieces() {
            let left = self.forcing.length(piece) - offset;
            let part = N::from_f64(LONGEST_STEP);
            let (tau, whole) =
                if part < left { (part, false) } else { (left, true) };
            let place = Moment { piece, offset };
            let drive = self.drive(place, (side, u), false);
            let series: TaylorSeries<N, HARD> =
                expand(self.dynamics.model, (u, w), tau, &drive);
            let end = series.end();
            let ends = [(u, w), end];
            tracker.step(&self.flown(ends, tau, &drive, N::zero()));
            (u, w) = end;
            let mut v = series.v;
            let turning = next_turning(&mut v, N::one(), self.isa);
            let top = turning.map_or(u, |(x, _)| value(&series.c, x));
            let error = tracker.error();
            if !(error <= small) {
                return best;
            }
            let ratio = (top - limit).to_f64() / error;
            best = if ratio > best { ratio } else { best };
            let falls = w > N::zero() && u < below;
            if !(best < FAR_BEYOND) || !falls {
                return best;
            }
            (piece, offset) = if whole {
                (piece + 1, N::zero())
            } else {
                (piece, offset + tau)
            };
        }
        let ratio = gap(&self.dynamics, u, w).to_f64()
            / tracker.bound(gap_gradient(&self.dynamics, u));
        if ratio > best { ratio } else { best }
    }
}

#[cfg(test)]
mod tests;
