//! From a fragility to a decision: Eqs. 5 to 7, annual frequencies, and the
//! interval of a probability estimated from few records.

use anyhow::{Context as _, Result};
use libm::{exp, log};
use rocking_procedures::fragility::risk::HazardCurve;
use rocking_procedures::fragility::total::TotalFragility;
use rocking_procedures::fragility::{c_max, eq5, eq6, eq7};
use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::lognormal::{FitMethod, fit};
use rocking_statistics::resampling::Resampling;
use rocking_statistics::{Clusters, ExtendedSample, Lognormal, Range, normal};

use crate::methods::cells::Csv;
use crate::methods::method::{Context, Reply, WrongModel};

const RISK: Csv = Csv::new("oracles/risk.csv");
const TOTAL: Csv = Csv::new("oracles/total.csv");

/// Annual frequencies under a hazard curve against quadrature over x.
pub fn annual_frequency(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Name of the curve in the file.
        curve: String,
        /// Its points: intensity, annual frequency.
        points: Vec<(f64, f64)>,
    }
    let hazard = HazardCurve::try_new(&points)?;
    for row in RISK.rows(&curve)? {
        let [shift, mu, beta, covered, low, high] = row.numbers(1)?;
        let right = Lognormal::try_new(shift, mu, beta)?;
        let unshifted = Lognormal::try_new(0.0, log(right.median()), beta)?;
        let fragility = context.or(WrongModel::WithoutShift, unshifted, right);
        let found = hazard.annual_frequency(fragility);
        let (covered_only, right) = (found.covered, found.truncation_lower);
        let least = context.or(WrongModel::NothingBeyond, covered_only, right);
        answer.put("at-least", [least], [low]);
        answer.put("at-most", [found.truncation_upper], [high]);
        // A difference, of numbers below `high`.
        answer.put("covered", [found.covered / high], [covered / high]);
    }
    Ok(())
}

/// Probabilities, quantiles and annual frequencies of fragilities with the
/// error of the model, against quadrature over that error.
pub fn total(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Points of the hazard curve: intensity, annual frequency.
        points: Vec<(f64, f64)>,
    }
    let hazard = HazardCurve::try_new(&points)?;
    for what in ["cdf", "quantile", "frequency"] {
        for row in TOTAL.rows(what)? {
            let [shift, mu, beta, bias, s, x, value] = row.numbers(1)?;
            let records = Lognormal::try_new(shift, mu, beta)?;
            let right = TotalFragility::try_new(records, bias, s)?;
            // Only the part above the onset has the larger dispersion.
            let above = Lognormal::try_new(shift, mu, libm::hypot(beta, s))?;
            let above = above.scaled(bias)?.into();
            let wrong = WrongModel::ErrorAboveTheShift;
            let model = context.or(wrong, above, right);
            let found = match what {
                "cdf" => model.cdf(x),
                "quantile" => model.quantile(x),
                _ => hazard.annual_frequency(model).truncation_lower,
            };
            answer.put(what, [found], [value]);
        }
    }
    Ok(())
}

/// Annual frequencies for a power law and a lognormal, which have Cornell's
/// closed form H(m) exp(k^2 beta^2/2).
pub fn cornell(context: &Context, answer: &mut Reply) -> Result<()> {
    const K0: f64 = 1e-4;
    input! { context;
        /// Exponents of the hazard k0 x^-k, with median and dispersion.
        exponent_median_dispersion: Vec<(f64, f64, f64)>,
    }
    for (k, median, beta) in exponent_median_dispersion {
        let hazard = |x: f64| K0 * exp(-k * log(x));
        let at = |z: f64| median * exp(beta * z);
        // Wide enough for the peak of the integrand, at the score -k beta;
        // a point inside breaks the quadrature where nothing changes.
        let points =
            [at(-k * beta - 12.0), median, at(12.0)].map(|x| (x, hazard(x)));
        let curve = HazardCurve::try_new(&points)?;
        let fragility = Lognormal::try_new(0.0, log(median), beta)?;
        let right = curve.annual_frequency(fragility).truncation_lower;
        let wrong = WrongModel::HazardAtTheMedian;
        let found = context.or(wrong, hazard(median), right);
        let closed = hazard(median) * exp(0.5 * k * k * beta * beta);
        answer.put("annual-frequency", [found], [closed]);
    }
    Ok(())
}

/// Widths of the interval of a probability in scores: by the delta method,
/// over those by resampling the records.
pub fn interval(context: &Context, answer: &mut Reply) -> Result<()> {
    const LEVEL: f64 = 0.95;
    input! { context;
        n: usize, replicates: usize, shift: f64, ln_median: f64,
        dispersion: f64,
        /// Scores of the intensities.
        scores: Vec<f64>,
    }
    let truth = Lognormal::try_new(shift, ln_median, dispersion)?;
    // Values at the quantiles.
    let place = |k: usize| (k as f64 + 0.5) / n as f64;
    let values: Vec<f64> = (0..n).map(|k| truth.quantile(place(k))).collect();
    let fitted = |values: &[f64]| {
        let sample = ExtendedSample::try_new(values).ok()?;
        let method = FitMethod::MaximumLikelihood;
        Some(fit(&sample, shift, method).ok()?.distribution)
    };
    let whole = fitted(&values).context("no fit")?;
    let name = "cases/interval-of-a-probability";
    let draws = Bootstrap::new(name, 0, n, replicates);
    let fits = draws.map(|places| {
        let drawn: Vec<f64> = places.iter().map(|&i| values[i]).collect();
        fitted(&drawn)
    });
    let records = Clusters::singletons(n);
    let (how, range) = (Resampling::Bootstrap, Range::Real);
    for score in scores {
        let x = shift + exp(ln_median + dispersion * score);
        let score =
            |fit: &Option<Lognormal>| fit.map_or(f64::NAN, |fit| fit.score(x));
        let column: Vec<f64> = fits.iter().map(score).collect();
        let point = whole.score(x);
        let drawn = records.estimate(point, &column, how, range, LEVEL);
        let (low, high) = drawn.context("no interval")?.estimate.ends();
        let wide = normal::quantile(0.5 * (1.0 + LEVEL));
        let known = 2.0 * wide / (n as f64).sqrt();
        let delta = whole.estimate_of_cdf(n, x, LEVEL);
        let ends = delta.map(normal::quantile).ends();
        let (wrong, width) = (WrongModel::KnownDispersion, ends.1 - ends.0);
        let found = context.or(wrong, known, width);
        answer.put("width", [found], [high - low]);
    }
    Ok(())
}

const FRAGILITY: Csv = Csv::new("oracles/fragility.csv");

/// Eq. 7 over constants against 50 digits; Eqs. 5 and 6 of the shifted
/// lognormal that Eq. 7 is about; its limit and its end.
pub fn transforms(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Median as the file writes it.
        median: String,
    }
    for row in FRAGILITY.rows(&median)? {
        let [median, beta, shift, c, expected] = row.numbers(0)?;
        let value = match context.wrong {
            Some(WrongModel::Equation7AsPrinted) => {
                let up = median * exp(c * beta) - shift;
                let down = median * exp(-c * beta) - shift;
                log(up / down) / (2.0 * c)
            }
            Some(WrongModel::DeltaMethod) => beta * median / (median - shift),
            _ => eq7(median, beta, shift, c)?,
        };
        answer.put("eq7", [value], [expected]);
        // The median and quantiles of a shifted lognormal with this excess.
        let excess = median - shift;
        let low = shift + excess * exp(-expected);
        let high = shift + excess * exp(expected);
        let mu = eq5(median, shift)?;
        answer.put("eq5", [mu], [log(excess)]);
        let six = eq6(low, high, shift)?;
        answer.put("eq6", [six], [expected]);
        let end = c_max(median, beta, shift)?;
        // Just below its end Eq. 7 is large; at its end it is undefined.
        if end.is_finite() {
            let beyond = eq7(median, beta, shift, end).is_err();
            let refused = context.or(WrongModel::Clamped, false, beyond);
            let refused = f64::from(refused);
            answer.put("refused-at-its-end", [refused], [1.0]);
        }
    }
    Ok(())
}
