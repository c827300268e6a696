//! Intensity measures of records, as the JSON of their fields.

use pyo3::prelude::*;
use rocking_records::intensity::velocity_pulse::{candidates, pulse};
use rocking_records::intensity::{
    IntensityError, Measures, PairMeasures, Settings,
};

use crate::given::{ExcitationInput, record_of};
use crate::procedures::answer;
use crate::work::refuse;

/// The measures of one component, or a percentile of those of two over all
/// directions.
#[pyfunction]
pub fn intensity_measures(
    py: Python<'_>,
    record: ExcitationInput<'_>,
    second: Option<(ExcitationInput<'_>, f64)>,
    periods: Vec<f64>,
    damping: f64,
    gravity: f64,
) -> PyResult<String> {
    let first = record_of(record)?;
    let settings =
        Settings::try_new(gravity, damping, periods).map_err(refuse)?;
    let Some((second, percentile)) = second else {
        return answer(py, || Measures::of(&first, &settings));
    };
    let second = record_of(second)?;
    answer(py, || {
        let pair =
            PairMeasures::of(&first, &second, &settings, &[percentile])?;
        Ok::<_, IntensityError>(pair.rotd.into_iter().next())
    })
}

/// The velocity pulse of two components; `null` where there is none.
#[pyfunction]
pub fn velocity_pulse(
    py: Python<'_>,
    first: ExcitationInput<'_>,
    second: ExcitationInput<'_>,
    gravity: f64,
) -> PyResult<String> {
    let (first, second) = (record_of(first)?, record_of(second)?);
    answer(py, || {
        let found = candidates(&first, &second, gravity)?;
        Ok::<_, IntensityError>(pulse(&found).cloned())
    })
}
