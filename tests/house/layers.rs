//! Files that lead to each other, and doors that compute.

use std::collections::{BTreeMap, BTreeSet};

use super::source::{holds, tokens};
use super::{modules_of, pass, read, sources};

/// Folders in which no files lead to each other in a circle: what a file
/// names lies below it.
const LAYERED: [&str; 6] = [
    "crates/synthesis/src",
    "validation/common/src",
    "validation/draw/src",
    "validation/proof/src",
    "validation/report/src",
    "validation/study/src",
];

/// Doors: they show what `rocking::procedures` found and compute nothing.
const DOORS: [&str; 3] = [
    "python/src",
    "validation/command/src/cli",
    "validation/study/src/questions",
];

/// What a door may name of `rocking::statistics`: data, and names of choices.
const PLAIN: [&str; 9] = [
    "CensoredSample",
    "Clusters",
    "ExtendedSample",
    "FitMethod",
    "Lognormal",
    "QuantileType",
    "Sample",
    "SampleError",
    "Stripe",
];

/// Parts that a door still names, by its file. The list only shrinks.
const STILL: &[(&str, &[&str])] = &[
    ("validation/command/src/cli/lilliefors.rs", &["lilliefors"]),
    ("validation/study/src/questions/grid.rs", &["lilliefors"]),
    (
        "validation/study/src/questions/levels.rs",
        &["acceptance", "lilliefors", "multiple", "normality"],
    ),
    ("validation/study/src/questions/nulls.rs", &["lilliefors"]),
    ("validation/study/src/questions/options.rs", &["bootstrap"]),
    ("validation/study/src/questions/power.rs", &["lilliefors", "normality"]),
    (
        "validation/study/src/questions/suites/compare.rs",
        &["bootstrap", "two_sample"],
    ),
];

type Path = Vec<String>;

/// The tokens of a file without its tests.
fn program(text: &str) -> Vec<String> {
    let mut all = tokens(text);
    let test = ["cfg", "(", "test", ")", "]", "mod", "tests", "{"];
    let at = all.windows(test.len()).position(|window| window == test);
    all.truncate(at.unwrap_or(all.len()));
    all
}

/// Adds the paths that begin at a token, behind `prefix`; the place after
/// them.
fn walk(
    tokens: &[String],
    at: usize,
    prefix: &[String],
    out: &mut Vec<Path>,
) -> usize {
    let token = |at: usize| tokens.get(at).map_or("", String::as_str);
    let mut at = at;
    if token(at) == "{" {
        at += 1;
        while !["}", ""].contains(&token(at)) {
            at = walk(tokens, at, prefix, out);
            at += usize::from(token(at) == ",");
        }
        return at + 1;
    }
    let mut path = prefix.to_vec();
    match token(at) {
        "super" => drop(path.pop()),
        "self" => {}
        name => path.push(name.to_owned()),
    }
    let next = token(at + 2).chars().next();
    if token(at + 1) == "::"
        && next.is_some_and(|c| c == '{' || c == '_' || c.is_alphabetic())
    {
        return walk(tokens, at + 2, &path, out);
    }
    out.push(path);
    at + if token(at + 1) == "as" { 3 } else { 1 }
}

/// The paths that begin with `start`, from `prefix` on.
fn paths(tokens: &[String], start: &str, prefix: &[String]) -> Vec<Path> {
    let mut out = Vec::new();
    let mut at = 0;
    while at + 1 < tokens.len() {
        let before = tokens[..at].last().map_or("", String::as_str);
        let inner = ["::", "in"].contains(&before);
        if tokens[at] == start && tokens[at + 1] == "::" && !inner {
            at = walk(tokens, at + 2, prefix, &mut out);
        } else {
            at += 1;
        }
    }
    out
}

/// Which file of a folder names which, by their modules.
fn arrows(
    files: &BTreeMap<Path, Vec<String>>,
) -> BTreeMap<&Path, BTreeSet<Path>> {
    let file_of = |path: &Path| {
        let found = (0..=path.len()).rev().map(|n| path[..n].to_vec());
        found.into_iter().find(|path| files.contains_key(path))
    };
    let arrows_of = |(own, tokens): (_, &Vec<String>)| {
        let own: &Path = own;
        let mut named = paths(tokens, "crate", &[]);
        if let Some((_, above)) = own.split_last() {
            named.extend(paths(tokens, "super", above));
        }
        for child in files.keys().filter(|path| path.len() == own.len() + 1) {
            if child.starts_with(own) {
                named.extend(paths(tokens, &child[own.len()], child));
            }
        }
        let found = named.iter().filter_map(file_of);
        (own, found.filter(|path| path != own).collect())
    };
    files.iter().map(arrows_of).collect()
}

/// Files that lead to each other in a circle, or lie between two circles.
fn circles(files: &BTreeMap<Path, Vec<String>>) -> Vec<String> {
    let mut left = arrows(files);
    loop {
        let there: BTreeSet<Path> =
            left.keys().map(|path| (*path).clone()).collect();
        let named: BTreeSet<Path> = left.values().flatten().cloned().collect();
        left.retain(|own, names| {
            named.contains(*own) && !names.is_disjoint(&there)
        });
        if left.len() == there.len() {
            return there.iter().map(|path| path.join("/")).collect();
        }
    }
}

fn of_folder(folder: &str) -> BTreeMap<Path, Vec<String>> {
    let with = |path: String| {
        let modules = modules_of(&path, folder);
        let own: Path = modules.iter().map(|m| (*m).to_owned()).collect();
        (own, program(&read(&path)))
    };
    let is_program =
        |path: &String| !modules_of(path, folder).contains(&"tests");
    sources(&[folder]).into_iter().filter(is_program).map(with).collect()
}

#[test]
fn no_files_lead_to_each_other_in_a_circle() {
    let mut problems = Vec::new();
    for folder in LAYERED {
        let files = of_folder(folder);
        assert!(arrows(&files).values().any(|named| !named.is_empty()));
        let found = circles(&files);
        if !found.is_empty() {
            problems.push(format!("{folder}: a circle: {found:?}"));
        }
    }
    pass(&problems);
}

#[test]
fn a_circle_of_files_is_found() {
    let file = |path: &str, text: &str| {
        let path: Path = path.split('/').map(String::from).collect();
        (path, program(text))
    };
    let turning = BTreeMap::from([
        file("a", "mod b; use b::{B, c as d}; mod tests { use super::*; }"),
        file("a/b", "use super::{One, super::e::Two}; fn f() {}"),
        file("e", "use std::e; struct Two;"),
    ]);
    assert_eq!(circles(&turning), ["a", "a/b"]);
    let layered = BTreeMap::from([
        file("a", "mod b; pub use b::B; use crate::e::{self, Two};"),
        file("a/b", "use crate::e::Two; #[cfg(test)] mod tests { super::A }"),
        file("e", "struct Two;"),
    ]);
    assert!(circles(&layered).is_empty());
}

#[test]
fn doors_compute_no_statistics() {
    let still: BTreeMap<&str, &[&str]> = STILL.iter().copied().collect();
    let mut problems = Vec::new();
    let mut used: BTreeSet<(String, String)> = BTreeSet::new();
    let mut seen = 0;
    for path in sources(&DOORS) {
        let tokens = program(&read(&path));
        seen += usize::from(holds(&tokens, &["rocking", "::", "procedures"]));
        for named in paths(&tokens, "rocking", &[]) {
            let [statistics, part, ..] = named.as_slice() else { continue };
            let last = named.last().unwrap_or(part).as_str();
            if statistics != "statistics" || PLAIN.contains(&last) {
                continue;
            }
            let allowed = still.get(path.as_str()).copied().unwrap_or(&[]);
            if allowed.contains(&part.as_str()) {
                used.insert((path.clone(), part.clone()));
            } else {
                problems.push(format!("{path}: computes with {part}"));
            }
        }
    }
    assert!(seen > 0, "no door calls a procedure");
    for (path, parts) in STILL {
        for part in *parts {
            if !used.contains(&((*path).to_owned(), (*part).to_owned())) {
                problems.push(format!("{path}: {part} may leave the list"));
            }
        }
    }
    pass(&problems);
}
