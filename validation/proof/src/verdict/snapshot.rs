//! The committed form of the results: sorted by id, rounded to the digits
//! that the bounds support, one value a line.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{CaseOutcome, CaseVerdict, Check, Rejection};
use crate::cases::{Bound, EvidenceKind, OracleKind};
use rocking_common::json::{self, Extended};
use rocking_common::words::rounded;

/// Results of cases by their ids.
pub type Results = BTreeMap<String, CaseResult>;

/// The result of a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaseResult {
    /// Kind of evidence.
    pub kind: EvidenceKind,
    /// Name of the method.
    pub method: String,
    /// Nature of the expected values.
    pub oracle: OracleKind,
    /// Quantities by name.
    pub quantities: BTreeMap<String, QuantityResult>,
    /// Wrong models that the case rejected.
    pub rejected: BTreeMap<String, Rejection>,
    /// The verdict.
    pub verdict: CaseVerdict,
}

/// A quantity against its bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QuantityResult {
    /// The bound: a number, two for an interval, null if it is waived.
    pub bound: Value,
    /// The first values.
    pub first: Vec<Extended>,
    /// Kind of the bound.
    pub kind: String,
    /// Error over bound.
    pub margin: Extended,
    /// Number of values.
    pub values: usize,
}

impl CaseResult {
    /// True if the case passed.
    pub fn passed(&self) -> bool {
        self.verdict == CaseVerdict::Pass
    }

    /// Quantities whose bound is not waived.
    pub fn compared(
        &self,
    ) -> impl Iterator<Item = (&String, &QuantityResult)> {
        self.quantities.iter().filter(|(_, q)| q.kind != "waived")
    }
}

/// Most digits printed of any number.
const MOST_DIGITS: usize = 9;
/// Values printed of a list.
const MOST_VALUES: usize = 3;

/// The snapshot's text, ending in a line feed.
pub fn text(outcomes: &[CaseOutcome]) -> String {
    let entry =
        |outcome: &CaseOutcome| (outcome.case.id.clone(), entry(outcome));
    let all: Results = outcomes.iter().map(entry).collect();
    format!("{:#}\n", json!(all))
}

fn entry(outcome: &CaseOutcome) -> CaseResult {
    let checks = outcome.checks.iter();
    let mut rejected = outcome.rejections.clone();
    for by in rejected.values_mut() {
        by.margin.0 = rounded(by.margin.0, 1);
    }
    CaseResult {
        kind: outcome.case.kind,
        method: outcome.case.method.clone(),
        oracle: outcome.case.expect.oracle,
        quantities: checks
            .map(|check| (check.quantity.clone(), quantity(check)))
            .collect(),
        rejected,
        verdict: outcome.verdict,
    }
}

fn quantity(check: &Check) -> QuantityResult {
    let digits = digits(check);
    let shown = check.observed.iter().take(MOST_VALUES);
    let (kind, bound) = match &check.bound {
        Bound::Exact => ("exact", json!(0)),
        Bound::Absolute(x) => ("absolute", json::extended(*x)),
        Bound::Relative(x) => ("relative", json::extended(*x)),
        Bound::Order(x) => ("order", json::extended(*x)),
        Bound::Interval(low, high) => {
            ("interval", json!([low, high].map(|x| Extended(*x))))
        }
        Bound::Waived(_) => ("waived", Value::Null),
    };
    QuantityResult {
        bound,
        first: shown.map(|x| Extended(rounded(*x, digits))).collect(),
        kind: kind.to_owned(),
        // An error at the level of rounding moves with every change of the
        // code: only its size is shown.
        margin: Extended(rounded(check.margin, 1)),
        values: check.observed.len(),
    }
}

/// Significant digits that the bound supports.
fn digits(check: &Check) -> usize {
    let observed = check.observed.iter();
    let largest = observed.fold(0.0, |a: f64, x| a.max(x.abs()));
    let relative = match check.bound {
        Bound::Relative(x) => x,
        Bound::Absolute(x) if largest > 0.0 => x / largest,
        Bound::Exact => 0.0,
        _ => 1e-3,
    };
    let mut digits = 1;
    let mut unit = 0.1;
    while digits < MOST_DIGITS && relative < unit {
        digits += 1;
        unit *= 0.1;
    }
    digits
}
