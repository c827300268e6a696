//! The peak so far as a barrier: when the rest of a record can surely not lift
//! a block over it.
//!
//! Let v and d be the ground's velocity and place, v zero at the record's
//! end, both seen from the pivot, x = alpha - u, c = cos x and s = sin x (for
//! Eq. 2, 1 and x). With y = u' + v c, the ground's acceleration drops out of
//! the rate of the energy E = y^2/2 + U(u), U being the potential energy
//! without ground motion:
//!
//! ```text
//! y' = -s (1 - v u')        (Eq. 2: -s)
//! E' = -v s (c - u' y)      (Eq. 2: -v s)
//! ```
//!
//! While E stays below M^2/2, the potential energy at the peak, the peak u_p
//! is not reached, |y| stays below M, and |u'| below M + V, V being the
//! largest |v| to come. An impact leaves -eta y - (1 - eta) v c of y; at rest
//! y is v c. Two bounds follow.
//!
//! Whatever the impacts, E grows by no more than
//!
//! ```text
//! (s c + s |u' y|) X <= (lean + alpha M (M + V)) X,
//! ```
//!
//! X being the integral of |v| and `lean` the largest s c.
//!
//! And in one hop, from impact to impact, E grows by no more than a G that
//! the ground's sway R bounds, the difference of the largest and the least d
//! in it. For y falls all the way, by s >= x (1 - alpha^2/6), and x^2 is at
//! least y^2 + B^2 with B = 2 sin((alpha - u_p)/2), so that a hop lasts for
//! T = 2 asinh(M/B), over 1 - alpha^2/6 and over 1 - V (M + V), at most.
//! And with d measured from the middle of its range, by parts,
//!
//! ```text
//! integral of v s c = [d s c] + integral of d k u',      k = cos 2x
//!   = [d s c] + integral of d k y - [d^2 k c/2] + integral of (d^2/2) (k c)'
//! ```
//!
//! where |(k c)'| <= 5 alpha |u'|. Y, the integral of |y|, has two parts, for
//! y changes its sign once: each is a rise or a fall of u, u_p at most, and
//! an integral of v c, which is R + alpha R/2 times the integral of |u'|, and
//! that is Y + V T at most. Hence
//!
//! ```text
//! Y <= (2 u_p + 2 R + alpha R V T/2) / (1 - alpha R/2)
//! G <= lean R + Y (R/2 + alpha V (M + V) + 5/8 alpha R^2)
//!      + R^2/4 + 5/8 alpha R^2 V T.
//! ```
//!
//! If E is below S^2/2 with S^2 = M^2 - 2 G, the hop stays below the peak; and
//! if eta M + (1 - eta) V <= S, so do all that follow, for every impact leaves
//! less than S.
//!
//! # Proof P1
//!
//! A run for the peak alone ends early, and a certificate is closed
//! (`assess_settled`), where the bounds above exclude a higher peak. They rest
//! on the energy of Eqs. 1 and 2 (`least_potential`, `lean`, `BarrierHop`), on
//! an impact that leaves -eta y - (1 - eta) v c of y with a constant eta of at
//! most 1, and on a peak below the saddle. Under another impact law,
//! `Driver::for_extent` and `Driver::observe` take no barrier until P1 is proved
//! for it. (`Barrier::none` is no substitute: it is a barrier that a run
//! raises later.)

use crate::excitation::Remaining;
use crate::integrator::dynamics::{Dynamics, Model};
use crate::integrator::forcing::Remainder;
use crate::number::Real;

/// Factor on bounds that covers rounding and truncation.
const SURELY: f64 = 1.001;

/// Largest V (M + V) for which hops are bounded.
const STEADY: f64 = 1.0 / 64.0;

/// The peak so far, and the bounds on the rest of a record that follow from
/// it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Barrier<N> {
    /// The peak of the barrier.
    peak: N,
    /// M^2, and M.
    height: N,
    speed: N,
    /// Piece from which on every impact takes more than a hop can give.
    calm: usize,
    /// S^2 there, and X.
    safe: N,
    travel: N,
}

impl<N: Real> Barrier<N> {
    /// The barrier of no peak.
    pub fn none() -> Self {
        let zero = N::zero();
        Self {
            peak: zero,
            height: zero,
            speed: zero,
            calm: usize::MAX,
            safe: zero,
            travel: zero,
        }
    }

    /// Raises the barrier to a peak.
    #[inline(always)]
    pub fn raise(
        &mut self,
        to: N,
        dynamics: &Dynamics<N>,
        remainder: &Remainder<'_, N>,
    ) {
        if to > self.peak {
            self.raise_surely(to, dynamics, remainder);
        }
    }

    #[inline(never)]
    fn raise_surely(
        &mut self,
        to: N,
        dynamics: &Dynamics<N>,
        remainder: &Remainder<'_, N>,
    ) {
        self.peak = to;
        let least = least_potential(dynamics, to);
        self.height = least + least;
        self.speed = self.height.sqrt();
        let hop = BarrierHop::below(self, dynamics);
        let window = remainder.window(hop.time);
        let safe = |piece| {
            let left = remainder.left(piece);
            let sway = window.map(|window| remainder.sway(piece, window));
            sway.and_then(|sway| hop.safe(left.speed, sway))
        };
        let holds = |piece| safe(piece).is_some();
        self.calm = remainder.first(self.calm, holds);
        self.safe = safe(self.calm).unwrap_or(self.height);
        self.travel = remainder.left(self.calm).travel;
    }

    /// Velocity below which a block that leaves the base surely never reaches
    /// its peak again under the rest of the excitation; not positive if there
    /// is none.
    #[inline(always)]
    pub fn fastest(&self, dynamics: &Dynamics<N>, left: Remaining<N>) -> N {
        self.square(dynamics, left).positive_part().sqrt() - left.speed
    }

    /// True if a block at rest surely never reaches its peak again.
    #[inline(always)]
    pub fn is_above_rest(
        &self,
        dynamics: &Dynamics<N>,
        left: Remaining<N>,
    ) -> bool {
        left.speed * left.speed < self.square(dynamics, left)
    }

    /// Twice the energy below which a block surely never reaches its peak
    /// again.
    #[inline(always)]
    fn square(&self, dynamics: &Dynamics<N>, left: Remaining<N>) -> N {
        let Remaining { speed, travel } = left;
        let twice = N::from_f64(2.0 * SURELY);
        let most = self.speed * (self.speed + speed);
        let rate = twice * (dynamics.alpha * most + lean(dynamics));
        let to_end = self.height - rate * travel;
        let further = (travel - self.travel).positive_part();
        let to_calm = self.safe - rate * further;
        let square = if to_calm > to_end { to_calm } else { to_end };
        square * N::from_f64(1.0 / SURELY)
    }
}

/// The largest s c.
#[inline(always)]
fn lean<N: Real>(dynamics: &Dynamics<N>) -> N {
    let Dynamics { sine, cosine, .. } = *dynamics;
    match dynamics.model {
        Model::Nonlinear if sine < cosine => sine * cosine,
        Model::Nonlinear => N::ratio(1, 2),
        Model::Linearized => dynamics.alpha,
    }
}

/// Bounds on hops below a peak.
struct BarrierHop<N> {
    alpha: N,
    eta: N,
    lean: N,
    peak: N,
    /// M^2, and M.
    height: N,
    speed: N,
    /// T.
    time: N,
}

impl<N: Real> BarrierHop<N> {
    fn below(barrier: &Barrier<N>, dynamics: &Dynamics<N>) -> Self {
        let Barrier { peak, height, speed, .. } = *barrier;
        let Dynamics { model, alpha, eta, .. } = *dynamics;
        let one = N::one();
        let x = alpha - peak;
        let (gap, slow) = match model {
            Model::Nonlinear => {
                let sine = one - x * x * N::ratio(1, 24);
                (x * sine, one - alpha * alpha * N::ratio(1, 6))
            }
            Model::Linearized => (x, one),
        };
        let slow = slow * N::from_f64((1.0 - STEADY) / SURELY);
        let time = N::from_f64(2.0) * asinh(speed / gap) / slow;
        Self { alpha, eta, lean: lean(dynamics), peak, height, speed, time }
    }

    /// S^2 for a ground of speed `v` and a sway, if every impact takes more
    /// energy than a hop can give.
    fn safe(&self, v: N, sway: N) -> Option<N> {
        let Self { alpha, eta, lean, peak, height, speed, time } = *self;
        let one = N::one();
        let most = v * (speed + v);
        let bend = alpha * sway * N::ratio(1, 2);
        if !(most < N::from_f64(STEADY) && bend < one) {
            return None;
        }
        let flight = v * time;
        let rise = peak + sway;
        let way = (rise + rise + bend * flight) / (one - bend);
        let square = sway * sway;
        let bent = N::ratio(5, 8) * alpha * square;
        let part = sway * N::ratio(1, 2) + alpha * most + bent;
        let gain = lean * sway + way * part;
        let gain = gain + square * N::ratio(1, 4) + bent * flight;
        let safe = height - N::from_f64(2.0 * SURELY) * gain;
        let after = eta * speed + (one - eta) * v;
        let lasts = after * after * N::from_f64(SURELY) <= safe;
        lasts.then_some(safe)
    }
}

fn asinh<N: Real>(x: N) -> N {
    let one = N::one();
    let square = x * x;
    (x + square / (one + (one + square).sqrt())).ln_1p()
}

/// Lower bound of the potential energy at `u` up to alpha, above the base and
/// without ground motion:
///
/// ```text
/// Eq. 1:  u (sin alpha - u/2 (cos alpha + u/3 sin alpha))
/// Eq. 2:  u (alpha - u/2)
/// ```
fn least_potential<N: Real>(dynamics: &Dynamics<N>, u: N) -> N {
    let half = u * N::ratio(1, 2);
    match dynamics.model {
        Model::Nonlinear => {
            let Dynamics { sine, cosine, .. } = *dynamics;
            u * (sine - half * (cosine + u * N::ratio(1, 3) * sine))
        }
        Model::Linearized => u * (dynamics.alpha - half),
    }
}

#[cfg(test)]
mod tests;
