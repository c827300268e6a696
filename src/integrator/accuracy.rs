//! How far rounding, truncation and the inputs' own uncertainty move a run.
//!
//! The variational equation carries, beside the state (u, w), the covariance
//! of the accumulated rounding, the sensitivity to ln(eta), and the
//! fundamental matrix since the last uplift from rest. At an impact the
//! saltation matrix applies; rest forgets everything. Second-order accuracy
//! is plenty: one digit is asked for.

/// Multiple of the standard deviation that is reported as the bound.
const COVERAGE: f64 = 32.0;

/// Tracked quantities, in units of 1/p.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Accuracy {
    /// Distance from 1 to the next number of the run's type.
    unit: f64,
    /// Covariance of the error of (u, w).
    uu: f64,
    uw: f64,
    ww: f64,
    /// Derivative of (u, w) with respect to ln(eta).
    eta: [f64; 2],
    /// Fundamental matrix, columns by initial u and w.
    initial: [[f64; 2]; 2],
    /// Snapshot at the largest peak so far.
    peak_error: f64,
    peak_condition: f64,
    /// Error of the last decision taken by the saddle.
    decision_error: f64,
}

/// A 2 by 2 matrix by rows.
type Matrix = [[f64; 2]; 2];

impl Accuracy {
    /// Nothing yet, in arithmetic with this unit roundoff.
    pub fn new(roundoff: f64) -> Self {
        Self { unit: 2.0 * roundoff, ..Self::default() }
    }

    /// Starts anew at an uplift from rest, or at release.
    pub fn start(&mut self) {
        (self.uu, self.uw, self.ww) = (0.0, 0.0, 0.0);
        self.eta = [0.0; 2];
        self.initial = [[1.0, 0.0], [0.0, 1.0]];
    }

    fn apply(&mut self, m: &Matrix) {
        let [[a, b], [c, d]] = *m;
        let (uu, uw, ww) = (self.uu, self.uw, self.ww);
        self.uu = a * a * uu + 2.0 * a * b * uw + b * b * ww;
        self.uw = a * c * uu + (a * d + b * c) * uw + b * d * ww;
        self.ww = c * c * uu + 2.0 * c * d * uw + d * d * ww;
        let times = |[u, w]: [f64; 2]| [a * u + b * w, c * u + d * w];
        let [first, second] = self.initial;
        [self.eta, self.initial[0], self.initial[1]] =
            [self.eta, first, second].map(times);
    }

    /// A step of length `tau` with curvature `j` = d u''/d u, adding the
    /// errors `u` and `w` made in it.
    pub fn step(&mut self, j: f64, tau: f64, error: [f64; 2]) {
        let half = 0.5 * j * tau * tau;
        self.apply(&[
            [1.0 + half, tau * (1.0 + half / 3.0)],
            [j * tau, 1.0 + half],
        ]);
        self.uu += error[0] * error[0];
        self.ww += error[1] * error[1];
    }

    /// An impact at speed `speed` (before it), with accelerations u'' just
    /// before and just after, each on its own branch.
    pub fn impact(&mut self, eta: f64, speed: f64, before: f64, after: f64) {
        let shear =
            if speed > 0.0 { (after + eta * before) / -speed } else { 0.0 };
        self.apply(&[[-eta, 0.0], [shear, -eta]]);
        self.eta[1] += eta * speed;
    }

    /// Standard deviation of the error of u.
    fn deviation(&self) -> f64 {
        self.uu.max(0.0).sqrt()
    }

    /// Notes the error at a peak `u`.
    pub fn peak(&mut self, u: f64, alpha: f64) {
        let moved = self.eta[0].abs()
            + alpha * (self.initial[0][0].abs() + self.initial[1][0].abs());
        self.note(COVERAGE * self.deviation() / alpha, moved / u);
    }

    /// Notes the error at a peak `u` reached in free motion from (u0, w0):
    /// energy carries the errors there. `slope` is dE/du at the state and
    /// `at_peak` at the peak.
    pub fn peak_by_energy(
        &mut self,
        (slope, w): (f64, f64),
        at_peak: f64,
        u: f64,
        alpha: f64,
    ) {
        let variance = slope * slope * self.uu
            + 2.0 * slope * w * self.uw
            + w * w * self.ww;
        let along = |v: [f64; 2]| (slope * v[0] + w * v[1]).abs();
        let moved = along(self.eta)
            + alpha * (along(self.initial[0]) + along(self.initial[1]));
        let own = self.unit * (w * w + (slope * u).abs());
        let error = COVERAGE * variance.max(0.0).sqrt() + own;
        self.note(error / (at_peak * alpha), moved / (at_peak * u));
    }

    fn note(&mut self, error: f64, condition: f64) {
        self.peak_error = error + self.unit;
        self.peak_condition = condition;
    }

    /// Notes the error of a run that overturns in the current state.
    pub fn overturned(&mut self, alpha: f64) {
        self.peak_error = COVERAGE * self.deviation() / alpha + self.unit;
    }

    /// Notes the error of a decision about fate, a quantity with these
    /// derivatives by u and w.
    pub fn decision(&mut self, gradient: [f64; 2], alpha: f64) {
        let [a, b] = gradient;
        let variance =
            a * a * self.uu + 2.0 * a * b * self.uw + b * b * self.ww;
        let error = COVERAGE * variance.max(0.0).sqrt() / alpha;
        self.decision_error = error + self.unit;
    }

    /// Bound on the error of the fate margin.
    pub fn fate_error(&self) -> f64 {
        self.decision_error.max(self.peak_error)
    }

    /// Bound on the error of the peak ratio.
    pub fn peak_error(&self) -> f64 {
        self.peak_error
    }

    /// Condition number of the peak.
    pub fn peak_condition(&self) -> f64 {
        self.peak_condition
    }
}
