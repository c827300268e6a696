//! Writing a study's folder: all of it, or nothing that is half a file.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::files::WriteError;

/// Files of a report by name; folders in a name are parted by `/`.
pub type Files = BTreeMap<String, Vec<u8>>;

/// Where a report's findings lie.
pub const FINDINGS: &str = "data/findings.json";

/// Puts what a person compares into `data/`, drawings into `figures/`; the
/// page stays on top.
#[must_use]
pub fn laid_out(files: Files) -> Files {
    let place = |name: String| match name.rsplit_once('.') {
        Some((_, "csv" | "json")) => format!("data/{name}"),
        Some((_, "svg")) => format!("figures/{name}"),
        _ => name,
    };
    files.into_iter().map(|(name, text)| (place(name), text)).collect()
}

/// Writes `files` into the folder `out`: first into a folder beside it, and
/// only when that is complete file by file into place, `index.html` last.
/// Other files in `out` stay.
///
/// # Errors
/// [`WriteError`] naming the file or folder; the folder beside is removed.
pub fn write(out: &Path, files: &Files) -> Result<(), WriteError> {
    let part = part_of(out);
    let attempt = || {
        for (name, content) in files {
            let path = part.join(name);
            create(path.parent().unwrap_or(&part))?;
            fs::write(&path, content)
                .map_err(|source| WriteError { path, source })?;
        }
        let last = "index.html";
        let order = files.keys().filter(|n| *n != last);
        for name in order.chain(files.keys().filter(|n| *n == last)) {
            let path = out.join(name);
            create(path.parent().unwrap_or(out))?;
            fs::rename(part.join(name), &path)
                .map_err(|source| WriteError { path, source })?;
        }
        Ok(())
    };
    let outcome = attempt();
    // The error that matters is the first one.
    let _ = fs::remove_dir_all(&part);
    outcome
}

/// Refuses a folder that could not be written to, before hours are spent.
///
/// # Errors
/// [`WriteError`] naming the folder.
pub fn check(out: &Path) -> Result<(), WriteError> {
    if out.exists() && !out.is_dir() {
        let source = io::Error::from(io::ErrorKind::NotADirectory);
        return Err(WriteError { path: out.to_owned(), source });
    }
    let part = part_of(out);
    let outcome = create(&part);
    let _ = fs::remove_dir_all(&part);
    outcome
}

fn create(folder: &Path) -> Result<(), WriteError> {
    fs::create_dir_all(folder)
        .map_err(|source| WriteError { path: folder.to_owned(), source })
}

/// A hidden folder beside `out`, on the same file system.
fn part_of(out: &Path) -> PathBuf {
    let mut name = std::ffi::OsString::from(".");
    name.push(out.file_name().unwrap_or("report".as_ref()));
    name.push(format!(".{}.part", std::process::id()));
    out.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn writes_all_files_and_leaves_nothing_else() {
        let root = std::env::temp_dir()
            .join(format!("rocking-output-{}", std::process::id()));
        let out = root.join("report");
        let mut files = Files::new();
        files.insert("index.html".into(), b"<p>".to_vec());
        files.insert("a.csv".into(), b"x\n".to_vec());
        let files_of = |files: &Files| laid_out(files.clone());
        let before = files_of(&files);
        write(&out, &before).expect("written");
        files.insert("a.csv".into(), b"y\n".to_vec());
        fs::write(out.join("data/mine.csv"), b"z\n").expect("another's");
        write(&out, &files_of(&files)).expect("replaced");
        let there = |name: &str| fs::read(out.join(name)).expect("read");
        assert_eq!(there("data/a.csv"), b"y\n");
        assert_eq!(there("data/mine.csv"), b"z\n");
        let here = fs::read_dir(&root).expect("folder").count();
        assert_eq!(here, 1, "only the report itself");
        assert_eq!(fs::read_dir(&out).expect("folder").count(), 2);
        let data = fs::read_dir(out.join("data")).expect("folder");
        assert_eq!(data.count(), 2);
        // A file in the way is refused, and stays.
        let blocked = root.join("blocked");
        fs::write(&blocked, b"mine").expect("write");
        assert!(check(&blocked).is_err());
        assert!(write(&blocked, &files).is_err());
        assert_eq!(fs::read(&blocked).expect("read"), b"mine");
        assert_eq!(fs::read_dir(&root).expect("folder").count(), 2);
        fs::remove_dir_all(&root).expect("clean");
    }
}
