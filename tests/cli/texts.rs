//! Texts that people read, as committed snapshots: a changed word is seen in
//! the change, and renewed by `.ci/accept`.

use std::path::Path;

use insta::{Settings, assert_snapshot};

use super::super::compare::accepting;
use super::diff::sides;
use super::support::{folder, run};

/// A help has no more lines, at 100 columns; those of the two commands that
/// take every kind of block and motion have a quarter more.
const LINES_OF_A_SCREEN: usize = 50;
const LONGER: [&str; 2] = ["respond", "ida"];

fn settings() -> Settings {
    let mut settings = Settings::clone_current();
    let place = accepting().map(|root| root.join("tests/cli/snapshots"));
    settings.set_snapshot_path(place.unwrap_or_else(|| "snapshots".into()));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings
}

#[test]
fn help_of_every_command() {
    let place = folder("texts-help", &[]);
    let (status, top, error) = run(&place, "--help");
    assert_eq!((status, error.as_str()), (0, ""));
    settings().bind(|| assert_snapshot!("help", top));
    let mut commands = subcommands(&top);
    assert!(commands.len() > 15, "{top}");
    let examples = Path::new(env!("CARGO_MANIFEST_DIR"));
    let examples = examples.join("../../docs/commands.md");
    let examples = std::fs::read_to_string(examples).unwrap();
    for name in &commands {
        assert!(examples.contains(&format!("`rocking {name}")), "{name}");
    }
    while let Some(command) = commands.pop() {
        let (status, text, error) = run(&place, &format!("{command} --help"));
        assert_eq!((status, error.as_str()), (0, ""), "{command}");
        let lines = text.lines().count();
        let is_long = LONGER.contains(&command.as_str());
        let most = LINES_OF_A_SCREEN
            + if is_long { LINES_OF_A_SCREEN / 4 } else { 0 };
        assert!(lines <= most, "{command}: {lines} lines");
        let name = format!("help-{}", command.replace(' ', "-"));
        settings().bind(|| assert_snapshot!(name, text));
        let inner = subcommands(&text).into_iter();
        commands.extend(inner.map(|inner| format!("{command} {inner}")));
    }
}

#[test]
fn the_version_names_the_commit() {
    let place = folder("texts-version", &[]);
    let (status, text, _) = run(&place, "--version");
    let head = concat!("rocking ", env!("CARGO_PKG_VERSION"), " (commit ");
    let named = text.strip_prefix(head).and_then(|t| t.strip_suffix(")\n"));
    let named = named.expect(&text);
    let (commit, changes) = named.split_once(" with changes ").unzip();
    let commit = commit.unwrap_or(named);
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let hash = |text: &str| {
        text.len() == 12 && text.chars().all(|c| c.is_ascii_hexdigit())
    };
    match Path::new(root).join(".git").exists() {
        true => {
            let is_named = hash(commit) && changes.is_none_or(hash);
            assert!(status == 0 && is_named, "{text}");
        }
        false => assert_eq!((status, commit), (0, "unknown")),
    }
}

/// The commands that a help lists: rows of two words or more under any
/// heading but the last, which has the options.
pub fn subcommands(help: &str) -> Vec<String> {
    let lists = help.split_once("\nOptions:\n").map_or("", |(own, _)| own);
    let lists = lists.split_once("\nUsage:").map_or("", |(_, own)| own);
    let rows = lists.lines().filter_map(|row| {
        row.strip_prefix("  ")
            .filter(|row| !row.starts_with([' ', '-', '[', '<']))
    });
    let names = rows.filter_map(|row| row.split_whitespace().next());
    names.filter(|name| *name != "rocking").map(str::to_owned).collect()
}

#[test]
fn what_changed_between_two_results() {
    let findings = [
        ("\"eta\": 0.92", "\"eta\": 0.919"),
        ("2.31, \"low\": 2.27, \"high\": 2.3353", "2.6"),
        ("3.3, \"low\": 3.1, \"high\": 3.5", "3.4"),
        ("\"seen\": \"yes\"", "\"seen\": \"in part\""),
    ];
    let cases = [("\"first\": [0.5]", "\"first\": [0.6]")];
    let place = sides("texts", &findings, &cases);
    for (name, flags) in [
        ("diff-text", "--all"),
        ("diff-markdown", "--markdown"),
        ("diff-json", "--json"),
    ] {
        let (status, text, error) =
            run(&place, &format!("diff old new {flags}"));
        assert_eq!(status, 1, "{error}");
        // Every commit has another.
        let lines = text.lines().filter(|l| !l.starts_with("  \"commit\": "));
        let text: String = lines.flat_map(|line| [line, "\n"]).collect();
        settings().bind(|| assert_snapshot!(name, text));
    }
}
