//! Free motion after the excitation, in closed form.
//!
//! Energy above the base, D = w^2/2 + U(u), is constant between impacts and
//! falls by eta^2 at each. With E_s the saddle's energy, a block that moves
//! outwards with D > E_s, or is beyond the saddle with D < E_s, overturns;
//! one that moves inwards with D > E_s meets the base first and overturns on
//! the other side if eta^2 D > E_s. Times follow by Carlson's R_F (Eq. 1) or
//! atanh (Eq. 2).
//!
//! # Proofs P3 and P10
//!
//! P3: the fate follows from the energy alone. It is constant in flight and
//! falls by eta^2 at an impact; the ground is at rest; the saddle alone
//! separates the fates.
//!
//! P10: `last` lets the closed form replace a motion that observation cuts
//! later. No hop after the second is higher, since eta is at most 1, and a
//! block overturns on its branch or after one impact (P3).

mod orbit;

use crate::integrator::certificate::Decision;
use crate::integrator::dynamics::{Dynamics, Model, Overturning};
use crate::integrator::motion::{BlockMotion, RunTrace, tail_speed};
use crate::integrator::{Impact, ImpactError, Side, WorkLimit};
use crate::number::Real;
use orbit::{Energy, OrbitPlace, hop, speed_at, transit, turning};

/// Impacts logged at most where neither motion nor observation ends.
const ENDLESS_IMPACTS: usize = 1000;

/// Relative step of differences: one digit of these is needed.
const DIFFERENCE: f64 = 1e-6;

/// Relative error of the time of a tail of impacts, at the speeds at which
/// one stands for them.
const TAIL: f64 = 1e-9;

/// What the free motion is asked.
pub(crate) struct Coast<'a, N> {
    pub dynamics: &'a Dynamics<N>,
    /// When it starts, s.
    pub start_s: N,
    /// Log impacts and the time of rest.
    pub events: bool,
    /// When the log ends, s: after all that outcome and peak rest on.
    pub until_s: Option<N>,
    /// Work beyond which the run is refused.
    pub limit: WorkLimit,
}

/// How it ends.
pub(crate) struct CoastEnd<N> {
    pub overturned: Option<(N, Side)>,
    /// Smallest distance of a decision taken here from the other one, where
    /// the criterion is decided by the saddle.
    pub margin: Option<f64>,
    /// The smallest such distance by either criterion.
    pub nearest: f64,
}

/// Decides the free motion from `motion` on, completing `record`.
pub(crate) fn coast<N: Real>(
    ask: &Coast<'_, N>,
    motion: BlockMotion<N>,
    record: &mut RunTrace<N>,
) -> CoastEnd<N> {
    let d = ask.dynamics;
    let BlockMotion { side, u, w } = motion;
    let zero = N::zero();
    let level = Energy::of(d, u, w);
    let inward = w < zero;
    let passing = gap(d, u, w).abs().to_f64();
    let gap = (gap(d, u, w) / d.alpha).to_f64().abs();
    let gradient = gap_gradient(d, u);
    for tracker in record.trackers() {
        let error = tracker.bound(gradient);
        let start_s = ask.start_s.to_f64();
        tracker.decide(Decision::Overturning, passing, error, start_s);
    }
    if flies_out(d, (u, w), level) {
        return fly_out(ask, motion, level, gap, record);
    }
    // The block turns, or already moves inwards, and meets the base.
    let here = OrbitPlace { u, speed: w.abs() };
    let time = if inward {
        transit(d, OrbitPlace { u: zero, speed: level.speed() }, here, level)
    } else {
        let top = turning(d, level);
        let rise = transit(d, here, OrbitPlace { u: top, speed: zero }, level);
        raise(d, record, top, ask.start_s + rise / d.p, (u, w), 0.0);
        rise + hop(d, level)
    };
    let impact_s = ask.start_s + time / d.p;
    let next = level.after_impact(d);
    let w = d.eta * level.speed();
    let saddle_speed = (d.saddle_energy() + d.saddle_energy()).sqrt();
    let passing = (w - saddle_speed).to_f64().abs();
    let second = ((w - saddle_speed) / d.alpha).to_f64().abs();
    let margin = gap.min(second);
    // The speed at the base has the energy's error over itself.
    let share = (d.eta / level.speed()).to_f64();
    let by_energy = [slope(d, u).to_f64(), motion.w.to_f64()];
    let gradient = by_energy.map(|by| by * share);
    for tracker in record.trackers() {
        let error = tracker.bound(gradient);
        let impact_s = impact_s.to_f64();
        tracker.decide(Decision::Overturning, passing, error, impact_s);
    }
    let errors = record.accuracy.map(|accuracy| {
        let energy = level.above_base.to_f64();
        let late = |[u, w]: [f64; 2]| {
            let level = Energy::of(d, N::from_f64(u), N::from_f64(w));
            time_to_base(d, N::from_f64(u), N::from_f64(w), level).to_f64()
        };
        let motion = [u, motion.w].map(Real::to_f64);
        let late = accuracy.bound(derivatives(late, motion));
        CoastErrors {
            late,
            energy: accuracy.bound(by_energy) / energy,
            known: accuracy.certificate().is_clear() && late.is_finite(),
        }
    });
    if next.below_saddle < zero {
        log_impact(ask, record, impact_s, level.speed(), errors);
        let motion = BlockMotion { side: side.flipped(), u: zero, w };
        let later = Coast { start_s: impact_s, ..*ask };
        return fly_out(&later, motion, next, margin, record);
    }
    hops(ask, record, impact_s, level, (u, motion.w), errors);
    CoastEnd {
        overturned: None,
        margin: margin_of(d, margin),
        nearest: margin,
    }
}

/// True where a block overturns on the branch that it is on.
fn flies_out<N: Real>(
    d: &Dynamics<N>,
    (u, w): (N, N),
    level: Energy<N>,
) -> bool {
    let passes = level.below_saddle < N::zero();
    let inward = w < N::zero();
    if u > d.alpha { !(inward && passes) } else { !inward && passes }
}

/// What free motion comes to last of all that outcome and peak rest on: the
/// overturning, or the top of the second hop.
pub(crate) struct Last {
    /// When, in 1/p from the state on.
    pub time: f64,
    /// It is an overturning.
    pub overturns: bool,
    /// Derivatives of the time by u and w, to a few digits.
    pub gradient: [f64; 2],
}

/// That of the free motion from a state on.
pub(crate) fn last<N: Real>(d: &Dynamics<N>, u: N, w: N) -> Last {
    let (time, overturns) = last_after(d, u, w);
    let late = |[u, w]: [f64; 2]| {
        last_after(d, N::from_f64(u), N::from_f64(w)).0.to_f64()
    };
    let gradient = derivatives(late, [u, w].map(Real::to_f64));
    Last { time: time.to_f64(), overturns, gradient }
}

fn last_after<N: Real>(d: &Dynamics<N>, u: N, w: N) -> (N, bool) {
    let level = Energy::of(d, u, w);
    if flies_out(d, (u, w), level) {
        return (time_out(d, (u, w), level), true);
    }
    let base = time_to_base(d, u, w, level);
    let next = level.after_impact(d);
    let (u, w) = (N::zero(), d.eta * level.speed());
    if next.below_saddle < u {
        (base + time_out(d, (u, w), next), true)
    } else {
        (base + hop(d, next), false)
    }
}

/// Time (in 1/p) from a place in free motion to the base.
fn time_to_base<N: Real>(d: &Dynamics<N>, u: N, w: N, level: Energy<N>) -> N {
    let here = OrbitPlace { u, speed: w.abs() };
    if w < N::zero() {
        let base = OrbitPlace { u: N::zero(), speed: level.speed() };
        return transit(d, base, here, level);
    }
    let top = OrbitPlace { u: turning(d, level), speed: N::zero() };
    transit(d, here, top, level) + hop(d, level)
}

/// Derivatives of a quantity by u and w, to a few digits.
fn derivatives(of: impl Fn([f64; 2]) -> f64, [u, w]: [f64; 2]) -> [f64; 2] {
    let step = DIFFERENCE * (u.abs() + w.abs());
    // Towards the base, which both sides of a decision reach.
    let here = of([u, w]);
    [of([u - step, w]) - here, of([u, w - step]) - here].map(|x| x / step)
}

/// What free motion makes of the errors at its first impact.
#[derive(Clone, Copy)]
struct CoastErrors {
    /// Of the impact's time, in 1/p.
    late: f64,
    /// Of the energy before it, relative.
    energy: f64,
    /// All decisions before are clear.
    known: bool,
}

impl CoastErrors {
    /// Bounds for an impact at a time and a speed.
    fn of<N: Real>(
        self,
        d: &Dynamics<N>,
        time_s: f64,
        speed: f64,
    ) -> Option<ImpactError> {
        let p = d.p.to_f64();
        let unit = 2.0 * N::ROUNDOFF;
        self.known.then(|| ImpactError {
            time_s: self.late / p + unit * time_s,
            speed_rad_s: speed * p * (0.5 * self.energy + 4.0 * unit),
        })
    }

    /// State after a further hop of a level; `half` is half its duration.
    fn after_hop<N: Real>(
        self,
        d: &Dynamics<N>,
        level: Energy<N>,
        half: f64,
    ) -> Self {
        let energy = self.energy + 8.0 * N::ROUNDOFF;
        let less = N::one() - N::from_f64(DIFFERENCE);
        let above_base = level.above_base * less;
        let below_saddle = d.saddle_energy() - above_base;
        let other = hop(d, Energy { above_base, below_saddle }).to_f64();
        let by_energy = (half - other).abs() / DIFFERENCE;
        let rounding = 8.0 * N::ROUNDOFF * half;
        let late = self.late + 2.0 * (by_energy * energy + rounding);
        Self { late, energy, ..self }
    }
}

/// Signed distance along the unstable direction from the stable manifold:
/// w - 2 sin((alpha - u)/2) for Eq. 1, w - (alpha - u) for Eq. 2.
pub(crate) fn gap<N: Real>(d: &Dynamics<N>, u: N, w: N) -> N {
    let y = d.alpha - u;
    match d.model {
        Model::Nonlinear => {
            let (s, _) = (y * N::ratio(1, 2)).sin_cos();
            w - (s + s)
        }
        Model::Linearized => w - y,
    }
}

/// Its derivatives by u and w.
pub(crate) fn gap_gradient<N: Real>(d: &Dynamics<N>, u: N) -> [f64; 2] {
    let half = 0.5 * (d.alpha - u).to_f64();
    match d.model {
        Model::Nonlinear => [libm::cos(half), 1.0],
        Model::Linearized => [1.0, 1.0],
    }
}

/// Under |theta| >= alpha the peak itself is the margin.
fn margin_of<N: Real>(d: &Dynamics<N>, margin: f64) -> Option<f64> {
    (d.overturning == Overturning::HalfPi).then_some(margin)
}

impl<N: Real> Coast<'_, N> {
    /// True from the end of the log on.
    fn past(&self, time_s: N) -> bool {
        self.until_s.is_some_and(|until| !(time_s < until))
    }
}

/// Overturning on the current branch.
fn fly_out<N: Real>(
    ask: &Coast<'_, N>,
    motion: BlockMotion<N>,
    level: Energy<N>,
    margin: f64,
    record: &mut RunTrace<N>,
) -> CoastEnd<N> {
    let BlockMotion { side, u, w } = motion;
    let time = time_out(ask.dynamics, (u, w), level);
    let time_s = ask.start_s + time / ask.dynamics.p;
    for tracker in record.trackers() {
        tracker.overturned();
    }
    CoastEnd {
        overturned: Some((time_s, side)),
        margin: Some(margin),
        nearest: margin,
    }
}

/// Time (in 1/p) from a state to overturning on the branch that it is on.
fn time_out<N: Real>(d: &Dynamics<N>, (u, w): (N, N), level: Energy<N>) -> N {
    let here = OrbitPlace { u, speed: w.abs() };
    let end = OrbitPlace { u: d.limit, speed: speed_at(d, d.limit, level) };
    if !(u < d.limit) {
        N::zero()
    } else if w < N::zero() {
        // Beyond the saddle and moving inwards, but turned back before it:
        // in to the mirror image of the turning point, and out again.
        let mirror = d.alpha + (d.alpha - turning(d, level));
        let turn = OrbitPlace { u: mirror, speed: N::zero() };
        transit(d, turn, here, level) + transit(d, turn, end, level)
    } else {
        transit(d, here, end, level)
    }
}

/// Raises the peak if the top of a hop does.
///
/// `differed` is the energy from which the hop's was taken as a difference.
fn raise<N: Real>(
    d: &Dynamics<N>,
    record: &mut RunTrace<N>,
    top: N,
    time_s: N,
    (u, w): (N, N),
    differed: f64,
) {
    if !(top > record.peak) {
        return;
    }
    record.peak = top;
    record.peak_time_s = Some(time_s);
    record.work.turning_points += 1;
    for tracker in record.trackers() {
        let here = (slope(d, u).to_f64(), w.to_f64());
        let at_top = slope(d, top).to_f64();
        tracker.peak_by_energy(here, at_top, top.to_f64(), differed);
    }
}

/// dU/du: sin(alpha - u) or alpha - u.
fn slope<N: Real>(d: &Dynamics<N>, u: N) -> N {
    let y = d.alpha - u;
    match d.model {
        Model::Nonlinear => y.sin_cos().0,
        Model::Linearized => y,
    }
}

fn log_impact<N: Real>(
    ask: &Coast<'_, N>,
    record: &mut RunTrace<N>,
    time_s: N,
    speed: N,
    errors: Option<CoastErrors>,
) {
    record.work.impacts += 1;
    if ask.events {
        record.impacts.push(Impact {
            time_s,
            speed_before_rad_s: speed * ask.dynamics.p,
            error: errors.and_then(|errors| {
                errors.of(ask.dynamics, time_s.to_f64(), speed.to_f64())
            }),
        });
    }
}

/// The hops from an impact on, with the level before it, to rest.
fn hops<N: Real>(
    ask: &Coast<'_, N>,
    record: &mut RunTrace<N>,
    first_s: N,
    before: Energy<N>,
    state: (N, N),
    mut errors: Option<CoastErrors>,
) {
    let d = ask.dynamics;
    let tail = d.alpha * N::from_f64(tail_speed::<N>());
    let two = N::from_f64(2.0);
    let mut level = before;
    let mut time_s = first_s;
    for count in 0.. {
        if ask.past(time_s) {
            return;
        }
        let speed = level.speed();
        log_impact(ask, record, time_s, speed, errors);
        if record.exceeds(ask.limit, time_s) {
            return;
        }
        level = level.after_impact(d);
        let half = hop(d, level);
        // Only the first hop after the excitation can raise the peak.
        if count == 0 {
            let top = turning(d, level);
            // An impact takes the depth below the saddle as a difference.
            let saddle = d.saddle_energy().to_f64();
            raise(d, record, top, time_s + half / d.p, state, saddle);
        }
        let endless = !(d.eta < N::one())
            && ask.until_s.is_none()
            && count + 1 >= ENDLESS_IMPACTS;
        if !ask.events || endless {
            return;
        }
        let after = d.eta * speed;
        if after < tail && d.eta < N::one() {
            // Each remaining hop lasts 2 w/D, D the base acceleration.
            let down = d.restoring(N::zero());
            let rest = two * after / (down * (N::one() - d.eta));
            let rest_s = time_s + rest / d.p;
            if ask.past(rest_s) {
                return;
            }
            record.rest_time_s = Some(rest_s);
            let known = errors.filter(|errors| errors.known);
            record.rest_error_s = known.map(|errors| {
                let (late, rest) = (errors.late, rest.to_f64());
                let error = late + rest * (0.5 * errors.energy + TAIL);
                let unit = 2.0 * N::ROUNDOFF;
                error / d.p.to_f64() + unit * time_s.to_f64()
            });
            return;
        }
        errors = errors
            .filter(|_| ask.events)
            .map(|errors| errors.after_hop(d, level, half.to_f64()));
        time_s = time_s + two * half / d.p;
    }
}

#[cfg(test)]
mod tests;
