//! The text of a comparison: the cause first.

use super::change::{Change, Difference, Subject};
use super::effect::RecordSets;
use super::number::NumberChange;
use rocking_common::paper::SuiteKind;

/// Most lines of a list, without `--all`.
const MOST: usize = 12;

/// The command that shows everything.
const ALL: &str = "`rocking diff OLD NEW --all`";

impl Difference {
    /// The comparison for people; `all` lists every change.
    pub fn text(&self, all: bool) -> String {
        let mut out = self.head().join("\n") + "\n";
        for (title, mut lines) in self.lists(all) {
            let left = lines.len().saturating_sub(MOST);
            if left > 0 && !all {
                lines.truncate(MOST);
                lines.push(format!("{left} more: {ALL}"));
            }
            if !lines.is_empty() {
                out += &format!("\n{title}\n");
            }
            for line in lines {
                out += &format!("  {}\n", line.replace('\n', "\n    "));
            }
        }
        out
    }

    /// The changes of a kind, of what both sides have.
    fn common(&self, kind: Subject) -> impl Iterator<Item = &Change> + Clone {
        let own = self.changes.iter().filter(move |c| c.kind == kind);
        own.filter(|change| change.is_common())
    }

    /// The changes in a few sentences, the cause first.
    fn head(&self) -> Vec<String> {
        let count = |kind| self.compared.get(&kind).copied().unwrap_or(0);
        let changed = |kind| some(self.common(kind));
        let answers = count(Subject::Answer) + count(Subject::Wording);
        let [findings, cases, numbers] =
            [Subject::Finding, Subject::Case, Subject::Number].map(count);
        if self.identical {
            return vec![format!(
                "Identical: {answers} answers, {findings} verdicts on \
                 statements, {cases} cases, {numbers} numbers."
            )];
        }
        let mut out = vec![self.cause()];
        let moved = self.records.iter().filter(|(_, r)| !r.are_same());
        out.extend(moved.map(|(suite, records)| records.sentence(suite)));
        let ordinary = self.records.get(SuiteKind::Ordinary.name());
        let both = ordinary.map(|records| &records.both[..]);
        out.extend(self.effect.sentence(both.unwrap_or_default()));
        if answers > 0 {
            let opposite = self.common(Subject::Finding);
            out.push(format!(
                "Answers based on findings: {} of {answers} turned; {} changed \
                 only in numbers.",
                changed(Subject::Answer),
                changed(Subject::Wording)
            ));
            out.push(format!(
                "Verdicts on statements (seen, exists): {} of {findings} \
                 changed, {} to the contrary.",
                changed(Subject::Finding),
                some(opposite.filter(|change| change.opposite))
            ));
        }
        if cases > 0 {
            out.push(format!(
                "Reference cases: {} of {cases} verdicts changed.",
                changed(Subject::Case)
            ));
        }
        let moved = |relevant: bool| {
            let all = self.common(Subject::Number);
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

    /// The settings that changed, and whether the records are the same.
    fn cause(&self) -> String {
        let records = self.records.values();
        let counts = records.clone().map(|r| r.both.len().to_string());
        let counts: Vec<String> = counts.collect();
        let is_same = records.clone().all(RecordSets::are_same);
        let same = match is_same && !counts.is_empty() {
            true => format!(" (same {} records)", counts.join(" + ")),
            false => String::new(),
        };
        match &lines(self.common(Subject::Setting))[..] {
            [] => format!("No setting changed{same}."),
            [one] => format!("Setting changed: {one}{same}."),
            all => format!("{} settings changed{same}:", all.len()),
        }
    }

    /// The lists, in the order of consequence.
    fn lists(&self, all: bool) -> [(&'static str, Vec<String>); 10] {
        let common = |kind| lines(self.common(kind));
        let numbers = self.common(Subject::Number);
        let lost = self.changes.iter().filter(|c| c.new.is_none());
        let gained = self.changes.iter().filter(|c| c.old.is_none());
        let (mut notes, mut texts) =
            (self.notes.clone(), common(Subject::Text));
        if !texts.is_empty() && !all {
            let n = texts.len();
            notes.push(format!("{n} texts, intervals and details differ"));
            texts.clear();
        }
        let mut settings = common(Subject::Setting);
        if settings.len() == 1 {
            settings.clear();
        }
        [
            ("Settings", settings),
            ("Answers that turned", common(Subject::Answer)),
            ("Answers that changed only in numbers", common(Subject::Wording)),
            ("Verdicts on statements that changed", common(Subject::Finding)),
            (
                "Largest single moves (u: change over the half-widths of both \
                 intervals; n: records or ratios behind the value)",
                lines(numbers.filter(|c| all || c.relevant)),
            ),
            ("Reference cases", common(Subject::Case)),
            ("Only in the old results", lines(lost)),
            ("Only in the new results", lines(gained)),
            ("Also", notes),
            ("Texts, intervals, details", texts),
        ]
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
        (_, moved) => {
            let moved = moved.map(|moved| format!("; {moved}"));
            format!("{what}: {old} -> {new}{}", moved.unwrap_or_default())
        }
    }
}
