//! Square waves on the nonlinear block: on every constant stretch gravity is
//! turned by psi = atan(a/g), and the stretches are chained, through impacts
//! too.

use std::f64::consts::FRAC_PI_2;

use super::bisect;
use super::carlson::rf;

/// A block under a ground acceleration that is constant by stretches, times
/// in units of 1/p.
#[derive(Clone, Debug, PartialEq)]
pub struct SquareWave {
    /// Slenderness angle in rad.
    pub alpha_rad: f64,
    /// Coefficient of restitution.
    pub eta: f64,
    /// Acceleration over g and duration of each stretch.
    pub stretches: Vec<(f64, f64)>,
}

/// State of rocking: theta is `side` times `y`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SquareState {
    /// Sign of theta.
    pub side: f64,
    /// |theta| in rad.
    pub y: f64,
    /// Its derivative by p t.
    pub w: f64,
}

/// Motion of the block from rest at t = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct SquareMotion {
    /// Times and speeds just before each impact during the wave.
    pub impacts: Vec<(f64, f64)>,
    /// State at the end of the wave.
    pub end: SquareState,
}

/// A hop on one stretch. With u = (alpha + side psi - y)/2 the motion is
/// u'^2 = P^2 (kappa + sin^2 u), P^2 = sqrt(1 + (a/g)^2).
struct SquareHop {
    turned: f64,
    rate: f64,
    kappa: f64,
    u: f64,
    /// True if u grows.
    inward: bool,
}

impl SquareHop {
    fn new(alpha_rad: f64, pull: f64, state: SquareState) -> Self {
        let turned = alpha_rad + state.side * libm::atan(pull);
        let rate = (1.0 + pull * pull).sqrt().sqrt();
        let u = 0.5 * (turned - state.y);
        let sine = libm::sin(u);
        let speed = 0.5 * state.w / rate;
        let kappa = speed * speed - sine * sine;
        Self { turned, rate, kappa, u, inward: state.w < 0.0 }
    }

    /// Time of flight to |u| from the turning point, or from u = 0 if the hop
    /// passes it.
    fn reach(&self, u: f64) -> f64 {
        let (s, c) = (libm::sin(u).abs(), libm::cos(u));
        let k = self.kappa;
        let (factor, integral) = if k < 0.0 {
            let left = (s * s + k).max(0.0);
            (left.sqrt(), rf(-k * c * c, -k * (1.0 + k), s * s * (1.0 + k)))
        } else {
            (s, rf(k * c * c, k + s * s, k))
        };
        factor * integral / self.rate
    }

    /// True if the hop turns, so that it stays on its side of u = 0.
    fn turns(&self) -> bool {
        self.kappa < 0.0
    }

    /// Time on the hop's own clock, zero at the turning point or at u = 0.
    fn clock(&self, u: f64, inward: bool) -> f64 {
        let away = (u > 0.0) == inward;
        if away { self.reach(u) } else { -self.reach(u) }
    }

    /// Time until u, passed inwards or outwards; infinite if it is not ahead.
    fn until(&self, u: f64, inward: bool) -> f64 {
        let s = libm::sin(u);
        let behind = (u > 0.0) != (self.u > 0.0);
        let beyond = s * s + self.kappa < 0.0;
        let against = inward != self.inward;
        let missed = if self.turns() { behind || beyond } else { against };
        if missed {
            return f64::INFINITY;
        }
        self.clock(u, inward) - self.clock(self.u, self.inward)
    }

    /// State `t` later.
    fn after(&self, side: f64, t: f64) -> SquareState {
        let clock = self.clock(self.u, self.inward) + t;
        let low =
            if self.turns() { libm::asin((-self.kappa).sqrt()) } else { 0.0 };
        let size = if clock == 0.0 {
            low
        } else {
            bisect(low, FRAC_PI_2, |u| self.reach(u) - clock.abs())
        };
        // A turning hop approaches until the clock's zero, then goes away;
        // a hop that passes u = 0 changes the sign of u there.
        let (sign, inward) = if self.turns() {
            (self.u.signum(), (self.u > 0.0) == (clock > 0.0))
        } else if self.inward {
            (clock.signum(), true)
        } else {
            (-clock.signum(), false)
        };
        let s = libm::sin(size);
        let speed = 2.0 * self.rate * (self.kappa + s * s).max(0.0).sqrt();
        let w = if inward { -speed } else { speed };
        SquareState { side, y: self.turned - 2.0 * sign * size, w }
    }
}

impl SquareWave {
    /// Motion from rest, lifted by the first stretch.
    pub fn motion(&self) -> SquareMotion {
        let first = self.stretches.first().map_or(0.0, |s| s.0);
        let mut state = SquareState { side: -first.signum(), y: 0.0, w: 0.0 };
        let mut impacts = Vec::new();
        let mut start = 0.0;
        for &(pull, duration) in &self.stretches {
            let mut left = duration;
            loop {
                let hop = SquareHop::new(self.alpha_rad, pull, state);
                let base = 0.5 * hop.turned;
                let hit = hop.until(base, true);
                // A hop that leaves the base does not meet it at once.
                let ahead = hit > 0.0 && hit <= left;
                if !ahead {
                    state = hop.after(state.side, left);
                    break;
                }
                let s = libm::sin(base);
                let speed = 2.0 * hop.rate * (hop.kappa + s * s).sqrt();
                left -= hit;
                impacts.push((start + duration - left, speed));
                let (side, w) = (-state.side, self.eta * speed);
                state = SquareState { side, y: 0.0, w };
            }
            start += duration;
        }
        SquareMotion { impacts, end: state }
    }

    /// Outcome of the free motion after the wave, by energy.
    pub fn ending(&self, end: SquareState) -> Ending {
        let alpha = self.alpha_rad;
        // Energies above the base: of the block and of the saddle.
        let above = 0.5 * end.w * end.w
            + 2.0 * libm::sin(0.5 * end.y) * libm::sin(alpha - 0.5 * end.y);
        let half = libm::sin(0.5 * alpha);
        let saddle = 2.0 * half * half;
        let passes = above > saddle;
        let overturns = if passes { end.w > 0.0 } else { end.y > alpha };
        if overturns {
            return Ending { passes, overturned: end.side, impact: None };
        }
        let again = self.eta * self.eta * above > saddle;
        let overturned = if again { -end.side } else { 0.0 };
        Ending { passes, overturned, impact: Some((2.0 * above).sqrt()) }
    }
}

/// Outcome of free motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ending {
    /// The energy exceeds that of the saddle.
    pub passes: bool,
    /// Side on which it overturns; zero if it survives.
    pub overturned: f64,
    /// Speed before its first impact, over p.
    pub impact: Option<f64>,
}
