//! The procedures of the core: each gives the JSON that the command prints.

use std::fmt::Display;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use rocking::stop;
use rocking_procedures::comparison::NamedSample;
use rocking_procedures::contrast::ContrastSample;
use rocking_procedures::{
    Draws, FitOptions, NormalityOptions, compare as compare_pairs,
    contrast as contrast_suites, fit_sample, fit_stripes as fit_counts,
    summarise as summarise_sample, test_normality as test,
};
use rocking_statistics::lognormal::{FitMethod, Stripe};
use rocking_statistics::{
    CensoredSample, Clusters, ExtendedSample, Lognormal, QuantileType,
};
use serde::Serialize;

use crate::given::choose;
use crate::work::{self, refuse};

/// The JSON of what a procedure finds on all processors.
pub fn answer<T: Serialize + Send, E: Display + Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, E> + Send,
) -> PyResult<String> {
    let found = work::on_all(py, work)?.map_err(refuse)?;
    serde_json::to_string(&found).map_err(refuse)
}

/// A sample as Python gives it: values, infinite if censored, and the limits
/// of those that are censored at a known one, and the earthquakes and the
/// names of the records, none if they are not known.
pub type SampleInput<'py> =
    (PyReadonlyArray1<'py, f64>, Vec<Option<f64>>, Vec<String>, Vec<String>);

pub fn sample_of(
    (values, limits, ..): &SampleInput<'_>,
) -> PyResult<CensoredSample> {
    CensoredSample::try_new(values.as_slice()?, limits).map_err(refuse)
}

/// The values of a sample by earthquake, if they are known.
pub fn clusters_of((_, _, events, _): &SampleInput<'_>) -> Option<Clusters> {
    (!events.is_empty()).then(|| Clusters::from_labels(events))
}

/// The options of a fit.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Fit {
    shift: String,
    method: String,
    pub dispersion: String,
    quantile_type: u8,
    c: f64,
    n_resamples: usize,
    seed: u64,
    band: Vec<f64>,
}

impl Fit {
    pub fn options(self) -> PyResult<FitOptions> {
        let t = QuantileType::try_new(self.quantile_type).map_err(refuse)?;
        let methods = FitMethod::all(t).map(|m| (m.name(), m));
        let (replicates, seed) = (self.n_resamples, self.seed);
        Ok(FitOptions {
            method: choose("method", &self.method, &methods)?,
            shift: self.shift.parse().map_err(refuse)?,
            family: Vec::new(),
            quantile_type: t,
            c: self.c,
            draws: (replicates > 0).then_some(Draws { replicates, seed }),
            clusters: None,
            band: self.band,
        })
    }
}

/// A fit of a sample.
#[pyfunction]
pub fn fit(
    py: Python<'_>,
    sample: SampleInput<'_>,
    options: Fit,
) -> PyResult<String> {
    let clusters = clusters_of(&sample);
    let (sample, options) = (sample_of(&sample)?, options.options()?);
    let options = FitOptions { clusters, ..options };
    answer(py, || fit_sample(&sample, &options))
}

/// A fit of counts: (intensity, exceeded, n) of each stripe.
#[pyfunction]
pub fn fit_stripes(
    py: Python<'_>,
    stripes: Vec<(f64, u64, u64)>,
    shift: f64,
) -> PyResult<String> {
    let stripes: Vec<Stripe> = stripes
        .into_iter()
        .map(|(im, exceeded, n)| Stripe { im, exceeded, n })
        .collect();
    answer(py, || fit_counts(&stripes, shift))
}

/// Tests of normality, of the logarithms above a shift if one is given.
#[pyfunction]
pub fn test_normality(
    py: Python<'_>,
    sample: SampleInput<'_>,
    shift: Option<String>,
    level: f64,
    replicates: Option<u64>,
    seed: u64,
) -> PyResult<String> {
    let sample = sample_of(&sample)?;
    let log_above = shift.map(|shift| shift.parse()).transpose();
    let log_above = log_above.map_err(refuse)?;
    let options = NormalityOptions { log_above, level, replicates, seed };
    answer(py, || test(&sample, &options))
}

/// Quantiles and boxplot of a sample.
#[pyfunction]
pub fn summarise(
    py: Python<'_>,
    values: PyReadonlyArray1<'_, f64>,
    probabilities: Vec<f64>,
    quantile_type: u8,
) -> PyResult<String> {
    let t = QuantileType::try_new(quantile_type).map_err(refuse)?;
    let values = values.as_slice()?;
    let sorted = || ExtendedSample::try_new(values);
    let sample = work::on_numbers(py, values.len(), sorted)?;
    let sample = sample.map_err(refuse)?;
    answer(py, || summarise_sample(&sample, &probabilities, t))
}

/// Two samples over the same records.
#[pyfunction]
pub fn compare(
    py: Python<'_>,
    a: SampleInput<'_>,
    b: SampleInput<'_>,
    margin: f64,
) -> PyResult<String> {
    let a = NamedSample { records: &a.3, values: a.0.as_slice()? };
    let b = NamedSample { records: &b.3, values: b.0.as_slice()? };
    answer(py, || compare_pairs(a, b, margin))
}

/// Two samples over different records.
#[pyfunction]
pub fn contrast(
    py: Python<'_>,
    a: SampleInput<'_>,
    b: SampleInput<'_>,
    replicates: usize,
    seed: u64,
) -> PyResult<String> {
    let (of_a, of_b) = (sample_of(&a)?, sample_of(&b)?);
    let a = ContrastSample { sample: &of_a, records: &a.3, events: &a.2 };
    let b = ContrastSample { sample: &of_b, records: &b.3, events: &b.2 };
    answer(py, || contrast_suites(a, b, Draws { replicates, seed }))
}

/// A function of the lognormal (shift, log_mean, dispersion) at each number.
#[pyfunction]
pub fn lognormal<'py>(
    py: Python<'py>,
    law: (f64, f64, f64),
    function: &str,
    numbers: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    type Function = fn(&Lognormal, f64) -> f64;
    let functions: [(&str, Function); 4] = [
        ("cdf", Lognormal::cdf),
        ("sf", Lognormal::survival),
        ("ppf", Lognormal::quantile),
        ("logpdf", Lognormal::ln_pdf),
    ];
    let of = choose("function", function, &functions)?;
    let law = Lognormal::try_new(law.0, law.1, law.2).map_err(refuse)?;
    let numbers = numbers.as_slice()?;
    let value = |x: &f64| {
        stop::point();
        of(&law, *x)
    };
    let values = || numbers.iter().map(value).collect::<Vec<f64>>();
    Ok(work::on_numbers(py, numbers.len(), values)?.into_pyarray(py))
}
