//! What the report shows of the proof: the declared cases with their
//! results, the digits that each precision reaches, and figures of closed
//! forms.

mod defect;
mod families;
mod spectrum;

pub use families::families;

use serde_json::Value;

use crate::cases::{CaseError, load_all};
use crate::figures::data::Chart;
use crate::report::{Family, PlainTable};
use crate::scene::EngineError;

/// The committed results of the declared cases.
const RESULTS: &str = include_str!("../../reports/data/validation.json");
/// The committed table of digits.
const DIGITS: &str = include_str!("../../reports/data/precision.csv");

/// Why there is nothing to show.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EvidenceError {
    /// The cases cannot be read.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// The results cannot be read.
    #[error("reports/data/validation.json: {0}")]
    Results(#[from] serde_json::Error),
    /// A scene of a figure cannot be run.
    #[error(transparent)]
    Engine(#[from] EngineError),
}

/// A chart and the sentence that says what one sees.
pub struct ShownChart {
    /// Its number in the report.
    pub number: String,
    /// The drawing and its numbers.
    pub chart: Chart,
    /// What one sees, made from the numbers.
    pub reading: String,
}

/// Declared cases with the committed results, family by family.
///
/// # Errors
/// [`EvidenceError`] where cases or results cannot be read.
pub fn committed_families() -> Result<Vec<Family>, EvidenceError> {
    Ok(families(&load_all()?, &committed_results()?))
}

/// The committed results of the declared cases, by id.
///
/// # Errors
/// [`EvidenceError::Results`] where they cannot be read.
pub fn committed_results() -> Result<Value, EvidenceError> {
    Ok(serde_json::from_str(RESULTS)?)
}

/// Significant digits that each precision reaches on the hard cases and the
/// reference trajectories.
#[must_use]
pub fn digits_table() -> PlainTable {
    let mut table = PlainTable::from_csv(
        "table-precision",
        "Table 2. Significant digits reached by three precisions",
        "End: the peak of |theta|/alpha, or the instant of overturning. \
         Impacts: the worst of the instants and speeds of the first ten. \
         Where there is no reference of 36 digits the truth is the \
         double-double run. The same source runs in all three; a digit \
         missing in double precision is missing for the sensitivity of the \
         motion, which the error estimate states.",
        DIGITS,
    );
    table.header = [
        "case",
        "equation",
        "truth",
        "end, single",
        "end, double",
        "end, double-double",
        "impacts, single",
        "impacts, double",
        "impacts, double-double",
    ]
    .map(String::from)
    .into();
    table
}

/// The figures of the proof.
///
/// # Errors
/// [`EvidenceError::Engine`] where a scene is refused.
pub fn charts() -> Result<Vec<ShownChart>, EvidenceError> {
    Ok(vec![defect::chart()?, spectrum::chart()?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::Cost;
    use crate::figures::Figure as _;

    #[test]
    fn charts_have_something_in_every_series() {
        for shown in charts().unwrap() {
            assert!(shown.chart.svg().unwrap().starts_with("<svg"));
            assert!(!shown.reading.contains("NaN"), "{}", shown.reading);
            for series in shown.chart.panels.iter().flat_map(|p| &p.series) {
                let drawn = series.y.iter().filter(|y| y.is_finite()).count();
                assert!(drawn >= 2, "{}: {drawn}", series.label);
            }
        }
    }

    #[test]
    fn committed_results_fit_the_cases() {
        let families = committed_families().unwrap();
        let cases: usize = families.iter().map(|f| f.cases.len()).sum();
        let all = load_all().unwrap();
        let quick = all.iter().filter(|c| c.cost == Cost::Quick).count();
        assert_eq!(cases, quick);
        let shown = families.iter().flat_map(|f| &f.cases);
        assert!(shown.into_iter().all(|c| c.error != "no result"));
        assert!(digits_table().rows.len() > 30);
    }
}
