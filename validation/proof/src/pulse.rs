//! An independent computation of the pulses: acceleration, turns and end, and
//! a particular solution of Eq. 2. The core gives their names and parameters.

use std::f64::consts::{PI, SQRT_2, TAU};

use rocking::excitation::{PulseKind, PulseParameter as P};

/// Peak of (x^2 - 3) x exp(-x^2/2).
fn ricker_beta() -> f64 {
    let r = 3.0 - 6.0_f64.sqrt();
    6.0_f64.sqrt() * r.sqrt() * libm::exp(-0.5 * r)
}

/// The equivalent, on a block with this p, of a pulse on a block with
/// p = 1 rad/s; the acceleration is multiplied by `unit`.
pub fn rescaled(mut pulse: PulseKind, unit: f64, p: f64) -> PulseKind {
    for (parameter, value) in pulse.parameters_mut() {
        match parameter {
            P::Amplitude => *value *= unit,
            P::Velocity => *value = *value * unit / p,
            P::Omega | P::Frequency => *value *= p,
            P::Duration | P::Period => *value /= p,
            P::Cycles | P::Gamma | P::Phase => {}
        }
    }
    pulse
}

/// End of a pulse, s, and the instants at which it turns or has a kink.
pub fn turns(pulse: PulseKind) -> (f64, Vec<f64>) {
    let quarters = |count: u32, end: f64, omega_rad_s: f64| {
        let at = |k: u32| f64::from(k) * 0.5 * PI / omega_rad_s;
        (end, (1..count).map(at).collect())
    };
    let about = |end: f64, rate: f64, turns: &[f64]| {
        (end, turns.iter().map(|x| 0.5 * end + x / rate).collect())
    };
    match pulse {
        PulseKind::HalfSine { omega_rad_s: w, .. } => quarters(2, PI / w, w),
        PulseKind::OneSine { omega_rad_s: w, .. }
        | PulseKind::OneCosine { omega_rad_s: w, .. } => {
            quarters(4, TAU / w, w)
        }
        PulseKind::Rectangle { duration_s, .. } => (duration_s, Vec::new()),
        PulseKind::Triangle { duration_s, .. } => {
            (duration_s, vec![0.5 * duration_s])
        }
        PulseKind::RickerSymmetric { period_s, cycles, .. } => {
            let rate = 2.0_f64.sqrt() * PI / period_s;
            let x = 3.0_f64.sqrt();
            about(cycles * period_s, rate, &[-x, 0.0, x])
        }
        PulseKind::RickerAntisymmetric { period_s, cycles, .. } => {
            let rate = TAU / (3.0_f64.sqrt() * period_s);
            let r = 6.0_f64.sqrt();
            let (far, near) = ((3.0 + r).sqrt(), (3.0 - r).sqrt());
            about(cycles * period_s, rate, &[-far, -near, near, far])
        }
        PulseKind::MavroeidisPapageorgiou { frequency_hz, gamma, .. } => {
            // No closed form of its turns: many short pieces.
            let end = gamma / frequency_hz;
            let pieces = (1..256).map(|k| f64::from(k) / 256.0 * end);
            (end, pieces.collect())
        }
        _ => (f64::NAN, Vec::new()),
    }
}

/// Acceleration and particular solution P'' - P = -A with its derivative.
#[derive(Default)]
pub struct Particular {
    pub a: f64,
    pub p: f64,
    pub v: f64,
}

pub fn kinks(pulse: PulseKind) -> Vec<f64> {
    let end = turns(pulse).0;
    match pulse {
        PulseKind::Triangle { .. } => vec![0.0, 0.5 * end, end],
        _ => vec![0.0, end],
    }
}

/// At `t` of the smooth stretch `piece`.
pub fn particular(pulse: PulseKind, piece: usize, t: f64) -> Particular {
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
            let left = duration_s - t;
            let (x, v) = if piece == 0 { (t, slope) } else { (left, -slope) };
            Particular { a: slope * x, p: slope * x, v }
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
            let mut sum = Particular::default();
            let (up, down) = (1.0 + 1.0 / gamma, 1.0 - 1.0 / gamma);
            let parts = [(0.5, 1.0), (0.25 * up, up), (0.25 * down, down)];
            for (share, rate) in parts {
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
