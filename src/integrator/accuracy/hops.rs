//! Hops so small that their order does not matter.
//!
//! Impacts accumulate, and at some speed W the error of the state is as large
//! as the state. The impacts that follow are then unknown, but not their size:
//! until the ground next exceeds the uplift threshold, every hop is slower than
//! a small multiple of W, and the motion after that uplift starts within that
//! speed of the computed motion. The errors restart there from this bound.
//!
//! # Proof P12
//!
//! Let f vary linearly, and let B = (threshold - |f|) cos alpha be the lesser of
//! the downward accelerations on the two sides, r the slope of |f| cos alpha,
//! eta the coefficient of restitution and q = min(1/eta^2 - 1, 1).
//!
//! 1. While B falls, the energy w^2/2 + B u falls. An impact reduces it.
//! 2. While B rises, the energy grows at most in proportion to B. A hop that
//!    begins at w lasts for 2 w/B at most, so that w^2 grows in it by 2 r w/B^2
//!    of itself at most. If this is below q, the next impact takes more.
//! 3. It is, from B_* on with B_*^2 = 2 r w/q. On the way to a b with
//!    b^2 = 2 r W, the speed grows by b^2/(2 r) = W at most, and from b to B_*
//!    by the square root of B_*/b. With w = 2 W (B_*/b)^(1/2) this gives
//!    (B_*/b)^(3/2) = 2/q: w stays below 2 W (2/q)^(1/3).
//! 4. The change of gravity with u adds a share of tau^2, below 1 % in a step
//!    of at most 0.1.
//! 5. Above the threshold, the true and the computed motion have the same
//!    acceleration, away from the base. Each begins within W of zero, so that
//!    they differ by 2 W at most, whichever impacts are left. If the computed
//!    motion reaches `CLEAR` times W, the true motion rises, too. If it does
//!    not before the ground falls below the threshold, the true motion is
//!    slower than (`CLEAR` + 2) W.
//!
//! It rests on an impact that multiplies the speed by a constant eta below 1,
//! and on a forcing that is linear within a piece.

use super::{Accuracy, COVERAGE};
use crate::integrator::certificate::{CLEARANCE, Decision};

/// Largest speed of a hop, over alpha, that counts as small.
const SMALL: f64 = 1e-6;

/// Multiple of the speed of hops at which a motion has left its base.
const CLEAR: f64 = 64.0;

/// Allowance for the change of gravity with the rotation.
const SLACK: f64 = 1.1;

/// Difference of two motions over the bound on their speeds after an impact.
/// In a hop each is within the square root of 2 of that bound.
const APART: f64 = 3.0;

/// Rounding of an acceleration over the threshold, in units in the last place.
const ROUNDED: f64 = 8.0;

/// Hops whose order is unknown, in units of 1/p.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SmallHops {
    /// Bound on the speed after an impact.
    pub speed: f64,
    /// Begin, and the time up to which the bound holds.
    from: f64,
    to: f64,
    /// Rate of the ground acceleration while B rises and the bound includes
    /// the growth by that, otherwise zero.
    counted: f64,
}

impl SmallHops {
    /// Bounds on the difference of two such motions.
    pub fn errors(&self) -> [f64; 2] {
        let apart = APART * self.speed;
        [apart * (self.to - self.from), apart]
    }
}

/// A motion near its base, in units of 1/p.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearBase {
    pub u: f64,
    pub w: f64,
    pub time: f64,
    /// Largest downward acceleration.
    pub most: f64,
    pub eta: f64,
}

/// A step of small hops, in units of 1/p.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HopStep {
    pub tau: f64,
    pub end: f64,
    pub end_s: f64,
    /// Ground acceleration over gravity at both ends, and its rate.
    pub f: [f64; 2],
    pub rate: f64,
    /// Uplift threshold over gravity.
    pub threshold: f64,
    pub cosine: f64,
    pub eta: f64,
    /// Velocity at the end.
    pub w: f64,
}

/// Share of the energy that an impact takes over the share that it leaves; 1 at
/// most.
fn loss(eta: f64) -> f64 {
    (1.0 / (eta * eta) - 1.0).min(1.0)
}

/// Growth of the speed after an impact while B rises from any value.
fn growth(eta: f64) -> f64 {
    2.0 * SLACK * libm::cbrt(2.0 / loss(eta))
}

impl Accuracy {
    /// True if small hops begin here: the motion and its error are small.
    pub fn hops_begin(&mut self, at: &NearBase) -> bool {
        let [u, w] = [[1.0, 0.0], [0.0, 1.0]].map(|x| self.bound(x));
        let u = at.u + CLEARANCE * u;
        let w = at.w.abs() + CLEARANCE * w;
        let speed = (w * w + 2.0 * at.most * u).sqrt();
        let is_small = speed < SMALL * self.alpha && loss(at.eta) > 0.0;
        if is_small {
            let from = at.time - u / speed;
            let (to, counted) = (at.time, 0.0);
            self.hops = Some(SmallHops { speed, from, to, counted });
        }
        is_small
    }

    /// Follows small hops over a step.
    pub fn hop(&mut self, by: &HopStep) {
        let Some(mut hops) = self.hops else { return };
        let HopStep { tau, end, threshold, cosine, w, .. } = *by;
        let [from, to] = by.f.map(|f| threshold - f.abs());
        let turns = by.f[0] * by.f[1] < 0.0;
        hops.to = end;
        hops.speed += ROUNDED * self.unit * threshold * tau;
        if from < 0.0 && (turns || !(to < 0.0)) {
            hops.speed *= CLEAR + APART;
        }
        let rate = by.rate.abs();
        let rises = turns || (by.f[0] * by.rate < 0.0 && to > 0.0);
        if rises && hops.counted != rate {
            let (q, growth) = (loss(by.eta), growth(by.eta));
            let steep = 2.0 * rate * growth * hops.speed / (q * cosine);
            let near = from.max(0.0);
            if !(near * near > steep) {
                hops.speed *= growth;
            }
            // On the other side hops become slower.
            if !(threshold * threshold > steep * growth) {
                hops.speed = f64::INFINITY;
            }
        }
        hops.counted = if rises { rate } else { 0.0 };
        self.hops = Some(hops);
        if to < 0.0 && w > CLEAR * hops.speed {
            self.start();
        } else if hops.speed < SMALL * self.alpha {
            self.reach(0.0, hops.errors()[0]);
        } else {
            self.lose_hops(by.end_s);
        }
    }

    /// Notes that nothing bounds the hops any longer.
    pub fn lose_hops(&mut self, time_s: f64) {
        self.hops = None;
        self.decide(Decision::Contact, 0.0, 1.0, time_s);
    }

    /// Covariance at the end of small hops, or at rest.
    pub(super) fn start_covariance(&mut self) {
        let errors = self.hops.take().map_or([0.0; 2], |hops| hops.errors());
        let [u, w] = errors.map(|error| error / COVERAGE);
        // Both bounds may be reached at once.
        (self.uu, self.uw, self.ww) = (2.0 * u * u, 0.0, 2.0 * w * w);
    }
}

#[cfg(test)]
mod tests {
    use super::growth;

    /// Largest speed after an impact of a ball that bounces at speed 1 under a
    /// downward acceleration b + t, until its hops are short.
    fn largest(mut b: f64, eta: f64) -> f64 {
        let (mut speed, mut most) = (1.0_f64, 1.0_f64);
        while b < 1e4 && speed > 1e-3 {
            // u/t = w - b t/2 - t^2/6 = 0.
            let root = (b * b + 8.0 / 3.0 * speed).sqrt();
            let time = 4.0 * speed / (b + root);
            speed = eta * (b * time + 0.5 * time * time - speed);
            b += time;
            most = most.max(speed);
        }
        most
    }

    #[test]
    fn bouncing_under_rising_gravity_stays_within_the_bound() {
        let mut closest = 0.0_f64;
        for eta in [0.1, 0.5, 0.8, 0.92, 0.99, 0.999, 0.9999] {
            for k in -40..20 {
                let b = libm::exp10(0.1 * f64::from(k));
                let share = largest(b, eta) / growth(eta);
                assert!(share <= 1.0, "eta {eta}, b {b}: {share}");
                closest = closest.max(share);
            }
        }
        assert!(closest > 0.2, "largest share of the bound: {closest}");
    }
}
