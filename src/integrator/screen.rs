//! A rough certificate of every run, by its impacts alone.
//!
//! Whether a run is worth the careful assessment of its decisions is told by
//! an estimate that costs next to nothing: the covariance of the error of
//! (u, w) is carried from impact to impact, not from step to step. In flight
//! it grows as that of a block near its base without ground motion,
//! u'' = u - alpha: the error of a = u + w by exp(tau), that of b = u - w by
//! exp(-tau). The estimate adds the squares of error over margin of all
//! decisions, so that it is no less than the largest of them. Two runs of the
//! same scene have the same bits of it, in lanes or alone.

use crate::number::Number;

/// Rotation over the slenderness angle below which a lowest rotation above
/// the base is a decision that the estimate takes in.
pub(crate) const LOW: f64 = 1e-6;

/// Share of the slenderness angle that the error is held against: above it
/// the linear propagation is not trusted.
const PROPAGATION: f64 = 0.01;

/// Squarings in which the exponential of a flight's length is made.
const SQUARINGS: u32 = 5;

/// The estimate of a run, in units of 1/p.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Screen<N> {
    /// When the flight under way began.
    pub began: N,
    /// Covariance of the error of a = u + w and b = u - w there.
    pub aa: N,
    pub ab: N,
    pub bb: N,
    /// Sum of the squares of error over margin.
    pub doubt: N,
}

/// An impact, as the estimate sees it.
pub(crate) struct Landing<N> {
    /// When.
    pub time: N,
    /// One over the length of a step.
    pub inverse: N,
    /// Speed before it, and the accelerations before and after it.
    pub speed: N,
    pub before: N,
    pub after: N,
    pub eta: N,
    pub alpha: N,
}

impl<N: Number> Screen<N> {
    /// Of a block at rest.
    pub fn at_rest() -> Self {
        let zero = N::zero();
        Self { began: zero, aa: zero, ab: zero, bb: zero, doubt: zero }
    }

    /// Lifts at a time.
    #[inline(always)]
    pub fn start(self, time: N) -> Self {
        let rest = Self::at_rest();
        Self { began: time, doubt: self.doubt, ..rest }
    }

    /// Flies to a time, in steps of a length at about a speed.
    #[inline(always)]
    pub fn fly(self, time: N, inverse: N, speed: N) -> Self {
        let Self { began, aa, ab, bb, doubt } = self;
        let tau = time - began;
        let growth = growth(tau + tau);
        // Rounding of every step at that speed.
        let rounded = N::from_f64(0.5 * f64::EPSILON) * speed;
        let aa = (rounded * rounded).mul_add(tau * inverse, aa);
        Self { began: time, aa: growth * aa, ab, bb: bb / growth, doubt }
    }

    /// Variances and covariance of the error of u and w, four times.
    #[inline(always)]
    fn four_times(&self) -> (N, N, N) {
        let Self { aa, ab, bb, .. } = *self;
        let (sum, twice) = (aa + bb, ab + ab);
        (sum + twice, aa - bb, sum - twice)
    }

    /// An impact: its speed against the error of that, the hop after it
    /// against the error of its time, and whether errors are small.
    #[inline(always)]
    pub fn land(self, at: &Landing<N>) -> Self {
        let Landing { time, inverse, speed, before, after, eta, alpha } = *at;
        let there = self.fly(time, inverse, speed);
        let (uu, uw, ww) = there.four_times();
        // One division for both.
        let both = N::ratio(1, 2) / (speed * alpha);
        let (slow, slender) = (both * alpha, both * speed);
        // The speed changes by w + u before/speed, the time by u/speed; the
        // hop takes 2 eta speed/after.
        let by_u = (before + before) * slow;
        let met = by_u.mul_add(by_u.mul_add(uu, uw + uw), ww);
        let hop = (after + after) * (slow * slow);
        let room = slender * N::from_f64(1.0 / PROPAGATION);
        let doubt = (slow * slow).mul_add(met, there.doubt);
        let doubt = (room * room).mul_add(uu + ww, doubt);
        let doubt = (hop * hop).mul_add(uu, doubt);
        // Saltation.
        let shear = eta.mul_add(before, after) * (slow + slow);
        let (kept, mixed) = (eta * eta, eta * shear);
        let quarter = N::ratio(1, 4);
        let (uu, uw, ww) = (uu * quarter, uw * quarter, ww * quarter);
        let after_uw = mixed.mul_add(uu, kept * uw);
        let after_ww = mixed.mul_add(uw + uw, kept * ww);
        let after_ww = (shear * shear).mul_add(uu, after_ww);
        let after_uu = kept * uu;
        let (sum, twice) = (after_uu + after_ww, after_uw + after_uw);
        Self {
            began: time,
            aa: sum + twice,
            ab: after_uu - after_ww,
            bb: sum - twice,
            doubt,
        }
    }

    /// A decision of some margin, about a quantity that changes as u and w
    /// do.
    #[inline(always)]
    pub fn decide(self, margin: N) -> Self {
        let (uu, _, ww) = self.four_times();
        let square = (uu + ww) * N::ratio(1, 4);
        let doubt = self.doubt + square / (margin * margin);
        Self { doubt, ..self }
    }
}

/// Exponential, to a few percent up to ten, and no less than half of it up
/// to thirty.
#[inline(always)]
fn growth<N: Number>(x: N) -> N {
    let part = x * N::ratio(1, 1 << SQUARINGS);
    let sum = part.mul_add(N::ratio(1, 3), N::one());
    let sum = (part * N::ratio(1, 2)).mul_add(sum, N::one());
    let mut growth = part.mul_add(sum, N::one());
    for _ in 0..SQUARINGS {
        growth = growth * growth;
    }
    growth
}

#[cfg(test)]
mod tests {
    use super::{Landing, Screen, growth};

    #[test]
    fn the_growth_is_about_the_exponential() {
        for k in 0..=100 {
            let x = 0.1 * f64::from(k);
            let share = growth(x) / libm::exp(x);
            assert!(share <= 1.0 && share > 0.93, "{x}: {share}");
        }
        assert!(growth(30.0) > 0.2 * libm::exp(30.0));
    }

    /// Flight and impact by matrices of (u, w): cosh and sinh, and the
    /// saltation matrix.
    #[test]
    fn an_impact_carries_the_covariance_by_the_matrices() {
        let (uu, uw, ww) = (2e-20, -1e-20, 3e-20);
        let start = Screen {
            began: 0.0,
            aa: uu + 2.0 * uw + ww,
            ab: uu - ww,
            bb: uu - 2.0 * uw + ww,
            doubt: 0.0,
        };
        let (speed, before, after, eta) = (0.1, -0.3, -0.2, 0.9);
        let at = Landing {
            time: 0.7,
            inverse: 0.0,
            speed,
            before,
            after,
            eta,
            alpha: 0.2,
        };
        let found = start.land(&at);
        let e = growth(1.4).sqrt();
        let (c, s) = (0.5 * (e + 1.0 / e), 0.5 * (e - 1.0 / e));
        let shear = (after + eta * before) / -speed;
        let m =
            [[-eta * c, -eta * s], [shear * c - eta * s, shear * s - eta * c]];
        let of = |x: [f64; 2], y: [f64; 2]| {
            x[0] * y[0] * uu
                + (x[0] * y[1] + x[1] * y[0]) * uw
                + x[1] * y[1] * ww
        };
        let [u, w] = m;
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
        assert!(close(found.aa, of(u, u) + 2.0 * of(u, w) + of(w, w)));
        assert!(close(found.bb, of(u, u) - 2.0 * of(u, w) + of(w, w)));
        assert!(close(found.ab, of(u, u) - of(w, w)));
        let (uu, ww) = (of([c, s], [c, s]), of([s, c], [s, c]));
        let met = of(
            [before / speed * c + s, before / speed * s + c],
            [before / speed * c + s, before / speed * s + c],
        );
        let hop = after / (2.0 * speed * speed);
        let doubt = met / (speed * speed)
            + (uu + ww) / (0.002 * 0.002)
            + uu * hop * hop;
        assert!(close(found.doubt, doubt), "{:e} {doubt:e}", found.doubt);
    }
}
