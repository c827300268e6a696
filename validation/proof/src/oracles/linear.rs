//! Eq. 2 under an analytic pulse: closed form between events, in p t,
//! theta/alpha and a/(g alpha). A pulse is that of a block with p = 1 rad/s
//! and g alpha = 1 m/s2.

use std::f64::consts::{PI, SQRT_2, TAU};

use crate::scene::{Forcing, PulseKind, ricker_beta};

/// What the block does.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Response {
    /// First uplift.
    pub uplift: Option<f64>,
    /// Sign of theta after it.
    pub side: f64,
    /// Impacts: p t and |theta'|/(p alpha).
    pub impacts: Vec<(f64, f64)>,
    /// When |theta| reaches alpha.
    pub overturned: Option<f64>,
}

/// Acceleration and particular solution P'' - P = -A with its derivative.
struct Particular {
    a: f64,
    p: f64,
    v: f64,
}

fn kinks(pulse: PulseKind) -> Vec<f64> {
    match pulse {
        PulseKind::Triangle { duration_s, .. } => {
            vec![0.0, 0.5 * duration_s, duration_s]
        }
        _ => vec![0.0, Forcing::Pulse(pulse).end_s()],
    }
}

/// At `t` of the smooth stretch `piece`.
fn at(pulse: PulseKind, piece: usize, t: f64) -> Particular {
    match pulse {
        PulseKind::OneSine { amplitude, omega_rad_s }
        | PulseKind::HalfSine { amplitude, omega_rad_s } => {
            sine(amplitude, omega_rad_s, 0.0, t)
        }
        PulseKind::OneCosine { amplitude, omega_rad_s } => {
            sine(amplitude, omega_rad_s, 0.5 * PI, t)
        }
        PulseKind::Rectangle { amplitude: a, .. } => {
            Particular { a, p: a, v: 0.0 }
        }
        PulseKind::Triangle { amplitude, duration_s } => {
            let slope = 2.0 * amplitude / duration_s;
            if piece == 0 {
                Particular { a: slope * t, p: slope * t, v: slope }
            } else {
                let value = slope * (duration_s - t);
                Particular { a: value, p: value, v: -slope }
            }
        }
        PulseKind::RickerSymmetric { amplitude, period_s, cycles } => {
            let rate = SQRT_2 * PI / period_s;
            let bell = Bell::at(rate, t - 0.5 * cycles * period_s);
            let scale = amplitude / (rate * rate);
            Particular {
                a: -scale * bell.second,
                p: scale * (bell.value + bell.w),
                v: scale * (bell.first + bell.w_first),
            }
        }
        PulseKind::RickerAntisymmetric { amplitude, period_s, cycles } => {
            let rate = TAU / (3.0_f64.sqrt() * period_s);
            let bell = Bell::at(rate, t - 0.5 * cycles * period_s);
            let scale = amplitude / (ricker_beta() * rate * rate * rate);
            // w'' = w + G.
            Particular {
                a: -scale * bell.third,
                p: scale * (bell.first + bell.w_first),
                v: scale * (bell.second + bell.w + bell.value),
            }
        }
        PulseKind::MavroeidisPapageorgiou {
            velocity,
            frequency_hz,
            gamma,
            phase_rad,
        } => {
            let w = TAU * frequency_hz;
            let u = t - 0.5 * gamma / frequency_hz;
            let mut sum = Particular { a: 0.0, p: 0.0, v: 0.0 };
            let (up, down) = (1.0 + 1.0 / gamma, 1.0 - 1.0 / gamma);
            for (share, rate) in
                [(0.5, 1.0), (0.25 * up, up), (0.25 * down, down)]
            {
                let scale = -velocity * w * share;
                let part = sine(scale, w * rate, phase_rad, u);
                sum.a += part.a;
                sum.p += part.p;
                sum.v += part.v;
            }
            sum
        }
        _ => Particular { a: f64::NAN, p: f64::NAN, v: f64::NAN },
    }
}

fn sine(a: f64, omega: f64, phase: f64, t: f64) -> Particular {
    let (s, c) = (libm::sin(omega * t + phase), libm::cos(omega * t + phase));
    let scale = a / (1.0 + omega * omega);
    Particular { a: a * s, p: scale * s, v: scale * omega * c }
}

/// G = exp(-(rate u)^2/2) with its derivatives, and w with w'' - w = G.
struct Bell {
    value: f64,
    first: f64,
    second: f64,
    third: f64,
    w: f64,
    w_first: f64,
}

impl Bell {
    fn at(rate: f64, u: f64) -> Self {
        let x = rate * u;
        let value = libm::exp(-0.5 * x * x);
        let c = (0.5 * PI).sqrt() / rate * libm::exp(0.5 / (rate * rate));
        let plus = libm::exp(u) * libm::erf((x + 1.0 / rate) / SQRT_2);
        let minus = libm::exp(-u) * libm::erf((x - 1.0 / rate) / SQRT_2);
        Self {
            value,
            first: -rate * x * value,
            second: rate * rate * (x * x - 1.0) * value,
            third: rate * rate * rate * (3.0 - x * x) * x * value,
            w: 0.5 * c * (plus - minus),
            w_first: 0.5 * c * (plus + minus),
        }
    }
}

/// Points of a piece that are looked at, closer together at its start.
const POINTS: usize = 4000;

/// Rotation over alpha above which a hop counts as begun: shorter hops are
/// beyond this oracle.
const ROUNDING: f64 = 1e-13;

/// A hop on one smooth piece: z = |theta|/alpha from `start` on.
struct Hop {
    pulse: Option<(PulseKind, usize)>,
    side: f64,
    start: f64,
    growing: f64,
    decaying: f64,
}

impl Hop {
    fn new(
        pulse: Option<(PulseKind, usize)>,
        side: f64,
        t: f64,
        (z, w): (f64, f64),
    ) -> Self {
        let part = particular(pulse, t);
        let y = z - 1.0 - side * part.p;
        let v = w - side * part.v;
        Self {
            pulse,
            side,
            start: t,
            growing: 0.5 * (y + v),
            decaying: 0.5 * (y - v),
        }
    }

    fn state(&self, t: f64) -> (f64, f64) {
        let x = t - self.start;
        let part = particular(self.pulse, t);
        let up = self.growing * libm::exp(x);
        let down = self.decaying * libm::exp(-x);
        (1.0 + self.side * part.p + up + down, self.side * part.v + up - down)
    }

    fn root(
        &self,
        low: f64,
        high: f64,
        of: impl Fn((f64, f64)) -> f64,
    ) -> f64 {
        super::bisect(low, high, |t| of(self.state(t)))
    }
}

fn particular(pulse: Option<(PulseKind, usize)>, t: f64) -> Particular {
    pulse.map_or(Particular { a: 0.0, p: 0.0, v: 0.0 }, |(pulse, piece)| {
        at(pulse, piece, t)
    })
}

/// Response from rest, with at most `impacts` impacts.
#[must_use]
pub fn respond(pulse: PulseKind, eta: f64, impacts: usize) -> Response {
    let mut response = Response::default();
    let kinks = kinks(pulse);
    // Uplift: the first |A| > 1.
    let Some((piece, uplift)) = uplift(pulse, &kinks) else {
        return response;
    };
    let side = -at(pulse, piece, inside(uplift, &kinks, piece)).a.signum();
    response.uplift = Some(uplift);
    response.side = side;
    let (mut t, mut z, mut w, mut side) = (uplift, 0.0, 0.0, side);
    for k in piece..kinks.len() {
        let end = kinks.get(k + 1).copied().unwrap_or(f64::INFINITY);
        loop {
            let over = end.is_infinite();
            // The free branch is followed until its fate is settled.
            let last = if over { t + 60.0 } else { end };
            let hop = Hop::new((!over).then_some((pulse, k)), side, t, (z, w));
            match next(&hop, last) {
                Next::Reached(state) => {
                    (z, w) = state;
                    t = last;
                    break;
                }
                Next::Overturned(at) => {
                    response.overturned = Some(at);
                    return response;
                }
                Next::Impact(at, speed) => {
                    response.impacts.push((at, speed));
                    if response.impacts.len() >= impacts {
                        return response;
                    }
                    (t, z, w, side) = (at, 0.0, eta * speed, -side);
                }
            }
        }
    }
    response
}

enum Next {
    Reached((f64, f64)),
    Overturned(f64),
    Impact(f64, f64),
}

/// First event of a hop before `end`.
fn next(hop: &Hop, end: f64) -> Next {
    let length = end - hop.start;
    let at = |k: usize| {
        let share = k as f64 / POINTS as f64;
        hop.start + length * share * share * share
    };
    let mut before = at(1);
    let mut old = hop.state(before);
    // At its start z is a simple or a triple zero, lost in rounding.
    let mut clear = false;
    for k in 2..=POINTS {
        let now = if k == POINTS { end } else { at(k) };
        let new = hop.state(now);
        let turn = (old.1 * new.1 < 0.0)
            .then(|| hop.root(before, now, |state| state.1));
        let stops = [turn, Some(now)];
        let mut low = before;
        for stop in stops.into_iter().flatten() {
            let (z, _) = hop.state(stop);
            if z >= 1.0 {
                let at = hop.root(low, stop, |state| state.0 - 1.0);
                return Next::Overturned(at);
            }
            clear |= z > ROUNDING;
            if z < 0.0 && clear {
                let at = hop.root(low, stop, |state| state.0);
                return Next::Impact(at, hop.state(at).1.abs());
            }
            low = stop;
        }
        (before, old) = (now, new);
    }
    Next::Reached(old)
}

fn inside(t: f64, kinks: &[f64], piece: usize) -> f64 {
    t + 1e-9 * (kinks[piece + 1] - kinks[piece])
}

fn uplift(pulse: PulseKind, kinks: &[f64]) -> Option<(usize, f64)> {
    for (piece, ends) in kinks.windows(2).enumerate() {
        let (start, end) = (ends[0], ends[1]);
        let over = |t: f64| at(pulse, piece, t).a.abs() - 1.0;
        if over(start) > 0.0 {
            return Some((piece, start));
        }
        let at = |k: usize| start + (end - start) * k as f64 / POINTS as f64;
        for k in 1..POINTS {
            if over(at(k)) > 0.0 {
                let t = super::bisect(at(k - 1), at(k), over);
                return Some((piece, t));
            }
        }
    }
    None
}
