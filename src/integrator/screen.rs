//! A rough certificate of every run.
//!
//! An estimate that costs little decides whether a run is worth the careful
//! assessment of its decisions. It follows the covariance of the error of
//! (u, w) by first-order steps, each with its own curvature: in a long flight
//! the curvature decides which error is forgotten and which error grows. The
//! estimate adds the squares of error over margin of all decisions, so it is
//! no less than the largest ratio. Lanes and single runs give the same bits.
//!
//! It includes rounding and, if the order is fixed, the truncation error that
//! the last term of a series shows. At a free order that error is smaller than
//! rounding.
//!
//! # Proof P5
//!
//! The estimate rests on the curvature of Eqs. 1 and 2 in flight, on the
//! saltation of P4, and, under a fixed order, on the last term of the series
//! (`is_fixed` in lanes, `within` in the driver). It is an estimate. But it
//! decides which analyses of a curve are flagged `unresolved`, and which runs
//! of `respond` are assessed. It compares no numbers and has no branch, since
//! it also runs in lanes.

use crate::number::{Number, Real};

/// Largest rough estimate of error over margin at which an analysis counts as
/// clear in double precision.
///
/// A certificate is clear if 32 standard deviations are at most a quarter of
/// every margin, which is 8e-3 here. A certificate also includes the
/// truncation error of a series of free order and constants that are rounded
/// once; the estimate does not. So the threshold is lower, by a factor of
/// three that was chosen on whole suites: see `tests/trials`.
pub(crate) const DOUBTFUL: f64 = 2.5e-3;

/// Largest error, as a share of the slenderness angle, at which the linear
/// propagation is trusted.
///
/// It is also the share of the slenderness angle below which the estimate
/// includes a lowest rotation above the base as a decision. A larger one has a
/// larger margin than the error may have.
pub(crate) const PROPAGATION: f64 = 0.01;

/// Margin of the error of a peak, as a share of the slenderness angle.
const PEAK: f64 = 1e-4;

/// The estimate of a run, in units of 1/p.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Screen<N> {
    /// Covariance of the error of (u, w).
    pub uu: N,
    pub uw: N,
    pub ww: N,
    /// Sum of the squares of error over margin.
    pub doubt: N,
    /// Variance of the error of the largest peak.
    pub peak: N,
}

/// Input of [`Screen::fly`].
pub(crate) struct ScreenLeg<N> {
    /// Length of the step.
    pub tau: N,
    /// Derivative of u'' by u at the start of the step.
    pub curvature: N,
    /// Motion at the end of the step.
    pub u: N,
    pub w: N,
    /// Size of the terms of the acceleration: alpha, and the forcing's.
    pub size: N,
    /// Last coefficient of the velocity, if the order is fixed.
    pub last: Option<N>,
}

/// Input of [`Screen::land`].
pub(crate) struct Landing<N> {
    /// Speed before the impact, and the accelerations before and after it.
    pub speed: N,
    pub before: N,
    pub after: N,
    pub eta: N,
    pub alpha: N,
}

impl<N: Number> Screen<N> {
    /// The estimate of a block at rest.
    pub fn at_rest() -> Self {
        let zero = N::zero();
        Self { uu: zero, uw: zero, ww: zero, doubt: zero, peak: zero }
    }

    /// Adds an uplift.
    #[inline(always)]
    pub fn start(self) -> Self {
        let Self { doubt, peak, .. } = self;
        Self { doubt, peak, ..Self::at_rest() }
    }

    /// Adds a step in flight: first the change of the velocity, then the path
    /// at the new velocity.
    ///
    /// The step rounds the rotation, the velocity, and the change of the
    /// velocity. The change is a difference of terms as large as `size`,
    /// however slow the block is.
    ///
    /// A series of `n` coefficients whose last one, for the velocity, is
    /// `last` has the truncation error `last` tau/n in the rotation, its next
    /// term, and about as much in the velocity; up to an impact within the
    /// step it has less. The errors of many steps in a row may have one sign.
    /// By the Cauchy-Schwarz inequality the square of such a sum is at most
    /// the sum of the squares, each over its share of the time: in a time T
    /// (in 1/p) a step counts as a variance of (`last` tau/n)^2 T/tau. T =
    /// n^2, 25 or more, makes this `last`^2 tau.
    #[inline(always)]
    pub fn fly(self, step: &ScreenLeg<N>) -> Self {
        let Self { uu, uw, ww, .. } = self;
        let ScreenLeg { tau, curvature, u, w, size, last } = *step;
        let push = curvature * tau;
        let pushed = push.mul_add(uu, uw);
        let ww = push.mul_add(uw + pushed, ww);
        let uw = tau.mul_add(ww, pushed);
        let uu = tau.mul_add(pushed + uw, uu);
        let roundoff = N::from_f64(0.25 * f64::EPSILON * f64::EPSILON);
        let change = size * tau;
        let rounded = change.mul_add(change, w * w);
        let uu = (roundoff * u).mul_add(u, uu);
        let ww = roundoff.mul_add(rounded, ww);
        let Some(last) = last else { return Self { uu, uw, ww, ..self } };
        let left = tau * last;
        let (uu, ww) = (left.mul_add(last, uu), left.mul_add(last, ww));
        Self { uu, uw, ww, ..self }
    }

    /// Notes the largest peak so far, `tau` after the start of a step.
    #[inline(always)]
    pub fn top(self, tau: N) -> Self {
        let drift = tau.mul_add(self.ww, self.uw + self.uw);
        Self { peak: tau.mul_add(drift, self.uu), ..self }
    }

    /// Adds an impact. It compares the speed with its error, the time of the
    /// next hop with the error of the time of the impact, and the errors with
    /// their limit.
    #[inline(always)]
    pub fn land(self, at: &Landing<N>) -> Self {
        let Landing { speed, before, after, eta, alpha } = *at;
        let Self { uu, uw, ww, doubt, .. } = self;
        // One division for all three.
        let all = N::one() / (speed * alpha * eta);
        let (slow, slender) = (all * (alpha * eta), all * (speed * eta));
        let lost = all * (speed * alpha);
        // The speed changes by w + u before/speed, the time by u/speed; the
        // hop takes 2 eta speed/after.
        let by_u = before * slow;
        let met = by_u.mul_add(by_u.mul_add(uu, uw + uw), ww);
        let hop = after * (slow * slow) * (lost * N::ratio(1, 2));
        let room = slender * N::from_f64(1.0 / PROPAGATION);
        let doubt = (slow * slow).mul_add(met, doubt);
        let doubt = (room * room).mul_add(uu + ww, doubt);
        let doubt = (hop * hop).mul_add(uu, doubt);
        // Saltation.
        let shear = eta.mul_add(before, after) * slow;
        let (kept, mixed) = (eta * eta, eta * shear);
        let after_ww = mixed.mul_add(uw + uw, kept * ww);
        Self {
            uu: kept * uu,
            uw: mixed.mul_add(uu, kept * uw),
            ww: (shear * shear).mul_add(uu, after_ww),
            doubt,
            ..self
        }
    }

    /// Adds a lowest rotation above the base.
    #[inline(always)]
    pub fn miss(self, lowest: N) -> Self {
        let doubt = self.doubt + self.uu / (lowest * lowest);
        Self { doubt, ..self }
    }

    /// Adds a rest: `after` the last impact, after which the block moves at
    /// `w`, and `before` the latest end of the chatter.
    #[inline(always)]
    pub fn rest(self, w: N, after: N, before: N) -> Self {
        let met = (after * after).mul_add(self.ww, self.uu);
        let margin = w * before;
        let doubt = self.doubt + met / (margin * margin);
        Self { doubt, ..self }
    }

    /// Adds the last decision, by the margin of a quantity that changes as u
    /// and w do, and compares the errors with their limit.
    #[inline(always)]
    pub fn end(self, margin: N, alpha: N) -> Self {
        let square = self.uu + self.ww;
        let room = N::from_f64(1.0 / PROPAGATION) / alpha;
        let doubt = self.doubt + square / (margin * margin);
        let doubt = (room * room).mul_add(square, doubt);
        Self { doubt, ..self }
    }
}

impl<N: Real> Screen<N> {
    /// True if the estimate of the run will not be below [`DOUBTFUL`],
    /// whatever follows. NaN is doubtful.
    #[inline(always)]
    pub fn is_surely_doubtful(&self) -> bool {
        !(self.doubt < N::from_f64(2.0 * DOUBTFUL * DOUBTFUL))
    }

    /// Adds the error of the largest peak.
    #[inline(always)]
    pub fn stand(self, alpha: N) -> Self {
        let room = N::from_f64(1.0 / PEAK) / alpha;
        let doubt = (room * room).mul_add(self.peak, self.doubt);
        Self { doubt, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::{DOUBTFUL, Landing, Screen, ScreenLeg};

    /// Flies so long in many short steps, at a curvature, without rounding.
    fn flown(start: Screen<f64>, time: f64, curvature: f64) -> Screen<f64> {
        let steps = 1000;
        let tau = time / f64::from(steps);
        let (u, w, size) = (0.0, 0.0, 0.0);
        let step = ScreenLeg { tau, curvature, u, w, size, last: None };
        (0..steps).fold(start, |screen, _| screen.fly(&step))
    }

    /// The variance of a quantity with these derivatives by u and w.
    fn of(screen: &Screen<f64>, x: [f64; 2], y: [f64; 2]) -> f64 {
        x[0] * y[0] * screen.uu
            + (x[0] * y[1] + x[1] * y[0]) * screen.uw
            + x[1] * y[1] * screen.ww
    }

    fn start() -> Screen<f64> {
        let (uu, uw, ww) = (2e-20, -1e-20, 3e-20);
        Screen { uu, uw, ww, ..Screen::at_rest() }
    }

    #[test]
    fn a_flight_carries_the_covariance_as_its_curvature_does() {
        for curvature in [1.0, 0.8, 1.3] {
            let found = flown(start(), 2.0, curvature);
            let rate = f64::sqrt(curvature);
            let e = libm::exp(2.0 * rate);
            let (c, s) = (0.5 * (e + 1.0 / e), 0.5 * (e - 1.0 / e));
            let (u, w) = ([c, s / rate], [s * rate, c]);
            let close = |a: f64, b: f64| (a / b - 1.0).abs() < 0.01;
            assert!(close(found.uu, of(&start(), u, u)), "{curvature}");
            assert!(close(found.uw, of(&start(), u, w)), "{curvature}");
            assert!(close(found.ww, of(&start(), w, w)), "{curvature}");
        }
    }

    /// An error that a flight forgets at one curvature grows at another.
    #[test]
    fn what_is_forgotten_depends_on_the_curvature() {
        let stable = Screen { uu: 1.0, uw: -1.0, ww: 1.0, ..start() };
        let near_base = flown(stable, 6.0, 1.0).uu;
        let leaning = flown(stable, 6.0, 0.8).uu;
        assert!(leaning > 100.0 * near_base, "{leaning} {near_base}");
    }

    /// Errors of one sign in every step, for as long as an order of 4 allows.
    #[test]
    fn truncation_errors_of_a_fixed_order_add_up() {
        let (tau, last, coefficients) = (0.01, 1e-9, 5.0);
        let (u, w, size, last) = (0.0, 0.0, 0.0, Some(last));
        let step = ScreenLeg { tau, curvature: 1.0, u, w, size, last };
        for steps in [1, 10, 100, 500, 2500] {
            let mut screen = Screen::<f64>::at_rest();
            let [mut by_u, mut by_w] = [0.0; 2];
            for _ in 0..steps {
                screen = screen.fly(&step);
                by_w += tau * by_u;
                by_u += tau * by_w + 1e-9 * tau / coefficients;
                by_w += 1e-9 * tau / coefficients;
            }
            for (error, variance) in [(by_u, screen.uu), (by_w, screen.ww)] {
                let ratio = error / variance.sqrt();
                assert!(ratio < 1.0 && ratio > 0.01, "{steps}: {ratio}");
            }
        }
    }

    /// The saltation matrix, and three decisions.
    #[test]
    fn an_impact_carries_the_covariance_by_its_matrix() {
        let (speed, before, after, eta) = (0.1, -0.3, -0.2, 0.9);
        let at = Landing { speed, before, after, eta, alpha: 0.2 };
        let (start, found) = (start(), start().land(&at));
        let shear = -(after + eta * before) / speed;
        let (u, w) = ([-eta, 0.0], [shear, -eta]);
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
        assert!(close(found.uu, of(&start, u, u)));
        assert!(close(found.uw, of(&start, u, w)));
        assert!(close(found.ww, of(&start, w, w)));
        let met = [before / speed, 1.0];
        let hop = after / (2.0 * eta * speed * speed);
        let doubt = of(&start, met, met) / (speed * speed)
            + (start.uu + start.ww) / (0.002 * 0.002)
            + start.uu * hop * hop;
        assert!(close(found.doubt, doubt), "{:e} {doubt:e}", found.doubt);
    }

    #[test]
    fn a_rest_is_held_against_the_time_that_is_left() {
        let (w, after) = (1e-3, 0.01);
        let near = start().rest(w, after, 1e-15).doubt.sqrt();
        let far = start().rest(w, after, 1e-3).doubt.sqrt();
        assert!(near > DOUBTFUL && far < DOUBTFUL, "{near} {far}");
    }

    #[test]
    fn a_peak_has_an_error_of_its_own() {
        let alpha = 0.2;
        // The variance of u half way through a step, as the flight has it.
        let (tau, u) = (0.3, [1.0, 0.3]);
        let top = start().top(tau).peak;
        assert!((top / of(&start(), u, u) - 1.0).abs() < 1e-12);
        let estimate = |error: f64| {
            let peak = (error * alpha) * (error * alpha);
            let run = Screen { peak, ..Screen::at_rest() };
            run.stand(alpha).doubt.sqrt()
        };
        assert!(estimate(3e-7) > DOUBTFUL && estimate(1e-7) < DOUBTFUL);
    }

    /// Rough estimate of a first hop of 100 steps that reaches a speed and
    /// ends at another, both over alpha.
    fn first_hop(fastest: f64, landing: f64) -> f64 {
        let (alpha, eta) = (0.2, 0.9);
        let speed = landing * alpha;
        let at = Landing { speed, before: 0.3, after: -0.7, eta, alpha };
        let mut flight = Screen::<f64>::at_rest().start();
        let w = -fastest * alpha;
        let (u, size, last) = (0.0, alpha, None);
        let step = ScreenLeg { tau: 0.02, curvature: 1.0, u, w, size, last };
        for _ in 0..99 {
            flight = flight.fly(&step);
        }
        flight.fly(&ScreenLeg { w: speed, ..step }).land(&at).doubt.sqrt()
    }

    /// The error is zero at rest, so after the first hop all of it is that
    /// hop's rounding.
    #[test]
    fn a_flight_that_ends_slowly_is_rounded_as_fast_as_it_was() {
        // The error of the time of the impact is that of the hop after it.
        let graze = first_hop(0.5, 1e-8);
        assert!(graze > 0.1, "{graze}");
        assert!(first_hop(0.5, 1e-7) > DOUBTFUL);
        assert!(first_hop(0.5, 1e-4) < DOUBTFUL);
        assert!(first_hop(0.5, 0.5) < 1e-11);
        // A block that is driven hard flies faster than alpha.
        let [fast, slow] = [20.0, 0.2].map(|speed| first_hop(speed, 1e-8));
        assert!((fast / slow / 100.0 - 1.0).abs() < 0.1, "{fast} {slow}");
    }
}
