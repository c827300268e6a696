//! Gives the command and the Python package the commit of their sources, for
//! `rocking --version`, IDA tables and assessments.

use std::fs;
use std::io::Write as _;
use std::process::{Command, Stdio};

/// Sources of the command and of the Python package.
const SOURCES: [&str; 8] = [
    "Cargo.lock",
    "Cargo.toml",
    "crates",
    "fixtures",
    "python/Cargo.lock",
    "python/src",
    "src",
    "validation",
];

/// The root of the repository: one folder above the Python package, two above
/// the command.
fn root() -> &'static str {
    if fs::exists("../fixtures").unwrap_or(false) { ".." } else { "../.." }
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

/// A hash of what differs from the commit: changes, and files that it does
/// not have.
fn changes() -> Option<String> {
    let named = |head: &[&str]| {
        let line = [&["-C", root()], head, &["--"], &SOURCES].concat();
        let output = Command::new("git").args(line).output().ok()?;
        output.status.success().then_some(output.stdout)
    };
    let mut all = named(&["diff", "HEAD", "--binary"])?;
    let others = named(&["ls-files", "--others", "--exclude-standard"])?;
    for name in String::from_utf8(others).ok()?.lines() {
        all.extend(name.bytes());
        all.extend(fs::read(format!("{}/{name}", root())).unwrap_or_default());
    }
    let mut hash = Command::new("git")
        .args(["hash-object", "--stdin"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .ok()?;
    hash.stdin.take()?.write_all(&all).ok()?;
    let output = hash.wait_with_output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    Some(text.get(..12)?.to_owned())
}

/// The commit, and a hash of what differs from it, so that two builds of
/// other sources have other names; none where the sources are no repository
/// of their own.
fn commit() -> Option<String> {
    if !git(&["-C", root(), "rev-parse", "--show-prefix"])?.is_empty() {
        return None;
    }
    let commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    let status =
        [&["-C", root(), "status", "--porcelain", "--"][..], &SOURCES];
    let status = status.concat();
    Some(match git(&status)?.is_empty() {
        true => commit,
        false => format!("{commit} with changes {}", changes()?),
    })
}

/// The commit that a package of a registry was made from.
fn packaged() -> Option<String> {
    let text = fs::read_to_string(".cargo_vcs_info.json").ok()?;
    let commit = text.split("\"sha1\": \"").nth(1)?.get(..12)?;
    let changed = text.contains("\"dirty\": true");
    Some(commit.to_owned() + if changed { " with changes" } else { "" })
}

fn main() {
    for source in SOURCES {
        println!("cargo::rerun-if-changed={}/{source}", root());
    }
    // Each commit adds a line to it.
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"]) {
        println!("cargo::rerun-if-changed={log}");
    }
    let commit =
        packaged().or_else(commit).unwrap_or_else(|| "unknown".into());
    println!("cargo::rustc-env=ROCKING_COMMIT={commit}");
}
