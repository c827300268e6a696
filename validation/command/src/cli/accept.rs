//! `rocking accept`: renews every committed file that holds results of this
//! program.

mod inputs;
mod lab;

use std::env;
use std::ffi::OsString;
use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::show::text;
use super::{study, validate};
use crate::failure::{At as _, Failure};
use crate::terminal::{note, say};
use rocking_common::files::{Folder, is_interrupted};
use rocking_common::findings::Findings;
use rocking_proof::cases::pinned::{COUNTERS, counters_csv, expect_counters};
use rocking_proof::cases::{Cost, load_all};
use rocking_proof::methods::{self, digits, digits_csv};
use rocking_proof::verdict::{Outcome, run_all, snapshot};
use rocking_report::evidence::Proof;
use rocking_report::lab::LAB;
use rocking_report::marked;
use rocking_report::output::{FINDINGS, Files};
use rocking_report::stale::{self, stale};

/// Renews every committed file that holds results of this program: pins,
/// help snapshots, docs/tables.md, the surrogate, the results on recorded
/// suites where ../shared/records has them, reports/, reports/lab.html where
/// `validation/web/build` can compile its engine, the results between marks in README,
/// docs and paper.
///
/// It runs in the root of the repository, by cargo, so that the program is
/// built from what is there. It runs the tests that hold such files, the
/// declared cases and the study. Where a case fails, nothing is written. It
/// prints what the results say differently, then writes the files that
/// change. Where a file changes that the program compiles in, it builds the
/// program again and goes on with that.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    cargo run --release -- accept --check\n  \
    cargo run --release -- accept")]
pub struct Args {
    /// Write nothing, say what would change, and fail where anything would.
    #[arg(long)]
    check: bool,
}

/// Folder of the pins.
const PINS: &str = "tests/pins";
/// Folder of the committed report.
const REPORTS: &str = "reports";
/// The example of the README, which shows the first paragraph that it prints.
const EXAMPLE: &str = "assess --objects examples/museum/objects.csv \
                       --hazard examples/museum/hazard.csv --out";
/// Results of the declared cases.
const CASES: &str = "data/validation.json";
/// Digits that each precision reaches.
const DIGITS: &str = "data/precision.csv";

/// The tests that hold files, and a file that each holds. A test hands over
/// what it found (`tests/compare.rs`): it alone can compute it, since
/// some of it is private to the core.
const HOLDERS: [(&str, &str); 8] = [
    ("regresses_bits_of_a_thousand_analyses", "tests/pins/golden.txt"),
    ("regresses_estimates_margins_and_work", "tests/pins/regressions.txt"),
    ("regresses_the_sums_of_many_short_runs", "tests/pins/short.txt"),
    ("regresses_the_bounds_of_the_proof", "tests/pins/rest.txt"),
    ("a_pool_gives_the_whole_response_of", "tests/pins/tallies.txt"),
    ("help_of_every_command", "tests/cli/snapshots/help.snap"),
    ("what_changed_between", "tests/cli/snapshots/diff-text.snap"),
    ("the_page_of_tables_is_that_of", "docs/tables.md"),
];
/// Snapshots of help and messages.
const SNAPSHOTS: &str = "tests/cli/snapshots";

/// How they are run. Both packages: so `cargo test` has built them already.
const TEST: [&str; 8] = [
    "test",
    "--locked",
    "--lib",
    "--test",
    "mechanics",
    "--test",
    "gate",
    "--",
];

/// Runs the command.
///
/// # Errors
/// [`Failure`] outside the root of the repository and for files that cannot
/// be read or written (status 2); for a test or a case that fails, for files
/// that belong to no report, and with `--check` for any change (status 1).
pub fn run(args: &Args) -> Result<(), Failure> {
    at_root()?;
    let mut files = from_tests()?;
    let idle = idle_snapshots(&files)?;
    let mut put = |folder: &str, name: &str, text: Vec<u8>| {
        files.insert(format!("{folder}/{name}"), text);
    };
    let (counters, results, precision) = cases()?;
    put("validation/proof", "work-counters.csv", counters.into_bytes());
    let old = file(&format!("{REPORTS}/{CASES}"))?;
    let mut words = compared(&old, &results);
    let compiled_in = inputs::made(&mut words)?;
    let compiled_in = changed(compiled_in, &mut words)?;
    if !compiled_in.is_empty() && !args.check {
        say(&words)?;
        write(&compiled_in)?;
        return again();
    }
    put(REPORTS, CASES, results.clone().into_bytes());
    put(REPORTS, DIGITS, precision.clone().into_bytes());
    let proof = Proof::from_texts(Path::new("data"), &results, precision)?;
    let report = study::report(&["--out", REPORTS], Some(&proof))?;
    let findings = report.get(FINDINGS).map(|f| String::from_utf8_lossy(f));
    let findings = Findings::parse(&findings.unwrap_or_default())
        .map_err(Failure::gate)?;
    let assessed = assessed()?;
    let results = marked::Results {
        findings: &findings,
        proof: &proof,
        assessed: Some(&assessed),
    };
    let mut pages = Files::new();
    for page in marked::PAGES {
        let new = results.renewed(page, &file(page)?)?;
        pages.insert(page.into(), new.into_bytes());
    }
    words += &stale(Path::new(REPORTS), &report)?.unwrap_or_default();
    for (name, content) in &report {
        put(REPORTS, name, content.clone());
    }
    if let Some(page) = lab::made()? {
        files.insert(format!("{REPORTS}/{LAB}"), page);
    }
    files.extend(pages);
    let mut changed = changed(files, &mut words)?;
    changed.extend(compiled_in);
    say(&words)?;
    let list: Vec<&str> = changed.keys().map(String::as_str).collect();
    let list = list.join("\n  ");
    if args.check && !changed.is_empty() {
        return Err(Failure::gate(format!(
            "{} files would change:\n  {list}\n`cargo run --release -- \
             accept` changes them",
            changed.len()
        )));
    }
    write(&changed)?;
    // What is left are files that no study writes.
    if let Some(words) = stale(Path::new(REPORTS), &report)? {
        return Err(Failure::gate(format!(
            "{words}{REPORTS} holds more than the report: remove the rest"
        )));
    }
    if !idle.is_empty() {
        return Err(Failure::gate(format!(
            "{SNAPSHOTS} holds what no test shows: remove {}",
            idle.join(", ")
        )));
    }
    if changed.is_empty() {
        say("nothing changes: all results are accepted\n")?;
    }
    Ok(())
}

/// Refuses another folder than the root of the repository, and a program
/// that was not built there just now.
fn at_root() -> Result<(), Failure> {
    let there = |path: &str| fs::canonicalize(path).ok();
    let built = env::var("CARGO_MANIFEST_DIR").ok();
    let built = built.and_then(|folder| there(&folder));
    let here =
        there("validation/command").filter(|_| Path::new(PINS).is_dir());
    if here.is_none() || built != here {
        return Err(Failure::input(
            "expected `cargo run --release -- accept` in the root of the \
             repository, so that the program is built from what is there",
        ));
    }
    if is_interrupted(Path::new(".")) {
        return Err(Failure::input(
            "files of two runs are here: remove `.rocking-*.part` and \
             restore what is missing with git, then run this again",
        ));
    }
    Ok(())
}

/// Puts files into the repository, and lists them.
fn write(changed: &Files) -> Result<(), Failure> {
    let Some((last, _)) = changed.last_key_value() else { return Ok(()) };
    Folder::open(Path::new("."))?.write(changed, &[last])?;
    let list: Vec<&str> = changed.keys().map(String::as_str).collect();
    let list = list.join("\n  ");
    say(&format!("{} files changed:\n  {list}\n", changed.len()))
}

/// Runs the command again, in a program that has the new files compiled in.
fn again() -> Result<(), Failure> {
    let mut line = vec!["run"];
    line.extend((!cfg!(debug_assertions)).then_some("--release"));
    line.extend(["--", "accept"]);
    note(&format!("cargo {}", line.join(" ")));
    let done = Command::new(cargo()).args(line).status()?;
    match done.success() {
        true => Ok(()),
        false => Err(Failure::gate("the second run failed")),
    }
}

fn cargo() -> OsString {
    env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// Committed snapshots that the tests no longer write.
fn idle_snapshots(written: &Files) -> Result<Vec<String>, Failure> {
    let mut idle = Vec::new();
    for entry in fs::read_dir(SNAPSHOTS).at(SNAPSHOTS)? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        let name = format!("{SNAPSHOTS}/{name}");
        if !written.contains_key(&name) {
            idle.push(name);
        }
    }
    idle.sort();
    Ok(idle)
}

/// The files that tests hold, as the tests find them.
fn from_tests() -> Result<Files, Failure> {
    let folder = tempfile::tempdir()?;
    // Snapshots go where insta takes the repository to be.
    fs::create_dir_all(folder.path().join("validation/command"))?;
    let line: Vec<&str> =
        TEST.into_iter().chain(HOLDERS.map(|(test, _)| test)).collect();
    let words = format!("cargo {}", line.join(" "));
    note(&words);
    let done = Command::new(cargo())
        .args(line)
        .env("ROCKING_ACCEPT", folder.path())
        .env("INSTA_WORKSPACE_ROOT", folder.path())
        .env("INSTA_UPDATE", "always")
        .stderr(Stdio::inherit())
        .output()?;
    if !done.status.success() {
        say(&String::from_utf8_lossy(&done.stdout))?;
        return Err(Failure::gate(format!("failed: {words}")));
    }
    let mut found = Files::new();
    gather(folder.path(), &PathBuf::new(), &mut found)?;
    let missing = HOLDERS.iter().find(|(_, file)| !found.contains_key(*file));
    if let Some((test, file)) = missing {
        return Err(Failure::gate(format!(
            "{file}: expected the test {test} to find it (for the tallies on \
             a machine with AVX2)"
        )));
    }
    Ok(found)
}

/// The files below a folder of `root`, by their paths from there.
fn gather(
    root: &Path,
    inner: &Path,
    found: &mut Files,
) -> Result<(), Failure> {
    for entry in fs::read_dir(root.join(inner))? {
        let entry = entry?;
        let path = inner.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            gather(root, &path, found)?;
        } else {
            let name = path.display().to_string();
            found.insert(name, fs::read(entry.path())?);
        }
    }
    Ok(())
}

/// The first paragraph that `rocking assess` prints of the example, in lines
/// as the README's.
fn assessed() -> Result<String, Failure> {
    note("the example of the README");
    let place = tempfile::tempdir()?;
    let program = fs::canonicalize(env::args_os().next().unwrap_or_default())?;
    let done = Command::new(program)
        .args(EXAMPLE.split_whitespace())
        .arg(place.path().join("museum"))
        .stderr(Stdio::inherit())
        .output()?;
    if !done.status.success() {
        return Err(Failure::gate(format!("failed: rocking {EXAMPLE}")));
    }
    let text = String::from_utf8_lossy(&done.stdout).into_owned();
    let first = text.split("\n\n").next().unwrap_or_default();
    Ok(wrapped(first))
}

/// Lines of at most 79 characters; `%` stays with its number.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::new()];
    let text = text.replace(" %", "\u{a0}%");
    for word in text.split_ascii_whitespace() {
        let last = lines.len() - 1;
        if lines[last].is_empty() {
            lines[last] = word.into();
        } else if lines[last].chars().count() + word.chars().count() < 79 {
            lines[last] += &format!(" {word}");
        } else {
            lines.push(word.into());
        }
    }
    lines.join("\n").replace('\u{a0}', " ")
}

/// Work counters, results of the declared cases and digits of each
/// precision, as their files have them.
fn cases() -> Result<(String, String, String), Failure> {
    note("declared cases");
    let mut cases = load_all()?;
    cases.retain(|case| case.cost == Cost::Quick);
    let counted = cases.iter().filter(|case| case.method == COUNTERS);
    let counted = counted
        .map(|case| Ok((case, methods::run(case, None)?.observed)))
        .collect::<Result<Vec<_>, Failure>>()?;
    let counters = counters_csv(&counted);
    expect_counters(&mut cases, &counters);
    let outcomes = run_all(&cases);
    let results = snapshot::text(&cases, &outcomes);
    let refused: Vec<Outcome> = outcomes
        .into_iter()
        .filter(|outcome| !outcome.verdict.is_accepted())
        .collect();
    if !refused.is_empty() {
        say(&text(&validate::Shown::of(&refused))?)?;
        return Err(Failure::gate(format!(
            "{} of {} cases are not accepted: nothing is written",
            refused.len(),
            cases.len()
        )));
    }
    Ok((counters, results, digits_csv(&digits()?)))
}

/// A file as it is; empty where there is none.
fn file(path: &str) -> Result<String, Failure> {
    match fs::read_to_string(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            Ok(String::new())
        }
        read => read.at(path),
    }
}

/// What the results of the declared cases say differently.
fn compared(old: &str, new: &str) -> String {
    if old.is_empty() {
        return String::new();
    }
    stale::compared(&Path::new(REPORTS).join(CASES), old, new)
}

/// Those of the files that are not as they are in the folder; adds to `words`
/// which lines change where nothing else tells.
fn changed(files: Files, words: &mut String) -> Result<Files, Failure> {
    let mut changed = Files::new();
    for (name, new) in files {
        let old = match fs::read(&name) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            read => Some(read.at(&name)?),
        };
        if old.as_ref() == Some(&new) {
            continue;
        }
        if !name.starts_with(REPORTS) || name.ends_with(DIGITS) {
            let old = old.unwrap_or_default();
            *words += &lines(&name, &old, &new);
        }
        changed.insert(name, new);
    }
    Ok(changed)
}

/// Characters of a changed line that are shown.
const SHOWN: usize = 200;

/// How many lines of a file change, and the first of them.
fn lines(name: &str, old: &[u8], new: &[u8]) -> String {
    let texts = [old, new].map(String::from_utf8_lossy);
    let [old, new] = texts.each_ref().map(|text| text.lines());
    let (old, new): (Vec<_>, Vec<_>) = (old.collect(), new.collect());
    let count = old.len().max(new.len());
    let at = |lines: &[&str], k: usize| {
        lines.get(k).map_or(String::new(), |line| (*line).to_owned())
    };
    let differ: Vec<usize> =
        (0..count).filter(|&k| at(&old, k) != at(&new, k)).collect();
    let mut out =
        format!("{name}: {} of {count} lines differ\n", differ.len());
    if let Some(&k) = differ.first() {
        // Writing to a string cannot fail.
        // A line of figures.json is as long as its figure.
        let _ = writeln!(out, "  line {}: {:.SHOWN$}", k + 1, at(&old, k));
        let _ = writeln!(out, "  now: {:.SHOWN$}", at(&new, k));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_no_longer_than_a_page_allows() {
        let text = "word ".repeat(40);
        let lines = wrapped(&text);
        assert!(lines.lines().all(|line| line.len() <= 79), "{lines}");
        assert_eq!(lines.lines().next().map(str::len), Some(79));
        assert_eq!(lines.split_whitespace().count(), 40);
    }

    #[test]
    fn the_first_changed_line_is_shown() {
        let shown = lines("pin", b"a 1\nb 2\nc 3\n", b"a 1\nb 4\nc 5\nd 6\n");
        let first = "  line 2: b 2\n  now: b 4\n";
        assert_eq!(shown, format!("pin: 3 of 4 lines differ\n{first}"));
    }

    #[test]
    fn results_of_another_form_are_shown_and_no_obstacle() {
        let case = |verdict: &str| {
            let rest = "\"quantities\": {}, \"rejected\": {}";
            let kind = "\"kind\": \"regression\", \"method\": \"m\"";
            format!(
                "{{\"f/x\": {{{kind}, \"oracle\": \"own-output\", \
                 \"verdict\": \"{verdict}\", {rest}}}}}"
            )
        };
        let (pass, fail) = (case("pass"), case("fail"));
        assert_eq!(compared(&pass, &pass), "");
        assert_eq!(compared("", &pass), "");
        assert!(compared(&fail, &pass).contains("fail"));
        assert!(compared("{}", &pass).starts_with("not compared: "));
    }
}
