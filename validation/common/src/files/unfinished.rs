//! Unfinished files and folders, and why there are none.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use tempfile::Builder;
use thiserror::Error;

/// How the names of unfinished files and folders begin and end.
pub(super) const PART: (&str, &str) = (".rocking-", ".part");

/// Locks an unfinished folder for its owner.
pub(super) const LOCK: &str = "lock";

/// Age from which something unfinished and not locked is somebody's left
/// behind, not just about to be locked.
pub(super) const LEFT_BEHIND: Duration = Duration::from_secs(10);

/// A file that could not be written.
#[derive(Debug, Error)]
#[error("cannot write {}: {source}", path.display())]
pub struct WriteError {
    /// The file asked for.
    pub path: PathBuf,
    /// What the system said, or why it was refused.
    #[source]
    pub source: io::Error,
}

impl WriteError {
    pub(super) fn at(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        |source| Self { path, source }
    }
}

/// The folder that holds `path`.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// Names and rights of what is unfinished.
pub(super) fn builder() -> Builder<'static, 'static> {
    let mut builder = Builder::new();
    builder.prefix(PART.0).suffix(PART.1);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // The user's mask takes its part of them.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder
}

/// An error of the library without the unfinished name.
pub(super) fn said(error: io::Error, folder: &Path) -> io::Error {
    if error.kind() == io::ErrorKind::NotFound {
        let reason = format!("there is no folder {}", folder.display());
        return io::Error::new(error.kind(), reason);
    }
    match error.raw_os_error() {
        Some(code) => io::Error::from_raw_os_error(code),
        None => error.kind().into(),
    }
}

/// Removes what killed runs left in `folder`; what cannot be removed stays.
pub(super) fn remove_left_behind(folder: &Path) {
    for path in unfinished(folder) {
        let is_folder = path.is_dir();
        let lock = if is_folder { path.join(LOCK) } else { path.clone() };
        let old =
            fs::metadata(&path).and_then(|found| found.modified()).is_ok_and(
                |then| then.elapsed().is_ok_and(|age| age >= LEFT_BEHIND),
            );
        let free = match File::open(&lock).map(|lock| lock.try_lock()) {
            Ok(Ok(())) => true,
            Ok(Err(TryLockError::WouldBlock | TryLockError::Error(_))) => {
                false
            }
            Err(_) => is_folder,
        };
        if old && free {
            let _ = match is_folder {
                true => fs::remove_dir_all(&path),
                false => fs::remove_file(&path),
            };
        }
    }
}

/// Unfinished files and folders in `folder`.
pub(super) fn unfinished(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let ours = |name: &std::ffi::OsStr| {
        name.to_str().is_some_and(|name| {
            name.starts_with(PART.0) && name.ends_with(PART.1)
        })
    };
    entries
        .filter(|entry| ours(&entry.file_name()))
        .map(|entry| entry.path())
        .collect()
}
