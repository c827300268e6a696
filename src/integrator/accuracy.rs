//! Errors of a run by rounding, truncation and the uncertainty of the inputs.
//!
//! The variational equation propagates, beside the state (u, w): the
//! covariance of the accumulated rounding, which differs in every step; the
//! derivatives by quantities that are rounded once and act in all steps; and,
//! for the condition number, the fundamental matrix since the last uplift from
//! rest.
//! At an impact the saltation matrix applies; rest forgets everything, and
//! whether a rest is one is a decision. Second-order accuracy is plenty: one
//! digit is needed.
//!
//! The propagation is linear. It ends if an error can turn a decision or is no
//! longer small: see [`Certificate`].
//!
//! # Proof P4
//!
//! The propagation, with `flown`, `assess_impact` and `surely_rests` of
//! `driver::decisions`, rests on the derivatives of Eqs. 1 and 2 and on the
//! saltation matrix of an impact at constant eta. `Once` lists the inputs and
//! constants whose rounding error is made once and acts in every step.

mod hops;

pub(crate) use hops::{HopStep, NearBase, SmallHops};

use crate::integrator::certificate::{
    CLEARANCE, Certificate, Decision, LARGEST_ERROR,
};

/// Multiple of the standard deviation that is reported as the bound.
const COVERAGE: f64 = 32.0;

/// Relative error, in units in the last place, of a quantity rounded once.
const ONCE: f64 = 2.0;

/// Relative error, in units in the last place, of the ground acceleration
/// and of the uplift threshold when a block at rest lifts.
const AT_REST: f64 = 4.0;

/// Relative error, in units in the last place, of the difference between a
/// time of the scene and a place in it.
const CLOCK: f64 = 2.0;

/// Quantities of a run that are rounded once. The derivatives of (u, w) by
/// their logarithms are tracked.
#[derive(Clone, Copy)]
enum Once {
    /// Uplift threshold.
    Threshold,
    /// Amplitude of the ground acceleration.
    Amplitude,
    /// Lengths of the steps, in units of 1/p.
    Clock,
    /// Time within a pulse.
    Phase,
    /// Coefficient of restitution, an input that enters exactly.
    Restitution,
}

/// Number of [`Once`].
const ONCES: usize = 5;

/// Tracked quantities, in units of 1/p.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Accuracy {
    /// Distance from 1 to the next number of the rounded type.
    unit: f64,
    /// True if the rounding of the inputs is tracked, not that of the
    /// arithmetic.
    of_inputs: bool,
    alpha: f64,
    /// Covariance of the error of (u, w).
    uu: f64,
    uw: f64,
    ww: f64,
    /// Derivatives of (u, w) by the quantities rounded once.
    once: [[f64; 2]; ONCES],
    /// Fundamental matrix, columns by initial u and w.
    initial: [[f64; 2]; 2],
    /// Snapshot at the largest peak so far.
    peak: f64,
    peak_error: f64,
    pub peak_condition: f64,
    /// Largest rotation that the block may have reached.
    highest: f64,
    pub certificate: Certificate,
    /// The present impacts surely end in a rest, so nothing until then has a
    /// consequence.
    pub resting: bool,
    /// The present hops, if their order is unknown.
    pub hops: Option<SmallHops>,
    /// Outcome and peak are final; later decisions are ignored.
    pub settled: bool,
}

/// A 2 by 2 matrix by rows.
type Matrix = [[f64; 2]; 2];

/// Input of [`Accuracy::step`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg {
    /// Length of the step.
    pub tau: f64,
    /// Derivative of u'' by u.
    pub curvature: f64,
    /// Sizes that are rounded in the step, of u and of w.
    pub sizes: [f64; 2],
    /// Truncation error of w.
    pub left: f64,
    /// Uplift threshold over gravity.
    pub threshold: f64,
    /// Ground acceleration over gravity, on the side of the rotation, and its
    /// rate.
    pub f: f64,
    pub rate: f64,
    /// Change of `f` if the time within the excitation changes by its span.
    pub shift: f64,
    /// Angular velocity and acceleration.
    pub w: f64,
    pub force: f64,
}

impl Accuracy {
    /// No error yet, in arithmetic with this unit roundoff.
    pub fn of_arithmetic(roundoff: f64, alpha: f64) -> Self {
        Self { unit: 2.0 * roundoff, alpha, ..Self::default() }
    }

    /// No error yet, of inputs that are known to the nearest double.
    pub fn of_inputs(alpha: f64) -> Self {
        let of_inputs = true;
        Self { unit: f64::EPSILON, of_inputs, alpha, ..Self::default() }
    }

    /// Restarts at rest, or after small hops.
    pub fn start(&mut self) {
        self.start_covariance();
        self.once = [[0.0; 2]; ONCES];
        self.initial = [[1.0, 0.0], [0.0, 1.0]];
        self.resting = false;
    }

    /// Starts at the release from a rotation.
    pub fn release(&mut self, u: f64) {
        self.start();
        self.uu = self.unit * u * self.unit * u;
        self.peak(u);
    }

    fn apply(&mut self, m: &Matrix) {
        let [[a, b], [c, d]] = *m;
        let (uu, uw, ww) = (self.uu, self.uw, self.ww);
        self.uu = a * a * uu + 2.0 * a * b * uw + b * b * ww;
        self.uw = a * c * uu + (a * d + b * c) * uw + b * d * ww;
        self.ww = c * c * uu + 2.0 * c * d * uw + d * d * ww;
        let times = |[u, w]: [f64; 2]| [a * u + b * w, c * u + d * w];
        self.once = self.once.map(times);
        self.initial = self.initial.map(times);
    }

    /// Propagates the errors over a step and adds those made in it.
    pub fn step(&mut self, by: &Leg) {
        let Leg { tau, curvature, sizes: [u, w], left, .. } = *by;
        let half = 0.5 * curvature * tau * tau;
        self.apply(&[
            [1.0 + half, tau * (1.0 + half / 3.0)],
            [curvature * tau, 1.0 + half],
        ]);
        let roundoff = 0.5 * self.unit;
        let (u, w) = (roundoff * u + left * tau, roundoff * w + left);
        self.uu += u * u;
        self.ww += w * w;
        let mut push = |which: Once, force: f64| {
            let [u, w] = &mut self.once[which as usize];
            *u += 0.5 * force * tau * tau;
            *w += force * tau;
        };
        push(Once::Threshold, -by.threshold);
        push(Once::Amplitude, -by.f);
        push(Once::Phase, -by.shift);
        let [u, w] = &mut self.once[Once::Clock as usize];
        *u += by.w * tau;
        *w += by.force * tau;
    }

    /// Propagates the errors over an impact at `speed` (before the impact),
    /// with the accelerations u'' just before and just after it, each on its
    /// own branch. Returns bounds on the errors of the impact's time and
    /// speed.
    ///
    /// The impact is certain if its speed is clear of the error of that speed.
    /// The order of events is certain if the time of the next hop is clear of
    /// the error of the impact's time.
    pub fn impact(
        &mut self,
        eta: f64,
        speed: f64,
        [before, after]: [f64; 2],
        time_s: f64,
    ) -> [f64; 2] {
        let late = self.bound([1.0 / speed, 0.0]);
        let met = self.bound([before / speed, 1.0]);
        self.decide(Decision::Contact, speed, met, time_s);
        if after < 0.0 {
            let hop = 2.0 * eta * speed / -after;
            self.decide(Decision::Contact, hop, late, time_s);
        }
        let shear =
            if speed > 0.0 { (after + eta * before) / -speed } else { 0.0 };
        self.apply(&[[-eta, 0.0], [shear, -eta]]);
        self.once[Once::Restitution as usize][1] += eta * speed;
        let rounded = self.unit * eta * speed;
        self.ww += rounded * rounded;
        [late, met]
    }

    /// Bound on the error of a quantity with these derivatives by u and w.
    pub fn bound(&self, [a, b]: [f64; 2]) -> f64 {
        if let Some(hops) = &self.hops {
            let [u, w] = hops.errors();
            return (a * u).abs() + (b * w).abs();
        }
        let variance =
            a * a * self.uu + 2.0 * a * b * self.uw + b * b * self.ww;
        let mut once = 0.0;
        for (k, [u, w]) in self.once.iter().enumerate() {
            if self.of_inputs || k != Once::Restitution as usize {
                once += (a * u + b * w).abs();
            }
        }
        // Rounding leaves variances a little below zero.
        let random = if variance < 0.0 { 0.0 } else { variance.sqrt() };
        COVERAGE * random + ONCE * self.unit * once
    }

    /// Bound on the error of u.
    pub fn error(&self) -> f64 {
        self.bound([1.0, 0.0])
    }

    /// Compares the error in flight with its limit. Returns the bound on the
    /// error of u.
    pub fn fly(&mut self, time_s: f64) -> f64 {
        // Clear up to the largest error itself.
        let most = CLEARANCE * LARGEST_ERROR * self.alpha;
        let [by_u, by_w] = [self.error(), self.bound([0.0, 1.0])];
        for error in [by_u, by_w] {
            self.decide(Decision::Propagation, most, error, time_s);
        }
        by_u
    }

    /// Notes a decision with its margin and the error of the margin.
    pub fn decide(
        &mut self,
        decision: Decision,
        margin: f64,
        error: f64,
        time_s: f64,
    ) {
        let hops = self.hops.is_some()
            && matches!(decision, Decision::Contact | Decision::Rest);
        if !self.settled && !self.resting && !hops {
            let ratio = ratio(margin, error);
            self.certificate.note(decision, ratio, time_s);
        }
    }

    /// Notes an end of observation in flight, at rotation `u` and velocity
    /// `w`, with the rotation `left` to overturning. `is_peak` means that the
    /// rotation is the largest so far. The time is given in 1/p and in s.
    pub fn stop(
        &mut self,
        [u, w]: [f64; 2],
        left: f64,
        is_peak: bool,
        [time, time_s]: [f64; 2],
    ) {
        let error = self.error() + w.abs() * self.mistimed(time);
        self.decide(Decision::End, left, error, time_s);
        if is_peak {
            self.take_peak(u, error, self.moved([1.0, 0.0]) / u);
        } else {
            self.reach(u, error);
        }
    }

    /// Notes the time between an event and the end of observation. `late` is a
    /// bound on the error of the event's time; the end is given in 1/p and in
    /// s.
    pub fn end(&mut self, between: f64, late: f64, [time, time_s]: [f64; 2]) {
        let error = late + self.mistimed(time);
        self.decide(Decision::End, between, error, time_s);
    }

    /// As [`Self::end`], for an uplift. Its time changes by `late` if the
    /// ground acceleration changes by the threshold and the clock by its span.
    pub fn end_at_rest(&mut self, between: f64, late: f64, times: [f64; 2]) {
        self.end(between, AT_REST * self.unit * late, times);
    }

    /// Bound on the error of an end of observation at `time`.
    fn mistimed(&self, time: f64) -> f64 {
        CLOCK * self.unit * time
    }

    /// Notes the least relative distance of the ground acceleration from the
    /// uplift threshold while the block rested.
    pub fn at_rest(&mut self, distance: f64, time_s: f64) {
        if std::mem::take(&mut self.resting) {
            self.hops = None;
        }
        let error = AT_REST * self.unit;
        self.decide(Decision::Uplift, distance, error, time_s);
    }

    /// Notes a rest; it decides something unless it was sure.
    pub fn rest(&mut self, time_s: f64) {
        if !self.resting {
            self.decide(Decision::Rest, 0.0, 1.0, time_s);
        }
    }

    /// Notes the error at a peak `u`, the highest so far.
    pub fn peak(&mut self, u: f64) {
        let moved = self.moved([1.0, 0.0]);
        self.take_peak(u, self.error(), moved / u);
    }

    /// Notes the error at a peak `u` reached in free motion from (u0, w0), by
    /// the error of the energy. `slope` is dE/du at the state and
    /// `at_peak` at the peak; `differed` is the energy from which that of the
    /// peak's hop was taken as a difference.
    pub fn peak_by_energy(
        &mut self,
        (slope, w): (f64, f64),
        at_peak: f64,
        u: f64,
        differed: f64,
    ) {
        let along = [slope, w];
        let own = self.unit * (w * w + (slope * u).abs() + differed);
        let error = (self.bound(along) + own) / at_peak;
        self.take_peak(u, error, self.moved(along) / (at_peak * u));
    }

    /// Change of a quantity with these derivatives under relative changes of
    /// restitution and initial state.
    fn moved(&self, [a, b]: [f64; 2]) -> f64 {
        let along = |[u, w]: [f64; 2]| (a * u + b * w).abs();
        let [first, second] = self.initial;
        along(self.once[Once::Restitution as usize])
            + self.alpha * (along(first) + along(second))
    }

    fn take_peak(&mut self, u: f64, error: f64, condition: f64) {
        self.peak = u;
        self.peak_error = error;
        self.peak_condition = condition;
        self.reach(u, error);
    }

    /// Notes a turning point that may be the highest.
    pub fn reach(&mut self, u: f64, error: f64) {
        let most = u + error;
        if !self.settled && !(most <= self.highest) {
            self.highest = most;
        }
    }

    /// Notes the error of a run that overturns in the current state.
    pub fn overturned(&mut self) {
        self.peak_error = self.error();
    }

    /// Bound on the error of the peak ratio; `None` if it is not known.
    pub fn peak_error(&self) -> Option<f64> {
        // Some other peak may be the highest.
        let other = self.highest - self.peak;
        let error =
            if other > self.peak_error { other } else { self.peak_error };
        let known = self.certificate.is_clear();
        known.then_some(error / self.alpha + self.unit)
    }
}

/// Margin over error. No error leaves every decision clear, even one without
/// a margin: the numbers are exact.
fn ratio(margin: f64, error: f64) -> f64 {
    if error == 0.0 && margin >= 0.0 { f64::INFINITY } else { margin / error }
}
