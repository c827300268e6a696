//! Overturning conditions of Eq. 2: the amplitude over g alpha at which the
//! growing exponential vanishes, with and without an impact.

use std::f64::consts::PI;

use super::bisect;

/// Rectangle of duration p t = tau: 1/(1 - exp(-tau)).
///
/// ```
/// use rocking_proof::oracles::overturning::rectangle;
/// let a = rectangle(0.7);
/// // tau = ln[A/(A - 1)].
/// assert!(((a / (a - 1.0)).ln() - 0.7).abs() < 1e-15);
/// ```
pub fn rectangle(tau: f64) -> f64 {
    -1.0 / libm::expm1(-tau)
}

/// Isosceles triangle of base tau:
/// (tau/2)/(-ln[1 - (1 - exp(-tau/2))^2]).
pub fn triangle(tau: f64) -> f64 {
    let rise = -libm::expm1(-0.5 * tau);
    0.5 * tau / -libm::log1p(-rise * rise)
}

/// One full cosine, without impact: (1 + Omega^2)/(1 - exp(-2 pi/Omega)).
pub fn one_cosine(omega: f64) -> f64 {
    (1.0 + omega * omega) / -libm::expm1(-2.0 * PI / omega)
}

/// `half_cycles` half periods of a sine, without impact: the root of
/// sqrt(A^2 - 1) - (-1)^N A exp(-x_N) = Omega,
/// x_N = [N pi - asin(1/A)]/Omega. One half cycle is the exact form of
/// Housner's sqrt(1 + Omega^2); two are mode 2 of the one-sine pulse.
pub fn sine_without_impact(half_cycles: u32, omega: f64) -> f64 {
    let n = f64::from(half_cycles);
    let sign = if half_cycles.is_multiple_of(2) { 1.0 } else { -1.0 };
    let f = |a: f64| {
        let x = (n * PI - libm::asin(1.0 / a)) / omega;
        (a * a - 1.0).sqrt() - sign * a * libm::exp(-x) - omega
    };
    bisect(1.0, 4.0 * (1.0 + omega) * (1.0 + omega), f)
}

/// F(A) = c^2 (Omega + A e^-x - r)(A e^x - r - Omega): one impact after a
/// one-sine pulse overturns where F > 1/eta^2 - 1.
fn after_pulse(a: f64, omega: f64) -> f64 {
    let r = (a * a - 1.0).sqrt();
    let x = (2.0 * PI - libm::asin(1.0 / a)) / omega;
    let c = omega / (1.0 + omega * omega);
    c * c * (omega + a * libm::exp(-x) - r) * (a * libm::exp(x) - r - omega)
}

/// Upper edge of mode 1 (impact after the pulse); none beyond the fold.
pub fn mode_1_upper(omega: f64, eta: f64) -> Option<f64> {
    let need = 1.0 / (eta * eta) - 1.0;
    let mode_2 = sine_without_impact(2, omega);
    let top = maximum(1.0, mode_2, |a| after_pulse(a, omega));
    let f = |a: f64| after_pulse(a, omega) - need;
    (f(top) > 0.0).then(|| bisect(top, mode_2, f))
}

/// The end of mode 1 of the one-sine pulse (eta > 1/sqrt(2)): Omega and A at
/// which the largest F equals 1/eta^2 - 1.
pub fn fold(eta: f64) -> (f64, f64) {
    let need = 1.0 / (eta * eta) - 1.0;
    let top = |omega| stationary(omega, sine_without_impact(2, omega));
    let excess = |omega| after_pulse(top(omega), omega) - need;
    let omega = bisect(3.5, 60.0, excess);
    (omega, top(omega))
}

/// The amplitude of the largest F: A + r = Omega coth(x/2).
fn stationary(omega: f64, mode_2: f64) -> f64 {
    bisect(1.0, mode_2, |a| {
        let r = (a * a - 1.0).sqrt();
        let x = (2.0 * PI - libm::asin(1.0 / a)) / omega;
        a + r - omega / libm::tanh(0.5 * x)
    })
}

/// Place of the largest value of a function with one peak, by thirds. Unlike
/// [`stationary`] it needs no sign change, which is missing at omega < p.
fn maximum(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let third = (high - low) / 3.0;
        if f(low + third) < f(high - third) {
            low += third;
        } else {
            high -= third;
        }
    }
    0.5 * (low + high)
}
