//! The impact, and the proof that a chatter ends.
//!
//! # Proof P2
//!
//! `accumulation` and `prove` end a series of impacts. They rest on a constant
//! eta below 1, on the downward acceleration at the base of Eqs. 1 and 2
//! (`restoring`), and on a forcing that is a polynomial within the piece.

use crate::integrator::Impact;
use crate::integrator::driver::{Again, Driver, Flight, Step};
use crate::integrator::dynamics::Overturning;
use crate::integrator::forcing::Forcing;
use crate::integrator::motion::{BlockMotion, tail_speed};
use crate::integrator::screen::Landing;
use crate::number::Real;

/// As [`tail_speed`], if only forces are observed. They depend on the square
/// of the speed, so the threshold may be larger.
const TAIL_OF_FORCES: f64 = 1e-5;

/// Largest rotation over alpha to which a barrier is raised if larger
/// rotations do not end a run.
const BELOW_SADDLE: f64 = 0.98;

/// Impacts that accumulate.
pub(crate) struct Chatter<N> {
    /// Time (in 1/p) from the first impact to the rest.
    pub time: N,
    /// Relative bound on the change of `time` by varying accelerations.
    pub spread: N,
    /// Bound on the rotation after the first impact.
    rise: N,
}

/// The number, if it is positive.
#[inline(always)]
fn positive<N: Real>(x: N) -> Option<N> {
    (x > N::zero()).then_some(x)
}

impl<N: Real, G: Forcing<N, F>, const F: usize, const HARD: usize>
    Driver<N, G, F, HARD>
{
    /// Makes the impact at a step's place, with `speed` and acceleration
    /// `before` it. Returns the end of the flight if the impact ends it.
    #[inline(always)]
    pub(super) fn impact(
        &mut self,
        step: &mut Step<N>,
        speed: N,
        before: N,
    ) -> Option<Flight<N>> {
        let speed = speed.positive_part();
        let side = step.motion.side.flipped();
        let w = self.dynamics.eta * speed;
        self.record.work.impacts += 1;
        let f = self.oriented(step.place, side, false);
        let error = self
            .record
            .accuracy
            .and_then(|_| self.assess_impact(step.place, speed, before, &f));
        if self.observe.events && positive(speed).is_some() {
            self.record.impacts.push(Impact {
                time_s: self.time_s(step.place),
                speed_before_rad_s: speed * self.dynamics.p,
                error,
            });
        }
        if let Some(screen) = self.screen {
            let landing = Landing {
                speed,
                before: -self.dynamics.restoring(-f[0]),
                after: -self.dynamics.restoring(f[0]),
                eta: self.dynamics.eta,
                alpha: self.dynamics.alpha,
            };
            let screen = screen.land(&landing);
            self.screen = Some(screen);
            let ends = self.again == Again::IfDoubtful;
            if ends && screen.is_surely_doubtful() {
                return Some(Flight::Doubtful);
            }
        }
        step.motion = BlockMotion { side, u: N::zero(), w };
        if self.is_settled(step.place.piece, w) {
            return Some(Flight::Settled);
        }
        let left = self.forcing.length(step.place.piece) - step.place.offset;
        let chatter = self.chatter(&f, w, left)?;
        let (place, time_s) = self.later(step.place, w, chatter.time);
        if self.record.accuracy.is_some() {
            self.assess_rest(place, &chatter, (speed, w), error, time_s);
        }
        Some(Flight::Rest(place, time_s))
    }

    /// True if only outcome and peak are needed and the rest of the excitation
    /// from a piece on can change neither, for a block that moves at `w` on
    /// the base.
    #[inline(always)]
    pub(super) fn is_settled(&mut self, piece: usize, w: N) -> bool {
        if piece < self.exit_from {
            return false;
        }
        self.see_peak();
        let fastest = self.fastest(piece);
        if self.record.accuracy.is_some() {
            self.assess_settled(w, fastest);
        }
        self.ends_early && w < fastest
    }

    /// Raises the barrier to the peak so far, or at once as high as it may
    /// stand if the peak is not needed.
    #[inline(always)]
    pub fn see_peak(&mut self) {
        if let Some(barrier) = &mut self.barrier
            && let Some(remainder) = self.forcing.remainder()
        {
            // Below the saddle, which other rotations may exceed.
            let most = self.dynamics.alpha * N::from_f64(BELOW_SADDLE);
            let peak = self.record.peak;
            let is_beyond = self.dynamics.overturning == Overturning::HalfPi
                && peak > most;
            let is_low = self.outcome_only && !(peak > most);
            let height = if is_beyond || is_low { most } else { peak };
            barrier.raise(height, &self.dynamics, &remainder);
        }
    }

    /// Velocity below which the block may leave the base in a piece and need
    /// not be followed; not positive if there is none.
    #[inline(always)]
    pub fn fastest(&self, piece: usize) -> N {
        let fastest = || {
            let left = self.forcing.remainder()?.left(piece);
            Some(self.barrier.as_ref()?.fastest(&self.dynamics, left))
        };
        fastest().unwrap_or(N::zero())
    }

    /// First piece from which on a block at rest need not be followed. The
    /// search starts at a guess, which is the result if there is no barrier.
    #[inline(always)]
    pub fn first_exit(&self, guess: usize) -> usize {
        let (Some(barrier), Some(remainder)) =
            (&self.barrier, self.forcing.remainder())
        else {
            return guess;
        };
        remainder.first(guess, |piece| {
            barrier.is_above_rest(&self.dynamics, remainder.left(piece))
        })
    }

    /// The chatter after an impact that leaves speed `w`, if it provably ends
    /// within `left` and need not be followed.
    #[inline(always)]
    pub(super) fn chatter(
        &self,
        f: &[N; F],
        w: N,
        left: N,
    ) -> Option<Chatter<N>> {
        let chatter = self.accumulation(f, w, left)?;
        if !self.is_below_peak(&chatter) {
            return None;
        }
        let tail = if self.observe.events {
            tail_speed::<N>()
        } else if self.record.forces.is_some() {
            TAIL_OF_FORCES
        } else {
            f64::INFINITY
        };
        (w < self.dynamics.alpha * N::from_f64(tail)).then_some(chatter)
    }

    /// True if no hop of a chatter raises the peak.
    #[inline(always)]
    pub(super) fn is_below_peak(&self, chatter: &Chatter<N>) -> bool {
        chatter.rise == N::zero() || chatter.rise < self.record.peak
    }

    /// The chatter after an impact that leaves speed `w`, if its impacts
    /// provably accumulate within `left` while the ground stays below the
    /// uplift threshold; `f` is the forcing on the new branch.
    ///
    /// Each hop rises by at most w^2/D and lasts at most 2 w/D, D being the
    /// least downward acceleration; from hop to hop the speed falls by
    /// eta sqrt(D_max/D_min) at least.
    #[inline(always)]
    pub(super) fn accumulation(
        &self,
        f: &[N; F],
        w: N,
        left: N,
    ) -> Option<Chatter<N>> {
        let margin = self.dynamics.threshold - f[0].abs();
        if w == N::zero() {
            let zero = N::zero();
            let chatter = Chatter { time: zero, spread: zero, rise: zero };
            return (!(margin < N::zero())).then_some(chatter);
        }
        let two = N::from_f64(2.0);
        let eta = self.dynamics.eta;
        positive(margin)?;
        positive(N::one() - eta)?;
        // Quick refusal before the proof.
        let scale = self.dynamics.restoring(-f[0].abs());
        let guess = two * w / (scale * (N::one() - eta));
        if !(guess < left) {
            return None;
        }
        self.prove(f, w, left, two * guess)
    }

    #[inline(never)]
    pub(super) fn prove(
        &self,
        f: &[N; F],
        w: N,
        left: N,
        window: N,
    ) -> Option<Chatter<N>> {
        let two = N::from_f64(2.0);
        let window = if window < left { window } else { left };
        let mut drift = N::zero();
        for k in (1..F).rev() {
            drift = (drift + f[k].abs()) * window;
        }
        let least = positive(self.dynamics.restoring(-(f[0].abs() + drift)))?;
        // Eq. 1 pushes outwards by at most (1 + tan alpha) u on a hop.
        let rise = w * w / least;
        let push = (N::one() + self.dynamics.threshold) * (rise + rise);
        let least = positive(least - push)?;
        let most = |f0: N| self.dynamics.restoring(f0 + drift) + push;
        let low = |f0: N| self.dynamics.restoring(f0 - drift) - push;
        let ratio = |f0: N| most(f0) / low(f0);
        let (here, there) = (ratio(f[0]), ratio(-f[0]));
        let worst = if here > there { here } else { there };
        let eta = self.dynamics.eta;
        let decay = eta * worst.sqrt();
        let bound =
            two * w * worst.sqrt() / (least * positive(N::one() - decay)?);
        if !(bound < window) {
            return None;
        }
        let rise = w * w / (two * least) * worst;
        // 2 w [1/D + eta/D'] / (1 - eta^2), D and D' on the two branches.
        let up = self.dynamics.restoring(f[0]);
        let down = self.dynamics.restoring(-f[0]);
        let hops = N::one() / up + eta / down;
        let time = two * w * hops / (N::one() - eta * eta);
        let spread = (worst - N::one()) / (N::one() - decay);
        Some(Chatter { time, spread, rise })
    }
}

#[cfg(test)]
mod tests;
