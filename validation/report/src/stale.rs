//! Whether a report on disk is what the program gives now, and in words of
//! the field what differs if not.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use anyhow::Context as _;

use crate::diff::{Results, compare};
use crate::output::{CASES, FINDINGS, Files, LAST};
use rocking_common::files::SUMS;
use rocking_common::table::cells;

/// What differs between the report in `out` and `files`; `None` if nothing
/// does. Findings come first, as [`crate::diff`] tells them, then tables by
/// their first row, then drawings and the page by name.
///
/// # Errors
/// Where the report cannot be read.
pub fn stale(out: &Path, files: &Files) -> anyhow::Result<Option<String>> {
    let there = names(out)?;
    let mut words = String::new();
    let mut drawn = Vec::new();
    let mut count = 0;
    for (name, new) in files {
        if !there.contains(name) {
            count += 1;
            let _ = writeln!(words, "{name}: missing");
            continue;
        }
        let old = read(&out.join(name))?;
        if old == *new {
            continue;
        }
        count += 1;
        if name.ends_with(".csv") {
            let rows = rows(&text(&old), &text(new));
            let _ = writeln!(words, "{name}: {rows}");
        } else if name != FINDINGS && name != SUMS {
            drawn.push(name.as_str());
        }
    }
    for name in there {
        if !files.contains_key(&name) && !CASES.contains(&name.as_str()) {
            count += 1;
            let _ = writeln!(words, "{name}: no file of this report");
        }
    }
    if count == 0 {
        return Ok(None);
    }
    if !drawn.is_empty() {
        let _ = writeln!(words, "drawn anew: {}", drawn.join(", "));
    }
    let findings = findings(out, files)?;
    Ok(Some(format!("{findings}{count} files differ\n{words}")))
}

/// What the findings say differently; empty where they agree.
fn findings(out: &Path, files: &Files) -> anyhow::Result<String> {
    let path = out.join(FINDINGS);
    let Some(new) = files.get(FINDINGS) else { return Ok(String::new()) };
    if !path.exists() {
        return Ok(String::new());
    }
    Ok(compared(&path, &text(&read(&path)?), &text(new)))
}

/// What two texts of one file of results say differently, as
/// [`crate::diff::compare`] finds it; empty where they agree. Results of
/// another form are replaced all the same, so that is no error.
fn compared(path: &Path, old: &str, new: &str) -> String {
    if old == new {
        return String::new();
    }
    let attempt = || {
        let old = Results::from_text(path, old)?;
        let new = Results::from_text(path, new)?;
        anyhow::Ok(compare(&old, &new)?.text(false) + "\n")
    };
    attempt().unwrap_or_else(|error| format!("not compared: {error:#}\n"))
}

/// How two tables differ: rows that do, and the first of them by its cells.
fn rows(old: &str, new: &str) -> String {
    let mut lines = (old.lines(), new.lines());
    let header = (lines.0.next(), lines.1.next());
    if header.0 != header.1 {
        return "other columns".into();
    }
    let names: Vec<&str> = header.0.unwrap_or("").split(',').collect();
    let (a, b): (Vec<&str>, Vec<&str>) =
        (lines.0.collect(), lines.1.collect());
    let mut out = if a.len() == b.len() {
        String::new()
    } else {
        format!("{} rows, now {}; ", a.len(), b.len())
    };
    let pairs = || a.iter().zip(&b).filter(|(a, b)| a != b);
    let _ = write!(out, "{} of {} rows differ", pairs().count(), a.len());
    let Some((old, new)) = pairs().next() else { return out };
    let (old, new) = (cells(old), cells(new));
    let mut place = Vec::new();
    let mut changes = Vec::new();
    for ((name, a), b) in names.iter().zip(&old).zip(&new) {
        if a != b {
            changes.push(format!("{name} {a} to {b}"));
        } else if changes.is_empty() && !a.is_empty() {
            place.push(format!("{name} {a}"));
        }
    }
    let _ = write!(
        out,
        ", the first at {}: {}",
        place.join(", "),
        changes.join(", ")
    );
    out
}

/// The files of a report in `out`: its page, its data, its drawings.
fn names(out: &Path) -> anyhow::Result<BTreeSet<String>> {
    let mut names = BTreeSet::new();
    for folder in ["", "data", "figures"] {
        let path = out.join(folder);
        if !folder.is_empty() && !path.exists() {
            continue;
        }
        let failed = || cannot_read(&path);
        for entry in fs::read_dir(&path).with_context(failed)? {
            let entry = entry.with_context(failed)?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if folder.is_empty() {
                if LAST.contains(&&*name) {
                    names.insert(name);
                }
            } else {
                names.insert(format!("{folder}/{name}"));
            }
        }
    }
    Ok(names)
}

fn read(path: &Path) -> anyhow::Result<Vec<u8>> {
    fs::read(path).with_context(|| cannot_read(path))
}

fn cannot_read(path: &Path) -> String {
    format!("cannot read {}", path.display())
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_differ_by_rows_and_the_first_is_shown() {
        let old = "p_rad_s,option,share\n1,\"a, b\",0.9\n3,c,0.8\n3,d,0.7\n";
        let new = "p_rad_s,option,share\n1,\"a, b\",0.9\n3,c,0.81\n3,d,0.6\n";
        assert_eq!(
            rows(old, new),
            "2 of 3 rows differ, the first at p_rad_s 3, option c: share 0.8 \
             to 0.81"
        );
        let quoted = old.replace("0.9", "0.91");
        assert_eq!(
            rows(old, &quoted),
            "1 of 3 rows differ, the first at p_rad_s 1, option a, b: share \
             0.9 to 0.91"
        );
        assert_eq!(rows(old, "p,share\n"), "other columns");
        let longer = format!("{old}4,e,0.1\n");
        assert_eq!(rows(old, &longer), "3 rows, now 4; 0 of 3 rows differ");
    }
}
