//! Why a method gave no answer.

use rocking::names::UnknownName;
use thiserror::Error;

use crate::scene::EngineError;

/// Why a method gave no answer.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MethodError {
    /// No method of this name is registered.
    #[error("method `{0}` is not registered")]
    Unknown(String),
    /// The input is not what the method reads.
    #[error("input: {0}")]
    Input(String),
    /// A name in the input that is none.
    #[error("input: {0}")]
    Name(#[from] UnknownName),
    /// A reference lacks what was asked for.
    #[error("{file}: {what}")]
    Reference {
        /// The file.
        file: &'static str,
        /// What is missing.
        what: String,
    },
    /// The engine gave no trace.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// An oracle has no value for this input.
    #[error("oracle: {0}")]
    Oracle(String),
}
