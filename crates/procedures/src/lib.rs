//! Fragility, risk and assessment: functions with typed results.
//!
//! Each procedure takes checked inputs and an options type, and gives one
//! result. The command line, the Python package, the study and the report
//! call these functions and show their results; none of them computes. A
//! result says its units in the names of its fields, has its intervals beside
//! its values, and is a `serde::Serialize`: a number that is not finite
//! becomes `null` in JSON.
//!
//! [`fragility`] has Eqs. 5 to 7, hazard curves and the annual frequency.
//! `examples/fragility.rs` goes from a folder of records to a fragility in 25
//! lines.

#![deny(missing_docs)]

/// Level of all intervals.
const LEVEL: f64 = 0.95;

pub mod assess;
pub mod capacities;
pub mod cloud;
pub mod comparison;
pub mod contrast;
pub mod counts;
pub mod fit;
pub mod fragility;
pub mod ida_summary;
mod inversion;
pub mod law;
pub mod model_error;
pub mod normality;
pub mod pivot;
pub mod ranking;
pub mod risk;
pub mod shaking;
pub mod shaking_table;
pub mod stripes;
pub mod summary;

pub use assess::{AssessOptions, Assessment, Object, assess};
pub use cloud::{CloudError, CloudFragility, CloudOptions, fit_cloud};
pub use comparison::{Comparison, ComparisonError, compare};
pub use contrast::{Contrast, ContrastError, contrast};
pub use counts::{
    CountsFragility, fit_outcomes, fit_stripes, sample_outcomes,
};
pub use fit::{
    BootstrapFits, DispersionRule, Draws, FitOptions, FitRemark, FragilityFit,
    LevelFit, ProcedureError, Shift, fit_levels, fit_sample,
};
pub use ida_summary::{IdaSummary, summarise_ida};
pub use inversion::inversion_discrepancy;
pub use law::{LawError, LawFragility, law_fragility};
pub use model_error::ModelError;
pub use normality::{Normality, NormalityOptions, test_normality};
pub use pivot::{PivotForces, pivot_forces};
pub use ranking::{Ranking, rank};
pub use risk::{FragilityInput, Risk, RiskError, risk};
pub use shaking::{TestComparison, compare_with_tests};
pub use stripes::{StripeResponses, stripes};
pub use summary::{Summary, summarise};

/// Writes a value, or why there is none as `{"reason": "..."}`.
pub(crate) fn or_reason<T: serde::Serialize, E: std::fmt::Display, S>(
    found: &Result<T, E>,
    to: S,
) -> Result<S::Ok, S::Error>
where
    S: serde::Serializer,
{
    use serde::ser::SerializeMap as _;
    match found {
        Ok(value) => value.serialize(to),
        Err(error) => {
            let mut map = to.serialize_map(Some(1))?;
            map.serialize_entry("reason", &error.to_string())?;
            map.end()
        }
    }
}

/// Writes nothing, a value, or why there is none.
pub(crate) fn if_known<T: serde::Serialize, E: std::fmt::Display, S>(
    found: &Option<Result<T, E>>,
    to: S,
) -> Result<S::Ok, S::Error>
where
    S: serde::Serializer,
{
    match found {
        None => to.serialize_none(),
        Some(found) => or_reason(found, to),
    }
}
