//! Links in the pages for people lead somewhere, and the pages of `docs` are
//! a book that is whole.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::{files, pass, read, root};

const SUMMARY: &str = "docs/SUMMARY.md";

/// The page as the book shows it: with what it includes.
fn page(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap_or_default();
    let included = |line: &str| {
        let line = line.strip_prefix("{{#include ")?.strip_suffix("}}")?;
        Some(page(&path.parent()?.join(line)))
    };
    let lines = text.lines();
    lines
        .map(|line| included(line).unwrap_or(line.to_owned()) + "\n")
        .collect()
}

/// Lines outside of fenced code.
fn prose(text: &str) -> impl Iterator<Item = &str> {
    let mut fenced = false;
    text.lines().filter(move |line| {
        let fence = line.trim_start().starts_with("```");
        fenced ^= fence;
        !fenced && !fence
    })
}

/// Where the relative links of a text lead.
fn targets(text: &str) -> impl Iterator<Item = &str> {
    let after = prose(text).flat_map(|line| line.split("](").skip(1));
    after
        .filter_map(|rest| Some(rest.split_once(')')?.0))
        .filter(|target| !target.contains("://"))
}

/// The name by which a link finds a heading.
fn anchor(heading: &str) -> String {
    let heading = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || *c == ' ');
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// What is wrong with the links of a text that lies in a folder.
fn problems(text: &str, folder: &str) -> Vec<String> {
    let mut found = Vec::new();
    for target in targets(text) {
        let (path, name) = target.split_once('#').unwrap_or((target, ""));
        let place = root().join(folder).join(path);
        let names = |line: &str| line.starts_with('#') && anchor(line) == name;
        if folder == "docs" && path.contains("..") {
            found.push(format!("{target}: leads out of the book"));
        } else if !place.exists() {
            found.push(format!("{target}: is not there"));
        } else if !name.is_empty() && !prose(&page(&place)).any(names) {
            found.push(format!("{target}: no such heading"));
        }
    }
    found
}

#[test]
fn links_lead_somewhere() {
    let top = fs::read_dir(root()).unwrap();
    let top =
        top.map(|entry| entry.unwrap().file_name().display().to_string());
    let folders = ["docs", "python", "fixtures/benchmark", "validation/peers"];
    let own = |folder| {
        let of = move |path: &String| {
            Path::new(path).parent() == Some(Path::new(folder))
        };
        files(folder).into_iter().filter(of)
    };
    let mut wrong = Vec::new();
    let all = top.chain(folders.into_iter().flat_map(own));
    for path in all.filter(|path| path.ends_with(".md")) {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        let found = problems(&page(&root().join(&path)), folder);
        wrong.extend(found.into_iter().map(|what| format!("{path}: {what}")));
    }
    pass(&wrong);
    let text = "# A b\n[x](gone.md) [y](tables.md#gone) [z](../README.md)
        ```\n[in code](gone.md)\n```\n[ok](tables.md#ida) [ok](https://x/)";
    assert_eq!(
        problems(text, "docs"),
        [
            "gone.md: is not there",
            "tables.md#gone: no such heading",
            "../README.md: leads out of the book"
        ]
    );
}

#[test]
fn every_page_is_a_chapter_of_the_book() {
    let summary = read(SUMMARY);
    let chapters = targets(&summary).map(|target| format!("docs/{target}"));
    let pages = files("docs").into_iter();
    let pages = pages.filter(|path| path.ends_with(".md") && path != SUMMARY);
    assert_eq!(
        chapters.collect::<BTreeSet<_>>(),
        pages.collect::<BTreeSet<_>>()
    );
}
