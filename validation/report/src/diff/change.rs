//! The differences between two sets of results.

use std::collections::BTreeMap;

use serde::Serialize;

use super::effect::{OverturningChange, RecordSets};
use super::number::NumberChange;

/// The differences between two sets of results.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Difference {
    /// Number of relevant changes: of answers, verdicts, settings and records,
    /// of numbers beyond the smallest effect of interest or their tolerance,
    /// and of parts that one side lacks.
    pub relevant: usize,
    /// Whether nothing differs in what both sides have.
    pub identical: bool,
    /// Number of results of each kind that both sides have.
    pub compared: BTreeMap<Subject, usize>,
    /// The records of each suite.
    pub(super) records: BTreeMap<String, RecordSets>,
    /// The change of overturning intensities.
    pub(super) effect: OverturningChange,
    /// The changes; the heaviest of each kind comes first.
    pub changes: Vec<Change>,
    /// Remarks on the comparison.
    pub notes: Vec<String>,
}

/// The subject of a change.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Subject {
    /// A setting, or the source of a suite.
    Setting,
    /// The answer to a question of the first table.
    Answer,
    /// The words and numbers of an answer that stays.
    Wording,
    /// Whether a statement is seen, or its effect exists.
    Finding,
    /// The verdict on a reference case.
    Case,
    /// A number.
    Number,
    /// A part of the results.
    Part,
    /// Texts, intervals and details around results.
    #[default]
    Text,
}

/// A result that differs.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Change {
    /// Its kind.
    pub kind: Subject,
    /// Its name.
    pub what: String,
    /// The old value; none if the old results lack it.
    pub old: Option<String>,
    /// The new value.
    pub new: Option<String>,
    /// Whether it is more than a text, or a move within the limit.
    pub relevant: bool,
    /// Whether a verdict turned from yes to no or the opposite, or back.
    pub opposite: bool,
    /// The move of the number, or of the number under a verdict.
    pub moved: Option<NumberChange>,
    /// The reason why one side lacks it, if known.
    pub why: Option<String>,
}

impl Change {
    /// Whether both sides have it.
    pub(super) fn is_common(&self) -> bool {
        self.old.is_some() && self.new.is_some()
    }
}
