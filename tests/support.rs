//! The program under test, run in a folder of its own as a user runs it.

use std::fmt::Write as _;
use std::fs;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use rocking_synthesis::Pair;
use serde_json::Value;
use tempfile::TempDir;

use super::compare::near;

/// A command of the binary under test, in a folder.
pub fn rocking(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rocking"));
    command.args(arguments.split_whitespace()).current_dir(folder);
    command
}

/// Exit status, standard output and standard error.
pub fn outcome(output: Output) -> (i32, String, String) {
    let text = |bytes| String::from_utf8(bytes).unwrap();
    let status = output.status.code().unwrap();
    (status, text(output.stdout), text(output.stderr))
}

pub fn run(folder: &Path, arguments: &str) -> (i32, String, String) {
    outcome(rocking(folder, arguments).output().unwrap())
}

/// Standard output of a command that must succeed.
#[track_caller]
pub fn answer(folder: &Path, arguments: &str) -> String {
    let (status, out, error) = run(folder, arguments);
    assert_eq!((status, error.as_str()), (0, ""), "{arguments}");
    out
}

/// The same with `--json`, read.
#[track_caller]
pub fn json(folder: &Path, arguments: &str) -> Value {
    let more = if arguments.contains("--json") { "" } else { " --json" };
    let text = answer(folder, &format!("{arguments}{more}"));
    serde_json::from_str(&text).unwrap()
}

/// Fails unless a number of an answer is this, within a share of it.
#[track_caller]
pub fn close(value: &Value, expected: f64, tolerance: f64) {
    let limit = tolerance * expected.abs();
    near("number printed", value.as_f64().unwrap(), expected, limit);
}

/// Standard error of a command that must be refused and leave no trace.
#[track_caller]
pub fn refused(folder: &Path, arguments: &str) -> String {
    let before = tree(folder);
    let (status, out, error) = run(folder, arguments);
    assert_eq!((status, out.as_str()), (2, ""), "{arguments}\n{error}");
    assert_eq!(tree(folder), before, "{arguments}");
    error
}

/// Standard error of a command that must fail, after it listed what it could
/// read.
#[track_caller]
pub fn failure(folder: &Path, arguments: &str) -> String {
    let (status, _, error) = run(folder, arguments);
    assert_eq!(status, 2, "{arguments}: {error}");
    error
}

/// The refusal has these words.
#[track_caller]
pub fn refused_with(folder: &Path, arguments: &str, words: &str) {
    let error = refused(folder, arguments);
    assert!(error.contains(words), "{arguments}: no {words} in {error}");
}

/// The refusal is one message of one line and has these names.
#[track_caller]
pub fn refused_for(folder: &Path, arguments: &str, names: &[&str]) {
    let error = refused(folder, arguments);
    assert!(error.starts_with("rocking: "), "{arguments}: {error}");
    assert_eq!(error.lines().count(), 1, "{arguments}: {error}");
    for name in names {
        assert!(error.contains(name), "{arguments}: no {name} in {error}");
    }
}

/// All files below a folder with their content, hidden ones too.
pub fn tree(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.push((path.clone(), Vec::new()));
            found.extend(tree(&path));
        } else {
            // A link may lead to nothing.
            found.push((path.clone(), fs::read(&path).unwrap_or_default()));
        }
    }
    found.sort();
    found
}

/// A folder of a test's own, which is removed with the test: two runs of the
/// tests at once do not see each other.
pub struct Place {
    path: PathBuf,
    _root: TempDir,
}

impl Deref for Place {
    type Target = Path;

    fn deref(&self) -> &Path {
        &self.path
    }
}

impl AsRef<Path> for Place {
    fn as_ref(&self) -> &Path {
        self
    }
}

/// A fresh folder of this name with the given files.
pub fn folder(name: &str, files: &[(&str, &str)]) -> Place {
    let root = env!("CARGO_TARGET_TMPDIR");
    let root = TempDir::new_in(root).unwrap();
    let folder = Place { path: root.path().join(name), _root: root };
    fs::create_dir(&folder).unwrap();
    for (file, text) in files {
        let path = folder.join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

/// An AT2 file with these samples, five a line.
pub fn at2(dt_s: &str, npts: usize, samples: &[f64]) -> String {
    let mut text = format!(
        "PEER STRONG MOTION DATABASE RECORD\nNowhere, 1900, Station, 0\n\
         ACCELERATION TIME SERIES IN UNITS OF G\n\
         NPTS= {npts}, DT= {dt_s} SEC\n"
    );
    for line in samples.chunks(5) {
        for sample in line {
            // As Fortran writes it: an exponent with a sign and two digits.
            let number = format!("{sample:.7E}");
            let (digits, exponent) = number.split_once('E').unwrap();
            let exponent: i32 = exponent.parse().unwrap();
            write!(text, "{digits:>11}E{exponent:+03}").unwrap();
        }
        text.push('\n');
    }
    text
}

/// A smooth motion of about 3 s with its own rhythm.
pub fn motion(rhythm_rad_s: f64) -> Vec<f64> {
    let sample = |i: i32| {
        let t = 0.02 * f64::from(i);
        0.4 * t * libm::exp(-t) * libm::sin(rhythm_rad_s * t)
    };
    (0..150).map(sample).collect()
}

/// The pairs of the embedded suites, ordinary and pulse-type, made once.
pub fn suites() -> &'static [Vec<Pair>; 2] {
    static MADE: LazyLock<[Vec<Pair>; 2]> = LazyLock::new(|| {
        [rocking_synthesis::ordinary(), rocking_synthesis::pulse()]
            .map(|suite| suite.expect("a suite"))
    });
    &MADE
}
