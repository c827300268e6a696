//! Free rocking from rest at an initial rotation: every impact and
//! the settling time in closed form.

use super::carlson::rf;

/// What free rocking does.
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

/// Eq. 1: energy between impacts, Carlson's R_F for the times.
///
/// With D = 2 sin(theta0/2) sin(alpha - theta0/2): the speed is p sqrt(2 D),
/// a quarter period sqrt(D/2) R_F(q^2 c^2, q^2 (1 - q^2), s^2 (1 - q^2)),
/// s, c = sin, cos(alpha/2), q^2 = s^2 - D/2; an impact multiplies D by
/// eta^2.
pub fn nonlinear(
    alpha_rad: f64,
    eta: f64,
    rotation_rad: f64,
    impacts: usize,
) -> FreeRocking {
    let (s, c) = (libm::sin(0.5 * alpha_rad), libm::cos(0.5 * alpha_rad));
    let energy = 2.0
        * libm::sin(0.5 * rotation_rad)
        * libm::sin(alpha_rad - 0.5 * rotation_rad);
    // Near the saddle the difference s^2 - D/2 is known directly.
    let gap = libm::sin(0.5 * (alpha_rad - rotation_rad));
    let quarter = |d: f64, q2: f64| {
        (0.5 * d).sqrt() * rf(q2 * c * c, q2 * (1.0 - q2), s * s * (1.0 - q2))
    };
    // A hop at the end of the series lasts 2 v / sin(alpha).
    let short = |v: f64| 2.0 * v / libm::sin(alpha_rad);
    series(
        (energy, quarter(energy, gap * gap)),
        eta,
        impacts,
        alpha_rad,
        |d| 2.0 * quarter(d, s * s - 0.5 * d),
        short,
    )
}

/// Eq. 2: a quarter period is atanh(v), v = speed/(p alpha), and the peak
/// v^2/(1 + sqrt(1 - v^2)).
pub fn linearized(
    alpha_rad: f64,
    eta: f64,
    rotation_rad: f64,
    impacts: usize,
) -> FreeRocking {
    let ratio = rotation_rad / alpha_rad;
    let v2 = ratio * (2.0 - ratio);
    let scale = 0.5 * alpha_rad * alpha_rad;
    let speed = |d: f64| (d / scale).sqrt();
    // Near the saddle 1 - v = (1 - ratio)^2/(1 + v).
    let v = v2.sqrt();
    let first = 0.5
        * libm::log((1.0 + v) * (1.0 + v) / ((1.0 - ratio) * (1.0 - ratio)));
    let first = if ratio < 0.5 { libm::atanh(v) } else { first };
    series(
        (scale * v2, first),
        eta,
        impacts,
        alpha_rad,
        |d| 2.0 * libm::atanh(speed(d)),
        |v| 2.0 * v / alpha_rad,
    )
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
    is_nonlinear: bool,
    alpha_rad: f64,
    eta: f64,
    pull: f64,
    (time_p, speed_p): (f64, f64),
    impacts: usize,
) -> FreeRocking {
    let psi = libm::atan(pull);
    let rate = (1.0 + pull * pull).sqrt().sqrt();
    // Downward acceleration at the base on a side.
    let down = |side: f64| {
        if is_nonlinear {
            rate * rate * libm::sin(alpha_rad + side * psi)
        } else {
            alpha_rad + side * pull
        }
    };
    let hop = |side: f64, v: f64| {
        if is_nonlinear {
            let turned = alpha_rad + side * psi;
            let (s, c) = (libm::sin(0.5 * turned), libm::cos(0.5 * turned));
            let d = 0.5 * (v / rate) * (v / rate);
            let q2 = s * s - 0.5 * d;
            let quarter = (0.5 * d).sqrt()
                * rf(q2 * c * c, q2 * (1.0 - q2), s * s * (1.0 - q2));
            2.0 * quarter / rate
        } else {
            2.0 * libm::atanh(v / down(side))
        }
    };
    let mut answer =
        FreeRocking { impacts: Vec::new(), settling_p: f64::INFINITY };
    let (mut time, mut v, mut side) = (time_p, eta * speed_p, 1.0);
    while v > TAIL * alpha_rad || answer.impacts.len() < impacts {
        time += hop(side, v);
        if answer.impacts.len() < impacts {
            answer.impacts.push((time, v));
        }
        v *= eta;
        side = -side;
    }
    let hops = 1.0 / down(side) + eta / down(-side);
    answer.settling_p = time + 2.0 * v * hops / (1.0 - eta * eta);
    answer
}

fn series(
    (first_energy, first_quarter): (f64, f64),
    eta: f64,
    impacts: usize,
    alpha_rad: f64,
    hop: impl Fn(f64) -> f64,
    short_hop: impl Fn(f64) -> f64,
) -> FreeRocking {
    let mut answer =
        FreeRocking { impacts: Vec::new(), settling_p: f64::INFINITY };
    let mut energy = first_energy;
    let mut time = first_quarter;
    loop {
        let speed = (2.0 * energy).sqrt();
        let listed = answer.impacts.len() >= impacts;
        if !listed {
            answer.impacts.push((time, speed));
        }
        energy *= eta * eta;
        if listed && eta == 1.0 {
            return answer;
        }
        let after = eta * speed;
        if listed && after < TAIL * alpha_rad {
            answer.settling_p = time + short_hop(after) / (1.0 - eta);
            return answer;
        }
        time += hop(energy);
    }
}
