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

use std::fmt::Display;

use serde::{Serialize, Serializer};

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

/// Writes a value, or `{"reason": "..."}` if there is none.
pub(crate) fn or_reason<T: Serialize, E: Display, S: Serializer>(
    found: &Result<T, E>,
    to: S,
) -> Result<S::Ok, S::Error> {
    match found {
        Ok(value) => value.serialize(to),
        Err(error) => to.collect_map([("reason", error.to_string())]),
    }
}

/// Writes as [`or_reason`] does, and nothing for `None`.
pub(crate) fn if_known<T: Serialize, E: Display, S: Serializer>(
    found: &Option<Result<T, E>>,
    to: S,
) -> Result<S::Ok, S::Error> {
    match found {
        None => to.serialize_none(),
        Some(found) => or_reason(found, to),
    }
}
