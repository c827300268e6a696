//! House rules that the compiler doesn't enforce.

use std::collections::BTreeSet;
use std::fs::{self, FileType};
use std::path::{Path, PathBuf};

#[path = "house/ceilings.rs"]
mod ceilings;
#[path = "house/dependencies.rs"]
mod dependencies;
#[path = "house/fixtures.rs"]
mod fixtures;
#[path = "house/layers.rs"]
mod layers;
#[path = "house/links.rs"]
mod links;
#[path = "house/prose.rs"]
mod prose;

use layers::tokens;

/// Folders of sources in Rust.
const SOURCES: [&str; 5] =
    ["src", "crates", "validation", "tests", "python/src"];

/// The only files with `unsafe` begin so.
const UNSAFE: [&str; 2] = ["src/number/dispatch", "validation/web/src/abi.rs"];

/// Folders whose parallel loops may be stopped.
const FUSED: [&str; 3] = ["src", "crates", "python/src"];

/// Most lines of a file. A file holds one concept; one that comes near the
/// limit may hold two.
const MOST_LINES: usize = 600;

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

pub fn read(path: &str) -> String {
    fs::read_to_string(root().join(path))
        .unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// All files below a folder, as paths from the root, in order, without what
/// builds leave.
fn files(folder: &str) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(root().join(folder)).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        let path = format!("{folder}/{name}");
        if !entry.file_type().unwrap().is_dir() {
            found.push(path);
        } else if !["target", ".venv", "__pycache__"].contains(&name.as_str())
        {
            found.extend(files(&path));
        }
    }
    found.sort();
    found
}

/// Sources in Rust below folders.
fn sources(folders: &[&str]) -> Vec<String> {
    let all = folders.iter().flat_map(|folder| files(folder));
    let found: Vec<String> =
        all.filter(|path| path.ends_with(".rs")).collect();
    assert!(found.len() >= folders.len(), "no sources in {folders:?}");
    found
}

/// Names in the root of one kind, without what is made. In a worktree `.git`
/// is a file.
fn top(is_kind: impl Fn(&FileType) -> bool) -> BTreeSet<String> {
    let made = [".git", "target", "rocking-report"];
    let all = fs::read_dir(root()).unwrap().map(Result::unwrap);
    all.filter(|entry| is_kind(&entry.file_type().unwrap()))
        .map(|entry| entry.file_name().into_string().unwrap())
        .filter(|name| !made.contains(&name.as_str()))
        .collect()
}

/// The cells of the rows of tables in a section of a page.
fn table(page: &str, heading: &str) -> Vec<Vec<String>> {
    let section = page.split(heading).nth(1).unwrap();
    let section = section.split("\n## ").next().unwrap();
    let rows = section.lines().filter(|line| line.starts_with('|'));
    let cell = |cell: &str| cell.trim().trim_matches('`').to_owned();
    rows.map(|row| row.split('|').skip(1).map(cell).collect()).collect()
}

fn pass(problems: &[String]) {
    assert!(problems.is_empty(), "\n{}\n", problems.join("\n"));
}

#[test]
fn a_clone_shows_ten_folders() {
    let expected = ".ci crates docs examples fixtures python reports src \
                    tests validation";
    let found: Vec<String> = top(FileType::is_dir).into_iter().collect();
    assert_eq!(found.join(" "), expected);
}

#[test]
fn every_test_file_is_a_target() {
    let lists = [
        "tests/gate.rs",
        "tests/unit/Cargo.toml",
        "validation/command/Cargo.toml",
    ];
    let lists = lists.map(read).concat();
    for path in files("tests").iter().filter(|path| path.ends_with(".rs")) {
        let name = path.trim_start_matches("tests/");
        let names = [format!("\"{name}\""), format!("/{name}\"")];
        let is_listed = names.iter().any(|name| lists.contains(name));
        assert!(name.contains('/') || is_listed, "{name}: no target");
    }
}

#[test]
fn sources_keep_the_rules_of_the_house() {
    let mut problems = Vec::new();
    for path in sources(&SOURCES) {
        let text = read(&path);
        let all = tokens(&text);
        let count = |name: &str| all.iter().filter(|t| *t == name).count();
        let mut refuse = |is_so: bool, words: &str| {
            problems.extend(is_so.then(|| format!("{path}: {words}")));
        };
        let may = UNSAFE.iter().any(|own| path.starts_with(own));
        refuse(!may && count("unsafe_code") > 0, "allows unsafe code");
        let skips = all.windows(3).any(|three| three == ["#", "[", "ignore"]);
        refuse(skips, "skips a test");
        refuse(text.lines().count() > MOST_LINES, "is too long");
        // Without a fuse each item unwinds by itself where the work is
        // stopped (`src/stop.rs`): a million of them take seconds.
        let parallel = ["par_iter", "par_iter_mut", "into_par_iter"];
        let parallel: usize = parallel.iter().map(|own| count(own)).sum();
        let fused = FUSED.iter().any(|folder| path.starts_with(folder));
        refuse(fused && parallel != count("panic_fuse"), "lacks a fuse");
        // Oracles compute nothing with the core; their tests may meet it.
        let oracle = path.starts_with("validation/proof/src/oracles")
            && !path.ends_with("tests.rs");
        let uses = all.iter().any(|token| token.starts_with("rocking"));
        refuse(oracle && uses, "an oracle uses the core");
        // Or a program could show results that it did not find.
        for call in text.split("include_").skip(1) {
            let call = call.split(')').next().unwrap_or_default();
            let own = call.contains("/reports/") || call.contains("/pins/");
            refuse(own && !path.starts_with("tests"), "compiles in results");
        }
    }
    pass(&problems);
}

#[test]
fn texts_name_no_place_of_a_machine() {
    let places = ["home", "root", "work", "tmp", "Users", "mnt", "opt"];
    let mut texts: Vec<String> = top(FileType::is_dir)
        .iter()
        .flat_map(|folder| files(folder))
        .filter(|path| !path.starts_with("tests/fuzz/corpus"))
        .collect();
    texts.extend(top(FileType::is_file));
    let mut problems = Vec::new();
    for path in texts {
        let text = fs::read_to_string(root().join(&path)).unwrap_or_default();
        // A part of a longer relative path is no absolute path.
        let is_inner = |c: char| c.is_alphanumeric() || c == '.';
        for place in places.map(|place| format!("/{place}/")) {
            let mut all = text.match_indices(&place);
            if all.any(|(at, _)| !text[..at].ends_with(is_inner)) {
                problems.push(format!("{path}: {place}.."));
            }
        }
    }
    pass(&problems);
}
