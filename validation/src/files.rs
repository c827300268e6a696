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
