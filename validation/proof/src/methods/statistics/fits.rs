//! Estimates, quantiles, tests and intervals against values of other packages
//! and certified data sets; the inversion of response curves against examples
//! in exact rationals.

use anyhow::{Context as _, Result};
use rocking::capacity::{InversionRule, ResponseCurve};
use rocking_statistics::estimate::EstimateError;
use rocking_statistics::lilliefors::Statistic;
use rocking_statistics::lognormal::{Stripe, fit, fit_counts};
use rocking_statistics::normality::{
    anderson_darling, cramer_von_mises, shapiro_wilk,
};
use rocking_statistics::paired::{
    SignTest, equivalence, hodges_lehmann, sign_equivalence,
};
use rocking_statistics::two_sample::kolmogorov_smirnov;
use rocking_statistics::{
    Clusters, ExtendedSample, Interval, Proportion, QuantileType, Sample,
    normal,
};

use super::truths::divided;
use crate::methods::cells::Csv;
use crate::methods::method::{Context, Reply, WrongModel};

const COUNTS: Csv = Csv::new("oracles/censored.csv");
const LOGNORMAL: Csv = Csv::new("oracles/lognormal.csv");
const NORMALITY: Csv = Csv::new("oracles/normality.csv");
const PAIRED: Csv = Csv::new("oracles/paired.csv");
const QUANTILES: Csv = Csv::new("oracles/quantiles.csv");

/// A fit with and without a shift: parameters, likelihood and distances.
pub fn fits(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        sample: Vec<f64>,
        /// Its name in the file.
        method: String,
    }
    let sample = ExtendedSample::try_new(&sample)?;
    let number = context.or(WrongModel::OtherQuantileType, 7, 5);
    let quantile_type = QuantileType::try_new(number)?;
    let unit = context.or(WrongModel::HalfTheShift, 0.5, 1.0);
    let swapped = divided(context, method.parse()?);
    let swapped = swapped.with_quantile_type(quantile_type);
    for row in LOGNORMAL.rows(&method)? {
        let shift = unit * row.number(1)?;
        let fit = fit(&sample, shift, swapped)?;
        let own = fit.distribution;
        let area = own.area_distance(&sample).unwrap_or(f64::NAN);
        let likelihood = fit.log_likelihood.unwrap_or(f64::NAN);
        let quantities = [
            ("kept", fit.n_kept as f64),
            ("mu", own.log_mean()),
            ("beta", own.dispersion()),
            ("log-likelihood", likelihood),
            ("kolmogorov", own.kolmogorov_distance(&sample)),
            ("area", area),
        ];
        row.put(answer, 2, &quantities)?;
    }
    Ok(())
}

/// Fits of counts: parameters, likelihood and the ends of its intervals.
pub fn counts(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Rows of the file.
        names: Vec<String>,
        /// Of each row: intensity, records that exceeded, records run.
        stripes: Vec<Vec<[f64; 3]>>,
    }
    for (name, stripes) in names.iter().zip(&stripes) {
        let stripe = |&[im, k, n]: &[f64; 3]| {
            let im = context.or(WrongModel::NoLogarithm, libm::exp(im), im);
            Stripe { im, exceeded: k as u64, n: n as u64 }
        };
        let all: Vec<Stripe> = stripes.iter().map(stripe).collect();
        let found = fit_counts(&all, 0.0)?;
        let (median, beta) = (found.median, found.dispersion);
        let end = |end: Option<f64>| end.unwrap_or(f64::INFINITY);
        let likelihood = found.fit.log_likelihood.unwrap_or(f64::NAN);
        let quantities = [
            ("records", found.fit.n as f64),
            ("parameter", median.value()),
            ("parameter", beta.value()),
            ("log-likelihood", likelihood),
            ("end", end(median.low())),
            ("end", end(median.high())),
            ("end", end(beta.low())),
            ("end", end(beta.high())),
        ];
        COUNTS.row(&[name])?.put(answer, 1, &quantities)?;
    }
    Ok(())
}

/// Quantiles of one type for several sizes and probabilities.
pub fn quantiles(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        sample: Vec<f64>,
        /// Types 1 to 9.
        number: u8,
    }
    let other = if number == 7 { 5 } else { 7 };
    let used = context.or(WrongModel::OtherQuantileType, other, number);
    let quantile_type = QuantileType::try_new(used)?;
    for n in ["1", "2", "10", "11"] {
        for row in QUANTILES.rows(n)? {
            if row.text(1) != number.to_string() {
                continue;
            }
            let size = row.number(0)? as usize;
            let sample = Sample::try_new(&sample[..size])?;
            let own = quantile_type.quantile(&sample, row.number(2)?);
            let quantile = [("quantile", own?)];
            row.put(answer, 3, &quantile)?;
        }
    }
    Ok(())
}

/// Statistics and p-values of four tests of normality of the logarithms.
pub fn tests(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        sample: Vec<f64>,
        /// Its letter in the file.
        letter: String,
    }
    let logs = sample.iter().map(|x| libm::log(*x)).collect();
    let logs = context.or(WrongModel::NoLogarithm, sample, logs);
    let sample = Sample::try_new(&logs)?;
    let rows = NORMALITY.rows(&letter)?;
    let d = Statistic::try_new(&sample)?;
    let smaller = d.d_plus.min(d.d_minus);
    let d = context.or(WrongModel::UpperSideOnly, smaller, d.d);
    let a = anderson_darling(&sample)?;
    let w = cramer_von_mises(&sample)?;
    let s = shapiro_wilk(&sample)?;
    let quantities = [
        ("lilliefors", d),
        ("anderson-darling", a.statistic),
        ("anderson-darling-p", a.p_value.value()),
        ("cramer-von-mises", w.statistic),
        ("cramer-von-mises-p", w.p_value.value()),
        ("shapiro-wilk", s.statistic),
        ("shapiro-wilk-p", s.p_value.value()),
    ];
    rows[0].put(answer, 2, &quantities)
}

/// Equivalence by t and sign tests, the sign test, Hodges and Lehmann.
pub fn paired(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; ratios: Vec<f64>, letter: String);
    // 1 -+ m instead of 1/(1 + m) to 1 + m.
    let margin = context.or(WrongModel::OtherMargin, 0.06, 0.05);
    let mean = equivalence(&ratios, margin)?;
    let median = sign_equivalence(&ratios, margin)?;
    let sign = SignTest::about(&ratios, 1.0);
    let centre = hodges_lehmann(&ratios)?;
    let own = [
        ("geometric_mean", mean.geometric_mean.value()),
        ("low", mean.geometric_mean.ends().0),
        ("high", mean.geometric_mean.ends().1),
        ("p_lower", mean.p_lower),
        ("p_upper", mean.p_upper),
        ("sign_lower", median.p_lower),
        ("sign_upper", median.p_upper),
        ("sign", sign.p_value),
        ("hl", centre.ratio.value()),
        ("hl_low", centre.ratio.ends().0),
        ("hl_high", centre.ratio.ends().1),
    ];
    for (name, own) in own {
        let row = PAIRED.row(&[&letter, name])?;
        row.put(answer, 2, &[(&name.replace('_', "-"), own)])?;
    }
    Ok(())
}

const UNIVARIATE: Csv = Csv::new("nist/univariate.csv");

/// Mean and standard deviation of a certified data set.
pub fn moments(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; set: String);
    let row = &UNIVARIATE.rows(&set)?[0];
    let values = row.list(4, ' ')?;
    let sample = Sample::try_new(&values)?;
    let n = values.len() as f64;
    // One pass, sum x^2 - (sum x)^2/n.
    let (sum, square) =
        values.iter().fold((0.0, 0.0), |(s, q), x| (s + x, q + x * x));
    let pass = square - sum * sum / n;
    let right = sample.sum_of_squares();
    let squares = context.or(WrongModel::SumOfSquares, pass, right);
    let divisor = context.or(WrongModel::OtherDivisor, n, n - 1.0);
    let deviation = (squares / divisor).sqrt();
    let quantities =
        [("mean", sample.mean()), ("standard-deviation", deviation)];
    row.put(answer, 1, &quantities)
}

/// Kolmogorov's and Smirnov's distance of every two of the samples, and its
/// p-value.
pub fn two_samples(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; samples: Vec<Vec<f64>>);
    let samples = samples.iter().map(|values| ExtendedSample::try_new(values));
    let samples = samples.collect::<Result<Vec<_>, _>>()?;
    for (i, a) in samples.iter().enumerate() {
        for b in &samples[i + 1..] {
            let found = kolmogorov_smirnov(a, b);
            // The asymptotic tail of one side, doubled.
            let (n, m) = (a.len() as f64, b.len() as f64);
            let d = found.statistic;
            let doubled = 2.0 * libm::exp(-2.0 * d * d * n * m / (n + m));
            let p = found.p_value;
            let p = context.or(WrongModel::OneSideDoubled, doubled, p);
            answer.see("distance", [found.statistic]);
            answer.see("p-value", [p]);
        }
    }
    Ok(())
}

/// Capacities at the levels by every rule, and the number of crossings.
pub fn inversion(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// (IM, EDP), the first with EDP 0.
        curve: Vec<(f64, f64)>,
        overturning: Option<f64>, levels: Vec<f64>,
    }
    let (mut vertices, mut overturning) = (curve, overturning);
    if context.is(WrongModel::OverturningAsAnAngle)
        && let Some(im) = overturning.take()
    {
        // pi/2 at alpha = 0.05, interpolated to.
        vertices.push((im, 31.415_926_535_897_93));
    }
    let curve = ResponseCurve::try_new(&vertices, overturning)?;
    for level in levels {
        // Strictly above instead of at or above.
        let above = level * (1.0 + f64::EPSILON);
        let level = context.or(WrongModel::OpenCrossings, above, level);
        let crossings = curve.crossings(level)?;
        answer.see("crossings", [crossings.all().len() as f64]);
        for rule in InversionRule::ALL {
            let wrong = context.is(WrongModel::FirstForMedian);
            let first = wrong && rule == InversionRule::Median;
            let used = if first { InversionRule::First } else { rule };
            answer.see(rule.name(), [crossings.capacity(used).im()]);
        }
    }
    Ok(())
}

const PROPORTION: Csv = Csv::new("oracles/proportion.csv");

const LEVEL: f64 = 0.95;

/// Wilson's interval, which is not exact.
fn wilson(
    share: f64,
    trials: usize,
    level: f64,
) -> Result<Interval, EstimateError> {
    let (z, n) = (normal::quantile(0.5 * (1.0 + level)), trials as f64);
    let middle = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
    let spread = share * (1.0 - share) / n + z * z / (4.0 * n * n);
    let half = z * spread.sqrt() / (1.0 + z * z / n);
    Interval::try_new(middle - half, middle + half)
}

/// Exact intervals of single probabilities or of many together.
pub fn intervals(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Successes and trials.
        counts: Vec<(usize, usize)>,
        /// Number of probabilities that are covered together.
        together: usize,
    }
    for (successes, trials) in counts {
        let one = Proportion::try_new(successes, trials)?;
        let count = context.or(WrongModel::PointwiseIntervals, 1, together);
        let all = vec![one; count];
        let band = Proportion::band(&all, LEVEL)?;
        let mut interval = *band.first().context("no probability")?;
        if context.is(WrongModel::WilsonInterval) {
            let level = 1.0 - (1.0 - LEVEL) / count as f64;
            interval = wilson(one.share(), trials, level)?;
        }
        let words = [successes, trials, together].map(|k| k.to_string());
        let row = PROPORTION.row(&words.each_ref().map(String::as_str))?;
        let ends = [("low", interval.low()), ("high", interval.high())];
        row.put(answer, 3, &ends)?;
    }
    Ok(())
}

/// Intervals at 90 % of counts over clusters, by the effective number of
/// trials.
pub fn of_clusters(context: &Context, answer: &mut Reply) -> Result<()> {
    for row in PROPORTION.rows("clusters")? {
        let clusters = Clusters::from_labels(row.text(1).split(' '));
        let held = row.list(2, ' ')?;
        let held: Vec<bool> = held.into_iter().map(|x| x > 0.0).collect();
        let drawn = context.drawn(&clusters);
        let found = Proportion::of_clusters(&held, &drawn)?.interval(0.9)?;
        let ends = [("low", found.low()), ("high", found.high())];
        row.put(answer, 3, &ends)?;
    }
    Ok(())
}
