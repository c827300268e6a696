//! Comparisons that say what was compared, what the program got, what was
//! expected, and within which limit.
#![allow(dead_code, reason = "each program of tests takes what it needs")]

use std::fmt::{Debug, Display};
use std::fs;
use std::path::Path;

/// Folder for what is found; `rocking accept` sets it.
const ACCEPT: &str = "ROCKING_ACCEPT";

/// Fails unless `got` is `expected` within `limit`. NaN is never within.
#[track_caller]
pub fn near(what: impl Display, got: f64, expected: f64, limit: f64) {
    let off = (got - expected).abs();
    assert!(
        off <= limit,
        "{what}: got {got}, expected {expected} within {limit:e}: \
         off by {off:e}"
    );
}

/// Fails unless two lists are the same, and shows the first place that
/// differs.
#[track_caller]
pub fn same<T: PartialEq + Debug>(
    what: impl Display,
    got: &[T],
    expected: &[T],
) {
    if let Some((_, words)) = difference(got, expected) {
        panic!("{what}: {words}");
    }
}

/// The first place at which two lists differ, and what is there.
fn difference<T: PartialEq + Debug>(
    got: &[T],
    expected: &[T],
) -> Option<(usize, String)> {
    let length = got.len().max(expected.len());
    let differ = |k: &usize| got.get(*k) != expected.get(*k);
    let first = (0..length).find(differ)?;
    let count = (0..length).filter(differ).count();
    let words = format!(
        "{count} of {length} differ, first number {}\n     got {:?}\n\
         expected {:?}",
        first + 1,
        got.get(first),
        expected.get(first)
    );
    Some((first, words))
}

/// Fails where what was found is not the pin `name`, a text of this
/// program's own results in `tests/pins`. `found` has a name and a line for
/// each case; `columns` says what a line holds. Where `rocking accept` runs
/// the test, it gets the lines instead, and shows how they differ.
#[track_caller]
pub fn hold(name: &str, columns: &str, found: &[(String, String)]) {
    let lines: Vec<&str> = found.iter().map(|(_, line)| &**line).collect();
    if let Some(folder) = std::env::var_os(ACCEPT) {
        let text = lines.join("\n") + "\n";
        fs::write(Path::new(&folder).join(name), text).unwrap();
        return;
    }
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = own.ancestors().map(|root| root.join("tests/pins"));
    let path = folders.find(|folder| folder.is_dir()).unwrap().join(name);
    let pinned = fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("tests/pins/{name}: {error}"));
    let pinned: Vec<&str> = pinned.lines().collect();
    if let Some((k, words)) = difference(&lines, &pinned) {
        let case = found.get(k).map_or("no such case", |(case, _)| case);
        panic!(
            "tests/pins/{name}, {columns}: {words}\n    case {case}\nIf the \
             change is meant, `cargo run --release -- accept` renews all \
             pins."
        );
    }
}
