//! Earthquakes, sites and target spectra of the suite.

use super::attenuation::{
    QUANTITIES, between_components, correlation, deviation, median,
};
use super::moments::Conditioning;
use crate::draws::{Stream, cholesky, correlate};
use crate::pair::{
    Earthquake, LEAST_PGA_G, MOST_DRAWS, Role, Scenario, SynthesisError, stream_index,
};

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

/// Vs30, lognormal: median in m/s, standard deviation of the logarithm, and
/// the ends at which it is cut. The list has no sites: these are chosen, for
/// the firm soils and soft rocks that stations stand on.
const VS30_M_S: [f64; 4] = [380.0, 0.43, 180.0, 1000.0];

/// Earthquake, site, and logarithms of the quantities of both components.
#[derive(Clone, Debug)]
pub(super) struct Target {
    pub(super) scenario: Scenario,
    pub(super) components: [[f64; QUANTITIES]; 2],
}

/// The targets of the whole suite: drawn pair by pair, then transformed so
/// that the first components have the recorded moments. A pair whose PGA is
/// not above 0.14 g then is drawn again, until all are.
pub(super) fn conditioned(
    seed: &'static str,
    earthquakes: &[Earthquake],
) -> Result<Vec<Target>, SynthesisError> {
    let pairs: Vec<usize> = (0..earthquakes.len())
        .flat_map(|i| vec![i; earthquakes[i].pairs])
        .collect();
    let draw = |i: usize, attempt| {
        draw(seed, earthquakes, pairs[i], i as u64 + 1, attempt)
    };
    let mut drawn: Vec<Target> =
        (0..pairs.len()).map(|i| draw(i, 0)).collect();
    let mut attempt = 0;
    loop {
        attempt += 1;
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
        let Some(pair) = weak.first() else { return Ok(out) };
        if attempt == MOST_DRAWS {
            return Err(SynthesisError::Weak { suite: seed, pair: *pair as u64 + 1 });
        }
        for i in weak {
            drawn[i] = draw(i, attempt);
        }
    }
}

/// One pair of an earthquake without conditions. Deviations have a part that
/// all pairs of the earthquake share.
pub(super) fn draw(
    seed: &str,
    earthquakes: &[Earthquake],
    earthquake: usize,
    pair: u64,
    attempt: u64,
) -> Target {
    let mut draws =
        Stream::new(seed, stream_index(pair, attempt, Role::Scenario));
    let ln_distances = DISTANCES_KM.map(|[p, km]| [p, libm::log(km)]);
    let ln_r = quantile(&ln_distances, draws.uniform(0.0, 1.0));
    let [vs30, spread, softest, hardest] = VS30_M_S;
    let vs30 = vs30 * libm::exp(spread * draws.normals(1)[0]);
    let Earthquake { mw, reverse, .. } = earthquakes[earthquake];
    let earthquake = earthquake as u64 + 1;
    let scenario = Scenario {
        earthquake,
        mw,
        rrup_km: libm::exp(ln_r),
        vs30_m_s: vs30.clamp(softest, hardest),
        reverse,
        towards_site_km: 0.0,
    };
    let factor = factor();
    let of_earthquake = stream_index(earthquake, 0, Role::Earthquake);
    let common = Stream::new(seed, of_earthquake).normals(QUANTITIES);
    let common = correlate(&factor, &common);
    let first = correlate(&factor, &draws.normals(QUANTITIES));
    let own = correlate(&factor, &draws.normals(QUANTITIES));
    let (middle, alike) = (median(&scenario), between_components());
    let mut components = [middle; 2];
    for (k, [total, between]) in deviation().into_iter().enumerate() {
        let within = (total * total - between * between).sqrt();
        let shared = between * between / (total * total);
        let rho = (alike[k] - shared) / (1.0 - shared);
        let rest = (1.0 - rho * rho).sqrt();
        let second = rho * first[k] + rest * own[k];
        components[0][k] += between * common[k] + within * first[k];
        components[1][k] += between * common[k] + within * second;
    }
    Target { scenario, components }
}

/// Factor of the correlation between the quantities of one component.
pub(super) fn factor() -> Vec<Vec<f64>> {
    let lower = correlation();
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
