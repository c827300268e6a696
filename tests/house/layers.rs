//! Files that lead to each other, doors that compute, and names of types.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::{read, sources};

/// Crates in which no files lead to each other in a circle: what a file names
/// lies below it.
const LAYERED: [&str; 6] = [
    "crates/synthesis/src",
    "validation/common/src",
    "validation/draw/src",
    "validation/proof/src",
    "validation/report/src",
    "validation/study/src",
];

/// What a door may name of `rocking_statistics`: data, and names of choices.
const PLAIN: &str = "CensoredSample Clusters ExtendedSample FitMethod \
    Lognormal QuantileType Sample SampleError Stripe";

type Path = Vec<String>;

/// Identifiers and single punctuation characters (`::` is one token), without
/// comments and literals.
pub fn tokens(source: &str) -> Vec<String> {
    let mut found = Vec::new();
    flatten(source.parse().unwrap(), &mut found);
    found
}

fn flatten(stream: TokenStream, found: &mut Vec<String>) {
    for tree in stream {
        match tree {
            TokenTree::Group(group) => {
                let [open, close] = match group.delimiter() {
                    Delimiter::Brace => ["{", "}"],
                    Delimiter::Bracket => ["[", "]"],
                    _ => ["(", ")"],
                };
                found.push(open.to_owned());
                flatten(group.stream(), found);
                found.push(close.to_owned());
            }
            TokenTree::Literal(_) => {}
            one => match (one.to_string(), found.last_mut()) {
                (one, Some(last)) if one == ":" && last == ":" => {
                    last.push(':');
                }
                (one, _) => found.push(one),
            },
        }
    }
}

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
    if token(at) == "{" {
        let mut at = at + 1;
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
    at + 1
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

/// Files that lead to each other in a circle, or lie between two circles.
fn circles(files: &BTreeMap<Path, Vec<String>>) -> Vec<String> {
    let file_of = |path: &Path| {
        let mut above = (0..=path.len()).rev().map(|n| path[..n].to_vec());
        above.find(|path| files.contains_key(path))
    };
    let named = |(own, tokens): (&Path, &Vec<String>)| {
        let mut named = paths(tokens, "crate", &[]);
        if let Some((_, above)) = own.split_last() {
            named.extend(paths(tokens, "super", above));
        }
        let is_child = |path: &&Path| {
            path.len() == own.len() + 1 && path.starts_with(own)
        };
        for child in files.keys().filter(is_child) {
            named.extend(paths(tokens, &child[own.len()], child));
        }
        let found = named.iter().filter_map(file_of);
        (own.clone(), found.filter(|path| path != own).collect())
    };
    let mut left: BTreeMap<Path, BTreeSet<Path>> =
        files.iter().map(named).collect();
    loop {
        let there: BTreeSet<Path> = left.keys().cloned().collect();
        let named: BTreeSet<Path> = left.values().flatten().cloned().collect();
        left.retain(|own, names| {
            named.contains(own) && !names.is_disjoint(&there)
        });
        if left.len() == there.len() {
            return there.iter().map(|path| path.join("/")).collect();
        }
    }
}

/// The files of a crate by their modules, without tests.
fn of_crate(folder: &str) -> BTreeMap<Path, Vec<String>> {
    let mut found = BTreeMap::new();
    for path in sources(&[folder]) {
        let inner = path[folder.len() + 1..].trim_end_matches(".rs");
        let root = |name: &&str| ["lib", "main"].contains(name);
        let own = inner.split('/').filter(|name| !root(name));
        let own: Path = own.map(String::from).collect();
        if !own.contains(&"tests".to_owned()) {
            found.insert(own, program(&read(&path)));
        }
    }
    found
}

#[test]
fn no_files_lead_to_each_other_in_a_circle() {
    for folder in LAYERED {
        let found = circles(&of_crate(folder));
        assert!(found.is_empty(), "{folder}: a circle: {found:?}");
    }
    let file = |path: &str, text: &str| {
        (path.split('/').map(String::from).collect(), program(text))
    };
    let turning = BTreeMap::from([
        file("a", "mod b; use b::{B, c as d}; mod tests { use super::*; }"),
        file("a/b", "use super::{One, super::e::Two}; fn f() {}"),
        file("e", "use std::e; struct Two;"),
    ]);
    assert_eq!(circles(&turning), ["a", "a/b"]);
}

/// Names that types share, at most.
const MOST_SHARED: usize = 8;

#[test]
fn a_type_name_has_one_meaning() {
    let kinds = ["struct", "enum", "trait", "union"];
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let all = sources(&["src", "crates", "validation", "python/src"]);
    for path in all.iter().filter(|path| !path.contains("/tests")) {
        for pair in program(&read(path)).windows(2) {
            let is_type = pair[1].starts_with(char::is_uppercase);
            if is_type && kinds.contains(&pair[0].as_str()) {
                places.entry(pair[1].clone()).or_default().push(path.clone());
            }
        }
    }
    places.retain(|_, all| all.len() > 1);
    assert!(places.len() <= MOST_SHARED, "{}: {places:#?}", places.len());
}

/// The command and Python show results; all but one file compute none.
#[test]
fn doors_compute_no_statistics() {
    let plain = |path: &Path| PLAIN.contains(&path[path.len() - 1]);
    let computes = |file: &String| {
        let named = paths(&program(&read(file)), "rocking_statistics", &[]);
        !named.iter().all(plain)
    };
    let mut found = sources(&["python/src", "validation/command/src/cli"]);
    found.retain(computes);
    assert_eq!(found, ["validation/command/src/cli/lilliefors.rs"]);
}
