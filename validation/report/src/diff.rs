//! What changed between two sets of results, in engineering terms.
//!
//! Findings of a study and results of declared cases become [`Item`]s with a
//! name each; [`compare`] sets them beside each other, and [`Comparison`]
//! says what changed and whether it matters.

mod cases;
mod change;
mod findings;
mod flaw;
mod input;
mod item;
mod print;
mod strict;
#[cfg(test)]
mod tests;
mod words;

use std::collections::{BTreeMap, BTreeSet};

use anyhow::bail;
use serde::Serialize;

pub use change::{Change, Measure};
pub use input::Results;
pub use item::{Content, Item, Limit};

/// Everything of one kind that two sets of results say differently.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Comparison {
    /// Items found on both sides.
    pub compared: usize,
    /// Settings: the likely cause of what else changed.
    pub settings: Vec<Change>,
    /// Verdicts of claims and cases.
    pub verdicts: Vec<Change>,
    /// Claims, cases and rows that only the new results have.
    pub appeared: Vec<Presence>,
    /// Those that only the old results have.
    pub vanished: Vec<Presence>,
    /// Numbers, the most significant first; those without an uncertainty
    /// last.
    pub numbers: Vec<Change>,
    /// Words around results.
    pub texts: Vec<Change>,
    /// Files that only one side has.
    pub not_compared: Vec<String>,
}

/// Something on one side only.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Presence {
    /// What it is listed under.
    pub group: String,
    /// What it is.
    #[serde(rename = "what")]
    pub words: String,
    /// Whether it counts: a claim, a case, or something lost.
    pub significant: bool,
}

impl Comparison {
    /// Number of changes that matter.
    pub fn significant(&self) -> usize {
        let changes = [&self.settings, &self.verdicts, &self.numbers];
        let changed =
            changes.into_iter().flatten().filter(|c| c.significant).count();
        let seen = self.appeared.iter().chain(&self.vanished);
        changed + seen.filter(|p| p.significant).count()
    }

    /// Whether nothing at all differs.
    pub fn is_identical(&self) -> bool {
        *self
            == Self {
                compared: self.compared,
                not_compared: self.not_compared.clone(),
                ..Self::default()
            }
    }

    fn add(&mut self, change: Change, content: &Content) {
        match content {
            Content::Verdict(_) => self.verdicts.push(change),
            Content::Setting(_) => self.settings.push(change),
            Content::Text(_) => self.texts.push(change),
            Content::Number { .. } => self.numbers.push(change),
        }
    }

    fn items(&mut self, old: &[Item], new: &[Item], relative: f64) {
        let owners = |items: &[Item]| -> BTreeSet<String> {
            items.iter().map(|item| item.owner.clone()).collect()
        };
        let (before, after) = (owners(old), owners(new));
        self.vanished.extend(only(old, &after, true));
        self.appeared.extend(only(new, &before, false));
        let key = |item: &Item| (item.owner.clone(), item.name.clone());
        let by_key: BTreeMap<(String, String), &Item> =
            new.iter().map(|item| (key(item), item)).collect();
        let mut met = BTreeSet::new();
        for item in old.iter().filter(|item| after.contains(&item.owner)) {
            let Some(other) = by_key.get(&key(item)) else {
                self.vanished.push(alone(item, true));
                continue;
            };
            met.insert(key(item));
            self.compared += 1;
            if let Some(change) = Change::between(item, other, relative) {
                self.add(change, &item.content);
            }
        }
        for item in new.iter().filter(|item| before.contains(&item.owner)) {
            if !met.contains(&key(item)) {
                self.appeared.push(alone(item, false));
            }
        }
    }
}

/// Owners that the other side lacks, each once.
fn only(
    items: &[Item],
    others: &BTreeSet<String>,
    lost: bool,
) -> Vec<Presence> {
    let mut seen = BTreeSet::new();
    let mut out = Vec::new();
    for item in items.iter().filter(|item| !others.contains(&item.owner)) {
        if seen.insert(item.owner.as_str()) {
            let judged = items.iter().any(|other| {
                other.owner == item.owner
                    && matches!(other.content, Content::Verdict(_))
            });
            out.push(Presence {
                group: item.group.clone(),
                words: item.owner.clone(),
                significant: lost || judged,
            });
        }
    }
    out
}

fn alone(item: &Item, lost: bool) -> Presence {
    let text = matches!(item.content, Content::Text(_));
    Presence {
        group: item.group.clone(),
        words: item.words.clone(),
        significant: lost && !text,
    }
}

/// Sets two results beside each other; where nothing is stated a number may
/// change by the share `relative` of itself.
///
/// # Errors
/// Where no file of one kind is on both
/// sides.
pub fn compare(
    old: &Results,
    new: &Results,
    relative: f64,
) -> anyhow::Result<Comparison> {
    let mut out = Comparison::default();
    let kinds = [
        ("findings.json", &old.findings, &new.findings),
        ("validation.json", &old.cases, &new.cases),
    ];
    let mut common = false;
    for (name, old, new) in kinds {
        match (old, new) {
            (Some(old), Some(new)) => {
                common = true;
                out.items(old, new, relative);
            }
            (None, None) => {}
            (old, _) => {
                let side = if old.is_some() { "old" } else { "new" };
                out.not_compared
                    .push(format!("{name}: only among the {side} results"));
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
    for changes in [&mut out.numbers, &mut out.settings, &mut out.verdicts] {
        // What no uncertainty is stated of cannot be ranked among the rest.
        let blind = |c: &Change| c.measure == Measure::NoInterval;
        changes.sort_by(|a, b| {
            blind(a).cmp(&blind(b)).then(b.rank.total_cmp(&a.rank))
        });
    }
    Ok(out)
}
