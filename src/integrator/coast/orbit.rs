//! An orbit of free motion in closed form: its level of energy, its turning
//! points, and the time between two places.

use crate::integrator::dynamics::{Dynamics, Model};
use crate::number::Real;

/// A level of energy, above the base and below the saddle. Both are kept,
/// because near the saddle the depth would be lost in a difference.
#[derive(Clone, Copy)]
pub(super) struct Energy<N> {
    pub above_base: N,
    pub below_saddle: N,
}

impl<N: Real> Energy<N> {
    pub fn of(d: &Dynamics<N>, u: N, w: N) -> Self {
        Self {
            above_base: (N::ratio(1, 2) * w).mul_add(w, d.potential(u)),
            below_saddle: d.depth(u, w),
        }
    }

    pub fn after_impact(self, d: &Dynamics<N>) -> Self {
        let above_base = d.eta * d.eta * self.above_base;
        Self { above_base, below_saddle: d.saddle_energy() - above_base }
    }

    /// Speed at the base.
    pub fn speed(self) -> N {
        (self.above_base + self.above_base).sqrt()
    }
}

/// Rotation at which a level below the saddle turns the block.
///
/// Eq. 1: u = 2 asin[(D/2)/sin((alpha + psi)/2)] with
/// sin(psi/2) = sqrt(q/2), q below the saddle; Eq. 2:
/// u = 2 D/(alpha + sqrt(2 q)).
pub(super) fn turning<N: Real>(d: &Dynamics<N>, level: Energy<N>) -> N {
    let two = N::from_f64(2.0);
    let half = N::ratio(1, 2);
    let (energy, room) = (level.above_base, level.below_saddle);
    match d.model {
        Model::Nonlinear => {
            let psi = two * (half * room).sqrt().asin();
            let (s, _) = (half * (d.alpha + psi)).sin_cos();
            two * (half * energy / s).asin()
        }
        Model::Linearized => two * energy / (d.alpha + (two * room).sqrt()),
    }
}

/// Time (in 1/p) from the base to the turning point: a quarter period.
///
/// Eq. 1: sqrt(D/2) R_F(q^2 c^2, q^2 (1 - q^2), s^2 (1 - q^2)) with
/// s = sin(alpha/2), c = cos(alpha/2), q^2 = s^2 - D/2. Eq. 2: atanh(v),
/// v = sqrt(2 D)/alpha.
pub(super) fn hop<N: Real>(d: &Dynamics<N>, level: Energy<N>) -> N {
    let half = N::ratio(1, 2);
    match d.model {
        Model::Nonlinear => {
            let (s, c) = (half * d.alpha).sin_cos();
            let q2 = half * level.below_saddle;
            let other = N::one() - q2;
            (half * level.above_base).sqrt()
                * carlson_rf(q2 * c * c, q2 * other, s * s * other)
        }
        Model::Linearized => {
            // v = speed/alpha, (1 + v)/(1 - v) - 1 = 2 v (1 + v)/(1 - v^2).
            let v = level.speed() / d.alpha;
            let q = level.below_saddle;
            // 2 q/alpha^2 = 1 - v^2, without cancellation near the saddle.
            let room = (q + q) / (d.alpha * d.alpha);
            half * ((v + v) * (N::one() + v) / room).ln_1p()
        }
    }
}

/// A place on an orbit: rotation and absolute velocity. Near a turning point
/// half of the digits of the velocity would be lost if it were computed from
/// the rotation.
#[derive(Clone, Copy)]
pub(super) struct OrbitPlace<N> {
    pub u: N,
    pub speed: N,
}

/// Velocity at rotation u of a level.
pub(super) fn speed_at<N: Real>(d: &Dynamics<N>, u: N, level: Energy<N>) -> N {
    let y = d.alpha - u;
    let q = level.below_saddle + level.below_saddle;
    match d.model {
        Model::Nonlinear => {
            let (s, _) = (N::ratio(1, 2) * y).sin_cos();
            (N::from_f64(4.0) * s * s - q).positive_part().sqrt()
        }
        Model::Linearized => (y * y - q).positive_part().sqrt(),
    }
}

/// Time (in 1/p) between two places of monotone motion, `from` below `to`:
/// the integral of du / sqrt(2 (D - U(u))), which depends on |alpha - u|
/// alone.
pub(super) fn transit<N: Real>(
    d: &Dynamics<N>,
    from: OrbitPlace<N>,
    to: OrbitPlace<N>,
    level: Energy<N>,
) -> N {
    let high = (d.alpha - from.u, from.speed);
    let low = (d.alpha - to.u, to.speed);
    let zero = N::zero();
    let part = |first, second| match d.model {
        Model::Nonlinear => stretch(first, second),
        Model::Linearized => linear_stretch(first, second),
    };
    if !(low.0 < zero) {
        part(high, low)
    } else if high.0 > zero {
        let saddle = (zero, speed_at(d, d.alpha, level));
        part(high, saddle) + part((-low.0, low.1), saddle)
    } else {
        part((-low.0, low.1), (-high.0, high.1))
    }
}

/// Integral of dy / w, w^2 = y^2 - 2 q, from y2 to y1, y1 >= y2 >= 0: the
/// difference of ln(y + w).
fn linear_stretch<N: Real>((y1, w1): (N, N), (y2, w2): (N, N)) -> N {
    let dy = y1 - y2;
    // w^2 - y^2 is constant; at a turning point the velocity is the more
    // accurate of the two.
    let dw = if w2 == N::zero() { w1 } else { dy * (y1 + y2) / (w1 + w2) };
    if !(dw > N::zero()) {
        return N::zero();
    }
    let dy = if w2 == N::zero() { w1 * w1 / (y1 + y2) } else { dy };
    ((dy + dw) / (y2 + w2)).ln_1p()
}

/// Integral of dy / w, w^2 = 4 sin^2(y/2) - 2 q, from y2 to y1 with
/// y1 >= y2 >= 0.
///
/// With z = sin^2(y/2) it is the integral of
/// dz / (2 sqrt(z (1 - z) (z - q/2))), by Carlson's addition formula
/// R_F(U1^2, U2^2, U3^2), U_i = (X_i Y_j Y_k + Y_i X_j X_k)/(z1 - z2), X and
/// Y the square roots of the factors at the two ends (DLMF 19.29.4).
fn stretch<N: Real>((y1, w1): (N, N), (y2, w2): (N, N)) -> N {
    let half = N::ratio(1, 2);
    let (s1, c1) = (half * y1).sin_cos();
    let (s2, c2) = (half * y2).sin_cos();
    let (r1, r2) = (half * w1, half * w2);
    // sin^2(y1/2) - sin^2(y2/2); if one end is the turning point, from the
    // velocity, which is more accurate there.
    let width = if w2 == N::zero() {
        r1 * r1
    } else {
        (half * (y1 - y2)).sin_cos().0 * (half * (y1 + y2)).sin_cos().0
    };
    if !(width > N::zero()) {
        return N::zero();
    }
    let u1 = (s1 * c2 * r2 + s2 * c1 * r1) / width;
    let u2 = (c1 * s2 * r2 + c2 * s1 * r1) / width;
    let u3 = (r1 * s2 * c2 + r2 * s1 * c1) / width;
    carlson_rf(u1 * u1, u2 * u2, u3 * u3)
}

/// Carlson's symmetric elliptic integral R_F(x, y, z) by duplication; at
/// most one argument may vanish (DLMF 19.20, 19.36).
pub(super) fn carlson_rf<N: Real>(mut x: N, mut y: N, mut z: N) -> N {
    let vanishing = [x, y, z].iter().filter(|v| **v == N::zero()).count();
    if vanishing > 1 {
        // The saddle is reached after infinite time.
        return N::one() / N::zero();
    }
    let third = N::ratio(1, 3);
    let quarter = N::ratio(1, 4);
    // The series below is of order 8 in the relative spread.
    let close = (N::ROUNDOFF / 8.0).sqrt().sqrt().sqrt();
    loop {
        let mean = (x + y + z) * third;
        let spread = |v: N| ((mean - v) / mean).abs().to_f64();
        if spread(x).max(spread(y)).max(spread(z)) < 0.5 * close {
            let dx = (mean - x) / mean;
            let dy = (mean - y) / mean;
            let dz = -(dx + dy);
            let e2 = dx * dy - dz * dz;
            let e3 = dx * dy * dz;
            let series = N::one() - e2 * N::ratio(1, 10)
                + e3 * N::ratio(1, 14)
                + e2 * e2 * N::ratio(1, 24)
                - e2 * e3 * N::ratio(3, 44)
                - e2 * e2 * e2 * N::ratio(5, 208)
                + e3 * e3 * N::ratio(3, 104)
                + e2 * e2 * e3 * N::ratio(1, 16);
            return series / mean.sqrt();
        }
        let (rx, ry, rz) = (x.sqrt(), y.sqrt(), z.sqrt());
        let lambda = rx * ry + ry * rz + rz * rx;
        x = (x + lambda) * quarter;
        y = (y + lambda) * quarter;
        z = (z + lambda) * quarter;
    }
}
