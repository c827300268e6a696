//! What results say, one thing each.

use std::collections::BTreeMap;

use super::moved::Number;
use rocking_common::paper::Verdict;

/// One thing that results say.
#[derive(Clone, Debug)]
pub struct Item {
    /// What it is about, in the order of consequence.
    pub topic: &'static str,
    /// What it belongs to: a claim, a case, a table.
    pub owner: String,
    /// Its name within the owner.
    pub name: String,
    /// What it is, in words, without its place.
    pub words: String,
    /// Suite and arm, or the cell of a table.
    pub place: String,
    /// What it says.
    pub content: Content,
}

/// What an item says.
#[derive(Clone, Debug)]
pub enum Content {
    /// The answer to a question of the first table: the verdicts that it is
    /// made from, and the sentence.
    Answer(Vec<Vec<Verdict>>, String),
    /// Whether a claim or a case holds.
    Verdict(String),
    /// What makes two runs different runs: a setting, a suite, a declared
    /// tolerance.
    Setting(String),
    /// Words, intervals and details around results.
    Text(String),
    /// A result.
    Number(Number),
}

impl Item {
    /// By what it is found on the other side.
    pub fn key(&self) -> (&str, &str) {
        (&self.owner, &self.name)
    }

    /// Counts it among the results that one side lacks; a text is none.
    pub fn count_in(&self, list: &mut BTreeMap<String, usize>) {
        if !matches!(self.content, Content::Text(_)) {
            *list.entry(self.owner.clone()).or_default() += 1;
        }
    }
}
