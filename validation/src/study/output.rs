//! Writing a study's folder: all of it, or nothing that is half a file.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::files::WriteError;

/// Files of a report by name.
pub type Files = BTreeMap<String, Vec<u8>>;

/// Writes `files` into the folder `out`: first into a folder beside it, and
/// only when that is complete file by file into place, `index.html` last.
/// Other files in `out` stay.
///
/// # Errors
/// [`WriteError`] naming the file or folder; the folder beside is removed.
pub fn write(out: &Path, files: &Files) -> Result<(), WriteError> {
    let part = part_of(out);
    let attempt = || {
        create(&part)?;
        for (name, content) in files {
            let path = part.join(name);
            fs::write(&path, content)
                .map_err(|source| WriteError { path, source })?;
        }
        create(out)?;
        let last = "index.html";
        let order = files.keys().filter(|n| *n != last);
        for name in order.chain(files.keys().filter(|n| *n == last)) {
            let path = out.join(name);
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
        write(&out, &files).expect("written");
        files.insert("a.csv".into(), b"y\n".to_vec());
        write(&out, &files).expect("replaced");
        assert_eq!(fs::read(out.join("a.csv")).expect("read"), b"y\n");
        let here = fs::read_dir(&root).expect("folder").count();
        assert_eq!(here, 1, "only the report itself");
        assert_eq!(fs::read_dir(&out).expect("folder").count(), 2);
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
