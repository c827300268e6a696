//! What changed between two sets of results, in engineering terms.
//!
//! [`compare`] walks over both as trees of JSON. A [`Difference`] has what
//! changed, each number against the smallest effect of interest.

mod effect;
mod input;
mod number;
mod print;
#[cfg(test)]
mod tests;
mod walk;

use std::cmp::Reverse;
use std::collections::BTreeMap;

use anyhow::bail;
use serde::Serialize;

use effect::{OverturningChange, RecordSets};
use input::NAMES;
use number::NumberChange;
use walk::Walk;

pub use input::ResultFiles;

/// What two sets of results say differently.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Difference {
    /// Number of changes that are relevant: of answers, verdicts, settings
    /// and records, of numbers beyond the smallest effect of interest or
    /// their tolerance, and of what is on one side only.
    pub relevant: usize,
    /// Whether nothing at all differs in what both sides have.
    pub identical: bool,
    /// How many of each kind both sides have.
    pub compared: BTreeMap<Subject, usize>,
    /// The records of each suite.
    records: BTreeMap<String, RecordSets>,
    /// What became of the overturning intensities.
    effect: OverturningChange,
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
    /// A verdict on a claim.
    Verdict,
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
    /// Whether a verdict went from confirmed to not confirmed or back.
    pub opposite: bool,
    /// How the number moved, or that under the verdict.
    pub moved: Option<NumberChange>,
    /// Why one side lacks it, where that is known.
    pub why: Option<String>,
}

impl Change {
    /// Whether both sides have it.
    fn is_common(&self) -> bool {
        self.old.is_some() && self.new.is_some()
    }
}

/// Sets two results beside each other.
///
/// # Errors
/// Where no file of one kind is on both sides.
pub fn compare(
    old: &ResultFiles,
    new: &ResultFiles,
) -> anyhow::Result<Difference> {
    let mut out = Difference::default();
    let mut common = false;
    for (name, trees) in NAMES.iter().zip(old.trees.iter().zip(&new.trees)) {
        match trees {
            (Some(a), Some(b)) => {
                common = true;
                let mut walk = Walk { roots: [a, b], out: &mut out };
                walk.compare(&[], [Some(a), Some(b)]);
            }
            (None, None) => {}
            (old, _) => {
                let side = if old.is_some() { "old" } else { "new" };
                out.notes.push(format!(
                    "Not compared: {name}, which only the {side} results \
                     have."
                ));
            }
        }
    }
    if !common {
        bail!(
            "{} and {} have nothing in common: expected findings on both \
             sides, or results of cases on both",
            old.path.display(),
            new.path.display()
        );
    }
    let other = out.records.values().filter(|r| !r.are_same()).count();
    out.identical = out.changes.is_empty() && other == 0;
    let relevant = out.changes.iter().filter(|change| change.relevant);
    out.relevant = relevant.count() + other;
    out.changes.sort_by_key(|change| {
        let weight = change.moved.as_ref().map(NumberChange::weight);
        Reverse((change.relevant, change.opposite, weight))
    });
    Ok(out)
}
