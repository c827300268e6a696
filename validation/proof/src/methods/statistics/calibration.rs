//! Error rates of tests, intervals and estimators under a known truth.
//!
//! Every deviation is in units of its standard error, which follows from the
//! numbers of trials, ours and the reference's; half a unit of the last
//! printed digit is subtracted first. The bound of a case is then just a
//! false-alarm rate.

use anyhow::{Result, bail};
use libm::{exp, lgamma, log};
use rocking_statistics::boxplot::median_interval;
use rocking_statistics::lilliefors::{
    LillieforsTable, ShiftedNull, Statistic,
};
use rocking_statistics::lognormal::{FitMethod, fit};
use rocking_statistics::normal;
use rocking_statistics::normality::{
    anderson_darling, cramer_von_mises, shapiro_wilk,
};
use rocking_statistics::paired::{
    equivalence, hodges_lehmann, sign_equivalence,
};
use rocking_statistics::{Boxplot, ExtendedSample, QuantileType, Sample};

use super::truths::{Truth, divided, share};
use crate::methods::method::{Context, Reply, WrongModel};

/// Puts the mean of our trials beside that of the reference's trials (0:
/// exactly known), and their deviation in standard errors, less half a printed
/// unit.
fn put_mean(
    answer: &mut Reply,
    (name, [ours, due]): (&str, [f64; 2]),
    variance: f64,
    [trials, reference]: [u64; 2],
    rounding: f64,
) {
    let theirs = if reference == 0 { 0.0 } else { 1.0 / reference as f64 };
    let error = (variance * (1.0 / trials as f64 + theirs)).sqrt();
    let off = (ours - due).abs() - rounding;
    let gap = (ours - due).signum() * off / error;
    answer.put(name, [ours], [due]);
    let gap = if off <= 0.0 { 0.0 } else { gap };
    answer.put("standardised-gap", [gap], [0.0]);
}

/// Rejected shares of four tests.
pub fn rejection(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        truth: Truth, n: usize, trials: u64, level: f64,
        /// Rates of Lilliefors, Anderson-Darling, Cramer-von Mises and
        /// Shapiro-Wilk; a list can be shorter.
        rates: Vec<f64>,
        /// Trials behind each rate, 0 for an exact one.
        reference: Vec<u64>,
        rounding: f64,
    }
    // Of the fully specified distribution, asymptotically.
    let known = (-0.5 * log(0.5 * level) / n as f64).sqrt();
    let tabled = LillieforsTable::embedded().critical_value(n, level)?.0;
    let critical = context.or(WrongModel::PlainKolmogorov, known, tabled);
    let judged = rates.len();
    let found = truth.map(&context.case.id, n, trials, |values| {
        let sample = Sample::try_new(values)?;
        let d = Statistic::try_new(&sample)?.d;
        let mut out = [d > critical, false, false, false];
        let tests = [anderson_darling, cramer_von_mises, shapiro_wilk];
        for (out, test) in out[1..].iter_mut().zip(tests).take(judged - 1) {
            *out = test(&sample)?.p_value.value() < level;
        }
        Ok(out)
    })?;
    let references = rates.iter().zip(&reference);
    for (k, (rate, reference)) in references.enumerate() {
        let outcomes: Vec<bool> = found.iter().map(|f| f[k]).collect();
        let both = ("rate", [share(&outcomes), *rate]);
        let variance = rate * (1.0 - rate);
        put_mean(answer, both, variance, [trials, *reference], rounding);
    }
    Ok(())
}

/// Share of the samples in which an interval covers the truth, or in which a
/// test makes a decision of known probability.
pub fn coverage(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        truth: Truth, n: usize, trials: u64, procedure: String, rate: f64,
        reference: u64, rounding: f64,
    }
    let procedure = match (context.wrong, procedure.as_str()) {
        (Some(WrongModel::NotchForInterval), "exact-interval") => "notch",
        (Some(WrongModel::OtherInterval), "notch") => "exact-interval",
        (Some(WrongModel::OtherInterval), _) => "notch",
        (_, own) => own,
    };
    let outcomes = truth.map(&context.case.id, n, trials, |values| {
        covers(procedure, context.wrong, values)
    })?;
    let both = ("rate", [share(&outcomes), rate]);
    let variance = rate * (1.0 - rate);
    put_mean(answer, both, variance, [trials, reference], rounding);
    Ok(())
}

fn covers(
    procedure: &str,
    wrong: Option<WrongModel>,
    values: &[f64],
) -> Result<bool> {
    let sample = || ExtendedSample::try_new(values);
    let edge = || -> Vec<f64> {
        values.iter().map(|y| 1.05 * exp(0.03 * y)).collect()
    };
    Ok(match procedure {
        "notch" => {
            let own = Boxplot::try_new(&sample()?, QuantileType::default())?;
            own.notch_low <= 0.0 && 0.0 <= own.notch_high
        }
        "exact-interval" => {
            let found = median_interval(&sample()?, 0.95);
            found.is_some_and(|found| found.interval.holds(0.0))
        }
        "hodges-lehmann" => {
            let ratios: Vec<f64> = values.iter().map(|y| exp(*y)).collect();
            let found = hodges_lehmann(&ratios)?;
            found.ratio.interval().is_some_and(|i| i.holds(1.0))
        }
        // On the edge of equivalence the test finds it at its level.
        "mean-equivalence" => equivalence(&edge(), 0.05)?.p_value < 0.05,
        "median-equivalence" => {
            sign_equivalence(&edge(), 0.05)?.p_value < 0.05
        }
        // The shift is the sample's smallest value, which is left out.
        "smallest-value-as-shift" => above_smallest(wrong, values)?,
        other => bail!("procedure {other}"),
    })
}

/// Replicates of the null of one sample whose smallest value is its shift.
const NULL_REPLICATES: u64 = 400;

/// True if the test with the smallest value as shift rejects at 5 %: by the
/// null that the command simulates, or (wrong) by the table, or by the
/// dispersion above the smallest value.
fn above_smallest(wrong: Option<WrongModel>, values: &[f64]) -> Result<bool> {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let above = values.iter().filter(|x| **x > least);
    let logs: Vec<f64> = above.map(|x| log(x - least)).collect();
    let sample = Sample::try_new(&logs)?;
    let d = Statistic::try_new(&sample)?.d;
    if wrong == Some(WrongModel::KnownShift) {
        let table = LillieforsTable::embedded();
        return Ok(d > table.critical_value(logs.len(), 0.05)?.0);
    }
    let simulate = |values: &[f64]| {
        ShiftedNull::smallest_value(values, NULL_REPLICATES, 0)
    };
    let null = if wrong == Some(WrongModel::DispersionAboveTheSmallest) {
        // A sample of just that dispersion.
        let variance = sample.sum_of_squares() / (logs.len() as f64 - 1.0);
        let (beta, n) = (variance.sqrt(), values.len());
        let score = |i| normal::quantile((i as f64 - 0.5) / n as f64);
        let values = (1..=n).map(|i: usize| exp(beta * score(i)));
        simulate(&values.collect::<Vec<_>>())
    } else {
        simulate(values)
    };
    Ok(null?.null.p_value(d).value() <= 0.05)
}

/// Means of a fit's parameters over lognormal samples.
pub fn bias(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        dispersion: f64, n: usize, trials: u64, estimator: FitMethod,
        /// Mean of the estimated dispersion over the true one; none: by a
        /// closed form.
        dispersion_ratio: Option<f64>,
        /// Mean of the estimated log-mean over the true dispersion.
        log_mean: f64,
        /// Trials behind the two, 0 for exact ones.
        reference: u64,
        rounding: f64,
    }
    let method = divided(context, estimator);
    let truth = Truth::Lognormal { dispersion };
    let fits = truth.map(&context.case.id, n, trials, |values| {
        let sample = ExtendedSample::try_new(values)?;
        let own = fit(&sample, 0.0, method)?.distribution;
        Ok((own.dispersion() / dispersion, own.log_mean() / dispersion))
    })?;
    // E(s)/sigma of a normal sample: c4(n) = sqrt(2/(n - 1)) Gamma(n/2)/
    // Gamma((n - 1)/2), times sqrt((n - 1)/n) for divisor n.
    let size = n as f64;
    let gammas = lgamma(0.5 * size) - lgamma(0.5 * (size - 1.0));
    let c4 = (2.0 / (size - 1.0)).sqrt() * exp(gammas);
    let divided = match estimator {
        FitMethod::MaximumLikelihood => c4 * ((size - 1.0) / size).sqrt(),
        _ => c4,
    };
    let ratio = dispersion_ratio.unwrap_or(divided);
    let (ratios, means): (Vec<f64>, Vec<f64>) = fits.into_iter().unzip();
    let both = [("dispersion", ratios, ratio), ("log-mean", means, log_mean)];
    for (name, values, expected) in both {
        let sample = Sample::try_new(&values)?;
        let variance = sample.sum_of_squares() / (trials as f64 - 1.0);
        let both = (name, [sample.mean(), expected]);
        put_mean(answer, both, variance, [trials, reference], rounding);
    }
    Ok(())
}
