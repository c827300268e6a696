//! A comparison for people, and for a pull request.

use super::Presence;
use std::fmt::Write as _;

use super::words::percent;
use super::{Change, Comparison, Measure};

/// Changes that are listed unless all are wanted: of those within their
/// uncertainty, and of those beyond it in a group that state none.
const MOST: usize = 10;

/// What is listed, by its group, in the order of the first of each.
fn by_group<'a, T>(
    list: impl IntoIterator<Item = &'a T>,
    group: impl Fn(&'a T) -> &'a str,
) -> Vec<(&'a str, Vec<&'a T>)> {
    let mut groups: Vec<(&str, Vec<&T>)> = Vec::new();
    for one in list {
        match groups.iter_mut().find(|(name, _)| *name == group(one)) {
            Some((_, list)) => list.push(one),
            None => groups.push((group(one), vec![one])),
        }
    }
    groups
}

impl Comparison {
    /// Numbers beyond their uncertainty; numbers within it and words, as many
    /// as are shown; and how many of those are not.
    fn parted(&self, all: bool) -> (Vec<&Change>, Vec<&Change>, usize) {
        let (big, mut small): (Vec<_>, Vec<_>) =
            self.numbers.iter().partition(|c| c.significant);
        small.extend(&self.texts);
        let shown = if all { small.len() } else { small.len().min(MOST) };
        let left = small.len() - shown;
        small.truncate(shown);
        (big, small, left)
    }

    fn presences(&self) -> [(&'static str, &[Presence]); 2] {
        [("Appeared", &self.appeared), ("Vanished", &self.vanished)]
    }

    /// For people; `all` lists changes within their uncertainty too.
    pub fn text(&self, all: bool) -> String {
        let mut out = self.head();
        out.push('\n');
        let mut list = |title: &str, changes: Vec<&Change>| {
            if changes.is_empty() {
                return;
            }
            // Writing to a string cannot fail.
            let _ = writeln!(out, "\n{title}");
            for (group, changes) in by_group(changes, |c| &c.group) {
                let _ = writeln!(out, "  {group}");
                let blind = |c: &&&Change| c.measure == Measure::NoInterval;
                let most = if all { changes.len() } else { MOST };
                let left = changes.iter().filter(blind).skip(most).count();
                for change in &changes[..changes.len() - left] {
                    let _ = writeln!(out, "    {}", change.sentence());
                }
                if left > 0 {
                    let _ = writeln!(
                        out,
                        "    {left} more without an interval: --all"
                    );
                }
            }
        };
        let (big, small, left) = self.parted(all);
        list(
            "Settings that changed, the likely cause of the rest",
            self.settings.iter().collect(),
        );
        list("Verdicts that changed", self.verdicts.iter().collect());
        list("Beyond their uncertainty or tolerance", big);
        list("Within them, or words", small);
        if left > 0 {
            let _ = writeln!(out, "    {left} more: --all");
        }
        for (title, presences) in self.presences() {
            if !presences.is_empty() {
                let _ = writeln!(out, "\n{title}");
            }
            for (group, list) in by_group(presences, |one| &one.group) {
                let _ = writeln!(out, "  {group}");
                for one in list {
                    let _ = writeln!(out, "    {}", one.words);
                }
            }
        }
        out
    }

    /// What there is, in a paragraph.
    fn head(&self) -> String {
        let mut out = String::new();
        if self.is_identical() {
            let _ = write!(
                out,
                "Identical: {} verdicts, numbers and words on both sides.",
                self.compared
            );
        } else {
            let changed = self.settings.len()
                + self.verdicts.len()
                + self.numbers.len()
                + self.texts.len();
            let _ = write!(
                out,
                "{changed} of {} verdicts, numbers and words changed, {} \
                 appeared, {} vanished; {} of these changes are significant.",
                self.compared,
                self.appeared.len(),
                self.vanished.len(),
                self.significant()
            );
        }
        for note in &self.not_compared {
            let _ = write!(out, "\nNot compared: {note}.");
        }
        out
    }

    /// Markdown for a pull request.
    pub fn markdown(&self, all: bool) -> String {
        let mut out = format!("## What changed\n\n{}\n", self.head());
        let (big, small, left) = self.parted(all);
        for (title, changes) in [
            ("Settings", self.settings.iter().collect()),
            ("Verdicts", self.verdicts.iter().collect()),
            ("Beyond uncertainty or tolerance", big),
            ("Within uncertainty or tolerance", small),
        ] {
            table(&mut out, title, &changes);
        }
        if left > 0 {
            let _ = writeln!(out, "\n{left} more.");
        }
        for (title, presences) in self.presences() {
            if !presences.is_empty() {
                let _ = writeln!(out, "\n### {title}\n");
            }
            for one in presences {
                let _ = writeln!(
                    out,
                    "- {} ({})",
                    escaped(&one.words),
                    escaped(&one.group)
                );
            }
        }
        out
    }
}

fn table(out: &mut String, title: &str, changes: &[&Change]) {
    if changes.is_empty() {
        return;
    }
    let _ = writeln!(out, "\n### {title}");
    for (group, changes) in by_group(changes.iter().copied(), |c| &c.group) {
        let _ = writeln!(
            out,
            "\n**{}**\n\n| quantity | old | new | change | measured by |\n\
             |---|---|---|---|---|",
            escaped(group)
        );
        for c in changes {
            let _ = writeln!(
                out,
                "| {} | {} | {} | {} | {} |",
                escaped(&c.words),
                escaped(&c.old),
                escaped(&c.new),
                c.relative.map_or(String::new(), percent),
                c.measured()
            );
        }
    }
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
