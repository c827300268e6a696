//! House rules that the compiler doesn't enforce.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use rocking::capacity::InversionRule;
use rocking::excitation::PulseName;
use rocking::ida::Adjust;
use rocking::integrator::{Model, Overturning};
use rocking_statistics::QuantileType;
use rocking_statistics::lognormal::FitMethod;
use serde::Deserialize;

#[path = "house/edges.rs"]
mod edges;
#[path = "house/fixtures.rs"]
mod fixtures;
#[path = "house/layers.rs"]
mod layers;
#[path = "house/links.rs"]
mod links;
#[path = "house/packages.rs"]
mod packages;
#[path = "house/results.rs"]
mod results;
#[path = "house/source.rs"]
mod source;

use edges::{Edges, TREES};
use source::{holds, named_modules, tokens};

/// Libraries beside the core: manifest and sources.
const LIBRARIES: [(&str, &[&str]); 12] = [
    ("crates/exchange/Cargo.toml", &["crates/exchange/src"]),
    ("fixtures/Cargo.toml", &["fixtures/src"]),
    ("crates/score/Cargo.toml", &["crates/score/src"]),
    ("crates/surrogate/Cargo.toml", &["crates/surrogate/src"]),
    ("crates/synthesis/Cargo.toml", &["crates/synthesis/src"]),
    ("validation/common/Cargo.toml", &["validation/common/src"]),
    ("validation/draw/Cargo.toml", &["validation/draw/src"]),
    ("validation/proof/Cargo.toml", &["validation/proof/src"]),
    ("validation/report/Cargo.toml", &["validation/report/src"]),
    ("validation/study/Cargo.toml", &["validation/study/src"]),
    ("validation/web/Cargo.toml", &["validation/web/src"]),
];

/// Folders of sources that follow the same rules.
const SOURCES: [&str; 9] = [
    "src",
    "crates/exchange/src",
    "crates/score/src",
    "crates/surrogate/src",
    "crates/synthesis/src",
    "validation",
    "tests",
    "validation/web/src",
];

/// Dependencies of the core that everybody gets who uses it.
const CORE_DEPENDENCIES: &[&str] = &["libm", "thiserror"];

/// Its others, each brought in by a feature.
const CORE_OPTIONS: &[&str] =
    &["nalgebra", "rand", "rayon", "serde", "sha2", "statrs"];

/// The only files with `unsafe` begin so.
const UNSAFE: [&str; 2] = ["src/number/dispatch", "validation/web/src/abi.rs"];

/// Most lines of a file. A file holds one concept; one that comes near the
/// limit may hold two.
const MOST_LINES: usize = 600;

/// Folders of the root that people see in a clone.
const FOLDERS: &str = "src exchange score surrogate synthesis \
    validation tests examples fixtures reports .ci docs python/src \
    python/rocking python/tests python/notebooks web";

/// The page that explains every dependency.
const DEPENDENCIES: &str = "docs/repository.md";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path))
        .unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// All files below a folder, as paths from the root, in order.
fn files(folder: &str) -> Vec<String> {
    let mut found = Vec::new();
    let Ok(entries) = fs::read_dir(root().join(folder)) else {
        return found;
    };
    for entry in entries {
        let entry = entry.unwrap();
        let path = format!("{folder}/{}", entry.file_name().display());
        if entry.file_type().unwrap().is_dir() {
            found.extend(files(&path));
        } else {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn sources(folders: &[&str]) -> Vec<String> {
    let found: Vec<String> = folders
        .iter()
        .flat_map(|folder| files(folder))
        .filter(|path| path.ends_with(".rs"))
        .collect();
    assert!(found.len() >= folders.len(), "no sources in {folders:?}");
    found
}

fn pass(problems: &[String]) {
    assert!(problems.is_empty(), "\n{}\n", problems.join("\n"));
}

/// Modules that a file below `folder` lies in, without `lib` and `main`.
fn modules_of<'a>(path: &'a str, folder: &str) -> Vec<&'a str> {
    let inner = path.strip_prefix(folder).unwrap_or(path);
    let inner = inner.trim_start_matches('/').trim_end_matches(".rs");
    let root = |name: &&str| ["lib", "main"].contains(name);
    inner.split('/').filter(|name| !root(name)).collect()
}

/// The rows of a table: a module and what it may name.
fn rows(
    edges: Edges,
) -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    edges.lines().filter_map(|line| {
        let mut names = line.split_whitespace();
        Some((names.next()?, names.collect()))
    })
}

/// Where the sources below `folder` and their table disagree.
fn departures(folder: &str, edges: Edges) -> Vec<String> {
    let allowed: BTreeMap<&str, Vec<&str>> = rows(edges).collect();
    let mut problems = Vec::new();
    let mut found: BTreeSet<(String, String)> = BTreeSet::new();
    let mut modules: BTreeSet<String> = BTreeSet::new();
    for path in sources(&[folder]) {
        let place = modules_of(&path, folder);
        let Some(&module) = place.first() else { continue };
        modules.insert(module.to_owned());
        for name in named_modules(&tokens(&read(&path)), place.len()) {
            if name == module {
                continue;
            }
            let may = allowed.get(module);
            if name == "{" {
                problems.push(format!("{path}: write `crate::name`"));
            } else if !may.is_some_and(|may| may.contains(&name.as_str())) {
                problems.push(format!("{path}: {module} may not use {name}"));
            }
            found.insert((module.to_owned(), name));
        }
    }
    let listed: BTreeSet<String> =
        allowed.keys().map(|module| (*module).to_owned()).collect();
    for module in modules.symmetric_difference(&listed) {
        problems.push(format!("{folder}, {module}: a module, or a row alone"));
    }
    for (module, names) in allowed {
        for name in names {
            if !found.contains(&(module.to_owned(), name.to_owned())) {
                problems.push(format!("{module} -> {name} is not used"));
            }
        }
    }
    problems
}

/// Modules that lead to each other in a circle; none where there is none.
fn circle(edges: Edges) -> Vec<&'static str> {
    let mut left: Vec<_> = rows(edges).collect();
    loop {
        let names: Vec<&str> = left.iter().map(|(name, _)| *name).collect();
        left.retain(|(_, uses)| uses.iter().any(|u| names.contains(u)));
        if left.len() == names.len() {
            return names;
        }
    }
}

#[test]
fn modules_name_only_those_that_their_table_allows() {
    let found = TREES.iter().map(|(folder, edges)| departures(folder, edges));
    pass(&found.flatten().collect::<Vec<_>>());
}

#[test]
fn modules_lead_to_each_other_in_no_circle() {
    for (folder, edges) in TREES {
        assert!(circle(edges).is_empty(), "{folder}: {:?}", circle(edges));
    }
    assert_eq!(circle("a b\nb c\nc b"), ["a", "b", "c"]);
}

/// Without a fuse each item of a parallel iterator unwinds by itself where
/// the work is stopped (`src/stop.rs`): a million of them take seconds.
#[test]
fn what_runs_in_parallel_and_may_be_stopped_has_a_fuse() {
    let mut problems = Vec::new();
    for path in sources(&["src", "crates/synthesis/src", "python/src"]) {
        let words = tokens(&read(&path));
        let count = |name: &str| words.iter().filter(|w| *w == name).count();
        let parallel = count("par_iter") + count("into_par_iter");
        if parallel != count("panic_fuse") {
            problems.push(format!("{path}: a parallel iterator has no fuse"));
        }
    }
    pass(&problems);
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
struct Manifest {
    package: Package,
    #[serde(default)]
    dependencies: BTreeMap<String, toml::Value>,
    #[serde(default)]
    dev_dependencies: BTreeMap<String, toml::Value>,
    #[serde(default)]
    build_dependencies: BTreeMap<String, toml::Value>,
    #[serde(default)]
    features: BTreeMap<String, toml::Value>,
    lints: Option<toml::Value>,
    #[serde(default)]
    test: Vec<Target>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    license: Option<toml::Value>,
    publish: Option<bool>,
}

#[derive(Deserialize)]
struct Target {
    path: String,
}

fn manifest(path: &str) -> Manifest {
    toml::from_str(&read(path)).unwrap()
}

#[test]
fn the_core_has_two_dependencies_and_six_by_features_without_serde() {
    let core = manifest("Cargo.toml");
    let is_option = |of: &toml::Value| {
        of.get("optional").and_then(toml::Value::as_bool) == Some(true)
    };
    let (options, always): (Vec<_>, Vec<_>) =
        core.dependencies.iter().partition(|(_, of)| is_option(of));
    let names = |all: Vec<(&String, _)>| -> Vec<String> {
        all.into_iter().map(|(name, _)| name.clone()).collect()
    };
    assert_eq!(names(always), CORE_DEPENDENCIES);
    assert_eq!(names(options), CORE_OPTIONS);
    // A dependency that no feature names as `dep:` is a feature itself.
    let named = toml::Value::from(core.features.clone()).to_string();
    for option in CORE_OPTIONS {
        assert!(named.contains(&format!("\"dep:{option}\"")), "{option}");
    }
    let default = toml::Value::from(vec!["lanes", "records", "statistics"]);
    assert_eq!(core.features["default"], default);
    let tests: Vec<&String> = core.dev_dependencies.keys().collect();
    assert_eq!(tests, ["proptest", "rocking-fixtures", "serde_json"]);
    assert!(core.build_dependencies.is_empty());
}

/// Names that files and commands share: as a literal, in the core alone.
#[test]
fn the_core_s_names_are_spelled_once() {
    let methods = FitMethod::all(QuantileType::default());
    let names = Adjust::ALL
        .map(Adjust::name)
        .into_iter()
        .chain(PulseName::ALL[5..].iter().map(|pulse| pulse.name()))
        .chain(methods[..2].iter().map(|method| method.name()))
        .chain([Model::Linearized.name(), Overturning::HalfPi.name()])
        .chain([InversionRule::Monotone.name(), "pgv-d575"]);
    let folders = [&SOURCES[..6], &["python/src"]].concat();
    let texts: Vec<(String, String)> = sources(&folders)
        .into_iter()
        .filter(|path| !path.ends_with("tests.rs"))
        .map(|path| (path.clone(), read(&path)))
        .collect();
    let mut problems = Vec::new();
    for name in names {
        let literal = format!("\"{name}\"");
        let places: Vec<&str> = texts
            .iter()
            .filter(|(_, text)| text.contains(&literal))
            .map(|(path, _)| path.as_str())
            .collect();
        if places.len() != 1 || !places[0].starts_with("src/") {
            problems.push(format!("{name}: spelled in {places:?}"));
        }
    }
    pass(&problems);
}

#[test]
fn every_dependency_is_used_and_explained() {
    let page = read(DEPENDENCIES);
    let (core, harness) =
        (manifest("Cargo.toml"), manifest("validation/command/Cargo.toml"));
    let mut problems = Vec::new();
    let mut direct = BTreeSet::new();
    let harness_all: Vec<String> = harness
        .dependencies
        .into_keys()
        .chain(harness.dev_dependencies.into_keys())
        .collect();
    let core_tests = core.dev_dependencies.into_keys().collect();
    let core_all: Vec<String> = core.dependencies.into_keys().collect();
    let mut packages: Vec<(Vec<String>, &[&str])> = vec![
        (core_all, &["src"]),
        (core_tests, &["src", "tests"]),
        (harness_all, &["validation/command/src", "tests"]),
    ];
    for (path, folders) in LIBRARIES {
        let library = manifest(path);
        let all = library.dependencies.into_keys();
        let all = all.chain(library.dev_dependencies.into_keys()).collect();
        packages.push((all, folders));
    }
    for (names, folders) in packages {
        let words: BTreeSet<String> = sources(folders)
            .iter()
            .flat_map(|path| tokens(&read(path)))
            .collect();
        for name in names {
            if !words.contains(&name.replace('-', "_")) {
                problems.push(format!("{name}: not used in {folders:?}"));
            }
            direct.insert(name);
        }
    }
    let row = |name: &str| {
        page.lines()
            .find(|line| line.starts_with(&format!("| `{name}` |")))
            .map(|line| line.split('|').collect::<Vec<_>>())
    };
    for name in &direct {
        match row(name).as_deref() {
            Some([_, _, licence, reason, _])
                if !licence.trim().is_empty() && !reason.trim().is_empty() => {
            }
            _ => problems
                .push(format!("{DEPENDENCIES}: no licence, reason: {name}")),
        }
    }
    let table = page.split("## Dependencies").nth(1).unwrap_or_default();
    let table = table.split("\n## ").next().unwrap_or_default();
    for line in table.lines().filter(|line| line.starts_with("| `")) {
        let name = line.split('`').nth(1).unwrap_or_default();
        if !direct.contains(name) {
            problems.push(format!("{DEPENDENCIES}: {name} is no dependency"));
        }
    }
    pass(&problems);
}

#[test]
fn it_stands_on_the_crates_and_folders_asked_for() {
    let paths = ["Cargo.toml", "validation/command/Cargo.toml"].into_iter();
    let all: Vec<Manifest> =
        paths.chain(LIBRARIES.map(|(path, _)| path)).map(manifest).collect();
    for name in [
        "statrs",
        "rand",
        "rand_distr",
        "nalgebra",
        "rayon",
        "insta",
        "proptest",
        "plotters",
    ] {
        let there = all.iter().any(|m| {
            m.dependencies.contains_key(name)
                || m.dev_dependencies.contains_key(name)
        });
        assert!(there, "{name}");
    }
    for folder in ["src", "validation", "tests", "reports", "fixtures"] {
        assert!(!files(folder).is_empty(), "{folder}");
    }
}

#[test]
fn every_test_file_is_a_target_and_lints_are_the_same() {
    let harness = manifest("validation/command/Cargo.toml");
    let core = manifest("Cargo.toml");
    let both = harness.test.into_iter().chain(core.test);
    let targets: BTreeSet<String> = both
        .map(|target| target.path.replace("../", ""))
        .chain(read("tests/gate.rs").lines().filter_map(|line| {
            let name = line.strip_prefix("#[path = \"")?.strip_suffix("\"]");
            name.map(|name| format!("tests/{name}"))
        }))
        .collect();
    let on_disk: BTreeSet<String> = files("tests")
        .into_iter()
        .filter(|path| path.ends_with(".rs") && path.matches('/').count() == 1)
        .collect();
    assert_eq!(targets, on_disk);
    assert!(core.lints.is_some());
    assert!(harness.lints.is_some());
    for (path, _) in LIBRARIES {
        assert!(manifest(path).lints.is_some(), "{path}");
    }
}

#[test]
fn nothing_is_unsafe_unfinished_or_skipped() {
    let mut problems = Vec::new();
    for path in sources(&SOURCES) {
        let tokens = tokens(&read(&path));
        let mut refuse = |sequence: &[&str]| {
            if holds(&tokens, sequence) {
                problems.push(format!("{path}: {}", sequence.concat()));
            }
        };
        if !UNSAFE.iter().any(|own| path.starts_with(own)) {
            refuse(&["unsafe"]);
        }
        refuse(&["todo", "!"]);
        refuse(&["unimplemented", "!"]);
        refuse(&["dbg", "!"]);
        refuse(&["#", "[", "ignore"]);
        refuse(&["Other", "(", "String", ")"]);
    }
    pass(&problems);
}

#[test]
fn the_harness_stands_on_the_public_core() {
    let mut problems = Vec::new();
    for path in sources(&["validation", "tests"]) {
        let text = read(&path);
        let tokens = tokens(&text);
        let sources = format!("../{}/", "src");
        if holds(&tokens, &["include", "!"]) || text.contains(&sources) {
            problems.push(format!("{path}: reads sources of the core"));
        }
        // Oracles compute nothing with the core; their tests may meet it. A
        // pulse's kind and parameters reach them through `proof::scene`.
        if path.starts_with("validation/proof/src/oracles")
            && !path.ends_with("tests.rs")
            && holds(&tokens, &["rocking", "::"])
        {
            problems.push(format!("{path}: an oracle uses the core"));
        }
    }
    for path in sources(&[
        "src",
        "crates/exchange/src",
        "crates/score/src",
        "crates/synthesis/src",
    ]) {
        let tokens = tokens(&read(&path));
        if holds(&tokens, &["doc", "(", "hidden", ")"]) {
            problems.push(format!("{path}: public but hidden"));
        }
    }
    pass(&problems);
}

/// Or accepting a result would take a run, a build and a run, and a program
/// could show results that it did not find.
#[test]
fn the_program_compiles_in_no_result_of_its_own() {
    // The one pin that is an expected value, not a result.
    let expected = "/work-counters.csv\"";
    let (mut problems, mut seen) = (Vec::new(), 0);
    for path in sources(&SOURCES[..7]) {
        let text = read(&path);
        for (at, _) in text.match_indices(concat!("incl", "ude_")) {
            let call = text[at..].split(')').next().unwrap_or_default();
            let own = ["/reports/", "/tests/pins/"];
            if call.contains(expected) {
                seen += 1;
            } else if own.iter().any(|folder| call.contains(folder)) {
                problems.push(format!("{path}: compiles in {call}"));
            }
        }
    }
    assert_eq!(seen, 1, "files that compile in {expected}");
    pass(&problems);
}

#[test]
fn files_stay_on_one_topic() {
    let mut problems = Vec::new();
    for path in sources(&SOURCES).into_iter().chain(sources(&["python/src"])) {
        let lines = read(&path).lines().count();
        if lines > MOST_LINES {
            problems
                .push(format!("{path}: {lines} lines, at most {MOST_LINES}"));
        }
    }
    pass(&problems);
}

#[test]
fn texts_name_no_place_of_a_machine() {
    let places = ["home", "root", "work", "tmp", "Users", "mnt", "opt"];
    let mut texts: Vec<String> = FOLDERS.split(' ').flat_map(files).collect();
    let top = fs::read_dir(root()).unwrap().map(Result::unwrap);
    texts.extend(
        top.filter(|entry| entry.file_type().unwrap().is_file())
            .map(|entry| entry.file_name().display().to_string())
            // In a worktree it is a file that says where the rest lies.
            .filter(|name| name != ".git"),
    );
    let mut problems = Vec::new();
    for path in texts {
        let Ok(text) = fs::read_to_string(root().join(&path)) else {
            continue;
        };
        for place in places {
            let place = format!("/{place}/");
            for (at, _) in text.match_indices(&place) {
                let before = text[..at].chars().next_back();
                // A part of a longer relative path is no absolute path.
                if !before.is_some_and(|c| c.is_alphanumeric() || c == '.') {
                    problems.push(format!("{path}: {place}.."));
                }
            }
        }
    }
    pass(&problems);
}
