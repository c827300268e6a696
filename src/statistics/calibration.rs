//! Simulated truths: what the tests and intervals do when the answer is
//! known.
//!
//! Every bound follows from the numbers of trials, ours and the reference's,
//! at [`SIGMAS`] combined standard errors: a false alarm in 16,000 checks
//! each (two-sided). The reference rates are an independent simulation's,
//! rounded to the digits given.

use libm::{exp, log, log1p};
use rayon::prelude::*;

use super::boxplot::median_interval;
use super::lilliefors::{Statistic, Table};
use super::lognormal::{FitMethod, fit};
use super::normality::{anderson_darling, cramer_von_mises, shapiro_wilk};
use super::paired::{equivalence, hodges_lehmann};
use super::sample::{mean, sum_of_squares};
use super::{Boxplot, ExtendedSample, QuantileType, Sample};
use crate::streams::{Streams, standard_normal};

const SIGMAS: f64 = 4.0;

/// Applies `f` to `trials` samples of n standard normals, by index.
fn simulate<T: Send>(
    name: &str,
    n: usize,
    trials: u64,
    f: impl Fn(&[f64]) -> T + Sync,
) -> Vec<T> {
    let streams = Streams::new(name, 0);
    (0..trials)
        .into_par_iter()
        .map(|index| {
            let mut stream = streams.stream(index);
            let z: Vec<f64> =
                (0..n).map(|_| standard_normal(&mut stream)).collect();
            f(&z)
        })
        .collect()
}

/// Asserts a rate of `outcomes` against one known from `reference` trials
/// (0 for exact) and rounded to within `rounding`.
fn assert_rate(
    what: &str,
    outcomes: &[bool],
    rate: f64,
    reference: u64,
    rounding: f64,
) {
    let trials = outcomes.len() as f64;
    let ours = outcomes.iter().filter(|x| **x).count() as f64 / trials;
    let spread = rate * (1.0 - rate);
    let theirs = if reference == 0 { 0.0 } else { spread / reference as f64 };
    let bound = SIGMAS * (spread / trials + theirs).sqrt() + rounding;
    assert!((ours - rate).abs() <= bound, "{what}: {ours} against {rate}");
}

fn rejects(values: &[f64]) -> [bool; 4] {
    let sample = Sample::try_new(values).unwrap();
    let n = sample.len();
    let critical = Table::embedded().critical_value(n, 0.05).unwrap().0;
    [
        Statistic::try_new(&sample).unwrap().d > critical,
        anderson_darling(&sample).unwrap().p_value < 0.05,
        cramer_von_mises(&sample).unwrap().p_value < 0.05,
        shapiro_wilk(&sample).unwrap().p_value < 0.05,
    ]
}

const TESTS: [&str; 4] = ["D", "A2", "W2", "SW"];

fn assert_tests(
    name: &str,
    n: usize,
    truth: impl Fn(f64) -> f64 + Sync,
    rates: [f64; 4],
    reference: u64,
    rounding: f64,
) {
    let all = simulate(name, n, 10_000, |z| {
        let values: Vec<f64> = z.iter().map(|&z| truth(z)).collect();
        rejects(&values)
    });
    for (i, test) in TESTS.iter().enumerate() {
        let outcomes: Vec<bool> = all.iter().map(|r| r[i]).collect();
        let what = format!("{name}, n = {n}, {test}");
        // The last one's reference had 3000 trials.
        let reference = if i == 3 { reference.min(3000) } else { reference };
        assert_rate(&what, &outcomes, rates[i], reference, rounding);
    }
}

#[test]
fn tests_keep_their_level_under_normality() {
    for n in [12, 44, 86] {
        // The published approximations of p are good to about 0.002 here.
        assert_tests("size", n, |z| z, [0.05; 4], 0, 0.002);
    }
}

#[test]
fn power_agrees_with_an_independent_simulation() {
    // Unshifted tests where the truth is a shifted lognormal.
    let half = |z: f64| log1p(0.5 * exp(0.5 * z));
    let one = |z: f64| log1p(exp(0.8 * z));
    let trials = 20_000;
    for (n, rates) in
        [(44, [0.33, 0.47, 0.42, 0.58]), (86, [0.58, 0.79, 0.71, 0.88])]
    {
        assert_tests("1 + 0.5 exp(0.5 z)", n, half, rates, trials, 0.005);
    }
    for (n, rates) in
        [(44, [0.41, 0.60, 0.52, 0.72]), (86, [0.72, 0.91, 0.85, 0.96])]
    {
        assert_tests("1 + exp(0.8 z)", n, one, rates, trials, 0.005);
    }
}

#[test]
fn the_grid_alone_rejects_a_true_shifted_lognormal() {
    // Intensities 1 + 0.9 exp(0.6 z) put on the next level of the 0.01 g
    // grid, 86 records: the shifted test at nominal 5 %.
    let critical = Table::embedded().critical_value(86, 0.05).unwrap().0;
    for (alpha_rad, rate) in [(0.05, 0.91), (0.10, 0.30), (0.25, 0.088)] {
        let step = 0.01 / libm::tan(alpha_rad);
        let outcomes = simulate("grid", 86, 4000, |z| {
            let on_grid = |z: &f64| {
                let im = 1.0 + 0.9 * exp(0.6 * z);
                log((im / step).ceil() * step - 1.0)
            };
            let values: Vec<f64> = z.iter().map(on_grid).collect();
            let sample = Sample::try_new(&values).unwrap();
            Statistic::try_new(&sample).unwrap().d > critical
        });
        let what = format!("grid at alpha = {alpha_rad}");
        assert_rate(&what, &outcomes, rate, 4000, 0.005);
    }
}

#[test]
fn the_notch_covers_a_median_less_often_than_the_exact_interval() {
    let covers = simulate("notch", 86, 20_000, |z| {
        let sample = ExtendedSample::try_new(z).unwrap();
        let quantile_type = QuantileType::default();
        let boxplot = Boxplot::try_new(&sample, quantile_type).unwrap();
        let interval = median_interval(&sample, 0.95).unwrap();
        (
            boxplot.notch_low <= 0.0 && boxplot.notch_high >= 0.0,
            interval.low <= 0.0 && interval.high >= 0.0,
        )
    });
    let (notch, exact): (Vec<bool>, Vec<bool>) = covers.into_iter().unzip();
    assert_rate("McGill notch", &notch, 0.907, 20_000, 0.0005);
    // 1 - 2 P(B <= 33), B binomial (86, 1/2); ranks 34 and 53.
    assert_rate("exact interval", &exact, 0.960_1, 0, 0.0001);
}

#[test]
fn trimming_biases_the_dispersion_and_censoring_does_not() {
    let quantile_type = QuantileType::default();
    let beta = 0.6;
    let fits = simulate("trimming", 86, 10_000, |z| {
        let values: Vec<f64> = z.iter().map(|z| exp(beta * z)).collect();
        let sample = ExtendedSample::try_new(&values).unwrap();
        let by = |method| fit(&sample, 0.0, method).unwrap().distribution;
        let trimmed = by(FitMethod::Trimmed(quantile_type));
        let censored = by(FitMethod::Censored(quantile_type));
        [
            trimmed.dispersion() / beta,
            trimmed.log_mean() / beta,
            censored.dispersion() / beta,
            censored.log_mean() / beta,
        ]
    });
    // -9.4 % and -0.099 beta (independent simulation); none for censoring,
    // but for the divisor n's own -0.9 %.
    for (i, (expected, slack)) in
        [(0.906, 0.0005), (-0.099, 0.0005), (0.991, 0.003), (0.0, 0.003)]
            .into_iter()
            .enumerate()
    {
        let column: Vec<f64> = fits.iter().map(|row| row[i]).collect();
        let trials = column.len() as f64;
        let error = (sum_of_squares(&column) / trials / trials).sqrt();
        let gap = (mean(&column) - expected).abs();
        assert!(gap <= SIGMAS * error + slack, "{i}: {}", mean(&column));
    }
}

#[test]
fn paired_procedures_keep_their_levels() {
    let margin = 0.05;
    let found = simulate("paired", 30, 20_000, |z| {
        // On the edge of equivalence, and centred at a ratio of 1.1.
        let edge: Vec<f64> =
            z.iter().map(|z| exp(log1p(margin) + 0.03 * z)).collect();
        let moved: Vec<f64> = z.iter().map(|z| 1.1 * exp(0.2 * z)).collect();
        let centre = hodges_lehmann(&moved).unwrap();
        (
            equivalence(&edge, margin).unwrap().p_value < 0.05,
            centre.low <= 1.1 && centre.high >= 1.1,
        )
    });
    let (equivalent, covers): (Vec<bool>, Vec<bool>) =
        found.into_iter().unzip();
    assert_rate("equivalence on the edge", &equivalent, 0.05, 0, 0.0);
    // The exact interval of 30 is discrete: P(V <= 137) = 0.0249.
    assert_rate("Hodges-Lehmann interval", &covers, 0.95, 0, 0.002);
}
