//! Why a case cannot be read.

use thiserror::Error;

use super::case::Bound;

/// Bytes of a case file, at most.
pub(super) const LARGEST: usize = 256 << 10;

/// Why a file of cases was refused.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("cases/{family}.toml: {fault}")]
pub struct CaseError {
    /// The family.
    pub family: String,
    /// What is wrong with its file.
    pub fault: CaseFault,
}

/// What is wrong with a file of cases; `place` is a case, or a table of
/// defaults.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CaseFault {
    /// The file is not of the expected form; with its line or its case.
    #[error("{0}")]
    Form(String),
    /// A value equals the one that its case would inherit.
    #[error("{place}: `{key}` repeats the inherited value: leave it out")]
    Repeated { place: String, key: String },
    /// No case inherits a default.
    #[error("{place}: no case inherits `{key}`")]
    Idle { place: String, key: String },
    /// A case does without a bound that it does not inherit.
    #[error(
        "{place}: `tolerance.without` names `{name}`, whose bound is not \
         inherited"
    )]
    Absent { place: String, name: String },
    /// No hand writes so many cases, and parsing takes a hundred times the
    /// text's memory.
    #[error("{0} bytes: expected at most {LARGEST}")]
    Long(usize),
    /// Two cases have one name.
    #[error("two cases are named `{0}`")]
    Duplicate(String),
    /// A file without cases proves nothing.
    #[error("no case")]
    Empty,
    /// A name is not of lower-case letters, digits, points and hyphens.
    #[error("case name `{0}`")]
    Name(String),
    /// A bound is negative or not a number.
    #[error("case `{name}`: bound of `{quantity}` is {bound:?}")]
    BadBound { name: String, quantity: String, bound: Bound },
    /// A text that must say something is empty.
    #[error("case `{name}`: `{field}` says nothing")]
    Silent { name: String, field: &'static str },
}
