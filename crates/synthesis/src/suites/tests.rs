//! Tests of the suites: published relations at points known from elsewhere,
//! and moments of the suites beside the recorded ones.

use std::sync::LazyLock;

use rocking_records::intensity::{Measures, Settings};

use super::{ORDINARY, PULSE};
use crate::attenuation::{
    DURATION, PERIODS_S, PGV, QUANTITIES, between_periods, median,
    with_velocity,
};
use crate::moments::{Moments, moments};
use crate::pair::{Pair, Scenario, SynthesisError};
use crate::peaks::Peak;
use crate::targets::{self, Design};
use crate::waves::Envelope;

/// Pairs of both suites, and logarithms of the quantities of the study
/// components as the core measures them.
type Made = (Vec<Pair>, Vec<[f64; QUANTITIES]>);
pub static MADE: LazyLock<[Made; 2]> = LazyLock::new(|| {
    [&ORDINARY, &PULSE].map(|suite| {
        let pairs = super::pairs(suite).expect("suite");
        let measured = pairs.iter().map(measured).collect();
        (pairs, measured)
    })
});

fn measured(pair: &Pair) -> [f64; QUANTITIES] {
    let settings = Settings::try_new(9.80665, 0.05, PERIODS_S[1..].to_vec());
    let m = Measures::of(&pair.components[0], &settings.expect("settings"));
    let m = m.expect("a motion");
    let mut out = [m.pga_g; QUANTITIES];
    out[1..PGV].copy_from_slice(&m.spectral_acceleration_g);
    out[PGV] = m.pgv_m_s;
    out[DURATION] = m.significant_duration_5_75_s;
    out.map(libm::log)
}

fn column(sample: &[[f64; QUANTITIES]], k: usize) -> Vec<f64> {
    sample.iter().map(|v| v[k]).collect()
}

fn correlation(sample: &[[f64; QUANTITIES]], j: usize, k: usize) -> f64 {
    let (x, y) = (column(sample, j), column(sample, k));
    let ([mx, sx], [my, sy]) = (moments(&x), moments(&y));
    let products = x.iter().zip(&y).map(|(x, y)| (x - mx) * (y - my));
    products.fold(0.0, |s, x| s + x) / (x.len() as f64 - 1.0) / (sx * sy)
}

/// Geometric mean, standard deviation, correlation with PGA and with PGV.
fn four(sample: &[[f64; QUANTITIES]], k: usize) -> [f64; 4] {
    let [mean, deviation] = moments(&column(sample, k));
    let [with_pga, with_pgv] = [0, PGV].map(|j| correlation(sample, j, k));
    [libm::exp(mean), deviation, with_pga, with_pgv]
}

#[test]
fn motions_have_the_recorded_moments() {
    // What the targets exclude themselves is left, most of it from 3 s on.
    // Motions scaled to their PGV at the end, with half of PGA's miss
    // corrected, fail: PGA and SA(0.5 s) are correlated by 0.86 there, and
    // SA(2 s) is high by 14 %. So does the near-fault model without
    // conditions, where PGA and SA(1 s) are correlated by 0.81 for 0.46.
    for (suite, (_, sample)) in [&ORDINARY, &PULSE].into_iter().zip(&*MADE) {
        for k in 0..=PGV {
            let name = format!("{} {k}", suite.name);
            let [mean, deviation, a, v] = four(sample, k);
            let [mean_wanted, wanted, with_pga, with_pgv] = suite.recorded[k];
            let ratio = mean / mean_wanted;
            assert!((0.95..=1.1).contains(&ratio), "{name}: mean {ratio}");
            let ratio = deviation / wanted;
            assert!((0.9..=1.1).contains(&ratio), "{name}: deviation {ratio}");
            assert!((a - with_pga).abs() < 0.1, "{name} with PGA: {a}");
            assert!((v - with_pgv).abs() < 0.1, "{name} with PGV: {v}");
        }
        let [mean, deviation, ..] = four(sample, DURATION);
        let [wanted, spread, ..] = suite.recorded[DURATION];
        assert!((0.8..=1.2).contains(&(mean / wanted)), "{mean}");
        assert!((0.8..=1.3).contains(&(deviation / spread)), "{deviation}");
    }
}

#[test]
fn average_accelerations_over_pga_are_the_recorded_ones() {
    // p in rad/s; of the recorded average spectral acceleration over PGA the
    // geometric mean, the median and the deviation of the logarithm, as the
    // example prints them. Lognormal targets, the motions before these, have
    // means of 0.93 to 0.97 and medians of 0.79 to 0.96 of the recorded ones.
    #[rustfmt::skip]
    let recorded = [
        [
            (1.0, 0.2404, 0.2750, 0.725),
            (2.0, 0.6557, 0.7304, 0.596),
            (3.0, 1.0392, 1.1764, 0.493),
            (4.0, 1.3456, 1.5044, 0.403),
            (6.0, 1.6987, 1.8159, 0.284),
        ],
        [
            (1.0, 0.4400, 0.4932, 0.728),
            (2.0, 0.9746, 1.1071, 0.507),
            (3.0, 1.3019, 1.4152, 0.402),
            (4.0, 1.5175, 1.6040, 0.333),
            (6.0, 1.7312, 1.7883, 0.242),
        ],
    ];
    for ((pairs, _), rows) in MADE.iter().zip(recorded) {
        for (p, mean_wanted, median_wanted, wanted) in rows {
            let periods = (0..10).map(|i| {
                std::f64::consts::TAU / p * libm::pow(0.15, f64::from(i) / 9.0)
            });
            let settings = Settings::try_new(9.80665, 0.05, periods.collect());
            let settings = settings.expect("settings");
            let ratio = |pair: &Pair| {
                let m = Measures::of(&pair.components[0], &settings);
                let m = m.expect("a motion");
                let ln =
                    m.spectral_acceleration_g.iter().map(|x| libm::log(*x));
                ln.sum::<f64>() / 10.0 - libm::log(m.pga_g)
            };
            let mut ratios: Vec<f64> = pairs.iter().map(ratio).collect();
            let [mean, deviation] = moments(&ratios);
            ratios.sort_by(f64::total_cmp);
            let n = ratios.len();
            let median = 0.5 * (ratios[n / 2 - 1] + ratios[n / 2]);
            let mean = libm::exp(mean) / mean_wanted;
            assert!((0.975..=1.025).contains(&mean), "{p}: mean {mean}");
            let median = libm::exp(median) / median_wanted;
            assert!((0.93..=1.06).contains(&median), "{p}: median {median}");
            let ratio = deviation / wanted;
            assert!((0.9..=1.1).contains(&ratio), "{p}: deviation {ratio}");
        }
    }
}

#[test]
fn pgv_is_not_late_after_pga() {
    // In the median, over D5-75: -0.01 of the recorded ordinary motions.
    // Causal filters of the bands give 0.12.
    let mut late: Vec<f64> = MADE[0]
        .0
        .iter()
        .zip(&MADE[0].1)
        .map(|(pair, measured)| {
            let samples = pair.components[0].samples_g();
            let at = |k: usize| Peak::of(k).found(samples).at as f64 * 0.01;
            (at(PGV) - at(0)) / libm::exp(measured[DURATION])
        })
        .collect();
    late.sort_by(f64::total_cmp);
    let middle = 0.5 * (late[42] + late[43]);
    assert!(middle.abs() < 0.05, "{middle}");
}

#[test]
fn earthquakes_have_the_listed_pairs() {
    for (suite, (pairs, _)) in [&ORDINARY, &PULSE].into_iter().zip(&*MADE) {
        for (i, (count, mw, reverse)) in suite.earthquakes.iter().enumerate() {
            let own: Vec<&Scenario> = pairs
                .iter()
                .map(|pair| &pair.scenario)
                .filter(|s| s.earthquake == i as u64 + 1)
                .collect();
            assert_eq!(own.len(), *count);
            assert!(own.iter().all(|s| s.mw == *mw && s.reverse == *reverse));
        }
    }
}

#[test]
fn pairs_of_an_earthquake_are_alike_beyond_their_scenario() {
    // Of the deviations' variance 0.41 is between earthquakes for PGA, as
    // Cauzzi et al. have it; independent pairs would have nothing in common.
    let many: Vec<f64> = (0..400)
        .flat_map(|earthquake: u64| {
            let suite =
                Design { earthquakes: &[(2, 7.0, false); 400], ..ORDINARY };
            let [x, y] = [1, 2].map(|pair| {
                let pair = 2 * earthquake + pair;
                let t = targets::draw(&suite, earthquake as usize, pair, 0);
                t.components[0][0] - median(&t.scenario)[0]
            });
            [x * y, 0.5 * (x * x + y * y)]
        })
        .collect();
    let [products, squares] =
        [0, 1].map(|k| many.iter().skip(k).step_by(2).fold(0.0, |s, x| s + x));
    let shared = products / squares;
    assert!((shared - 0.41).abs() < 0.12, "{shared}");
}

#[test]
fn without_conditioning_the_relations_miss_the_recorded_means() {
    // The named wrong model: the published relations alone. Records chosen
    // for strong motion have more at 0.5 and 1 s than their scenario's
    // median, so that the tolerance of the test above must refuse it.
    let drawn: Vec<[f64; QUANTITIES]> = (1..=86)
        .map(|pair| {
            targets::draw(&ORDINARY, pair as usize % 22, pair, 0).components[0]
        })
        .collect();
    for period in [0.5, 1.0] {
        let k = PERIODS_S.iter().position(|t| *t == period).expect("period");
        let ratio = four(&drawn, k)[0] / ORDINARY.recorded[k][0];
        assert!(ratio < 0.93, "{period} s: {ratio}");
    }
}

#[test]
fn targets_have_exactly_the_moments_they_are_conditioned_on() {
    for suite in [&ORDINARY, &PULSE] {
        let targets = targets::conditioned(suite).expect("targets");
        let sample: Vec<_> = targets.iter().map(|t| t.components[0]).collect();
        for (k, wanted) in suite.recorded.iter().enumerate() {
            for (own, wanted) in four(&sample, k).iter().zip(wanted) {
                assert!((own - wanted).abs() < 1e-12, "{k}: {own} {wanted}");
            }
        }
        let weakest = targets.iter().flat_map(|t| t.components.map(|c| c[0]));
        assert!(weakest.fold(0.0, f64::min) > libm::log(0.14));
    }
}

#[test]
fn a_suite_that_cannot_be_strong_is_refused() {
    static WEAK: LazyLock<Moments> = LazyLock::new(|| {
        let mut weak = *ORDINARY.recorded;
        weak[0][0] = 0.05;
        weak
    });
    let suite = Design { recorded: &WEAK, ..ORDINARY };
    let error = targets::conditioned(&suite).expect_err("too weak");
    assert!(matches!(error, SynthesisError::Weak { .. }), "{error}");
    assert!(error.to_string().contains("in 100 draws"), "{error}");
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
    assert_eq!(targets::factor().len(), QUANTITIES);
    // Bradley's relation at 1 s: 0.78 + 0.02 tanh(3 ln 1.1), times 0.92.
    let x = 3.0 * libm::log(1.1);
    let exact = 0.92 * (0.78 + 0.02 * libm::tanh(x));
    assert!((with_velocity(1.0) - exact).abs() < 1e-15);
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
    for k in 0..=PGV {
        assert!(far[k] < here[k] && larger[k] > here[k] && rock[k] < here[k]);
    }
    // Boore, Stewart, Seyhan and Atkinson (2014) give 0.25 g, rounded, for
    // this scenario; relations of that generation differ by a quarter, those
    // with acceleration in m/s2 or natural for decimal logarithms by much
    // more.
    // Their PGV is 0.26 m/s.
    let pgv_m_s = libm::exp(here[PGV]);
    assert!((0.19..0.35).contains(&pgv_m_s), "{pgv_m_s}");
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
fn the_fast_peaks_agree_with_the_core_from_below() {
    // The fast ones look at samples only: at most 1 - cos(pi/10), 5 %, low
    // at 0.1 s; and begin at rest one sample earlier. An oscillator without
    // damping would be high.
    let (pairs, measured) = &MADE[0];
    let samples = pairs[0].components[0].samples_g();
    for (k, ln) in measured[0].iter().enumerate().take(PGV + 1) {
        let ratio = Peak::of(k).found(samples).size / libm::exp(*ln);
        assert!((0.95..=1.003).contains(&ratio), "{k}: {ratio}");
    }
}

#[test]
fn a_peak_is_the_sum_of_its_weights_times_the_samples() {
    // An oscillator's memory ends at a hundredth.
    let samples = MADE[1].0[0].components[0].samples_g();
    for k in 0..=PGV {
        let peak = Peak::of(k);
        let found = peak.found(samples);
        let weights = peak.weights(&found);
        let upto = &samples[..=found.at];
        let value = weights
            .iter()
            .rev()
            .zip(upto.iter().rev())
            .fold(0.0, |sum, (w, x)| sum + w * x);
        let ratio = value / found.size;
        assert!((ratio - 1.0).abs() < 0.03, "{k}: {ratio}");
    }
}
