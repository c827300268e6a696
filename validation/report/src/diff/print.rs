//! A comparison for people: the cause first.

use super::change::{Change, Difference, Subject};
use super::effect::RecordSets;
use super::number::NumberChange;
use rocking_common::paper::SuiteKind;

/// Lines of a list that are shown unless all are wanted.
const MOST: usize = 12;

/// What shows everything.
const ALL: &str = "`rocking diff OLD NEW --all`";

impl Difference {
    /// For people; `all` lists every change.
    pub fn text(&self, all: bool) -> String {
        let mut out = self.head().join("\n") + "\n";
        for (title, lines) in self.lists(all) {
            out += &format!("\n{title}\n");
            let lines = lines.iter().map(|line| line.replace('\n', "\n    "));
            out.extend(lines.map(|line| format!("  {line}\n")));
        }
        out
    }

    fn changes_of(
        &self,
        kind: Subject,
    ) -> impl Iterator<Item = &Change> + Clone {
        self.changes.iter().filter(move |change| change.kind == kind)
    }

    /// Changes of a kind in what both sides have.
    fn count(&self, kinds: &[Subject]) -> usize {
        kinds.iter().filter_map(|kind| self.compared.get(kind)).sum()
    }

    /// What changed, the cause first, in a few sentences.
    fn head(&self) -> Vec<String> {
        let answers = self.count(&[Subject::Answer, Subject::Wording]);
        let [findings, cases, numbers] =
            [Subject::Finding, Subject::Case, Subject::Number]
                .map(|kind| self.count(&[kind]));
        if self.identical {
            return vec![format!(
                "Identical: {answers} answers, {findings} words on claims, \
                 {cases} cases, {numbers} numbers."
            )];
        }
        let mut out = vec![self.cause()];
        let moved = self.records.iter().filter(|(_, r)| !r.are_same());
        out.extend(moved.map(|(suite, records)| records.sentence(suite)));
        let ordinary = self.records.get(SuiteKind::Ordinary.name());
        let both = ordinary.map(|records| &records.both[..]);
        out.extend(self.effect.sentence(both.unwrap_or_default()));
        if answers > 0 {
            out.push(format!(
                "Answers that rest on findings: {} of {answers} changed; only \
                 numbers moved in {}.",
                some(self.changes_of(Subject::Answer)),
                some(self.changes_of(Subject::Wording))
            ));
            let flips =
                self.changes_of(Subject::Finding).filter(|c| c.is_common());
            out.push(format!(
                "Words on claims (seen, exists): {} of {findings} changed, {} \
                 from yes to no or the opposite, or back.",
                some(flips.clone()),
                some(flips.filter(|change| change.opposite))
            ));
        }
        if cases > 0 {
            out.push(format!(
                "Declared cases: {} of {cases} verdicts changed.",
                some(self.changes_of(Subject::Case))
            ));
        }
        let moved = |relevant: bool| {
            let all = self.changes_of(Subject::Number);
            some(all.filter(|change| change.relevant == relevant))
        };
        out.push(format!(
            "Numbers: {} of {numbers} moved by more than the smallest effect \
             of interest or their tolerance, {} by less.",
            moved(true),
            moved(false)
        ));
        out
    }

    /// What was set differently, and whether the records are the same.
    fn cause(&self) -> String {
        let records = self.records.values();
        let same = if records.len() > 0
            && records.clone().all(RecordSets::are_same)
        {
            let counts = records.map(|r| r.both.len().to_string());
            let counts = counts.collect::<Vec<_>>().join(" + ");
            format!(" (same {counts} records)")
        } else {
            String::new()
        };
        let settings = lines(self.changes_of(Subject::Setting));
        match settings.len() {
            0 => format!("No setting changed{same}."),
            1 => format!("Setting changed: {}{same}.", settings[0]),
            n => format!("Settings changed: {n}, listed below{same}."),
        }
    }

    /// The lists that have something, in the order of consequence.
    fn lists(&self, all: bool) -> Vec<(&'static str, Vec<String>)> {
        let common =
            |kind| lines(self.changes_of(kind).filter(|c| c.is_common()));
        let moved =
            self.changes_of(Subject::Number).filter(|c| all || c.relevant);
        let changes = self.changes.iter();
        let mut notes = self.notes.clone();
        let texts = self.changes_of(Subject::Text).count();
        if texts > 0 && !all {
            notes.push(format!("{texts} words, intervals and details differ"));
        }
        let mut settings = common(Subject::Setting);
        if settings.len() == 1 {
            settings.clear();
        }
        let mut lists = vec![
            ("Settings", settings),
            ("Answers that changed", common(Subject::Answer)),
            ("Answers in which only numbers moved", common(Subject::Wording)),
            ("Words on claims that changed", common(Subject::Finding)),
            (
                "Largest single moves (u: change over the half-widths of both \
                 intervals; n: records or ratios behind the value)",
                lines(moved),
            ),
            ("Declared cases", common(Subject::Case)),
            (
                "Only in the old results",
                lines(changes.clone().filter(|c| c.new.is_none())),
            ),
            (
                "Only in the new results",
                lines(changes.filter(|c| c.old.is_none())),
            ),
            ("Also", notes),
        ];
        if all {
            lists.push(("Words, intervals, details", common(Subject::Text)));
        }
        for (_, lines) in &mut lists {
            let left = lines.len().saturating_sub(MOST);
            if left > 0 && !all {
                lines.truncate(MOST);
                lines.push(format!("{left} more: {ALL}"));
            }
        }
        lists.retain(|(_, lines)| !lines.is_empty());
        lists
    }
}

/// A number of changes; "none" for zero.
fn some<'a>(changes: impl Iterator<Item = &'a Change>) -> String {
    match changes.count() {
        0 => "none".into(),
        n => n.to_string(),
    }
}

fn lines<'a>(changes: impl Iterator<Item = &'a Change>) -> Vec<String> {
    changes.map(line).collect()
}

/// A change in one line; the change of an answer in three.
fn line(change: &Change) -> String {
    let Change { kind, what, old, new, why, moved, .. } = change;
    let (Some(old), Some(new)) = (old, new) else {
        let side = if old.is_some() { "now" } else { "before" };
        let why = why.as_ref().map(|why| format!(" ({side}: {why})"));
        return what.clone() + &why.unwrap_or_default();
    };
    let moved = moved.as_ref().map(NumberChange::text);
    match (kind, moved) {
        (Subject::Answer | Subject::Wording, _) => {
            format!("{what}\nBefore: {old}\nNow: {new}")
        }
        (Subject::Setting, _) => format!("{what} {old} -> {new}"),
        (Subject::Number, Some(moved)) => format!("{what}: {moved}"),
        (_, None) => format!("{what}: {old} -> {new}"),
        (_, Some(moved)) => format!("{what}: {old} -> {new}; {moved}"),
    }
}
