//! Lilliefors' test: null distribution, table, published values, draws.

use std::f64::consts::{LN_2, PI};

use anyhow::{Context as _, Result, bail};
use nalgebra::{DMatrix, DVector};
use rand_distr::{Distribution as _, StandardNormal};
use rocking_statistics::lilliefors::{LillieforsTable, Statistic};
use rocking_statistics::streams::{Streams, standard_normal};
use rocking_statistics::{Sample, normal};

use super::truths::{StreamRng, trials};
use crate::methods::cells::Csv;
use crate::methods::method::{Context, Reply, WrongModel};

const EXACT: Csv = Csv::new("oracles/lilliefors_exact.csv");
const MEANS: Csv = Csv::new("oracles/lilliefors_mean.csv");

/// Simulated critical values against the exact ones, in units of both
/// errors together; and the range of D.
pub fn null(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        n: usize, replicates: u64,
        /// Error of the exact values.
        error: f64,
    }
    let streams = Streams::new("case, lilliefors null", 0);
    let mut statistics = trials(replicates, |index| {
        let mut stream = streams.stream(index);
        let z = (0..n).map(|_| standard_normal(&mut stream));
        let sample = Sample::try_new(&z.collect::<Vec<f64>>())?;
        let s = Statistic::try_new(&sample)?;
        Ok(match context.wrong {
            Some(WrongModel::UpperSideOnly) => s.d_plus,
            // D of scores that are too long by sqrt(n/(n - 1)).
            Some(WrongModel::OtherDivisor) => with_divisor_n(&sample),
            _ => s.d,
        })
    })?;
    statistics.sort_by(f64::total_cmp);
    let count = statistics.len() as f64;
    let at = |rank: f64| statistics[rank.clamp(1.0, count) as usize - 1];
    for row in EXACT.rows(&n.to_string())? {
        let [level, exact] = row.numbers(1)?;
        let rank = ((1.0 - level) * (count + 1.0)).ceil();
        let span = (0.2 * level.min(1.0 - level) * count).ceil();
        let spread = (level * (1.0 - level) * count).sqrt();
        let slope = (at(rank + span) - at(rank - span)) / (2.0 * span);
        let own = (spread * slope).max(error);
        let gap = (at(rank) - exact) / (own + error);
        answer.put("standardised-gap", [gap], [0.0]);
    }
    let largest = at(count) / Statistic::largest(n);
    answer.see("largest-of-all", [largest]);
    Ok(())
}

fn with_divisor_n(sample: &Sample) -> f64 {
    let n = sample.len() as f64;
    let deviation = (sample.sum_of_squares() / n).sqrt();
    let mean = sample.mean();
    sample.sorted().iter().enumerate().fold(0.0, |d: f64, (i, y)| {
        let f = normal::cdf((y - mean) / deviation);
        let i = i as f64;
        d.max((i + 1.0) / n - f).max(f - i / n)
    })
}

/// The largest possible D, by its formula and by the sample that attains it.
pub fn largest(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; n: Vec<usize>);
    for n in n {
        let expected = Statistic::largest(n);
        answer.see("largest", [expected]);
        // k values at one place, the others at another, for the best k.
        let mut attained: f64 = 0.0;
        for k in 1..n {
            let values = (0..n).map(|i| f64::from(i >= k));
            let sample = Sample::try_new(&values.collect::<Vec<f64>>())?;
            let s = Statistic::try_new(&sample)?;
            let smaller = s.d_minus.min(s.d_plus);
            let d = context.or(WrongModel::UpperSideOnly, smaller, s.d);
            attained = attained.max(d);
        }
        answer.put("attained", [attained], [expected]);
    }
    Ok(())
}

/// The mean of D from the table against that of an independent simulation,
/// in its standard errors and the table's own error.
pub fn mean(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        n: Vec<usize>,
        /// Error of the table's mean.
        error: f64,
    }
    for n in n {
        // The mean of the fully specified distribution, for large n.
        let known = (0.5 * PI / n as f64).sqrt() * LN_2;
        let table = LillieforsTable::embedded().mean(n)?;
        let ours = context.or(WrongModel::PlainKolmogorov, known, table);
        for row in MEANS.rows(&n.to_string())? {
            let [known, own] = row.numbers(1)?;
            let gap = (ours - known) / (own + error);
            answer.put("standardised-gap", [gap], [0.0]);
        }
    }
    Ok(())
}

/// The table against an independent simulation, in combined standard
/// errors.
pub fn table(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        n: Vec<usize>, levels: Vec<f64>,
        /// By size, then by level.
        values: Vec<Vec<f64>>,
        /// Half a unit of the last digit printed.
        rounding: f64,
        /// By size, then by level.
        errors: Vec<Vec<f64>>,
    }
    let table = LillieforsTable::embedded();
    for ((n, values), errors) in n.iter().zip(&values).zip(&errors) {
        for ((level, value), error) in levels.iter().zip(values).zip(errors) {
            let (mut ours, own) = table.critical_value(*n, *level)?;
            if context.is(WrongModel::PlainKolmogorov) {
                // Asymptotic points of the fully specified distribution.
                ours = (-0.5 * libm::log(0.5 * level) / *n as f64).sqrt();
            } else if context.is(WrongModel::InterpolatedInN) {
                ours = linear_in_n(*n, *level)?;
            }
            let both = (own * own + error * error).sqrt() + rounding;
            let gap = (ours - value) / both;
            answer.put("standardised-gap", [gap], [0.0]);
        }
    }
    for n in [44, 86] {
        let (_, own) = table.critical_value(n, 0.05)?;
        answer.see("own-error", [own]);
    }
    Ok(())
}

/// Critical value, linear in n between the sizes of a usual table.
fn linear_in_n(n: usize, level: f64) -> Result<f64> {
    let sizes = [4, 5, 6, 7, 8, 9, 10, 15, 20, 30, 50, 100, 200, 400, 900];
    let i = sizes.partition_point(|size| *size < n).clamp(1, sizes.len() - 1);
    let (low, high) = (sizes[i - 1], sizes[i]);
    let at = |n| LillieforsTable::embedded().critical_value(n, level);
    let share = (n as f64 - low as f64) / (high as f64 - low as f64);
    let (a, b) = (at(low)?.0, at(high)?.0);
    Ok(f64::mul_add(share, b - a, a))
}

/// True level of tests that use published critical values.
pub fn published(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Names of the sources.
        sources: Vec<String>,
        n: Vec<usize>, values: Vec<f64>,
    }
    if sources.len() != values.len() {
        bail!("sources and values");
    }
    for (n, value) in n.iter().zip(&values) {
        let p = LillieforsTable::embedded().p_value(*n, *value)?.estimate;
        let known = 2.0 * libm::exp(-2.0 * *n as f64 * value * value);
        let p = context.or(WrongModel::PlainKolmogorov, known, p.value());
        answer.see("true-level", [p]);
    }
    for level in [0.1, 0.05, 0.01, 0.001] {
        let own = linear_in_n(86, level)?;
        let own = context.or(WrongModel::PlainKolmogorov, 0.0, own);
        answer.see("interpolated-in-n-at-86", [own]);
    }
    Ok(())
}

/// c0 of D = c0/sqrt(n) - c1/n - c2/n^1.5, fitted to the table by weighted
/// least squares, and the largest residual in standard errors.
pub fn asymptotics(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; levels: Vec<f64>, least_n: usize);
    let sizes = LillieforsTable::sizes().into_iter().map(|(n, _)| n);
    let sizes: Vec<usize> = sizes.filter(|n| *n >= least_n).collect();
    let terms = context.or(WrongModel::TwoTerms, 2, 3);
    for level in levels {
        let table = LillieforsTable::embedded();
        let known = sizes.iter().map(|n| table.critical_value(*n, level));
        let known = known.collect::<Result<Vec<(f64, f64)>, _>>()?;
        let row = |i: usize, k: usize| {
            let root = (sizes[i] as f64).sqrt();
            let terms = [root, -(root * root), -(root * root * root)];
            1.0 / terms[k] / known[i].1
        };
        let matrix = DMatrix::from_fn(sizes.len(), terms, row);
        let right = known.iter().map(|(value, error)| value / error);
        let right = DVector::from_iterator(sizes.len(), right);
        let factors = matrix.clone().qr();
        let coefficients = factors
            .r()
            .solve_upper_triangular(&(factors.q().transpose() * &right))
            .context("singular")?;
        let misfit = (matrix * &coefficients - right).norm_squared()
            / (sizes.len() - terms) as f64;
        answer.see("c0", [coefficients[0]]);
        answer.see("mean-square-misfit", [misfit]);
    }
    Ok(())
}

/// Our normal variates against `rand_distr`'s on the same stream.
pub fn draws(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; draws: usize);
    let streams = Streams::new("two ziggurats", 0);
    let other = u64::from(context.is(WrongModel::NextStream));
    let (mut ours, mut theirs) = (streams.stream(other), streams.stream(0));
    let mut worst: f64 = 0.0;
    for _ in 0..draws {
        let a = standard_normal(&mut ours);
        let b: f64 = StandardNormal.sample(&mut StreamRng(&mut theirs));
        worst = worst.max((a - b).abs());
    }
    answer.put("largest-difference", [worst], [0.0]);
    Ok(())
}
