//! Writing files whole or not at all.

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use thiserror::Error;

/// A file that could not be written.
#[derive(Debug, Error)]
#[error("cannot write {}: {source}", path.display())]
pub struct WriteError {
    /// The file asked for.
    pub path: PathBuf,
    /// What the system said.
    #[source]
    pub source: io::Error,
}

/// Writes `content` to `path` by way of a temporary file in the same folder,
/// so that a reader sees the old file or the new one and never a part.
///
/// # Errors
/// [`WriteError`] naming the file asked for; the temporary file is removed.
pub fn write_atomically(
    path: &Path,
    content: impl AsRef<[u8]>,
) -> Result<(), WriteError> {
    let fail = |source| WriteError { path: path.to_owned(), source };
    let name = path
        .file_name()
        .ok_or_else(|| fail(io::Error::other("not a file name")))?;
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(hidden);
    let attempt = || {
        let mut file = fs::File::create(&part)?;
        file.write_all(content.as_ref())?;
        file.sync_all()?;
        fs::rename(&part, path)
    };
    attempt().map_err(|source| {
        // The error that matters is the first one.
        let _ = fs::remove_file(&part);
        fail(source)
    })
}

/// Writes `files` (paths below `folder`, and contents) into a new folder by
/// way of a hidden one beside it: all of them or nothing.
///
/// # Errors
/// [`WriteError`] for a folder that is there and not empty, and whatever the
/// system says; the hidden folder is removed.
pub fn write_new_folder(
    folder: &Path,
    files: impl IntoIterator<Item = (PathBuf, Vec<u8>)>,
) -> Result<(), WriteError> {
    let fail = |path: &Path, source| WriteError { path: path.into(), source };
    let name = folder.file_name();
    let name = name.ok_or_else(|| {
        fail(folder, io::Error::other("not the name of a folder"))
    })?;
    let empty = || -> io::Result<bool> {
        match fs::read_dir(folder) {
            Ok(mut entries) => Ok(entries.next().is_none()),
            Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(true),
            Err(error) => Err(error),
        }
    };
    if !empty().map_err(|error| fail(folder, error))? {
        let error = io::Error::from(io::ErrorKind::DirectoryNotEmpty);
        return Err(fail(folder, error));
    }
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{}.part", std::process::id()));
    let part = folder.with_file_name(hidden);
    let attempt = || {
        fs::create_dir_all(&part).map_err(|error| fail(&part, error))?;
        for (inner, content) in files {
            let path = part.join(inner);
            let write = || {
                fs::create_dir_all(path.parent().unwrap_or(&part))?;
                let mut file = fs::File::create(&path)?;
                file.write_all(&content)?;
                file.sync_all()
            };
            write().map_err(|error| fail(&path, error))?;
        }
        // Onto an empty folder, or where there is none.
        fs::rename(&part, folder).map_err(|error| fail(folder, error))
    };
    let outcome = attempt();
    if outcome.is_err() {
        // The error that matters is the first one.
        let _ = fs::remove_dir_all(&part);
    }
    outcome
}
