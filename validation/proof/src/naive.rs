//! A plain rocking integrator with switchable rules, used for wrong models.
//!
//! Fixed-step fourth-order Runge-Kutta in |theta|; events are located by
//! bisection on the step itself. With [`Rules::default`] every rule is correct
//! and the error is about 1e-9; every other choice is a mistake that has been
//! made in practice. It shares no code with the core.

use crate::cases::WrongModel;

use crate::scene::{
    CaseScene, Engine, EngineError, EngineResult, Forcing, Impact, Model,
    Trace, by_equation, other,
};

/// Largest step in units of 1/p of the right rules.
pub const STEP_P: f64 = 0.005;

/// Detection of impacts and overturning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Events {
    /// Located inside the step, dips inside a step included.
    Located,
    /// By the sign at the ends of steps as long as a sample, the rotation
    /// set to zero there.
    StepEnds,
    /// By that sign, at the zero of the straight line through the ends.
    Interpolated,
    /// As `StepEnds`, but the rotation keeps its value.
    StepEndsRotationKept,
}

/// The rules of a naive run; the default is right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// Detection of events.
    pub events: Events,
    /// Another mistake, if any.
    pub wrong: Option<WrongModel>,
    /// Largest step in units of 1/p; ten times that if impacts are not
    /// located.
    pub step_p: f64,
}

impl Default for Rules {
    fn default() -> Self {
        Self { events: Events::Located, wrong: None, step_p: STEP_P }
    }
}

/// The naive integrator.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Naive(pub Rules);

/// Speed below which the chatter's tail takes over, over p alpha.
const CHATTER: f64 = 1e-6;

/// Speed over p alpha below which the crude rules take a block to rest under
/// any ground acceleration.
const CRUDE: f64 = 0.1;

/// Steps after which a run is given up.
const MOST_STEPS: usize = 1_000_000;

/// Rocking on one side: rotation and velocity away from the base.
#[derive(Clone, Copy)]
struct NaiveHop {
    side: f64,
    z: f64,
    w: f64,
}

struct NaiveRun<'a> {
    rules: Rules,
    scene: &'a CaseScene,
    pieces_s: Vec<f64>,
    piece: usize,
    t: f64,
    steps: usize,
    trace: Trace,
}

impl Engine for Naive {
    fn respond(&self, scene: &CaseScene) -> EngineResult<Trace> {
        let mut run = NaiveRun {
            rules: self.0,
            scene,
            pieces_s: scene.forcing.pieces_s(),
            piece: 0,
            t: 0.0,
            steps: 0,
            trace: Trace::default(),
        };
        run.go()?;
        Ok(run.trace)
    }
}

impl NaiveRun<'_> {
    /// True for the mistake of this run.
    fn makes(&self, wrong: WrongModel) -> bool {
        self.rules.wrong == Some(wrong)
    }

    fn ground(&self, t: f64) -> f64 {
        if self.piece + 1 >= self.pieces_s.len() {
            return 0.0;
        }
        let held = self.makes(WrongModel::ZeroOrderHold);
        let t = if held { self.pieces_s[self.piece] } else { t };
        self.scene.forcing.at(self.piece, t)
    }

    /// End of the run. Steps that do not stop at impacts keep the chatter
    /// going for ever.
    fn until(&self) -> f64 {
        let until = self.scene.until_s.unwrap_or(f64::INFINITY);
        if self.rules.events == Events::Located {
            return until;
        }
        let after = 30.0 / self.scene.frequency_rad_s;
        until.min(self.scene.forcing.end_s() + after)
    }

    fn piece_end(&self) -> f64 {
        let end = self.pieces_s.get(self.piece + 1);
        end.map_or(f64::INFINITY, |end| *end).min(self.until())
    }

    fn threshold(&self) -> f64 {
        let mut scene = self.scene.clone();
        if self.makes(WrongModel::OtherThreshold) {
            scene.model = other(scene.model);
        }
        scene.threshold_m_s2()
    }

    fn go(&mut self) -> EngineResult<()> {
        let threshold = self.threshold();
        let mut hop = None;
        if let Forcing::Free { rotation_rad } = self.scene.forcing {
            let z = rotation_rad.abs();
            hop = Some(NaiveHop { side: rotation_rad.signum(), z, w: 0.0 });
            self.record_peak(z, self.t);
            self.trace.first_side = rotation_rad.signum();
        }
        let until = self.until();
        while self.t < until {
            let in_tail = self.piece + 1 >= self.pieces_s.len();
            let ends = self.makes(WrongModel::StopsWithTheRecord);
            if in_tail && (hop.is_none() || ends) {
                return Ok(());
            }
            hop = match hop {
                None => self.wait(threshold),
                Some(hop) => self.flight(hop, threshold)?,
            };
            if self.trace.overturned_s.is_some() {
                return Ok(());
            }
            while self.t >= self.piece_end() && self.t < until {
                self.piece += 1;
            }
        }
        Ok(())
    }

    /// From rest at `t` to uplift or to the piece's end.
    fn wait(&mut self, threshold: f64) -> Option<NaiveHop> {
        let end = self.piece_end();
        let over = |run: &Self, t: f64| run.ground(t).abs() > threshold;
        let mut at = self.t;
        if !over(self, at) {
            if !over(self, end) {
                self.t = end;
                return None;
            }
            let (mut low, mut high) = (at, end);
            for _ in 0..200 {
                let mid = 0.5 * (low + high);
                if over(self, mid) { high = mid } else { low = mid }
            }
            at = high;
        }
        self.t = at;
        let side = -self.ground(at).signum();
        if self.trace.uplifts == 0 {
            self.trace.first_side = side;
            self.trace.uplift_s = Some(at);
        }
        self.trace.uplifts += 1;
        self.trace.rest_s = None;
        Some(NaiveHop { side, z: 0.0, w: 0.0 })
    }

    fn acceleration(&self, side: f64, z: f64, t: f64) -> f64 {
        let alpha = self.scene.slenderness_rad;
        let p2 = self.scene.frequency_rad_s * self.scene.frequency_rad_s;
        let pull = side * self.ground(t) / self.scene.gravity_m_s2;
        if self.scene.model == Model::Linearized {
            return p2 * (z - alpha - pull);
        }
        let x = alpha - z;
        -p2 * (libm::sin(x) + pull * libm::cos(x))
    }

    /// One Runge-Kutta step of length `h`.
    fn step(&self, hop: NaiveHop, h: f64) -> NaiveHop {
        let f = |z: f64, t: f64| self.acceleration(hop.side, z, t);
        let (z, w, t) = (hop.z, hop.w, self.t);
        let half = 0.5 * h;
        let a1 = f(z, t);
        let w2 = w + half * a1;
        let a2 = f(z + half * w, t + half);
        let w3 = w + half * a2;
        let a3 = f(z + half * w2, t + half);
        let w4 = w + h * a3;
        let a4 = f(z + h * w3, t + h);
        NaiveHop {
            side: hop.side,
            z: z + h / 6.0 * (w + 2.0 * w2 + 2.0 * w3 + w4),
            w: w + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4),
        }
    }

    /// Step at which `level`, of one sign at 0+ and of the other at `high`,
    /// crosses zero: false position with halving, to rounding; on the far
    /// side of the crossing.
    fn root(
        &self,
        hop: NaiveHop,
        high: f64,
        level: impl Fn(NaiveHop) -> f64,
    ) -> f64 {
        let (mut low, mut high) = (0.0, high);
        let mut at_high = level(self.step(hop, high));
        let mut at_low = -at_high;
        for round in 0..100 {
            if high - low <= 1e-16 * high {
                break;
            }
            let share = at_low / (at_low - at_high);
            let mid = if round % 3 == 2 || round == 0 {
                0.5 * (low + high)
            } else {
                low + share.clamp(0.01, 0.99) * (high - low)
            };
            if !(mid > low && mid < high) {
                break;
            }
            let value = level(self.step(hop, mid));
            if (value < 0.0) == (at_high < 0.0) {
                (high, at_high) = (mid, value);
            } else {
                (low, at_low) = (mid, value);
            }
        }
        high
    }

    fn record_peak(&mut self, z: f64, t: f64) {
        let ratio = z / self.scene.slenderness_rad;
        if ratio > self.trace.peak_ratio {
            self.trace.peak_ratio = ratio;
            self.trace.peak_time_s = Some(t);
        }
    }

    fn longest_step(&self) -> f64 {
        let start = self.pieces_s.get(self.piece).copied().unwrap_or(0.0);
        let length = self.piece_end() - start;
        let located = self.rules.events == Events::Located;
        let (times, most) = match self.scene.forcing {
            _ if !located => (10.0, length),
            Forcing::Samples { .. } => (1.0, length),
            _ => (1.0, length / 100.0),
        };
        (times * self.rules.step_p / self.scene.frequency_rad_s).min(most)
    }

    /// Rocks to the end of the piece, to rest or to overturning.
    fn flight(
        &mut self,
        mut hop: NaiveHop,
        threshold: f64,
    ) -> EngineResult<Option<NaiveHop>> {
        let end = self.piece_end();
        let longest = self.longest_step();
        let limit = self.scene.limit_rad();
        let located = self.rules.events == Events::Located;
        let mut h = self.first_step(hop, longest);
        while self.t < end {
            self.steps += 1;
            if self.steps > MOST_STEPS {
                let (steps, t) = (self.steps, self.t);
                let what = format!("no end after {steps} steps, at t = {t} s");
                return Err(EngineError::Work(what));
            }
            h = h.min(longest);
            // The last step of a piece ends on its end to the bit.
            let last = self.t + h >= end;
            if last {
                h = end - self.t;
            }
            let mut next = self.step(hop, h);
            let mut stop = h;
            let turns = located && hop.w * next.w < 0.0;
            let turn = turns.then(|| self.root(hop, h, |x| x.w));
            let turn = turn.map(|s| (s, self.step(hop, s)));
            let high = turn.map_or(h, |(s, _)| s);
            if next.z >= limit || turn.is_some_and(|(_, x)| x.z >= limit) {
                self.t += self.root(hop, high, |x| x.z - limit);
                self.trace.overturned_s = Some(self.t);
                self.trace.peak_ratio = f64::INFINITY;
                self.trace.peak_time_s = None;
                return Ok(None);
            }
            let dips = turn.is_some_and(|(_, x)| x.z < 0.0);
            if next.z < 0.0 || dips {
                if located {
                    let high = if dips { high } else { h };
                    stop = self.root(hop, high, |x| x.z);
                    next = self.step(hop, stop);
                } else if self.rules.events == Events::Interpolated {
                    let share = hop.z / (hop.z - next.z);
                    stop = share * h;
                    next.z = 0.0;
                    next.w = hop.w + share * (next.w - hop.w);
                }
                if let Some((s, x)) = turn.filter(|(s, _)| *s < stop) {
                    self.record_peak(x.z, self.t + s);
                }
                self.t = if last && stop == h { end } else { self.t + stop };
                match self.impact(next, threshold) {
                    None => return Ok(None),
                    Some(after) => hop = after,
                }
                h = self.first_step(hop, longest);
                continue;
            }
            if let Some((s, x)) = turn {
                self.record_peak(x.z, self.t + s);
            }
            self.t = if last { end } else { self.t + stop };
            self.record_peak(next.z, self.t);
            hop = next;
            h *= 2.0;
        }
        Ok(Some(hop))
    }

    /// A step well inside the shortest hop that can follow.
    fn first_step(&self, hop: NaiveHop, longest: f64) -> f64 {
        if self.rules.events != Events::Located {
            return longest;
        }
        let pull = self.acceleration(hop.side, hop.z, self.t).abs();
        let short = 0.1 * hop.w.abs() / pull;
        let floor = 1e-9 / self.scene.frequency_rad_s;
        if hop.z > 0.0 {
            longest
        } else if hop.w > 0.0 {
            short.clamp(floor, longest)
        } else {
            // Uplift: no hop has a length yet.
            longest / 16.0
        }
    }

    fn impact(&mut self, hop: NaiveHop, threshold: f64) -> Option<NaiveHop> {
        let scene = self.scene;
        let speed = hop.w.abs();
        self.trace.impacts.push(Impact {
            time_s: self.t,
            speed_before_rad_s: speed,
            error: None,
        });
        let missed = self.makes(WrongModel::MissedImpact)
            && self.trace.impacts.len() == 1;
        let eta = if missed { 1.0 } else { scene.restitution };
        let w = eta * speed;
        let unit = scene.frequency_rad_s * scene.slenderness_rad;
        let ground = self.ground(self.t);
        let side = -hop.side;
        let crude = self.makes(WrongModel::CrudeRest);
        if crude && w < CRUDE * unit {
            self.trace.rest_s = Some(self.t);
            return None;
        }
        let chatters = w < CHATTER * unit
            && ground.abs() < threshold
            && scene.restitution < 1.0;
        if !crude && chatters {
            self.t += self.tail(w, side, ground / threshold);
            self.trace.rest_s = Some(self.t);
            return None;
        }
        if self.makes(WrongModel::SuppressedHop) && side * ground > threshold {
            return Some(NaiveHop { side: hop.side, z: 0.0, w });
        }
        let z = match self.rules.events {
            Events::StepEndsRotationKept => -hop.z,
            _ => 0.0,
        };
        Some(NaiveHop { side, z, w })
    }

    /// Time that the infinite chatter takes after an impact that leaves the
    /// speed `w`, under a ground acceleration `pull` times the threshold.
    fn tail(&self, w: f64, side: f64, pull: f64) -> f64 {
        let scene = self.scene;
        let alpha = scene.slenderness_rad;
        let lever = by_equation(scene.model, libm::sin(alpha), alpha);
        let (p, eta) = (scene.frequency_rad_s, scene.restitution);
        2.0 * w / (p * p * lever)
            * (1.0 / (1.0 + side * pull) + eta / (1.0 - side * pull))
            / (1.0 - eta * eta)
    }
}
