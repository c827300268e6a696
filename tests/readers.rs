//! What readers must not let pass: every valid file of the fuzz corpus,
//! changed line by line and byte by byte; and the corpus itself, replayed.

use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

use rocking_records::{Format, Header, Remark};
use rocking_statistics::streams::{Streams, below};

use super::compare::holds_table;

#[path = "fuzz/targets.rs"]
mod targets;

fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/fuzz/corpus")
}

/// Files of a folder, by name.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            (name, fs::read(path).unwrap())
        })
        .collect();
    found.sort();
    assert!(!found.is_empty(), "{}", folder.display());
    found
}

#[test]
fn the_corpus_gets_the_verdict_in_its_names() {
    for target in targets::names() {
        for (name, bytes) in files(&corpus().join(target)) {
            let verdict = targets::run(target, &bytes);
            let valid = name.starts_with("valid-");
            assert!(valid || name.starts_with("refused-"), "{name}");
            assert_eq!(verdict.is_ok(), valid, "{target}/{name}: {verdict:?}");
        }
    }
    let folders = fs::read_dir(corpus()).unwrap().count();
    assert_eq!(folders, targets::names().count());
}

/// `.ci/accept` renews the table.
#[test]
fn the_page_of_formats_has_a_row_for_each() {
    const HEAD: &str = "| format | files | source | numbers of channels |\n\
                        |---|---|---|---|\n";
    let rows = Format::by_name().into_iter().map(|format| {
        let Format { name, files, source, .. } = format;
        let numbers = if format.azimuths { "azimuths" } else { "" };
        format!("| `{name}` | {files} | {source} | {numbers} |\n")
    });
    holds_table("docs/formats.md", HEAD, &rows.collect::<String>());
}

/// The promises of `tests/fuzz/targets.rs` hold for changed files, too.
#[test]
fn changed_files_of_the_corpus_are_read_or_refused() {
    // What a table of numbers is made of, and what it is not.
    const PIECES: [&[u8]; 16] = [
        b",", b"\n", b"\"", b"-", b"0", b"9", b".", b"e308", b"inf", b"nan",
        b"#", b">", b"\x00", b"\xff", b"1e-320", b"\r",
    ];
    for target in targets::names() {
        for (name, bytes) in files(&corpus().join(target)) {
            // Long records are changed by the tests below.
            if bytes.len() > 4096 {
                continue;
            }
            let mut stream = Streams::new(target, 0).stream(0);
            for _ in 0..60 {
                let mut changed = bytes.clone();
                for _ in 0..=below(&mut stream, 3) {
                    let from = below(&mut stream, changed.len() + 1);
                    let room = changed.len() - from;
                    let cut = below(&mut stream, 1 + room.min(8));
                    let piece = PIECES[below(&mut stream, PIECES.len())];
                    let again = changed[from..][..cut].to_vec();
                    let with = match below(&mut stream, 3) {
                        0 => Vec::new(),
                        1 => [&again[..], piece, &again].concat(),
                        _ => piece.to_vec(),
                    };
                    changed.splice(from..from + cut, with);
                }
                // A promise that is broken panics.
                let done = catch_unwind(|| targets::run(target, &changed));
                let text = String::from_utf8_lossy(&changed);
                assert!(done.is_ok(), "{target}/{name}:\n{text}");
            }
        }
    }
}

/// Channels of a file in g and whether its last line is remarked on, or
/// `None` where the file is refused.
fn channels(target: &str, bytes: &[u8]) -> Option<(Vec<Vec<f64>>, bool)> {
    let options = targets::options(Format::named(target)?);
    let records = rocking_records::read_all("x", bytes, &options).ok()?;
    let samples =
        |r: &rocking_records::Record| r.accelerogram.samples_g().to_vec();
    let cut =
        |r: &rocking_records::Record| r.remarks.contains(&Remark::LastLine);
    let cut = records.iter().any(cut);
    Some((records.iter().map(samples).collect(), cut))
}

/// A changed file that was read, and not as before.
struct Passed {
    target: &'static str,
    file: String,
    change: String,
    /// Whether what was read is the beginning of what was there.
    begins: bool,
    /// Whether the changed file ends where a line's text does.
    whole_lines: bool,
    /// Whether all but the last sample are those that were there, and a
    /// remark says that the last line has no end.
    cut: bool,
}

/// Reads the changed files of every valid file of `targets`.
fn passed(
    targets: &[&'static str],
    changes: impl Fn(&[u8]) -> Vec<(String, Vec<u8>)>,
) -> Vec<Passed> {
    let mut found = Vec::new();
    let mut tried = 0;
    for target in targets {
        for (file, bytes) in files(&corpus().join(target)) {
            if !file.starts_with("valid-") {
                continue;
            }
            let (whole, _) = channels(target, &bytes).unwrap();
            for (change, changed) in changes(&bytes) {
                tried += 1;
                let Some((read, cut)) = channels(target, &changed) else {
                    continue;
                };
                if read != whole {
                    let (change, file) = (change.clone(), file.clone());
                    let mut pairs = read.iter().zip(&whole);
                    let begins = read.len() <= whole.len()
                        && pairs.all(|(a, b)| b.starts_with(a));
                    let cut = cut
                        && read.iter().zip(&whole).all(|(a, b)| {
                            a.len() <= b.len()
                                && a[..a.len() - 1] == b[..a.len() - 1]
                        });
                    let next = bytes.get(changed.len());
                    let whole_lines =
                        changed.ends_with(b"\n") || next == Some(&b'\n');
                    found.push(Passed {
                        target,
                        file,
                        change,
                        begins,
                        whole_lines,
                        cut,
                    });
                }
            }
        }
    }
    assert!(tried > 10 * targets.len(), "{tried}");
    found
}

fn none(found: &[Passed]) {
    let list: Vec<String> = found
        .iter()
        .map(|p| format!("{}/{}: {}", p.target, p.file, p.change))
        .collect();
    assert!(list.is_empty(), "read differently:\n{}", list.join("\n"));
}

/// Names of the formats that are `wanted`.
fn formats(wanted: impl Fn(&Format) -> bool) -> Vec<&'static str> {
    let all = Format::ALL.iter().filter(|format| wanted(format));
    all.map(|format| format.name).collect()
}

/// Formats that state their number of samples.
fn counted() -> Vec<&'static str> {
    formats(|format| format.header <= Header::NoUnit)
}

/// Lines with their ends.
fn lines(bytes: &[u8]) -> Vec<&[u8]> {
    bytes.split_inclusive(|b| *b == b'\n').collect()
}

fn with_lines(bytes: &[u8], times: usize) -> Vec<(String, Vec<u8>)> {
    let lines = lines(bytes);
    let changed = |at: usize| {
        let repeat = |i: usize| if i == at { times } else { 1 };
        let parts = lines.iter().enumerate();
        parts.flat_map(|(i, l)| l.repeat(repeat(i))).collect()
    };
    (0..lines.len())
        .map(|at| (format!("line {} {times} times", at + 1), changed(at)))
        .collect()
}

fn dropped_and_doubled(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut found = with_lines(bytes, 0);
    found.extend(with_lines(bytes, 2));
    // A file of a few lines is tried often enough at other places.
    found.extend(with_lines(bytes, 3));
    found
}

fn cut(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    (0..bytes.len())
        .map(|at| (format!("cut at {at}"), bytes[..at].to_vec()))
        .collect()
}

#[test]
fn a_dropped_or_doubled_line_never_passes() {
    none(&passed(&counted(), dropped_and_doubled));
    // Two columns: the times tell, except for lines at the ends and for the
    // head that states the unit.
    let mut found = passed(&["csv"], |bytes| {
        let count = lines(bytes).len();
        let numbers = lines(bytes);
        let mark = |line: &&[u8]| line.iter().copied().find(|b| *b != b'"');
        let head = numbers
            .iter()
            .map(mark)
            .take_while(|first| !first.is_some_and(|b| b.is_ascii_digit()))
            .count();
        let mut changes = with_lines(bytes, 2);
        changes.extend(with_lines(bytes, 0).drain(head + 1..count - 1));
        changes.extend(with_lines(bytes, 3));
        changes
    });
    found.retain(|p| !p.begins);
    none(&found);
}

#[test]
fn a_cut_file_never_passes() {
    // Where a file of several channels ends after one, nothing is missing
    // in those before.
    let mut found = passed(&counted(), cut);
    found.retain(|p| !(p.target == "cosmos" && p.begins));
    none(&found);
    // Without a count, a cut between two lines leaves no trace, and one
    // within the last number a remark.
    let mut found =
        passed(&formats(|format| format.header >= Header::NoCount), cut);
    found.retain(|p| !(p.begins && p.whole_lines || p.cut));
    none(&found);
}

/// Whether a line is numbers alone.
fn data(line: &[u8]) -> bool {
    line.iter().all(|b| b" \t\r\n.,;+-0123456789eEdD".contains(b))
        && line.iter().any(u8::is_ascii_digit)
}

/// Offsets of the lines that `wanted`.
fn offsets(bytes: &[u8], wanted: impl Fn(&[u8]) -> bool) -> Vec<usize> {
    let mut at = 0;
    let mut found = Vec::new();
    for line in lines(bytes) {
        if wanted(line) {
            found.extend(at..at + line.len());
        }
        at += line.len();
    }
    found
}

#[test]
fn a_number_of_another_width_never_passes() {
    let mut found = passed(&formats(|format| format.is_fixed), |bytes| {
        let mut changes = Vec::new();
        for at in offsets(bytes, data) {
            let mut narrower = bytes.to_vec();
            narrower.remove(at);
            changes.push((format!("without byte {at}"), narrower));
            for with in b"0 1-." {
                let mut wider = bytes.to_vec();
                wider.insert(at, *with);
                let name = format!("{:?} before {at}", char::from(*with));
                changes.push((name, wider));
            }
        }
        changes
    });
    found.retain(|p| p.file != "valid-free.at2");
    none(&found);
}

#[test]
fn a_changed_count_never_passes() {
    // Every digit of every header line, counts and all else; the scale of
    // counts is the one number there that makes samples.
    none(&passed(&counted(), |bytes| {
        let mut changes = Vec::new();
        let header =
            |line: &[u8]| !data(line) && !line.starts_with(b"Scale Factor");
        for at in offsets(bytes, header) {
            if !bytes[at].is_ascii_digit() {
                continue;
            }
            for digit in b"0123456789" {
                let mut changed = bytes.to_vec();
                changed[at] = *digit;
                let name = format!("{} at {at}", char::from(*digit));
                changes.push((name, changed));
            }
            let mut longer = bytes.to_vec();
            longer.insert(at, b'1');
            changes.push((format!("1 before {at}"), longer));
            let mut shorter = bytes.to_vec();
            shorter.remove(at);
            changes.push((format!("without byte {at}"), shorter));
        }
        changes
    }));
}
