//! Intensity measures of records.

use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rocking::intensity::{Measures, PairMeasures, Settings};

use crate::given::{Given, record_of, refuse};
use crate::work;

fn to_python<'py>(
    py: Python<'py>,
    found: &Measures,
) -> PyResult<Bound<'py, PyDict>> {
    let out = PyDict::new(py);
    out.set_item("pga_g", found.pga_g)?;
    out.set_item("pgv_m_s", found.pgv_m_s)?;
    out.set_item("pgd_m", found.pgd_m)?;
    out.set_item("arias_intensity_m_s", found.arias_intensity_m_s)?;
    out.set_item("cav_m_s", found.cav_m_s)?;
    let d5_75 = found.significant_duration_5_75_s;
    out.set_item("significant_duration_5_75_s", d5_75)?;
    let d5_95 = found.significant_duration_5_95_s;
    out.set_item("significant_duration_5_95_s", d5_95)?;
    out.set_item("mean_period_s", found.mean_period_s)?;
    let spectrum = found.spectral_acceleration_g.clone();
    out.set_item("spectral_acceleration_g", spectrum.into_pyarray(py))?;
    Ok(out)
}

/// The measures of one component.
#[pyfunction]
pub fn intensity_measures<'py>(
    py: Python<'py>,
    record: Given<'py>,
    periods: Vec<f64>,
    damping: f64,
    gravity: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let record = record_of(record)?;
    let settings =
        Settings::try_new(gravity, damping, periods).map_err(refuse)?;
    let found = work::alone(py, || Measures::of(&record, &settings))?;
    to_python(py, &found.map_err(refuse)?)
}

/// RotD50 of the measures of two components.
#[pyfunction]
pub fn rotd50<'py>(
    py: Python<'py>,
    first: Given<'py>,
    second: Given<'py>,
    periods: Vec<f64>,
    damping: f64,
    gravity: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let (first, second) = (record_of(first)?, record_of(second)?);
    let settings =
        Settings::try_new(gravity, damping, periods).map_err(refuse)?;
    let measures = || PairMeasures::of(&first, &second, &settings);
    let found = work::alone(py, measures)?;
    to_python(py, &found.map_err(refuse)?.rotd50)
}
