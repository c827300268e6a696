//! Why a suite was refused.

use thiserror::Error;

use super::SetAside;
use crate::error::RecordError;
use rocking::accelerogram::SuiteNameError;

/// A suite that was refused.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SuiteError {
    /// The folder or index could not be read.
    #[error("{path}: cannot be read: {reason}")]
    Unreadable {
        /// Folder or index.
        path: String,
        /// Message of the operating system.
        reason: String,
    },
    /// A record was refused.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A folder or index without a record.
    #[error(
        "{path}: no readable record in it: expected at least one{}",
        instead(set_aside)
    )]
    Empty {
        /// Folder or index.
        path: String,
        /// Its contents instead.
        set_aside: SetAside,
    },
    /// An index without a column `file`, or a row that does not fit.
    #[error("{path}:{line}: {found:?}: expected {expected}")]
    Index {
        /// The index.
        path: String,
        /// Line, counted from 1.
        line: usize,
        /// The text found.
        found: String,
        /// The text expected.
        expected: String,
    },
    /// A record that contradicts its row in the index.
    #[error(
        "{path}:{line}: {file} has {quantity} {found}: expected {expected}, as in the index"
    )]
    Mismatch {
        /// The index.
        path: String,
        /// Line, counted from 1.
        line: usize,
        /// The record.
        file: String,
        /// Column of the index.
        quantity: &'static str,
        /// Value of the record.
        found: String,
        /// Value of the index.
        expected: String,
    },
    /// Records that results could not distinguish.
    #[error("{path}: {source}")]
    Names {
        /// Folder or index.
        path: String,
        /// Which.
        #[source]
        source: SuiteNameError,
    },
    /// A record that changed between two readings.
    #[error(
        "{path}: record {name:?} has changed since it was first read: expected files that stay as they are"
    )]
    Changed {
        /// Folder or index.
        path: String,
        /// The record.
        name: String,
    },
    /// A pair without exactly one study component, or of more than two.
    #[error(
        "{path}: pair {pair:?} has {components} components, {study} for the study: expected at most 2, and 1 for the study"
    )]
    Pair {
        /// Folder or index.
        path: String,
        /// The pair.
        pair: String,
        /// Number of components.
        components: usize,
        /// Number of components that are marked for the study.
        study: usize,
    },
}

/// A result of reading a suite.
pub(super) type Result<T, E = SuiteError> = std::result::Result<T, E>;

/// Contents of the folder instead of records.
fn instead(set_aside: &SetAside) -> String {
    if set_aside.is_empty() {
        return String::new();
    }
    format!("; set aside: {set_aside}")
}

impl SuiteError {
    /// The file that was refused: a record, else the folder or index.
    pub fn file(&self) -> &str {
        match self {
            Self::Record(error) => &error.file,
            Self::Mismatch { file, .. } => file,
            Self::Unreadable { path, .. }
            | Self::Empty { path, .. }
            | Self::Index { path, .. }
            | Self::Changed { path, .. }
            | Self::Names { path, .. }
            | Self::Pair { path, .. } => path,
        }
    }

    /// Short name of the reason, the same in every version.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Record(error) => error.fault.code(),
            Self::Unreadable { .. } => "unreadable",
            Self::Empty { .. } => "empty",
            Self::Index { .. } => "index",
            Self::Mismatch { .. } => "mismatch",
            Self::Names { .. } => "same-name",
            Self::Changed { .. } => "changed",
            Self::Pair { .. } => "pair",
        }
    }

    /// Line of that file, counted from 1.
    pub fn line(&self) -> Option<usize> {
        match self {
            Self::Record(error) => error.line,
            Self::Index { line, .. } => Some(*line),
            _ => None,
        }
    }
}
