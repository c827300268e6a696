//! Links in the pages for people lead somewhere, and the pages of `docs` are
//! a book that is whole.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::{files, pass, read, root};

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

#[test]
fn links_lead_somewhere() {
    let all = ["docs", "python", "fixtures/benchmark", "validation/peers"];
    let all = all.into_iter().flat_map(files);
    let top = super::top(fs::FileType::is_file).into_iter();
    let mut wrong = Vec::new();
    for path in all.chain(top).filter(|path| path.ends_with(".md")) {
        let place = root().join(&path);
        let folder = place.parent().unwrap();
        let text = page(&place);
        for target in targets(&text) {
            let (to, name) = target.split_once('#').unwrap_or((target, ""));
            // An included page has the links of another folder.
            let to = if to.is_empty() { &place } else { &folder.join(to) };
            let names =
                |line: &str| line.starts_with('#') && anchor(line) == name;
            let out = path.starts_with("docs") && target.contains("..");
            let found = name.is_empty() || prose(&page(to)).any(names);
            if out || !to.exists() || !found {
                wrong.push(format!("{path}: {target}"));
            }
        }
    }
    pass(&wrong);
}

#[test]
fn every_page_is_a_chapter_of_the_book() {
    let summary = read("docs/SUMMARY.md");
    let chapters = targets(&summary).map(|target| format!("docs/{target}"));
    let pages = files("docs").into_iter();
    let is_page =
        |path: &String| path.ends_with(".md") && !path.ends_with("SUMMARY.md");
    let chapters: BTreeSet<_> = chapters.collect();
    assert_eq!(chapters, pages.filter(is_page).collect());
}
