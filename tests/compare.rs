//! Comparisons that say what was compared, what the program got, what was
//! expected, and within which limit.
#![allow(dead_code, reason = "each program of tests takes what it needs")]

use std::fmt::{Debug, Display};
use std::fs;
use std::path::{Path, PathBuf};

/// The folder for the files that tests find, where `.ci/accept` runs them.
pub fn accepting() -> Option<PathBuf> {
    std::env::var_os("ROCKING_ACCEPT").map(PathBuf::from)
}

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

/// Fails where the rows of the table under `head` in the page `path` are not
/// `rows`. Where `.ci/accept` runs the test, it gets the page with these.
#[track_caller]
pub fn holds_table(path: &str, head: &str, rows: &str) {
    let kept = fs::read_to_string(place(path)).unwrap();
    let (before, after) = kept.split_once(head).expect("the table's head");
    let (_, after) = after.split_once("\n\n").expect("text behind it");
    let page = format!("{before}{head}{rows}\n{after}");
    if let Some(kept) = committed(path, &page) {
        assert!(kept == page, "{path}: expected the rows\n{rows}");
    }
}

/// The text of a committed file, which a test finds to be `found`. None where
/// `.ci/accept` runs the test: then the text found goes to its folder.
pub fn committed(path: &str, found: &str) -> Option<String> {
    if let Some(folder) = accepting() {
        let place = folder.join(path);
        fs::create_dir_all(place.parent().unwrap()).unwrap();
        fs::write(place, found).unwrap();
        return None;
    }
    Some(fs::read_to_string(place(path)).unwrap())
}

/// Where a committed file is.
fn place(path: &str) -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut places = own.ancestors().map(|root| root.join(path));
    let place = places.find(|place| place.is_file());
    place.unwrap_or_else(|| panic!("{path}: no such file"))
}

/// Fails where what was found is not the pin `name`, a text of this
/// program's own results in `tests/pins`. `found` has a name and a line for
/// each case; `columns` says what a line holds. Where `.ci/accept` runs the
/// test, it gets the lines instead, and shows how they differ.
#[track_caller]
pub fn hold(name: &str, columns: &str, found: &[(String, String)]) {
    let lines: Vec<&str> = found.iter().map(|(_, line)| &**line).collect();
    let path = format!("tests/pins/{name}");
    let text = lines.join("\n") + "\n";
    let Some(pinned) = committed(&path, &text) else { return };
    let pinned: Vec<&str> = pinned.lines().collect();
    if let Some((k, words)) = difference(&lines, &pinned) {
        let case = found.get(k).map_or("no such case", |(case, _)| case);
        panic!(
            "tests/pins/{name}, {columns}: {words}\n    case {case}\nIf the \
             change is meant, `.ci/accept` renews all pins."
        );
    }
}
