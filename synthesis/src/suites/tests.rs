//! Tests of the ordinary suite: published relations at points known from
//! elsewhere, and moments of the suite beside the recorded ones.

use std::sync::LazyLock;

use rocking::intensity::{Measures, Settings};
use rocking::record::Accelerogram;

use super::attenuation::{
    PERIODS_S, PGV, QUANTITIES, between_periods, median,
};
use super::moments::{RECORDED, moments};
use super::targets::{self, Target};
use super::waves::{Envelope, matched_peak};
use crate::ordinary;
use crate::pair::{ORDINARY_SEED, Scenario};

/// Medians of the recorded suite, written by a study of it.
const COMPARISON: &str =
    include_str!("../../../fixtures/comparison/suites.csv");

/// Measures by their names in the comparison, with the recorded standard
/// deviation of the logarithm: of Tm from `rocking records`, of the others
/// as the suite is conditioned on it.
const COMPARED: [(&str, f64); 9] = [
    ("pga_g", 0.524),
    ("pgv_m_s", 0.597),
    ("mean_period_s", 0.421),
    ("significant_duration_5_75_s", 0.598),
    ("sa_0.3_g", 0.565),
    ("sa_0.5_g", 0.682),
    ("sa_1_g", 0.774),
    ("sa_2_g", 0.835),
    ("sa_3_g", 0.858),
];

fn recorded_median(name: &str) -> f64 {
    let row = COMPARISON
        .lines()
        .find(|line| line.starts_with(&format!("ordinary,motion,{name},")));
    row.and_then(|row| row.split(',').nth(12)?.parse().ok())
        .expect("a recorded median")
}

fn measured(motion: &Accelerogram) -> [f64; COMPARED.len()] {
    let periods = vec![0.3, 0.5, 1.0, 2.0, 3.0];
    let settings = Settings::try_new(9.80665, 0.05, periods);
    let m = Measures::of(motion, &settings.expect("settings"));
    let m = m.expect("a motion");
    let [a, b, c, d, e] = m.spectral_acceleration_g[..] else { panic!() };
    let t = m.mean_period_s.expect("frequencies");
    let d5_75 = m.significant_duration_5_75_s;
    [m.pga_g, m.pgv_m_s, t, d5_75, a, b, c, d, e]
}

/// Logarithms of the measures of the study components.
static SUITE: LazyLock<Vec<[f64; COMPARED.len()]>> = LazyLock::new(|| {
    let pairs = ordinary().expect("suite");
    let of = |m| measured(m).map(libm::log);
    pairs.iter().map(|pair| of(&pair.components[0])).collect()
});

fn middle(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    0.5 * (sorted[(n - 1) / 2] + sorted[n / 2])
}

#[test]
fn motions_have_the_recorded_medians_and_dispersions() {
    // 15 and 20 %: 1.6 and 2.6 standard errors of a sample of 86 with a
    // dispersion of 0.8, and less than what other choices of records with
    // the same criteria would change. The site-based model that this suite
    // had before fails by PGA 0.67, PGV 0.60, Tm 0.54 and SA(0.5 s) 0.40.
    for (k, (name, deviation)) in COMPARED.iter().enumerate() {
        let own: Vec<f64> = SUITE.iter().map(|m| m[k]).collect();
        let ratio = libm::exp(middle(&own)) / recorded_median(name);
        assert!((0.85..=1.15).contains(&ratio), "{name}: median {ratio}");
        let ratio = moments(&own)[1] / deviation;
        assert!((0.8..=1.2).contains(&ratio), "{name}: dispersion {ratio}");
    }
}

#[test]
fn without_conditioning_the_relations_miss_the_recorded_medians() {
    // The named wrong model: the published relations alone. Records chosen
    // for strong motion have more at 0.5 and 1 s than their scenario's
    // median, so that the tolerance of the test above must refuse it.
    let drawn: Vec<Target> = (1..=86)
        .map(|pair| {
            targets::draw(ORDINARY_SEED, &super::earthquakes(), 0, pair, 0)
        })
        .collect();
    for period in [0.5, 1.0] {
        let k = PERIODS_S.iter().position(|t| *t == period).expect("period");
        let own: Vec<f64> = drawn.iter().map(|t| t.components[0][k]).collect();
        let ratio = libm::exp(middle(&own))
            / recorded_median(&format!("sa_{period}_g"));
        assert!(ratio < 0.85, "{period} s: {ratio}");
    }
}

#[test]
fn targets_have_exactly_the_moments_they_are_conditioned_on() {
    let targets = targets::conditioned(ORDINARY_SEED, &super::earthquakes())
        .expect("targets");
    for (k, [mean, deviation, ..]) in RECORDED.iter().enumerate() {
        let own: Vec<f64> =
            targets.iter().map(|t| t.components[0][k]).collect();
        let [m, s] = moments(&own);
        assert!((m - libm::log(*mean)).abs() < 1e-12, "{k}: {m}");
        assert!((s - deviation).abs() < 1e-12, "{k}: {s}");
    }
    let weakest = targets.iter().flat_map(|t| t.components.map(|c| c[0]));
    assert!(weakest.fold(0.0, f64::min) > libm::log(0.14));
}

#[test]
fn periods_are_correlated_as_published() {
    // Above 0.109 s the relation is 1 - sin(0.366 ln(T2/T1)).
    let e = std::f64::consts::E;
    let exact = 1.0 - libm::sin(0.366);
    assert!((between_periods(1.0, e) - exact).abs() < 1e-15);
    assert_eq!(between_periods(0.3, 2.0), between_periods(2.0, 0.3));
    for period in PERIODS_S {
        assert!((between_periods(period, period) - 1.0).abs() < 1e-12);
    }
    // Independence, the wrong model, would have 0 here; Baker and Jayaram's
    // Figure 3 has about 0.7 between PGA and 0.5 s.
    let rho = between_periods(0.01, 0.5);
    assert!((0.6..0.75).contains(&rho), "{rho}");
    assert_eq!(targets::factor().len(), QUANTITIES - 1);
}

#[test]
fn the_median_grows_and_falls_as_physics_has_it() {
    let scenario = Scenario {
        earthquake: 1,
        mw: 6.9,
        rrup_km: 15.0,
        vs30_m_s: 380.0,
        reverse: false,
        towards_site_km: 0.0,
    };
    let here = median(&scenario);
    let far = median(&Scenario { rrup_km: 40.0, ..scenario });
    let larger = median(&Scenario { mw: 7.5, ..scenario });
    let rock = median(&Scenario { vs30_m_s: 760.0, ..scenario });
    for k in 0..PGV {
        assert!(far[k] < here[k] && larger[k] > here[k] && rock[k] < here[k]);
    }
    // Boore, Stewart, Seyhan and Atkinson (2014) give 0.25 g, rounded, for
    // this scenario; relations of that generation differ by a quarter, those
    // with acceleration in m/s2 or natural for decimal logarithms by much
    // more.
    let pga_g = libm::exp(here[0]);
    assert!((0.19..0.32).contains(&pga_g), "{pga_g}");
}

#[test]
fn the_envelope_has_its_duration_and_unit_energy() {
    let envelope = Envelope::of(6.5, 2.0);
    let d5_75 = envelope.time_s(0.75) - envelope.time_s(0.05);
    assert!((d5_75 - 6.5).abs() < 1e-9);
    let energy = (0..20_000).fold(0.0, |s, k| {
        let e = envelope.value(f64::from(k) * 0.005);
        s + 0.005 * e * e
    });
    assert!((energy - 1.0).abs() < 1e-5, "{energy}");
}

#[test]
fn the_fast_oscillator_agrees_with_the_core_from_below() {
    // The fast one looks at samples only: at most 1 - cos(pi/10), 5 %, low
    // at 0.1 s. An oscillator without damping would be high.
    let pairs = ordinary().expect("suite");
    for period in [0.1, 0.5, 2.0] {
        let motion = &pairs[0].components[0];
        let settings = Settings::try_new(9.80665, 0.05, vec![period]);
        let core = Measures::of(motion, &settings.expect("settings"));
        let core = core.expect("motion").spectral_acceleration_g[0];
        let ratio = matched_peak(period, motion.samples_g()) / core;
        assert!((0.95..=1.0 + 1e-9).contains(&ratio), "{period}: {ratio}");
    }
}

#[test]
fn debug_targets() {
    use super::attenuation::*;
    use super::waves::*;
    let targets =
        targets::conditioned(ORDINARY_SEED, &super::earthquakes()).unwrap();
    let pairs = ordinary().unwrap();
    let col = |k: usize| -> Vec<f64> {
        targets.iter().map(|t| t.components[0][k]).collect()
    };
    let ach = |k: usize| -> Vec<f64> {
        pairs
            .iter()
            .map(|p| achieved(k, p.components[0].samples_g()))
            .collect()
    };
    let corr = |a: &[f64], b: &[f64]| {
        let ([ma, sa], [mb, sb]) = (moments(a), moments(b));
        a.iter().zip(b).map(|(x, y)| (x - ma) * (y - mb)).sum::<f64>()
            / (a.len() as f64 - 1.0)
            / sa
            / sb
    };
    let (p, v) = (col(0), col(PGV));
    let (pa, va) = (ach(0), ach(PGV));
    for k in 0..QUANTITIES {
        let x = col(k);
        let r: Vec<f64> = x.iter().zip(&v).map(|(a, b)| a - b).collect();
        let mut line = format!(
            "{:5} target: mean {:.4} sd {:.3} sd/PGV {:.3} rPGA {:.3} rPGV {:.3}",
            PERIODS_S.get(k).copied().unwrap_or(0.0),
            moments(&x)[0].exp(),
            moments(&x)[1],
            moments(&r)[1],
            corr(&x, &p),
            corr(&x, &v)
        );
        if k <= PGV {
            let y = ach(k);
            let m: Vec<f64> = y.iter().zip(&x).map(|(a, b)| a - b).collect();
            let r: Vec<f64> = y.iter().zip(&va).map(|(a, b)| a - b).collect();
            line += &format!(
                " | achieved sd {:.3} sd/PGV {:.3} rPGA {:.3} rPGV {:.3} miss mean {:.3} sd {:.3} share>.05 {:.2} max {:.2}",
                moments(&y)[1],
                moments(&r)[1],
                corr(&y, &pa),
                corr(&y, &va),
                moments(&m)[0],
                moments(&m)[1],
                m.iter().filter(|e| e.abs() > 0.05).count() as f64 / 86.0,
                m.iter().fold(0.0f64, |a, e| a.max(e.abs()))
            );
        }
        println!("{line}");
    }
}
