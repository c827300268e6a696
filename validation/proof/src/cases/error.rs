//! Why a case cannot be read.

use thiserror::Error;

use super::case::Bound;

/// Bytes of a case file, at most.
pub(super) const LARGEST: usize = 256 << 10;

/// Why a file of cases was refused.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CaseError {
    /// The file is not of the expected form.
    #[error("cases/{family}.toml: {message}")]
    Form {
        /// The family.
        family: String,
        /// What is wrong, with its line or its case.
        message: String,
    },
    /// A value equals the one that its case would inherit.
    #[error(
        "cases/{family}.toml: {place}: `{key}` repeats the inherited value: \
         leave it out"
    )]
    Repeated {
        /// The family.
        family: String,
        /// The case, or the table of defaults.
        place: String,
        /// The key.
        key: String,
    },
    /// No case inherits a default.
    #[error("cases/{family}.toml: {place}: no case inherits `{key}`")]
    Idle {
        /// The family.
        family: String,
        /// The table of defaults.
        place: String,
        /// The key.
        key: String,
    },
    /// A case does without a bound that it does not inherit.
    #[error(
        "cases/{family}.toml: {place}: `tolerance.without` names `{name}`, \
         of which no bound is inherited"
    )]
    Absent {
        /// The family.
        family: String,
        /// The case, or the table of defaults.
        place: String,
        /// The quantity.
        name: String,
    },
    /// No hand writes so many cases, and parsing takes a hundred times the
    /// text's memory.
    #[error("cases/{family}.toml: {bytes} bytes: expected at most {LARGEST}")]
    Long {
        /// The family.
        family: String,
        /// Length of the text.
        bytes: usize,
    },
    /// Two cases have one name.
    #[error("cases/{family}.toml: two cases are named `{name}`")]
    Duplicate {
        /// The family.
        family: String,
        /// The name.
        name: String,
    },
    /// A file without cases proves nothing.
    #[error("cases/{family}.toml: no case")]
    Empty {
        /// The family.
        family: String,
    },
    /// A name is not of lower-case letters, digits, points and hyphens.
    #[error("cases/{family}.toml: case name `{name}`")]
    Name {
        /// The family.
        family: String,
        /// The name.
        name: String,
    },
    /// A bound is negative or not a number.
    #[error("{id}: bound of `{quantity}` is {bound:?}")]
    BadBound {
        /// The case.
        id: String,
        /// The quantity.
        quantity: String,
        /// What was found.
        bound: Bound,
    },
    /// A text that must say something is empty.
    #[error("{id}: `{field}` says nothing")]
    Silent {
        /// The case.
        id: String,
        /// The field.
        field: &'static str,
    },
}
