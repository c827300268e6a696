//! Tells the program the commit of its sources, for `rocking --version` and
//! for reports that are issued.

use std::fs;
use std::process::Command;

/// What the program is built from, beside this package's folder.
const SOURCES: [&str; 10] = [
    "../Cargo.lock",
    "../Cargo.toml",
    "../exchange",
    "../fixtures",
    "../parquet",
    "../score",
    "../src",
    "../surrogate",
    "../synthesis",
    "../validation",
];

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

/// The commit, and whether files differ from it; none where the sources are
/// no repository of their own.
fn commit() -> Option<String> {
    if !git(&["-C", "..", "rev-parse", "--show-prefix"])?.is_empty() {
        return None;
    }
    let commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    let status = [&["status", "--porcelain", "--"][..], &SOURCES].concat();
    Some(match git(&status)?.is_empty() {
        true => commit,
        false => commit + " with changes",
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
        println!("cargo::rerun-if-changed={source}");
    }
    // Each commit adds a line to it.
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"]) {
        println!("cargo::rerun-if-changed={log}");
    }
    let commit =
        packaged().or_else(commit).unwrap_or_else(|| "unknown".into());
    println!("cargo::rustc-env=ROCKING_COMMIT={commit}");
}
