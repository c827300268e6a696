//! What changed between two sets of results, in engineering terms.
//!
//! Findings of a study and results of declared cases become `Item`s.
//! [`compare`] sets like beside like; a [`Comparison`] has the answers and
//! verdicts that changed, and the numbers by kind, each against the smallest
//! effect of interest.

mod cases;
mod findings;
mod input;
mod item;
mod moved;
mod print;
mod records;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use anyhow::bail;
use serde::Serialize;

use input::NAMES;
use item::{Content, Item};
use moved::{Kind, Number};

pub use input::Results;

/// What two sets of results say differently.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Comparison {
    /// Whether nothing at all differs in what both sides have.
    pub identical: bool,
    /// Answers of the first table, by their questions.
    pub answers: Changes,
    /// Verdicts on claims and cases.
    pub verdicts: Changes,
    /// Numbers that are compared.
    pub compared: usize,
    /// Kinds of numbers of which some moved, in the order of consequence.
    pub numbers: Vec<Kind>,
    /// What was asked for, and the suites: the likely cause.
    pub settings: Changes,
    /// Words, intervals and details around results.
    pub texts: Changes,
    /// What only the new results have, with the number of results.
    pub appeared: BTreeMap<String, usize>,
    /// What only the old results have, with the number of results.
    pub vanished: BTreeMap<String, usize>,
    /// What else is to be known of the comparison.
    pub notes: Vec<String>,
}

/// What differs of one sort.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Changes {
    /// So many are on both sides.
    pub compared: usize,
    /// Those that differ.
    pub changed: Vec<Change>,
}

impl Changes {
    /// Number of those that differ, in every suite and arm.
    pub fn count(&self) -> usize {
        self.changed.iter().map(|change| change.places.len().max(1)).sum()
    }
}

/// Something that is said differently.
#[derive(Clone, Debug, Serialize)]
pub struct Change {
    /// What it is about.
    pub what: String,
    /// Suites and arms where it is so; may be empty.
    pub places: Vec<String>,
    /// What the old results say.
    pub old: String,
    /// What the new results say.
    pub new: String,
}

impl Comparison {
    /// Number of changes that matter: of answers, verdicts and settings, of
    /// numbers beyond the smallest effect of interest or their tolerance, and
    /// of what is on one side only.
    pub fn significant(&self) -> usize {
        let said = [&self.answers, &self.verdicts, &self.settings];
        said.map(Changes::count).iter().sum::<usize>()
            + self.numbers.iter().map(Kind::beyond).sum::<usize>()
            + self.appeared.len()
            + self.vanished.len()
    }

    fn items(&mut self, old: &[Item], new: &[Item]) {
        let (before, after) = (by_key(old), by_key(new));
        for item in old {
            match after.get(&item.key()) {
                Some(other) => self.pair(item, other),
                None => item.count_in(&mut self.vanished),
            }
        }
        for item in new.iter().filter(|i| !before.contains_key(&i.key())) {
            item.count_in(&mut self.appeared);
        }
    }

    fn pair(&mut self, old: &Item, new: &Item) {
        use Content::{Answer, Number, Setting, Text, Verdict};
        let (list, a, b) = match (&old.content, &new.content) {
            (Number(a), Number(b)) => return self.number(old, a, b),
            (Answer(was, a), Answer(is, b)) if was != is => {
                (&mut self.answers, a, b)
            }
            (Answer(_, a), Answer(_, b)) => {
                self.answers.compared += 1;
                (&mut self.texts, a, b)
            }
            (Verdict(a), Verdict(b)) => (&mut self.verdicts, a, b),
            (Setting(a), Setting(b)) => (&mut self.settings, a, b),
            (Text(a), Text(b)) => (&mut self.texts, a, b),
            // One key has one sort of content.
            _ => return,
        };
        list.compared += 1;
        if a != b {
            let place = Some(new.place.clone()).filter(|p| !p.is_empty());
            let is = |c: &&mut Change| {
                c.what == new.words && c.old == *a && c.new == *b
            };
            match list.changed.iter_mut().find(is) {
                Some(change) => change.places.extend(place),
                None => list.changed.push(Change {
                    what: new.words.clone(),
                    places: place.into_iter().collect(),
                    old: a.clone(),
                    new: b.clone(),
                }),
            }
        }
    }

    fn number(&mut self, item: &Item, old: &Number, new: &Number) {
        let own = |kind: &&mut Kind| kind.what == item.words;
        if let Some(kind) = self.numbers.iter_mut().rev().find(own) {
            return kind.add(&item.place, old, new);
        }
        let mut kind = Kind::new(item.topic, &item.words, new.limit);
        kind.add(&item.place, old, new);
        self.numbers.push(kind);
    }
}

fn by_key(items: &[Item]) -> BTreeMap<(&str, &str), &Item> {
    items.iter().map(|item| (item.key(), item)).collect()
}

/// Sets two results beside each other.
///
/// # Errors
/// Where no file of one kind is on both sides.
pub fn compare(old: &Results, new: &Results) -> anyhow::Result<Comparison> {
    let mut out = Comparison { identical: true, ..Comparison::default() };
    let mut common = false;
    let sheets = old.sheets.iter().zip(&new.sheets);
    for (name, (old, new)) in NAMES.iter().zip(sheets) {
        match (old, new) {
            (Some((old, text)), Some((new, other))) => {
                common = true;
                out.identical &= text == other;
                out.items(old, new);
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
    out.compared = out.numbers.iter().map(|kind| kind.cells).sum();
    out.numbers.retain_mut(Kind::finish);
    // The order of topics stays; within a topic what moved most comes first.
    for topic in out.numbers.chunk_by_mut(|a, b| a.topic == b.topic) {
        let heavier = |a: &Kind, b: &Kind| {
            let ((a, most_a), (b, most_b)) = (a.weight(), b.weight());
            b.total_cmp(&a).then(most_b.total_cmp(&most_a))
        };
        topic.sort_by(heavier);
    }
    if !out.identical {
        out.notes.extend(records::notes(old, new));
    }
    Ok(out)
}
