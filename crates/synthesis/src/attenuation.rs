//! Spectral accelerations and durations for given magnitude, distance and
//! site: medians, scatter and correlation.

use std::f64::consts::{LN_10, PI};

use crate::pair::{GRAVITY_M_S2, Scenario};

/// Periods of the target spectrum in s. The first is PGA.
pub(super) const PERIODS_S: [f64; 16] = [
    0.01, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0,
    7.5, 10.0,
];

/// Quantities of a target: spectral accelerations, then PGV and D5-75.
pub(super) const QUANTITIES: usize = PERIODS_S.len() + 2;

/// Place of PGV.
pub(super) const PGV: usize = PERIODS_S.len();

/// Place of D5-75.
pub(super) const DURATION: usize = PERIODS_S.len() + 1;

/// Coefficients of Cauzzi, Faccioli, Vanini and Bianchini (2015), horizontal
/// components at 5 % damping, one row a period, then PGV, in decimal
/// logarithms: c1, m1 and m2 for the magnitude, r1, r2 and r3 for the
/// distance.
const SOURCE: [[f64; 6]; PERIODS_S.len() + 1] = [
    [-2.19617, 0.52375, -0.060945, -3.80190, 0.355081, 11.64156],
    [0.67594, 0.67016, -0.084249, -4.29897, 0.395015, 16.94994],
    [0.40604, 0.63311, -0.071908, -3.86971, 0.352721, 13.75538],
    [-0.09647, 0.63942, -0.062562, -3.41543, 0.301005, 11.45346],
    [-0.50661, 0.66511, -0.056093, -3.09389, 0.273517, 8.29352],
    [-1.02453, 0.74771, -0.056269, -2.88529, 0.253678, 6.21199],
    [-1.36997, 0.82603, -0.060097, -2.79376, 0.248354, 5.20211],
    [-2.03150, 1.06127, -0.076144, -2.84119, 0.258367, 5.05140],
    [-2.48787, 1.21348, -0.085428, -2.85438, 0.259370, 4.97808],
    [-2.82394, 1.37033, -0.095341, -2.98721, 0.272340, 6.09930],
    [-3.48355, 1.65630, -0.115415, -3.04422, 0.264181, 8.97466],
    [-3.71812, 1.72769, -0.115581, -2.99231, 0.252381, 11.83860],
    [-3.58792, 1.68901, -0.112884, -3.12247, 0.282279, 12.75432],
    [-3.24400, 1.56533, -0.100789, -3.13552, 0.288242, 14.20965],
    [-3.64131, 1.54912, -0.093759, -2.90122, 0.276308, 12.67079],
    [-3.58474, 1.45589, -0.086587, -2.83142, 0.281961, 9.51257],
    [0.44222, 0.54822, -0.031947, -2.84578, 0.240674, 6.51697],
];

/// In the same rows bV and VA in m/s for the site, fR and fSS for the style of
/// faulting, and the standard deviation with style of faulting, total and
/// between earthquakes.
const SITE_AND_STYLE: [[f64; 6]; PERIODS_S.len() + 1] = [
    [-0.31007, 2319.19, 0.07246, -0.05632, 0.33733, 0.21622],
    [-0.10000, 36597.6, 0.10057, -0.07995, 0.37011, 0.23433],
    [-0.22732, 5440.35, 0.09629, -0.07626, 0.36816, 0.22827],
    [-0.43845, 1898.29, 0.06934, -0.06339, 0.36142, 0.21125],
    [-0.65541, 967.93, 0.05087, -0.04177, 0.35475, 0.19615],
    [-0.81009, 794.55, 0.04039, -0.03849, 0.36244, 0.20517],
    [-0.91661, 747.11, 0.02813, -0.02979, 0.36892, 0.21634],
    [-1.03136, 675.70, 0.00744, -0.01617, 0.37384, 0.22943],
    [-0.98919, 678.61, -0.00544, -0.00830, 0.37527, 0.23026],
    [-0.88586, 676.46, -0.01537, 0.00165, 0.37514, 0.23307],
    [-0.79096, 641.12, -0.00200, 0.00810, 0.36792, 0.22559],
    [-0.71271, 643.30, 0.01153, 0.00625, 0.36431, 0.23155],
    [-0.64282, 651.49, 0.00927, 0.01454, 0.36176, 0.23930],
    [-0.57286, 628.30, 0.00232, 0.02373, 0.35768, 0.23991],
    [-0.50571, 629.53, -0.02698, 0.04045, 0.34934, 0.24336],
    [-0.47735, 644.71, -0.03919, 0.04722, 0.33754, 0.24142],
    [-0.69096, 883.96, 0.01846, 0.00499, 0.32210, 0.21494],
];

/// Standard deviation of the logarithm of D5-75 of an arbitrary component,
/// total and between earthquakes (Bommer, Stafford and Alarcon 2009).
const DURATION_DEVIATION: [f64; 2] = [0.5564, 0.3527];

/// Median logarithm of each quantity, accelerations in g, PGV in m/s and D5-75
/// in s: Cauzzi et al. (2015), whose equations give the spectral displacement,
/// and Bommer et al. (2009) with the rupture at the surface.
pub(super) fn median(scenario: &Scenario) -> [f64; QUANTITIES] {
    let Scenario { mw, rrup_km: r, vs30_m_s: v, reverse, .. } = *scenario;
    let mut out = [0.0; QUANTITIES];
    for (k, rows) in SOURCE.into_iter().zip(SITE_AND_STYLE).enumerate() {
        let (
            [c1, m1, m2, r1, r2, r3],
            [site, va, reverse_term, slip_term, ..],
        ) = rows;
        let style = if reverse { reverse_term } else { slip_term };
        let decimal = c1
            + m1 * mw
            + m2 * mw * mw
            + (r1 + r2 * mw) * libm::log10(r + r3)
            + site * libm::log10(v / va)
            + style;
        // The equations give centimetres.
        let unit = PERIODS_S.get(k).map_or(0.01, |period| {
            let w = 2.0 * PI / period;
            w * w / (100.0 * GRAVITY_M_S2)
        });
        out[k] = LN_10 * decimal + libm::log(unit);
    }
    let ln_r = 0.5 * libm::log(r * r + 2.3316 * 2.3316);
    let with_distance = (2.0063 - 0.2520 * mw) * ln_r;
    let site = 0.2900 * libm::log(v);
    out[DURATION] = -5.6298 + 1.2619 * mw + with_distance - site;
    out
}

/// Standard deviation of the logarithm of each quantity, total and between
/// earthquakes.
pub(super) fn deviation() -> [[f64; 2]; QUANTITIES] {
    let mut out = [DURATION_DEVIATION; QUANTITIES];
    for (value, row) in out.iter_mut().zip(&SITE_AND_STYLE) {
        *value = [LN_10 * row[4], LN_10 * row[5]];
    }
    out
}

/// Correlation of the deviations of PGV and of a spectral acceleration
/// (Bradley, Earthquake Spectra 28, 2012), times 0.92: with the correlation
/// between periods, which others published, it is definite only then.
pub(super) fn with_velocity(period_s: f64) -> f64 {
    let [a, b, c, d] = match period_s {
        t if t < 0.1 => [0.73, 0.54, 0.045, 1.8],
        t if t < 0.75 => [0.54, 0.81, 0.28, 1.5],
        t if t < 2.5 => [0.80, 0.76, 1.1, 3.0],
        _ => [0.76, 0.70, 5.0, 3.2],
    };
    let step = libm::tanh(d * libm::log(period_s / c));
    0.92 * (0.5 * (a + b) - 0.5 * (a - b) * step)
}

/// Correlation of the deviations of two spectral accelerations of one
/// component (Baker and Jayaram 2008, their procedure of four cases).
pub(super) fn between_periods(one_s: f64, other_s: f64) -> f64 {
    let (short, long) =
        if one_s < other_s { (one_s, other_s) } else { (other_s, one_s) };
    let base = if short > 0.109 { short } else { 0.109 };
    let c1 = 1.0 - libm::cos(0.5 * PI - 0.366 * libm::log(long / base));
    if short > 0.109 {
        return c1;
    }
    let c2 = if long < 0.2 {
        let steep = 1.0 + libm::exp(100.0 * long - 5.0);
        let apart = (long - short) / (long - 0.0099);
        1.0 - 0.105 * (1.0 - 1.0 / steep) * apart
    } else {
        0.0
    };
    if long < 0.109 {
        return c2;
    }
    let c4 =
        c1 + 0.5 * (c1.sqrt() - c1) * (1.0 + libm::cos(PI * short / 0.109));
    if long < 0.2 && c2 < c4 { c2 } else { c4 }
}

/// Correlation of the deviations of D5-75 and of a spectral acceleration, as
/// in the recorded suite: -0.35 up to 0.5 s and 0.05 at 5 s, on a line in the
/// logarithm of the period.
pub(super) fn with_duration(period_s: f64) -> f64 {
    if period_s > 0.5 {
        -0.35 + 0.40 * libm::log10(period_s / 0.5)
    } else {
        -0.35
    }
}

/// Correlation of a quantity's deviations in the two components: by Baker and
/// Cornell (2006) at equal periods, for PGV as at 1 s, and 0.86 for D5-75, as
/// in the recorded suite.
pub(super) fn between_components() -> [f64; QUANTITIES] {
    let mut out = [0.86; QUANTITIES];
    out[PGV] = 0.79;
    for (value, period) in out.iter_mut().zip(PERIODS_S) {
        *value = 0.79 - 0.023 * libm::log(period);
    }
    out
}

/// Published correlation of the deviations of two quantities of one component,
/// for all of them: the rows of the strict lower triangle.
pub(super) fn correlation() -> Vec<Vec<f64>> {
    let row = |k: usize| {
        let before = PERIODS_S[..k].iter();
        before.map(|other| between_periods(PERIODS_S[k], *other)).collect()
    };
    let mut lower: Vec<Vec<f64>> = (0..PERIODS_S.len()).map(row).collect();
    lower.push(PERIODS_S.map(with_velocity).to_vec());
    // PGV goes with duration as waves of 1 s do.
    let durations = PERIODS_S.iter().chain(&[1.0]);
    lower.push(durations.map(|t| with_duration(*t)).collect());
    lower
}
