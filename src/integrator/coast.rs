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
//! P3: the outcome follows from only the energy. It is constant in flight and
//! falls by eta^2 at an impact; the ground is at rest; only the saddle
//! separates the outcomes.
//!
//! P10: `last` lets the closed form replace a motion that observation cuts
//! later. No hop after the second is higher, since eta is at most 1, and a
//! block overturns on its branch or after one impact (P3).

mod orbit;

use crate::integrator::certificate::Decision;
use crate::integrator::dynamics::{Dynamics, Model, Overturning};
use crate::integrator::motion::{BlockMotion, RunTrace, tail_speed};
use crate::integrator::{Impact, ImpactError, Observe, Side};
use crate::number::Real;
use orbit::{Energy, OrbitPlace, hop, speed_at, transit, turning};

/// Most impacts logged if neither motion nor observation ends.
const ENDLESS_IMPACTS: usize = 1000;

/// Relative step of differences, of which one digit is needed.
const DIFFERENCE: f64 = 1e-6;

/// Relative error of the time in which a tail of impacts ends, at speeds
/// below [`tail_speed`].
const TAIL: f64 = 1e-9;

/// Input of [`coast`].
pub(crate) struct Coast<'a, N> {
    pub dynamics: &'a Dynamics<N>,
    /// Start of the free motion, s.
    pub start_s: N,
    pub observe: &'a Observe,
    /// End of the log of impacts and rest, s. Outcome and peak are decided
    /// before it.
    pub until_s: Option<N>,
}

/// Last decision of a run.
#[derive(Default)]
pub(crate) struct CoastEnd<N> {
    pub overturned: Option<(N, Side)>,
    /// Smallest distance from the other outcome, if the saddle decides the
    /// criterion.
    pub margin: Option<f64>,
    /// The smallest such distance by either criterion.
    pub nearest: Option<f64>,
}

impl<N: Real> CoastEnd<N> {
    /// An overturning, which `record` notes.
    pub fn overturned(
        record: &mut RunTrace<N>,
        time_s: N,
        side: Side,
        margin: f64,
    ) -> Self {
        for tracker in record.trackers() {
            tracker.overturned();
        }
        let (overturned, margin) = (Some((time_s, side)), Some(margin));
        Self { overturned, margin, nearest: margin }
    }
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
    let (time, turn) = to_base(d, (u, w), level);
    if let Some((top, rise)) = turn {
        raise(d, record, top, ask.start_s + rise / d.p, (u, w), 0.0);
    }
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
            let (u, w) = (N::from_f64(u), N::from_f64(w));
            to_base(d, (u, w), Energy::of(d, u, w)).0.to_f64()
        };
        let motion = [u, motion.w].map(Real::to_f64);
        let late = accuracy.bound(derivatives(late, motion));
        CoastErrors {
            late,
            energy: accuracy.bound(by_energy) / energy,
            known: accuracy.certificate.is_clear() && late.is_finite(),
        }
    });
    if next.below_saddle < zero {
        log_impact(ask, record, impact_s, level.speed(), errors);
        let motion = BlockMotion { side: side.flipped(), u: zero, w };
        let later = Coast { start_s: impact_s, ..*ask };
        return fly_out(&later, motion, next, margin, record);
    }
    hops(ask, record, impact_s, level, (u, motion.w), errors);
    // Under |theta| >= alpha the peak itself is the margin.
    let nearest = Some(margin);
    let margin = nearest.filter(|_| d.overturning == Overturning::HalfPi);
    CoastEnd { overturned: None, margin, nearest }
}

/// True if a block overturns on its present branch.
fn flies_out<N: Real>(
    d: &Dynamics<N>,
    (u, w): (N, N),
    level: Energy<N>,
) -> bool {
    let passes = level.below_saddle < N::zero();
    let inward = w < N::zero();
    if u > d.alpha { !(inward && passes) } else { !inward && passes }
}

/// Last event that can decide outcome or peak of free motion: the overturning,
/// or the top of the second hop.
pub(crate) struct Last {
    /// Time from the state to the event, in 1/p.
    pub time: f64,
    /// True if the event is an overturning.
    pub overturns: bool,
    /// Derivatives of the time by u and w, to a few digits.
    pub gradient: [f64; 2],
}

/// [`Last`] of the free motion that starts at (u, w).
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
    let (base, _) = to_base(d, (u, w), level);
    let next = level.after_impact(d);
    let (u, w) = (N::zero(), d.eta * level.speed());
    if next.below_saddle < u {
        (base + time_out(d, (u, w), next), true)
    } else {
        (base + hop(d, next), false)
    }
}

/// Time (in 1/p) from a state of free motion to the base; if the block turns
/// before it, also the rotation and the time at which it turns.
fn to_base<N: Real>(
    d: &Dynamics<N>,
    (u, w): (N, N),
    level: Energy<N>,
) -> (N, Option<(N, N)>) {
    let zero = N::zero();
    let here = OrbitPlace { u, speed: w.abs() };
    if w < zero {
        let base = OrbitPlace { u: zero, speed: level.speed() };
        return (transit(d, base, here, level), None);
    }
    let top = turning(d, level);
    let rise = transit(d, here, OrbitPlace { u: top, speed: zero }, level);
    (rise + hop(d, level), Some((top, rise)))
}

/// Derivatives of a quantity by u and w, to a few digits.
fn derivatives(of: impl Fn([f64; 2]) -> f64, [u, w]: [f64; 2]) -> [f64; 2] {
    let step = DIFFERENCE * (u.abs() + w.abs());
    // Towards the base, which both sides of a decision reach.
    let here = of([u, w]);
    [of([u - step, w]) - here, of([u, w - step]) - here].map(|x| x / step)
}

/// Error bounds carried through free motion to an impact.
#[derive(Clone, Copy)]
struct CoastErrors {
    /// Error of the time of the impact, in 1/p.
    late: f64,
    /// Relative error of the energy before the impact.
    energy: f64,
    /// True if all decisions before the impact are clear.
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

    /// Errors after another hop of a level; `half` is half its duration.
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

/// Derivatives of [`gap`] by u and w.
pub(crate) fn gap_gradient<N: Real>(d: &Dynamics<N>, u: N) -> [f64; 2] {
    let half = 0.5 * (d.alpha - u).to_f64();
    match d.model {
        Model::Nonlinear => [libm::cos(half), 1.0],
        Model::Linearized => [1.0, 1.0],
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
    CoastEnd::overturned(record, time_s, side, margin)
}

/// Time (in 1/p) from a state to overturning on the same branch.
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
    if ask.observe.events {
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
    let past = |time_s: N| ask.until_s.is_some_and(|until| !(time_s < until));
    let mut level = before;
    let mut time_s = first_s;
    for count in 0.. {
        if past(time_s) {
            return;
        }
        let speed = level.speed();
        log_impact(ask, record, time_s, speed, errors);
        if record.exceeds(ask.observe.work_limit, time_s) {
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
        if !ask.observe.events || endless {
            return;
        }
        let after = d.eta * speed;
        if after < tail && d.eta < N::one() {
            // Each remaining hop lasts 2 w/D, D the base acceleration.
            let down = d.restoring(N::zero());
            let rest = two * after / (down * (N::one() - d.eta));
            let rest_s = time_s + rest / d.p;
            if past(rest_s) {
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
        errors =
            errors.map(|errors| errors.after_hop(d, level, half.to_f64()));
        time_s = time_s + two * half / d.p;
    }
}

#[cfg(test)]
mod tests;
