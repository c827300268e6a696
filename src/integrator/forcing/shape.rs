//! Series of the shapes that make up pulses.

use crate::excitation::PulseShape;
use crate::number::Real;

/// Series of a shape about time `t` (s) in units of 1/p.
pub(super) fn shape_series<N: Real, const F: usize>(
    shape: &PulseShape<N>,
    t: N,
    p: N,
) -> [N; F] {
    let mut out = [N::zero(); F];
    match shape {
        PulseShape::Sines(sines) => {
            for sine in sines.iter().filter(|s| s.amplitude != N::zero()) {
                let rate = sine.rate_rad_s;
                let angle = rate * t + sine.phase_rad;
                let (s, c) = angle.sin_cos();
                let step = rate / p;
                let mut term = sine.amplitude;
                for (k, x) in out.iter_mut().enumerate() {
                    let derivative = match k % 4 {
                        0 => s,
                        1 => c,
                        2 => -s,
                        _ => -c,
                    };
                    *x = *x + term * derivative;
                    term = term * step * N::ratio(1, k as i32 + 1);
                }
            }
        }
        PulseShape::Line { at_zero, slope } => {
            out[0] = *slope * t + *at_zero;
            if let Some(second) = out.get_mut(1) {
                *second = *slope / p;
            }
        }
        PulseShape::Gauss { scale, polynomial, rate, centre_s } => {
            let rate = *rate;
            let x = rate * (t - *centre_s);
            let half = N::ratio(-1, 2);
            // G' = -x G in the variable x.
            let mut g = [N::zero(); F];
            g[0] = (half * x * x).exp();
            for k in 0..F - 1 {
                let before = if k > 0 { g[k - 1] } else { N::zero() };
                g[k + 1] = -(x * g[k] + before) * N::ratio(1, k as i32 + 1);
            }
            let q = polynomial.map(N::from_f64);
            let three = N::from_f64(3.0);
            let two = N::from_f64(2.0);
            let about = [
                q[0] + x * (q[1] + x * (q[2] + x * q[3])),
                q[1] + x * (two * q[2] + three * x * q[3]),
                q[2] + three * x * q[3],
                q[3],
            ];
            let step = rate / p;
            let mut power = *scale;
            for k in 0..F {
                let mut sum = N::zero();
                for (j, a) in about.iter().enumerate().take(k + 1) {
                    sum = sum + *a * g[k - j];
                }
                out[k] = sum * power;
                power = power * step;
            }
        }
    }
    out
}
