//! The standard normal distribution, good in both tails.

use libm::{erf, erfc, exp, log, log1p};

/// 1/sqrt(2 pi).
const PEAK: f64 = 0.398_942_280_401_432_7;
/// ln sqrt(2 pi).
pub(crate) const LN_SQRT_TWO_PI: f64 = 0.918_938_533_204_672_8;

/// Density phi(z) = exp(-z^2/2)/sqrt(2 pi).
///
/// ```
/// assert_eq!(rocking_statistics::normal::pdf(0.0), 0.3989422804014327);
/// ```
pub fn pdf(z: f64) -> f64 {
    PEAK * exp(-0.5 * z * z)
}

/// Distribution function Phi(z) = erfc(-z/sqrt 2)/2, to a few units in the
/// last place in either tail.
///
/// ```
/// use rocking_statistics::normal::cdf;
/// assert_eq!(cdf(0.0), 0.5);
/// // Phi(-10), Abramowitz and Stegun, table 26.2
/// assert!((cdf(-10.0) / 7.61985302416e-24 - 1.0).abs() < 1e-11);
/// ```
pub fn cdf(z: f64) -> f64 {
    0.5 * erfc(-z * std::f64::consts::FRAC_1_SQRT_2)
}

/// Survival function 1 - Phi(z), without cancellation.
pub fn survival(z: f64) -> f64 {
    cdf(-z)
}

/// ln Phi(z), finite for every finite z.
///
/// Below -20, where Phi underflows in the end, the asymptotic series of
/// Mills' ratio is used (its first neglected term is below 1e-15).
pub fn ln_cdf(z: f64) -> f64 {
    if z > 5.0 {
        log1p(-cdf(-z))
    } else if z > -20.0 {
        log(cdf(z))
    } else {
        let w = 1.0 / (z * z);
        // 1 - w + 3 w^2 - 15 w^3 + 105 w^4 - 945 w^5
        let tail = [-945.0, 105.0, -15.0, 3.0, -1.0]
            .iter()
            .fold(0.0, |sum: f64, c| w * (sum + c));
        -0.5 * z * z - LN_SQRT_TWO_PI - log(-z) + log1p(tail)
    }
}

/// Quantile z with Phi(z) = p, for p in [0, 1]; infinite at the ends, NaN
/// outside.
///
/// Acklam's rational starter (relative error 1.2e-9), then one Halley step
/// on the better conditioned of erf and erfc.
///
/// ```
/// use rocking_statistics::normal::quantile;
/// assert!((quantile(0.975) - 1.959963984540054).abs() < 1e-15);
/// assert_eq!(quantile(0.5), 0.0);
/// ```
pub fn quantile(p: f64) -> f64 {
    if !(0.0..=1.0).contains(&p) {
        return f64::NAN;
    }
    if p == 0.0 || p == 1.0 {
        return if p == 0.0 { f64::NEG_INFINITY } else { f64::INFINITY };
    }
    if p > 0.5 {
        // 1 - p is exact here.
        return -lower_quantile(1.0 - p);
    }
    lower_quantile(p)
}

fn lower_quantile(p: f64) -> f64 {
    let z = starter(p);
    let error = if p > 0.25 {
        0.5 * erf(z * std::f64::consts::FRAC_1_SQRT_2) - (p - 0.5)
    } else {
        cdf(z) - p
    };
    // A ratio of two tails: never exp(z^2/2), which overflows.
    let step = error / pdf(z);
    if step.is_finite() { z - step / (1.0 + 0.5 * z * step) } else { z }
}

fn starter(p: f64) -> f64 {
    const A: [f64; 6] = [
        -3.969_683_028_665_376e1,
        2.209_460_984_245_205e2,
        -2.759_285_104_469_687e2,
        1.383_577_518_672_69e2,
        -3.066_479_806_614_716e1,
        2.506_628_277_459_239,
    ];
    const B: [f64; 6] = [
        -5.447_609_879_822_406e1,
        1.615_858_368_580_409e2,
        -1.556_989_798_598_866e2,
        6.680_131_188_771_972e1,
        -1.328_068_155_288_572e1,
        1.0,
    ];
    const C: [f64; 6] = [
        -7.784_894_002_430_293e-3,
        -3.223_964_580_411_365e-1,
        -2.400_758_277_161_838,
        -2.549_732_539_343_734,
        4.374_664_141_464_968,
        2.938_163_982_698_783,
    ];
    const D: [f64; 5] = [
        7.784_695_709_041_462e-3,
        3.224_671_290_700_398e-1,
        2.445_134_137_142_996,
        3.754_408_661_907_416,
        1.0,
    ];
    let horner = |c: &[f64], x: f64| c.iter().fold(0.0, |sum, k| sum * x + k);
    if p < 0.02425 {
        let q = (-2.0 * log(p)).sqrt();
        horner(&C, q) / horner(&D, q)
    } else {
        let q = p - 0.5;
        let r = q * q;
        q * horner(&A, r) / horner(&B, r)
    }
}

#[cfg(test)]
mod tests;
