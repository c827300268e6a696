//! Earthquakes, sites and target spectra of the suite.

use crate::attenuation::{
    PGV, QUANTITIES, between_components, correlation, deviation, median,
};
use crate::draws::{Deviates, cholesky, correlate};
use crate::moments::{Components, Moments, bend, condition};
use crate::pair::{
    LEAST_PGA_G, MOST_DRAWS, Role, Scenario, SynthesisError, stream_index,
};
use crate::peaks::Peak;
use crate::pulse::PulseModel;

/// Vs30, lognormal: median in m/s, standard deviation of the logarithm, and
/// the ends at which it is cut. The list has no sites: these values are chosen
/// for the usual firm soils and soft rocks of stations.
const VS30_M_S: [f64; 4] = [380.0, 0.43, 180.0, 1000.0];

/// Number of rounds in which ratios to PGA are bent and moments then restored:
/// each disturbs the other less from round to round.
const BENDS: usize = 5;

/// Parameters of a suite.
pub(super) struct Design {
    /// Start of the names of its components.
    pub(super) name: &'static str,
    /// Name of its random streams.
    pub(super) seed: &'static str,
    /// Earthquakes: number of pairs, moment magnitude, and whether faulting is
    /// reverse or oblique.
    pub(super) earthquakes: &'static [(usize, f64, bool)],
    /// Quantiles of the distance to the rupture: probability, km; between them
    /// the logarithm is linear.
    pub(super) distances_km: &'static [[f64; 2]],
    /// Whether motions have a velocity pulse.
    pub(super) pulses: bool,
    /// Moments that the first components have.
    pub(super) recorded: &'static Moments,
    /// Medians of their ratios to PGA, over geometric means.
    pub(super) medians: &'static [f64; 7],
}

/// Earthquake, site, and logarithms of the quantities of both components.
#[derive(Clone, Debug)]
pub(super) struct Target {
    pub(super) scenario: Scenario,
    pub(super) pulse: Option<PulseModel>,
    pub(super) components: Components,
}

/// The targets of the whole suite: drawn pair by pair, then transformed so
/// that the first components have the recorded moments, and nearly the
/// recorded medians of ratios to PGA. Then pairs with a PGA of 0.14 g or less
/// are drawn again, until there are none.
pub(super) fn conditioned(
    suite: &Design,
) -> Result<Vec<Target>, SynthesisError> {
    let counts = suite.earthquakes.iter().enumerate();
    let pairs: Vec<usize> =
        counts.flat_map(|(i, (pairs, ..))| vec![i; *pairs]).collect();
    let draw =
        |i: usize, attempt| draw(suite, pairs[i], i as u64 + 1, attempt);
    let mut drawn: Vec<Target> =
        (0..pairs.len()).map(|i| draw(i, 0)).collect();
    let mut attempt = 0;
    loop {
        attempt += 1;
        let mut out: Vec<_> = drawn.iter().map(|t| t.components).collect();
        for _ in 0..BENDS {
            bend(&mut out, suite.medians);
            condition(&mut out, suite.recorded);
        }
        let least = libm::log(LEAST_PGA_G);
        let weak = |i: &usize| !out[*i].iter().all(|c| c[0] > least);
        let weak: Vec<usize> = (0..out.len()).filter(weak).collect();
        let Some(pair) = weak.first() else {
            for (t, components) in drawn.iter_mut().zip(out) {
                t.components = components;
            }
            return Ok(drawn);
        };
        if attempt == MOST_DRAWS {
            let (suite, pair) = (suite.seed, *pair as u64 + 1);
            return Err(SynthesisError::Weak { suite, pair });
        }
        for i in weak {
            drawn[i] = draw(i, attempt);
        }
    }
}

/// One pair of an earthquake without conditions. A part of the deviations is
/// common to all pairs of the earthquake.
pub(super) fn draw(
    suite: &Design,
    earthquake: usize,
    pair: u64,
    attempt: u64,
) -> Target {
    let mut draws =
        Deviates::new(suite.seed, stream_index(pair, attempt, Role::Scenario));
    let rrup_km = quantile(suite.distances_km, draws.uniform(0.0, 1.0));
    let [vs30, spread, softest, hardest] = VS30_M_S;
    let vs30 = vs30 * libm::exp(spread * draws.normals(1)[0]);
    let (_, mw, reverse) = suite.earthquakes[earthquake];
    let earthquake = earthquake as u64 + 1;
    let scenario = Scenario {
        earthquake,
        mw,
        rrup_km,
        vs30_m_s: vs30.clamp(softest, hardest),
        reverse,
        towards_site_km: match suite.pulses {
            true => draws.uniform(5.0, 40.0),
            false => 0.0,
        },
    };
    let factor = factor();
    let of_earthquake = stream_index(earthquake, 0, Role::Earthquake);
    let common = Deviates::new(suite.seed, of_earthquake).normals(QUANTITIES);
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
    let pulse = suite.pulses.then(|| PulseModel::draw(&scenario, &mut draws));
    let pulses = pulse.iter().flat_map(PulseModel::samples);
    for (out, samples) in components.iter_mut().zip(pulses) {
        for (k, x) in out.iter_mut().enumerate().take(PGV + 1) {
            // Peaks of pulse and other waves do not meet.
            let part = Peak::of(k).found(&samples).size;
            *x = 0.5 * libm::log(libm::exp(2.0 * *x) + part * part);
        }
    }
    Target { scenario, pulse, components }
}

/// Factor of the correlation between the quantities of one component.
pub(super) fn factor() -> Vec<Vec<f64>> {
    // Definite for these constants, as a test checks.
    cholesky(&correlation()).unwrap_or_default()
}

/// Quantile at probability `p` of a table of positive numbers, whose logarithm
/// is linear between its rows.
fn quantile(table: &[[f64; 2]], p: f64) -> f64 {
    let rows = table.windows(2).find(|rows| p < rows[1][0]);
    rows.map_or(table[table.len() - 1][1], |rows| {
        let ([p0, x0], [p1, x1]) = (rows[0], rows[1]);
        x0 * libm::exp(libm::log(x1 / x0) * (p - p0) / (p1 - p0))
    })
}
