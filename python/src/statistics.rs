//! Fits, tests and quantiles of samples.

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rocking::statistics::bootstrap::{Bootstrap, accelerated, estimate};
use rocking::statistics::boxplot::Boxplot;
use rocking::statistics::lilliefors::{
    Assessment, Inapplicable, LillieforsError, Null, NullDistribution, Scale,
    ShiftedNull, Table, Verdict,
};
use rocking::statistics::lognormal::{FitError, FitMethod, LognormalFit, fit};
use rocking::statistics::paired::{
    Pairs, SignTest, equivalence, hodges_lehmann,
};
use rocking::statistics::{ExtendedSample, Lognormal, QuantileType};
use rocking::stop;
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::given::{choose, refuse};
use crate::work;

/// Replicates where the table does not reach, as the command line has it.
const REPLICATES_BEYOND: u64 = 100_000;

/// The shift, and the values that enter: without one, the smallest value,
/// and those above it.
fn split(values: &[f64], shift: Option<f64>) -> (f64, Vec<f64>) {
    match shift {
        Some(shift) => (shift, values.to_vec()),
        None => {
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let above = values.iter().copied().filter(|&x| x > least);
            (least, above.collect())
        }
    }
}

fn fit_to(
    values: &[f64],
    shift: Option<f64>,
    method: FitMethod,
) -> Result<LognormalFit, FitError> {
    let (shift, above) = split(values, shift);
    let sample =
        ExtendedSample::try_new(&above).map_err(|_| FitError::TooFew(0))?;
    fit(&sample, shift, method)
}

/// A lognormal fit, with its bootstrap where resamples are asked for.
#[pyfunction]
pub fn fit_fragility<'py>(
    py: Python<'py>,
    values: PyReadonlyArray1<'py, f64>,
    shift: Option<f64>,
    method: &str,
    quantile_type: u8,
    n_resamples: usize,
    seed: u64,
) -> PyResult<Bound<'py, PyDict>> {
    let t = QuantileType::try_new(quantile_type).map_err(refuse)?;
    let methods = FitMethod::all(t).map(|method| (method.name(), method));
    let method = choose("method", method, &methods)?;
    let values = values.as_slice()?.to_vec();
    let whole = ExtendedSample::try_new(&values).map_err(refuse)?;
    if n_resamples > 0 && shift.is_none() {
        return Err(refuse(
            "n_resamples with shift \"min\": a bootstrap of the smallest \
             value gives no interval; expected a shift that is known, as 1.0",
        ));
    }
    let found = fit_to(&values, shift, method).map_err(refuse)?;
    let row = |values: &[f64]| {
        fit_to(values, shift, method).map_or([f64::NAN; 3], |fit| {
            let fitted = fit.distribution;
            [fitted.log_mean(), fitted.dispersion(), fitted.median()]
        })
    };
    let resampled = || {
        let n = values.len();
        // The name that the command line's bootstrap has.
        let draws = Bootstrap::new("fragility", seed, n, n_resamples);
        let replicates = draws.map(|draw| {
            let drawn: Vec<f64> = draw.iter().map(|&i| values[i]).collect();
            row(&drawn)
        });
        let without = |k: usize| {
            stop::point();
            row(&[&values[..k], &values[k + 1..]].concat())
        };
        (replicates, (0..n).map(without).collect())
    };
    let (replicates, jackknife) = match n_resamples {
        0 => (Vec::new(), Vec::new()),
        _ => work::on_all(py, resampled)?,
    };
    let out = PyDict::new(py);
    let fitted = found.distribution;
    out.set_item("shift", fitted.shift())?;
    out.set_item("log_mean", fitted.log_mean())?;
    out.set_item("beta", fitted.dispersion())?;
    out.set_item("median", fitted.median())?;
    out.set_item("n", found.n)?;
    out.set_item("n_kept", found.n_kept)?;
    out.set_item("log_likelihood", found.log_likelihood)?;
    out.set_item("ks_distance", fitted.kolmogorov_distance(&whole))?;
    out.set_item("replicates", triples(py, &replicates)?)?;
    out.set_item("jackknife", triples(py, &jackknife)?)?;
    Ok(out)
}

fn triples<'py>(
    py: Python<'py>,
    rows: &[[f64; 3]],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    Array2::from_shape_vec((rows.len(), 3), rows.concat())
        .map(|table| PyArray2::from_owned_array(py, table))
        .map_err(refuse)
}

/// Standard error and ends of a bootstrap interval; with a jackknife
/// bias-corrected and accelerated.
#[pyfunction]
pub fn interval(
    point: f64,
    replicates: Vec<f64>,
    jackknife: Option<Vec<f64>>,
    level: f64,
) -> PyResult<(f64, f64, f64)> {
    if !(level > 0.0 && level < 1.0) {
        let text = "expected a number between 0 and 1";
        return Err(refuse(format!("confidence level {level}: {text}")));
    }
    let found = match jackknife {
        None => estimate(point, &replicates, level),
        Some(without) => accelerated(point, &replicates, &without, level),
    };
    found
        .map(|e| (e.standard_error, e.low, e.high))
        .ok_or_else(|| refuse("too few finite replicates for an interval"))
}

fn lognormal((shift, log_mean, beta): (f64, f64, f64)) -> PyResult<Lognormal> {
    Lognormal::try_new(shift, log_mean, beta).map_err(refuse)
}

/// What a function makes of each number.
fn each<'py>(
    py: Python<'py>,
    numbers: &PyReadonlyArray1<'py, f64>,
    value: impl Fn(f64) -> f64 + Send + Sync,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let numbers = numbers.as_slice()?;
    let value = |x: &f64| {
        stop::point();
        value(*x)
    };
    let values = || numbers.iter().map(value).collect::<Vec<f64>>();
    Ok(work::on_numbers(py, numbers.len(), values)?.into_pyarray(py))
}

/// F(x) of the lognormal (shift, log_mean, beta).
#[pyfunction]
pub fn cdf<'py>(
    py: Python<'py>,
    parameters: (f64, f64, f64),
    x: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let law = lognormal(parameters)?;
    each(py, &x, |x| law.cdf(x))
}

/// Quantiles of the lognormal (shift, log_mean, beta).
#[pyfunction]
pub fn ppf<'py>(
    py: Python<'py>,
    parameters: (f64, f64, f64),
    q: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let law = lognormal(parameters)?;
    each(py, &q, |q| law.quantile(q))
}

/// Lilliefors' test: statistic, p-value with its interval, critical value,
/// verdict or why there is none.
#[pyfunction]
pub fn lilliefors<'py>(
    py: Python<'py>,
    values: PyReadonlyArray1<'py, f64>,
    log: bool,
    shift: Option<f64>,
    n_mc: Option<u64>,
    seed: u64,
    level: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let values = values.as_slice()?.to_vec();
    if !(level > 0.0 && level < 1.0) {
        let text = "expected a number between 0 and 1";
        return Err(refuse(format!("level {level}: {text}")));
    }
    let (scale, entering) = if log {
        let (shift, above) = split(&values, shift);
        (Scale::Logarithmic { shift }, above)
    } else {
        (Scale::Linear, values.clone())
    };
    let sample = ExtendedSample::try_new(&entering).map_err(refuse)?;
    let least = log && shift.is_none();
    let null = simulated(py, &sample, &values, least, n_mc, seed)?;
    let source =
        null.as_ref().map_or(Null::Table(Table::embedded()), Null::Simulated);
    let test = Assessment::new(&sample, scale, level, source);
    let (verdict, reason) = match &test.verdict {
        Ok(Verdict::Rejected) => (Some("rejected"), None),
        Ok(Verdict::NotRejected) => (Some("not-rejected"), None),
        Ok(Verdict::Indeterminate) => (Some("indeterminate"), None),
        Err(Inapplicable::Test(error @ LillieforsError::Level { .. })) => {
            return Err(refuse(error));
        }
        Err(error) => (None, Some(error.to_string())),
    };
    let out = PyDict::new(py);
    let number = |x: Option<f64>| x.unwrap_or(f64::NAN);
    out.set_item("statistic", number(test.statistic.map(|s| s.d)))?;
    out.set_item("pvalue", number(test.p_value.map(|p| p.value)))?;
    out.set_item("pvalue_low", number(test.p_value.map(|p| p.low)))?;
    out.set_item("pvalue_high", number(test.p_value.map(|p| p.high)))?;
    out.set_item("critical_value", number(test.critical_value))?;
    out.set_item("level", test.level)?;
    out.set_item("n", test.n)?;
    out.set_item("verdict", verdict)?;
    out.set_item("reason", reason)?;
    let method = if null.is_some() { "simulation" } else { "table" };
    out.set_item("method", method)?;
    Ok(out)
}

/// The null distribution where it is to be simulated; none where the table
/// answers.
fn simulated(
    py: Python<'_>,
    sample: &ExtendedSample,
    values: &[f64],
    least: bool,
    n_mc: Option<u64>,
    seed: u64,
) -> PyResult<Option<NullDistribution>> {
    let n = sample.len();
    if n < 4 || sample.censored() > 0 {
        return Ok(None);
    }
    let is_beyond = Table::sizes().last().is_none_or(|&(last, _)| n > last);
    let own = (least || is_beyond).then_some(REPLICATES_BEYOND);
    let Some(replicates) = n_mc.or(own) else { return Ok(None) };
    let null = || {
        if least {
            let found = ShiftedNull::smallest_value(values, replicates, seed);
            return found.map(|found| found.null);
        }
        NullDistribution::simulate(n, replicates, seed)
    };
    work::on_all(py, null)?.map(Some).map_err(refuse)
}

/// A sample that may hold infinite values.
fn sorted(
    py: Python<'_>,
    values: &PyReadonlyArray1<'_, f64>,
) -> PyResult<ExtendedSample> {
    let values = values.as_slice()?;
    let sample = || ExtendedSample::try_new(values);
    work::on_numbers(py, values.len(), sample)?.map_err(refuse)
}

/// Quantiles of a sample that may hold infinite values.
#[pyfunction]
pub fn quantile<'py>(
    py: Python<'py>,
    values: PyReadonlyArray1<'py, f64>,
    q: PyReadonlyArray1<'py, f64>,
    quantile_type: u8,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let t = QuantileType::try_new(quantile_type).map_err(refuse)?;
    let sample = sorted(py, &values)?;
    let at = |q: &f64| t.of_extended(&sample, *q).map_err(refuse);
    let found = q.as_slice()?.iter().map(at).collect::<PyResult<Vec<_>>>()?;
    Ok(found.into_pyarray(py))
}

/// Quartiles, notch, whiskers and outliers.
#[pyfunction]
pub fn boxplot<'py>(
    py: Python<'py>,
    values: PyReadonlyArray1<'py, f64>,
    quantile_type: u8,
) -> PyResult<Bound<'py, PyDict>> {
    let t = QuantileType::try_new(quantile_type).map_err(refuse)?;
    let sample = sorted(py, &values)?;
    let found = Boxplot::try_new(&sample, t).map_err(refuse)?;
    let out = PyDict::new(py);
    // The keys that `matplotlib.axes.Axes.bxp` takes.
    out.set_item("n", found.n)?;
    out.set_item("q1", found.q1)?;
    out.set_item("med", found.median)?;
    out.set_item("q3", found.q3)?;
    out.set_item("cilo", found.notch_low)?;
    out.set_item("cihi", found.notch_high)?;
    out.set_item("whislo", found.whisker_low)?;
    out.set_item("whishi", found.whisker_high)?;
    out.set_item("fliers", found.outliers.into_pyarray(py))?;
    Ok(out)
}

/// Two samples over the same records.
#[pyfunction]
pub fn paired<'py>(
    py: Python<'py>,
    a: PyReadonlyArray1<'py, f64>,
    b: PyReadonlyArray1<'py, f64>,
    margin: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let found =
        Pairs::try_new(a.as_slice()?, b.as_slice()?).map_err(refuse)?;
    let out = PyDict::new(py);
    out.set_item("n", found.n)?;
    let zero = [found.both_zero, found.only_a_zero, found.only_b_zero];
    let infinite =
        [found.both_infinite, found.only_a_infinite, found.only_b_infinite];
    out.set_item("zero", zero)?;
    out.set_item("infinite", infinite)?;
    out.set_item("sign_pvalue", SignTest::of(&found.ratios, 1.0).p_value)?;
    out.set_item("mcnemar_pvalue", found.mcnemar().p_value)?;
    let mean = equivalence(&found.ratios, margin).map_err(refuse)?;
    out.set_item("geometric_mean", mean.geometric_mean)?;
    out.set_item("interval", (mean.low, mean.high))?;
    out.set_item("equivalence_pvalue", mean.p_value)?;
    let ratios = &found.ratios;
    // A mean of each two.
    let means = ratios.len() * ratios.len() / 2;
    let centre = work::on_numbers(py, means, || hodges_lehmann(ratios))?;
    let centre = centre.map_err(refuse)?;
    out.set_item("hodges_lehmann", centre.ratio)?;
    out.set_item("ratios", found.ratios.into_pyarray(py))?;
    Ok(out)
}

/// Slope of the least-squares line of y on x, and the two-sided p-value of
/// the hypothesis that it is zero.
#[pyfunction]
pub fn slope(x: Vec<f64>, y: Vec<f64>) -> PyResult<(f64, f64)> {
    let n = x.len() as f64;
    if x.len() != y.len() || x.len() < 3 {
        return Err(refuse("expected at least 3 pairs"));
    }
    let mean = |v: &[f64]| v.iter().sum::<f64>() / n;
    let (mx, my) = (mean(&x), mean(&y));
    let (mut xx, mut xy) = (0.0, 0.0);
    for (x, y) in x.iter().zip(&y) {
        xx += (x - mx) * (x - mx);
        xy += (x - mx) * (y - my);
    }
    if !(xx > 0.0) {
        return Err(refuse("the values do not vary: no slope"));
    }
    let slope = xy / xx;
    let rest = x.iter().zip(&y).map(|(x, y)| y - my - slope * (x - mx));
    let error = (rest.map(|r| r * r).sum::<f64>() / (n - 2.0) / xx).sqrt();
    let law = StudentsT::new(0.0, 1.0, n - 2.0).map_err(refuse)?;
    Ok((slope, 2.0 * law.sf((slope / error).abs())))
}
