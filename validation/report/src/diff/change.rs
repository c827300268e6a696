//! What two sets of results say differently.

use std::collections::BTreeMap;

use serde::Serialize;

use super::effect::{OverturningChange, RecordSets};
use super::number::NumberChange;

/// What two sets of results say differently.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Difference {
    /// Number of changes that are relevant: of answers, findings, settings
    /// and records, of numbers beyond the smallest effect of interest or
    /// their tolerance, and of what is on one side only.
    pub relevant: usize,
    /// Whether nothing at all differs in what both sides have.
    pub identical: bool,
    /// How many of each kind both sides have.
    pub compared: BTreeMap<Subject, usize>,
    /// The records of each suite.
    pub(super) records: BTreeMap<String, RecordSets>,
    /// What became of the overturning intensities.
    pub(super) effect: OverturningChange,
    /// What changed; of each kind, what weighs most comes first.
    pub changes: Vec<Change>,
    /// What else is to be known of the comparison.
    pub notes: Vec<String>,
}

/// What a change is of.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Subject {
    /// What was set, or where a suite is from.
    Setting,
    /// The answer to a question of the first table.
    Answer,
    /// An answer that stays, with its words and numbers.
    Wording,
    /// Whether a claim is seen, or its effect exists.
    Finding,
    /// The verdict on a declared case.
    Case,
    /// A number.
    Number,
    /// A part of the results.
    Part,
    /// Words, intervals and details around results.
    #[default]
    Text,
}

/// Something that is said differently.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Change {
    /// What it is of.
    pub kind: Subject,
    /// What it is about.
    pub what: String,
    /// What the old results say; nothing where they lack it.
    pub old: Option<String>,
    /// What the new results say.
    pub new: Option<String>,
    /// Whether it is more than words, or a move within the limit.
    pub relevant: bool,
    /// Whether a word on a claim went from yes to no or the opposite, or
    /// back.
    pub opposite: bool,
    /// How the number moved, or that under the word.
    pub moved: Option<NumberChange>,
    /// Why one side lacks it, where that is known.
    pub why: Option<String>,
}

impl Change {
    /// Whether both sides have it.
    pub(super) fn is_common(&self) -> bool {
        self.old.is_some() && self.new.is_some()
    }
}
