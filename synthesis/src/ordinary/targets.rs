//! Earthquakes, sites and target spectra of the suite.

use super::attenuation::{
    DRAWN, DURATION, PERIODS_S, PGV, QUANTITIES, between_components,
    between_periods, deviation, median, with_duration,
};
use super::moments::Conditioning;
use crate::draws::{Stream, cholesky, correlate};
use crate::pair::{LEAST_PGA_G, Role, Scenario, stream_index};

/// Quantiles of the moment magnitude: probability, magnitude. They follow the
/// record list, whose 22 events have Mw 6.3 to 7.62.
const MAGNITUDES: [[f64; 2]; 7] = [
    [0.0, 6.3],
    [0.1, 6.45],
    [0.25, 6.55],
    [0.5, 6.75],
    [0.7, 6.93],
    [0.85, 7.4],
    [1.0, 7.62],
];

/// Quantiles of the distance to the rupture, in km, from the same list;
/// between them the logarithm is linear.
const DISTANCES_KM: [[f64; 2]; 7] = [
    [0.0, 0.5],
    [0.1, 3.9],
    [0.25, 8.3],
    [0.5, 15.2],
    [0.75, 23.0],
    [0.9, 28.7],
    [1.0, 70.0],
];

/// Share of reverse and oblique faulting in the list.
const REVERSE: f64 = 0.65;

/// Vs30, lognormal: median in m/s, standard deviation of the logarithm, and
/// the ends at which it is cut. The list has no sites: these are chosen, for
/// the firm soils and soft rocks that stations stand on.
const VS30_M_S: [f64; 4] = [380.0, 0.43, 180.0, 1000.0];

/// Standard deviation of the logarithm of PGV about the mean of those of the
/// spectral accelerations from 0.3 to 3 s: that of the recorded suite, where
/// both are correlated by 0.95.
const VELOCITY_DEVIATION: f64 = 0.19;

/// Earthquake, site, and logarithms of the quantities of both components.
#[derive(Clone, Debug)]
pub(super) struct Target {
    pub(super) scenario: Scenario,
    pub(super) components: [[f64; QUANTITIES]; 2],
}

/// The targets of the whole suite: drawn pair by pair, then transformed so
/// that the first components have the recorded moments. A pair whose PGA is
/// not above 0.14 g then is drawn again, until all are.
pub(super) fn conditioned(seed: &str, pairs: u64) -> Vec<Target> {
    let mut attempts = vec![0; pairs as usize];
    let mut drawn: Vec<Target> =
        (1..=pairs).map(|pair| draw(seed, pair, 0)).collect();
    loop {
        let first: Vec<_> = drawn.iter().map(|t| t.components[0]).collect();
        let conditioning = Conditioning::of(&first);
        let out: Vec<Target> = drawn
            .iter()
            .map(|t| Target {
                components: t.components.map(|c| conditioning.apply(&c)),
                ..*t
            })
            .collect();
        let least = libm::log(LEAST_PGA_G);
        let weak = |t: &Target| !t.components.iter().all(|c| c[0] > least);
        let weak: Vec<usize> =
            (0..out.len()).filter(|i| weak(&out[*i])).collect();
        if weak.is_empty() {
            return out;
        }
        for i in weak {
            attempts[i] += 1;
            drawn[i] = draw(seed, i as u64 + 1, attempts[i]);
        }
    }
}

/// One pair without conditions.
pub(super) fn draw(seed: &str, pair: u64, attempt: u64) -> Target {
    let mut draws =
        Stream::new(seed, stream_index(pair, attempt, Role::Scenario));
    let mw = quantile(&MAGNITUDES, draws.uniform(0.0, 1.0));
    let ln_distances = DISTANCES_KM.map(|[p, km]| [p, libm::log(km)]);
    let ln_r = quantile(&ln_distances, draws.uniform(0.0, 1.0));
    let reverse = draws.uniform(0.0, 1.0) < REVERSE;
    let [vs30, spread, softest, hardest] = VS30_M_S;
    let vs30 = vs30 * libm::exp(spread * draws.normals(1)[0]);
    let scenario = Scenario {
        mw,
        rrup_km: libm::exp(ln_r),
        vs30_m_s: vs30.clamp(softest, hardest),
        reverse,
        towards_site_km: 0.0,
    };
    let factor = factor();
    let first = correlate(&factor, &draws.normals(DRAWN));
    let own = correlate(&factor, &draws.normals(DRAWN));
    let shared = between_components();
    let mut deviations = [[0.0; DRAWN]; 2];
    for (k, rho) in shared.iter().enumerate() {
        let rest = (1.0 - rho * rho).sqrt();
        deviations[0][k] = first[k];
        deviations[1][k] = rho * first[k] + rest * own[k];
    }
    let velocity = draws.normals(2);
    let (middle, spread) = (median(&scenario), deviation());
    let mut components = [[0.0; QUANTITIES]; 2];
    for ((out, z), v) in components.iter_mut().zip(&deviations).zip(velocity) {
        let ln = |k: usize| middle[k] + spread[k] * z[k];
        for (k, x) in out.iter_mut().take(PGV).enumerate() {
            *x = ln(k);
        }
        let near =
            PERIODS_S.iter().enumerate().filter(|(_, t)| is_velocity(**t));
        let (sum, count) =
            near.fold((0.0, 0.0), |(s, n), (k, _)| (s + ln(k), n + 1.0));
        out[PGV] = sum / count + VELOCITY_DEVIATION * v;
        out[DURATION] = ln(DRAWN - 1);
    }
    Target { scenario, components }
}

/// Whether PGV goes with the spectral acceleration at this period.
fn is_velocity(period_s: f64) -> bool {
    (0.3..=3.0).contains(&period_s)
}

/// Factor of the correlation between the quantities of one component.
pub(super) fn factor() -> Vec<Vec<f64>> {
    let mut lower: Vec<Vec<f64>> = PERIODS_S
        .iter()
        .enumerate()
        .map(|(k, one)| {
            let before = PERIODS_S[..k].iter();
            before.map(|other| between_periods(*one, *other)).collect()
        })
        .collect();
    lower.push(PERIODS_S.map(with_duration).to_vec());
    let rows: Vec<&[f64]> = lower.iter().map(Vec::as_slice).collect();
    // Definite for these constants; a test holds it.
    cholesky(&rows).unwrap_or_default()
}

/// Quantile at probability `p` of a table, linear between its rows.
fn quantile(table: &[[f64; 2]], p: f64) -> f64 {
    let rows = table.windows(2).find(|rows| p < rows[1][0]);
    rows.map_or(table[table.len() - 1][1], |rows| {
        let ([p0, x0], [p1, x1]) = (rows[0], rows[1]);
        x0 + (x1 - x0) * (p - p0) / (p1 - p0)
    })
}
