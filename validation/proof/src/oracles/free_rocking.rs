//! Free rocking from rest at an initial rotation: every impact and
//! the settling time in closed form.

use super::carlson::rf;
use crate::scene::{Model, by_equation};

/// Result of free rocking.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeRocking {
    /// Times of the impacts, in units of 1/p, and speeds just before them,
    /// over p.
    pub impacts: Vec<(f64, f64)>,
    /// Sum of the infinite series of impacts, in units of 1/p; infinite
    /// without loss.
    pub settling_p: f64,
}

/// Speed over p alpha below which the rest of the series is geometric to
/// rounding.
const TAIL: f64 = 1e-6;

/// A quarter period of Eq. 1, in units of 1/p, by Carlson's R_F.
///
/// With the speed p sqrt(2 D) at the base it is sqrt(D/2) R_F(q^2 c^2,
/// q^2 (1 - q^2), s^2 (1 - q^2)), s, c = sin, cos(alpha/2), q^2 = s^2 - D/2.
fn quarter(alpha_rad: f64, d: f64, q2: f64) -> f64 {
    let (s, c) = (libm::sin(0.5 * alpha_rad), libm::cos(0.5 * alpha_rad));
    (0.5 * d).sqrt() * rf(q2 * c * c, q2 * (1.0 - q2), s * s * (1.0 - q2))
}

/// Time between impacts, in units of 1/p. In Eq. 2 a quarter period is
/// atanh(v), v = speed/(p alpha).
fn hop(model: Model, alpha_rad: f64, d: f64) -> f64 {
    if model == Model::Linearized {
        return 2.0 * libm::atanh((d / (0.5 * alpha_rad * alpha_rad)).sqrt());
    }
    let s = libm::sin(0.5 * alpha_rad);
    2.0 * quarter(alpha_rad, d, s * s - 0.5 * d)
}

/// Energy D and time of the first impact after a release.
fn first(model: Model, alpha_rad: f64, rotation_rad: f64) -> (f64, f64) {
    if model == Model::Linearized {
        let ratio = rotation_rad / alpha_rad;
        let v2 = ratio * (2.0 - ratio);
        // Near the saddle 1 - v = (1 - ratio)^2/(1 + v).
        let (v, left) = (v2.sqrt(), 1.0 - ratio);
        let far = 0.5 * libm::log((1.0 + v) * (1.0 + v) / (left * left));
        let time = if ratio < 0.5 { libm::atanh(v) } else { far };
        return (0.5 * alpha_rad * alpha_rad * v2, time);
    }
    let half = 0.5 * rotation_rad;
    let energy = 2.0 * libm::sin(half) * libm::sin(alpha_rad - half);
    // Near the saddle the difference s^2 - D/2 is known directly.
    let gap = libm::sin(0.5 * (alpha_rad - rotation_rad));
    (energy, quarter(alpha_rad, energy, gap * gap))
}

/// Free rocking of a block (slenderness in rad, restitution) from a rotation:
/// an impact multiplies the energy by eta^2, and a hop at the end of the
/// series lasts 2 v over the acceleration at the base.
pub fn free(
    model: Model,
    [alpha_rad, eta, rotation_rad]: [f64; 3],
    impacts: usize,
) -> FreeRocking {
    let mut list = Vec::new();
    let (mut energy, mut time) = first(model, alpha_rad, rotation_rad);
    let down = by_equation(model, libm::sin(alpha_rad), alpha_rad);
    let settling_p = loop {
        let speed = (2.0 * energy).sqrt();
        let listed = list.len() >= impacts;
        if !listed {
            list.push((time, speed));
        }
        energy *= eta * eta;
        if listed && eta == 1.0 {
            break f64::INFINITY;
        }
        let after = eta * speed;
        if listed && after < TAIL * alpha_rad {
            break time + 2.0 * after / down / (1.0 - eta);
        }
        time += hop(model, alpha_rad, energy);
    };
    FreeRocking { impacts: list, settling_p }
}

/// Chatter under a constant acceleration `pull` = a/g below the uplift
/// threshold, after a first impact (time and speed before it, in units of
/// 1/p and p) of a hop with theta < 0 when `pull` > 0.
///
/// On the side s = sgn(theta) gravity is turned by s psi = s atan(a/g) and
/// its square root of rate multiplied by (1 + (a/g)^2)^(1/4): a hop is one of
/// free rocking with alpha + s psi. In Eq. 2 it lasts
/// 2 atanh(v/(alpha + s a/g)). The last hops sum to
/// 2 v [1/(c + s a) + eta/(c - s a)]/(1 - eta^2), c + s a the downward
/// acceleration on the side entered with speed v.
pub fn chatter(
    model: Model,
    [alpha_rad, eta, pull]: [f64; 3],
    (time_p, speed_p): (f64, f64),
    impacts: usize,
) -> FreeRocking {
    let psi = libm::atan(pull);
    let rate = (1.0 + pull * pull).sqrt().sqrt();
    // Downward acceleration at the base on a side.
    let down = |side: f64| {
        let turned = rate * rate * libm::sin(alpha_rad + side * psi);
        by_equation(model, turned, alpha_rad + side * pull)
    };
    let hop = |side: f64, v: f64| {
        if model == Model::Linearized {
            return 2.0 * libm::atanh(v / down(side));
        }
        let d = 0.5 * (v / rate) * (v / rate);
        hop(model, alpha_rad + side * psi, d) / rate
    };
    let mut list = Vec::new();
    let (mut time, mut v, mut side) = (time_p, eta * speed_p, 1.0);
    while v > TAIL * alpha_rad || list.len() < impacts {
        time += hop(side, v);
        if list.len() < impacts {
            list.push((time, v));
        }
        v *= eta;
        side = -side;
    }
    let hops = 1.0 / down(side) + eta / down(-side);
    let settling_p = time + 2.0 * v * hops / (1.0 - eta * eta);
    FreeRocking { impacts: list, settling_p }
}
