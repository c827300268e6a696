//! Whether a report on disk is up to date, and the differences if not.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use anyhow::Context as _;

use crate::diff::{ResultFiles, compare};
use crate::output::{CASES, FINDINGS, Files, LAST};

/// The differences between the report in `out` and `files`; none if there are
/// none. Findings come first, as [`crate::diff`] describes them, then the
/// files by name. A report without its folder `figures` is compared without
/// it: the page shows the figures, and the manifest has their hashes.
///
/// # Errors
/// If the report cannot be read.
pub fn stale(out: &Path, files: &Files) -> anyhow::Result<Option<String>> {
    let mut there = names(out)?;
    let mut findings = String::new();
    let mut lines = Vec::new();
    let has_figures = out.join("figures").is_dir();
    for (name, new) in files {
        let path = out.join(name);
        if !has_figures && name.starts_with("figures/") {
            continue;
        }
        if !there.remove(name) {
            lines.push(format!("{name}: missing"));
            continue;
        }
        let old = fs::read(&path).with_context(|| unread(&path))?;
        if old == *new {
            continue;
        }
        lines.push(format!("{name}: differs"));
        if name == FINDINGS {
            // Findings of another form are replaced, too: not an error.
            findings = compared(&path, &old, new)
                .unwrap_or_else(|error| format!("not compared: {error:#}\n"));
        }
    }
    there.retain(|name| !CASES.contains(&name.as_str()));
    lines.extend(
        there.iter().map(|name| format!("{name}: not a file of this report")),
    );
    Ok((!lines.is_empty()).then(|| {
        format!(
            "{findings}{} files differ:\n{}\n",
            lines.len(),
            lines.join("\n")
        )
    }))
}

fn compared(path: &Path, old: &[u8], new: &[u8]) -> anyhow::Result<String> {
    let read = |text: &[u8]| {
        ResultFiles::from_text(path, &String::from_utf8_lossy(text))
    };
    Ok(compare(&read(old)?, &read(new)?)?.text(false) + "\n")
}

/// The files of a report in `out`: its page, its data, its drawings.
fn names(out: &Path) -> anyhow::Result<BTreeSet<String>> {
    let mut names = BTreeSet::new();
    for folder in ["", "data/", "figures/"] {
        let path = out.join(folder);
        if !folder.is_empty() && !path.exists() {
            continue;
        }
        for entry in fs::read_dir(&path).with_context(|| unread(&path))? {
            let name = entry.with_context(|| unread(&path))?.file_name();
            let name = format!("{folder}{}", name.to_string_lossy());
            if !folder.is_empty() || LAST.contains(&&*name) {
                names.insert(name);
            }
        }
    }
    Ok(names)
}

fn unread(path: &Path) -> String {
    format!("cannot read {}", path.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_differ_are_named() {
        let folder = tempfile::tempdir().expect("folder");
        let write = |name: &str, text: &str| {
            fs::write(folder.path().join(name), text).expect("write");
        };
        fs::create_dir(folder.path().join("data")).expect("folder");
        write("data/same.csv", "1\n");
        write("data/moved.csv", "1\n");
        write("data/gone.csv", "1\n");
        write("data/verification.json", "{}\n");
        write("notes.txt", "mine\n");
        write(FINDINGS, "{}");
        let new = |names: &[&str]| -> Files {
            let file = |name: &&str| ((*name).to_owned(), b"1\n".to_vec());
            names.iter().map(file).collect()
        };
        let mut files = new(&["data/same.csv", "data/gone.csv"]);
        files.insert(FINDINGS.into(), b"{}".to_vec());
        files.insert("data/moved.csv".into(), b"1\n".to_vec());
        assert_eq!(stale(folder.path(), &files).expect("read"), None);
        files.remove("data/gone.csv");
        files.insert("data/moved.csv".into(), b"2\n".to_vec());
        files.insert("data/new.csv".into(), Vec::new());
        files.insert(FINDINGS.into(), b"[]".to_vec());
        let words =
            stale(folder.path(), &files).expect("read").expect("words");
        assert!(words.starts_with("not compared: "), "{words}");
        let list = "4 files differ:\ndata/findings.json: differs\n\
                    data/moved.csv: differs\ndata/new.csv: missing\n\
                    data/gone.csv: not a file of this report\n";
        assert!(words.ends_with(list), "{words}");
    }
}
