//! Answers of other codes, scored.

use std::path::Path;

use pyo3::prelude::*;
use rocking_score::{Answers, SCENES, score as score_answers};

use crate::procedures::answer;
use crate::work::refuse;

/// The score of answers as CSV; `place` is their name in messages.
#[pyfunction]
pub fn score(py: Python<'_>, csv: &str, place: &str) -> PyResult<String> {
    let answers = Answers::parse(csv, Path::new(place)).map_err(refuse)?;
    answer(py, || Ok::<_, std::convert::Infallible>(score_answers(&answers)))
}

/// The scenes of the reference data set, as JSON.
#[pyfunction]
pub fn score_scenes() -> &'static str {
    SCENES
}
