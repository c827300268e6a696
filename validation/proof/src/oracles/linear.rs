//! Eq. 2 under an analytic pulse: closed form between events, in p t,
//! theta/alpha and a/(g alpha). The pulse acts on a block with p = 1 rad/s and
//! g alpha = 1 m/s2.

use super::bisect;
use crate::pulse::{Particular, kinks, particular};
use crate::scene::PulseKind;

/// Response of the block.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct LinearResponse {
    /// First uplift.
    pub uplift: Option<f64>,
    /// Sign of theta after it.
    pub side: f64,
    /// Impacts: p t and |theta'|/(p alpha).
    pub impacts: Vec<(f64, f64)>,
    /// Time at which |theta| reaches alpha.
    pub overturned: Option<f64>,
}

/// Sampled points of a piece, closer together at its start.
const POINTS: usize = 4000;

/// Rotation over alpha above which a hop counts as begun; this oracle does
/// not resolve shorter hops.
const ROUNDING: f64 = 1e-13;

/// A hop on one smooth piece: z = |theta|/alpha from `start` on.
struct LinearHop {
    pulse: Option<(PulseKind, usize)>,
    side: f64,
    start: f64,
    growing: f64,
    decaying: f64,
}

impl LinearHop {
    fn new(
        pulse: Option<(PulseKind, usize)>,
        side: f64,
        t: f64,
        (z, w): (f64, f64),
    ) -> Self {
        let part = in_flight(pulse, t);
        let y = z - 1.0 - side * part.p;
        let v = w - side * part.v;
        let (growing, decaying) = (0.5 * (y + v), 0.5 * (y - v));
        Self { pulse, side, start: t, growing, decaying }
    }

    fn state(&self, t: f64) -> (f64, f64) {
        let x = t - self.start;
        let part = in_flight(self.pulse, t);
        let up = self.growing * libm::exp(x);
        let down = self.decaying * libm::exp(-x);
        (1.0 + self.side * part.p + up + down, self.side * part.v + up - down)
    }
}

fn in_flight(pulse: Option<(PulseKind, usize)>, t: f64) -> Particular {
    let of = |(pulse, piece)| particular(pulse, piece, t);
    pulse.map_or(Particular::default(), of)
}

/// Response from rest, with at most `impacts` impacts.
pub fn respond(pulse: PulseKind, eta: f64, impacts: usize) -> LinearResponse {
    let mut response = LinearResponse::default();
    let kinks = kinks(pulse);
    // Uplift: the first |A| > 1.
    let Some((piece, uplift)) = uplift(pulse, &kinks) else {
        return response;
    };
    // Just after the uplift.
    let inside = uplift + 1e-9 * (kinks[piece + 1] - kinks[piece]);
    let mut side = -particular(pulse, piece, inside).a.signum();
    response.uplift = Some(uplift);
    response.side = side;
    let (mut t, mut z, mut w) = (uplift, 0.0, 0.0);
    for k in piece..kinks.len() {
        let end = kinks.get(k + 1).copied().unwrap_or(f64::INFINITY);
        loop {
            // The free branch is followed until its outcome is settled.
            let over = end.is_infinite();
            let last = if over { t + 60.0 } else { end };
            let pulse = (!over).then_some((pulse, k));
            match next(&LinearHop::new(pulse, side, t, (z, w)), last) {
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
fn next(hop: &LinearHop, end: f64) -> Next {
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
        let turns = old.1 * new.1 < 0.0;
        let turn = turns.then(|| bisect(before, now, |t| hop.state(t).1));
        let mut low = before;
        for stop in turn.into_iter().chain([now]) {
            let (z, _) = hop.state(stop);
            if z >= 1.0 {
                let at = bisect(low, stop, |t| hop.state(t).0 - 1.0);
                return Next::Overturned(at);
            }
            clear |= z > ROUNDING;
            if z < 0.0 && clear {
                let at = bisect(low, stop, |t| hop.state(t).0);
                return Next::Impact(at, hop.state(at).1.abs());
            }
            low = stop;
        }
        (before, old) = (now, new);
    }
    Next::Reached(old)
}

fn uplift(pulse: PulseKind, kinks: &[f64]) -> Option<(usize, f64)> {
    for (piece, ends) in kinks.windows(2).enumerate() {
        let (start, end) = (ends[0], ends[1]);
        let over = |t: f64| particular(pulse, piece, t).a.abs() - 1.0;
        if over(start) > 0.0 {
            return Some((piece, start));
        }
        let at = |k: usize| start + (end - start) * k as f64 / POINTS as f64;
        for k in 1..POINTS {
            if over(at(k)) > 0.0 {
                return Some((piece, bisect(at(k - 1), at(k), over)));
            }
        }
    }
    None
}
