//! A reference case.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::wrong::WrongModel;
use rocking::names::named;

named! {
    /// The kind of evidence a family gives.
    pub enum EvidenceKind: "kind" {
        /// The code does what the model says: closed forms, high precision.
        CodeVerification = "code-verification",
        /// The numerical error has the size that the method promises.
        SolutionVerification = "solution-verification",
        /// The model against published findings.
        ModelComparison = "model-comparison",
        /// A statistical procedure keeps its stated error rates.
        StatisticalCalibration = "statistical-calibration",
        /// An accepted number of this program.
        Regression = "regression",
    }
}

/// A family: one file of cases.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Family {
    /// One line for people.
    pub title: String,
    /// Kind of evidence.
    pub kind: EvidenceKind,
    /// Defaults of every case of the file.
    #[serde(default)]
    pub default: toml::Table,
    /// Defaults of the cases of a method.
    #[serde(default)]
    pub method: BTreeMap<String, toml::Table>,
}

/// Source of a claim.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaseSource {
    /// Author and year, or the document.
    pub cite: String,
    /// Equation, table or section.
    #[serde(rename = "where")]
    pub place: String,
    /// A note for readers.
    #[serde(default)]
    pub note: String,
}

/// Runs that include a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cost {
    /// In every `cargo test`.
    Quick,
    /// Only with `--full`.
    Full,
}

named! {
    /// Nature of the expected values.
    pub enum OracleKind: "oracle" {
        /// A formula, evaluated outside the code under test.
        ClosedForm = "closed-form",
        /// An independent computation in high precision.
        HighPrecision = "high-precision",
        /// A property that needs no outside number (symmetry, invariance).
        Property = "property",
        /// Refinement of the method itself.
        SelfConvergence = "self-convergence",
        /// Another program.
        ExternalCode = "external-code",
        /// Published numbers.
        Published = "published",
        /// Measurements.
        Experiment = "experiment",
        /// Simulation with known truth.
        KnownTruthSimulation = "known-truth-simulation",
        /// Earlier output of this program.
        OwnOutput = "own-output",
    }
}

/// Expected values.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expect {
    /// Nature of the values.
    pub oracle: OracleKind,
    /// File or module the values come from.
    pub origin: String,
    /// Values that the case lists, by quantity; the method gives the others.
    #[serde(default)]
    pub values: BTreeMap<String, Values>,
}

/// One number or a list.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Values {
    /// One number.
    One(f64),
    /// A list.
    Many(Vec<f64>),
}

impl Values {
    /// The numbers as a list.
    pub fn to_vec(&self) -> Vec<f64> {
        match self {
            Self::One(x) => vec![*x],
            Self::Many(xs) => xs.clone(),
        }
    }
}

/// Allowed distance of a quantity from its expected value.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Bound {
    /// Equal as numbers.
    Exact,
    /// |observed - expected| at most this.
    Absolute(f64),
    /// |observed - expected| at most this times |expected|.
    Relative(f64),
    /// Observed inside [low, high]; no expected value.
    Interval(f64, f64),
    /// Observed order of convergence at least the expected one less this.
    Order(f64),
    /// Not required of this case, for this reason.
    Waived(String),
}

/// Origin of a bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToleranceBasis {
    /// 100 times the error of a careful double-precision code, but at least
    /// 1e-13.
    AttainableFloat64,
    /// Rounding of the evaluated formula times its condition number.
    Conditioning,
    /// The bits must be equal.
    Identity,
    /// Digits printed by the source.
    ReferenceRounding,
    /// Step size and order.
    Discretisation,
    /// Sampling error.
    Sampling,
    /// Digitising or measuring error.
    Measurement,
}

/// Tolerances, their reason, and the wrong models that must break them.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tolerance {
    /// Origin of the bounds.
    pub basis: ToleranceBasis,
    /// The reason for the bounds.
    pub because: String,
    /// Bound of each quantity.
    pub bounds: BTreeMap<String, Bound>,
    /// Wrong models that must fail the case.
    #[serde(default)]
    pub reject: Vec<WrongModel>,
    /// Bound, of the same kind, at which the naive integrator with correct
    /// rules passes; required if a wrong algorithm is rejected.
    #[serde(default)]
    pub naive: Option<f64>,
}

/// One reference case.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// `family/name`; in the file only the name.
    #[serde(rename = "name")]
    pub id: String,
    /// Name of the family; not in the file.
    pub family: String,
    /// Kind of evidence, from the family; not in the file.
    pub kind: EvidenceKind,
    /// The claim.
    pub claim: String,
    /// Source of the claim.
    pub source: CaseSource,
    /// Name of the registered method.
    pub method: String,
    /// Runs that include it.
    pub cost: Cost,
    /// Input of the method.
    #[serde(default)]
    pub input: toml::Table,
    /// Expected values.
    pub expect: Expect,
    /// Tolerances.
    pub tolerance: Tolerance,
}
