//! A rough certificate of every run, by its impacts alone.
//!
//! Whether a run is worth the careful assessment of its decisions is told by
//! an estimate that costs next to nothing: the covariance of the error of
//! (u, w) is carried from impact to impact, not from step to step. In flight
//! it grows as that of a block near its base without ground motion, whose
//! u'' = u - alpha: by cosh and sinh of the time since the last impact. The
//! estimate adds the squares of error over margin of all decisions, so that
//! it is no less than the largest of them. Two runs of the same scene have
//! the same bits of it, in lanes or alone.

use crate::number::Number;

/// Rotation over the slenderness angle below which a lowest rotation above
/// the base is a decision that the estimate takes in.
pub(crate) const LOW: f64 = 1e-6;

/// Share of the slenderness angle that the error is held against: above it
/// the linear propagation is not trusted.
const PROPAGATION: f64 = 0.01;

/// Parts in which the exponential of a flight's length is made.
const HALVINGS: i32 = 6;

/// The estimate of a run, in units of 1/p.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Screen<N> {
    /// When the flight under way began.
    pub began: N,
    /// Covariance of the error of (u, w) there.
    pub uu: N,
    pub uw: N,
    pub ww: N,
    /// Sum of the squares of error over margin.
    pub doubt: N,
}

/// An impact, as the estimate sees it.
pub(crate) struct Landing<N> {
    /// When, and the length of a step.
    pub time: N,
    pub step: N,
    /// Speed before it, and the accelerations before and after it.
    pub speed: N,
    pub before: N,
    pub after: N,
    pub eta: N,
    /// One over the slenderness angle.
    pub slender: N,
}

impl<N: Number> Screen<N> {
    /// Of a block at rest.
    pub fn at_rest() -> Self {
        let zero = N::zero();
        Self { began: zero, uu: zero, uw: zero, ww: zero, doubt: zero }
    }

    /// Lifts at a time.
    #[inline(always)]
    pub fn start(self, time: N) -> Self {
        let rest = Self::at_rest();
        Self { began: time, doubt: self.doubt, ..rest }
    }

    /// Flies to a time, in steps of a length at about a speed.
    #[inline(always)]
    pub fn fly(self, time: N, step: N, speed: N) -> Self {
        let tau = time - self.began;
        let half = N::ratio(1, 2);
        let growth = growth(tau);
        let decay = N::one() / growth;
        let (c, s) = (half * (growth + decay), half * (growth - decay));
        let Self { uu, uw, ww, doubt, .. } = self;
        // Rounding of every step at that speed.
        let rounded = N::from_f64(0.5 * f64::EPSILON) * speed;
        let ww = (rounded * rounded).mul_add(tau / step, ww);
        let cross = (c * s) * (uw + uw);
        let (cc, ss) = (c * c, s * s);
        Self {
            began: time,
            uu: cc.mul_add(uu, ss.mul_add(ww, cross)),
            uw: (c * s).mul_add(uu + ww, (cc + ss) * uw),
            ww: ss.mul_add(uu, cc.mul_add(ww, cross)),
            doubt,
        }
    }

    /// An impact: its speed against the error of that, the hop after it
    /// against the error of its time, and whether errors are small.
    #[inline(always)]
    pub fn land(self, at: &Landing<N>) -> Self {
        let Landing { time, step, speed, before, after, eta, slender } = *at;
        let Self { uu, uw, ww, doubt, .. } = self.fly(time, step, speed);
        let slow = N::one() / speed;
        // The speed changes by w + u before/speed, the time by u/speed.
        let by_u = before * slow;
        let met = by_u.mul_add(by_u * uu, (by_u + by_u).mul_add(uw, ww));
        let hop = after * slow * slow / (eta + eta);
        let room = slender * N::from_f64(1.0 / PROPAGATION);
        let small = (uu + ww) * (room * room);
        let doubt = (slow * slow).mul_add(met, doubt + small);
        let doubt = (hop * hop).mul_add(uu, doubt);
        // Saltation.
        let shear = eta.mul_add(before, after) * slow;
        let (sheared, kept) = (shear * shear, eta * eta);
        let both = eta * shear;
        Self {
            began: time,
            uu: kept * uu,
            uw: both.mul_add(uu, kept * uw),
            ww: sheared.mul_add(uu, (both + both).mul_add(uw, kept * ww)),
            doubt,
        }
    }

    /// A decision of some margin, about a quantity that changes as u and w
    /// do.
    #[inline(always)]
    pub fn decide(self, margin: N) -> Self {
        let Self { uu, ww, doubt, .. } = self;
        Self { doubt: doubt + (uu + ww) / (margin * margin), ..self }
    }
}

/// Exponential of a flight's length, to a percent up to thirty.
#[inline(always)]
fn growth<N: Number>(tau: N) -> N {
    let part = tau * N::ratio(1, 1 << HALVINGS);
    let sum = part.mul_add(N::ratio(1, 3), N::one());
    let sum = (part * N::ratio(1, 2)).mul_add(sum, N::one());
    let mut growth = part.mul_add(sum, N::one());
    for _ in 0..HALVINGS {
        growth = growth * growth;
    }
    growth
}
