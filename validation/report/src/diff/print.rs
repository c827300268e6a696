//! A comparison for people, and for a pull request: the consequence first.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::moved::Kind;
use super::{Change, Comparison};

/// Lines of a list that are shown unless all are wanted.
const MOST: usize = 12;

/// Characters of the Markdown, at most: a comment may have 65,536.
const MOST_CHARACTERS: usize = 20_000;

/// What shows everything.
const ALL: &str = "`rocking diff OLD NEW --all`";

/// A title, and the lines under it.
type List = (&'static str, Vec<String>);

impl Comparison {
    /// For people; `all` lists every change.
    pub fn text(&self, all: bool) -> String {
        let mut out = self.head() + "\n";
        for (title, lines) in self.lists(all) {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "\n{title}");
            for line in lines {
                let _ = writeln!(out, "  {}", line.replace('\n', "\n    "));
            }
        }
        out
    }

    /// Markdown for a pull request, of 20,000 characters at most.
    pub fn markdown(&self) -> String {
        let mut out = format!("## What changed\n\n{}\n", self.head());
        let rest = format!("\nThe rest: {ALL}.\n");
        let most = MOST_CHARACTERS - rest.chars().count();
        let mut count = out.chars().count();
        for (title, lines) in self.lists(false) {
            let title = format!("\n### {title}\n\n");
            let lines = lines.iter().map(|line| line.replace('\n', "; "));
            let lines = lines.map(|line| format!("- {}\n", escaped(&line)));
            for part in [title].into_iter().chain(lines) {
                count += part.chars().count();
                if count > most {
                    return out + &rest;
                }
                out += &part;
            }
        }
        out
    }

    /// What there is, in a sentence.
    fn head(&self) -> String {
        let Self { answers, verdicts, .. } = self;
        let numbers = self.compared;
        if self.identical {
            return format!(
                "Identical: {} answers, {} verdicts, {numbers} numbers.",
                answers.compared, verdicts.compared
            );
        }
        let beyond: usize = self.numbers.iter().map(Kind::beyond).sum();
        format!(
            "Changed: {} of {} answers, {} of {} verdicts; {beyond} of \
             {numbers} numbers beyond the smallest effect of interest.",
            answers.count(),
            answers.compared,
            verdicts.count(),
            verdicts.compared,
        )
    }

    fn kinds_beyond(&self) -> impl Iterator<Item = &Kind> {
        self.numbers.iter().filter(|kind| kind.beyond() > 0)
    }

    /// The lists that have something, in the order of consequence.
    fn lists(&self, all: bool) -> Vec<List> {
        let lines = |list: &[Change]| list.iter().map(line).collect();
        let only = |list: &BTreeMap<String, usize>| {
            let line = |(what, n): (&String, &usize)| match n {
                1 => what.clone(),
                n => format!("{what}: {n} results"),
            };
            list.iter().map(line).collect()
        };
        let mut why: Vec<String> = lines(&self.settings.changed);
        why.extend(self.notes.iter().cloned());
        let mut lists = vec![
            ("Answers", self.answers.changed.iter().map(answer).collect()),
            ("Verdicts", lines(&self.verdicts.changed)),
            (
                "Numbers beyond the smallest effect of interest: medians \
                 over cells",
                self.kinds_beyond().map(Kind::sentence).collect(),
            ),
            ("Only in the old results", only(&self.vanished)),
            ("Only in the new results", only(&self.appeared)),
            ("Settings and records", why),
            ("Within the smallest effect of interest", self.within()),
        ];
        if all {
            lists.push(("Every number that moved", self.every_number()));
            lists.push((
                "Words, intervals, details",
                lines(&self.texts.changed),
            ));
        } else {
            for (_, lines) in &mut lists {
                let left = lines.len().saturating_sub(MOST);
                if left > 0 {
                    lines.truncate(MOST);
                    lines.push(format!("{left} more: {ALL}"));
                }
            }
        }
        lists.retain(|(_, lines)| !lines.is_empty());
        lists
    }

    /// What stays within: a count, the first kinds in the order of
    /// consequence, and what is not compared.
    fn within(&self) -> Vec<String> {
        let mut out = Vec::new();
        let small = |kind: &Kind| kind.moved.len() - kind.beyond();
        let moved: usize = self.numbers.iter().map(small).sum();
        if moved > 0 {
            out.push(format!("Smaller moves, and moves of counts: {moved}"));
        }
        let kinds = self.numbers.iter();
        let kinds = kinds.filter(|k| k.beyond() == 0 && !k.moved.is_empty());
        out.extend(kinds.take(2).map(Kind::sentence));
        let elsewhere = self.numbers.iter().map(|k| &k.decided_elsewhere);
        let elsewhere: usize = elsewhere.map(Vec::len).sum();
        for (n, what) in [
            (
                elsewhere,
                "Values of claims not compared, as another cell decides",
            ),
            (self.texts.count(), "Words, intervals and details that differ"),
        ] {
            if n > 0 {
                out.push(format!("{what}: {n}"));
            }
        }
        out
    }

    fn every_number(&self) -> Vec<String> {
        let mut out = Vec::new();
        for kind in &self.numbers {
            let what = &kind.what;
            let moved = kind.moved.iter();
            out.extend(moved.map(|m| format!("{what}, {}", kind.one(m))));
            let other = kind.decided_elsewhere.iter();
            out.extend(other.map(|cells| format!("{what}, {cells}")));
        }
        out
    }
}

fn answer(change: &Change) -> String {
    let Change { what, old, new, .. } = change;
    format!("{what}\nBefore: {old}\nNow: {new}")
}

fn line(change: &Change) -> String {
    let Change { what, places, old, new } = change;
    let places = match places.len() {
        0 => String::new(),
        _ => format!(", {}", places.join("; ")),
    };
    format!("{what}{places}: {old} to {new}")
}
/// Text that Markdown shows as it is.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '|' | '*' | '_' | '<' | '`' | '[' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            '\n' | '\r' => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
