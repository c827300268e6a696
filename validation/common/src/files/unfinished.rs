//! Unfinished files and folders.

use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use thiserror::Error;

use super::system::{self, Lock, PART};

/// Locks an unfinished folder for its owner.
pub(super) const LOCK: &str = "lock";

/// Mark in an unfinished folder whose files are being put into place.
pub(super) const MOVING: &str = "moving";

/// Age from which an unfinished file or folder that was never locked counts as left
/// behind, not as about to be locked.
pub(super) const LEFT_BEHIND: Duration = Duration::from_secs(10);

/// A file that could not be written.
#[derive(Debug, Error)]
#[error("cannot write {}: {source}", path.display())]
pub struct WriteError {
    /// The requested file.
    pub path: PathBuf,
    /// The error of the system, or the reason of the refusal.
    #[source]
    pub source: io::Error,
}

impl WriteError {
    pub(super) fn at(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        |source| Self { path, source }
    }
}

/// The folder that contains `path`.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
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

/// Removes what ended runs left in `folder`, except for marked folders, whose files
/// are in place. A part that cannot be removed stays.
pub(super) fn remove_left_behind(folder: &Path) {
    for path in unfinished(folder) {
        if state(&path) != Some(Lock::Free) || path.join(MOVING).exists() {
            continue;
        }
        let _ = match path.is_dir() {
            true => system::remove_dir_all(&path),
            false => system::remove_file(&path),
        };
    }
}

/// Whether a run is at work on an unfinished file or folder: its lock is free if
/// not, and unknown if somebody may be about to lock it. `None` if it is gone.
pub(super) fn state(path: &Path) -> Option<Lock> {
    let found = fs::metadata(path).ok()?;
    let lock = if found.is_dir() { path.join(LOCK) } else { path.to_owned() };
    let had_lock =
        found.is_dir() && fs::metadata(&lock).is_ok_and(|lock| lock.len() > 0);
    let old = found
        .modified()
        .is_ok_and(|then| then.elapsed().is_ok_and(|age| age >= LEFT_BEHIND));
    Some(match system::tried(&lock) {
        Ok(Lock::Free) if !(had_lock || old) => Lock::Unknown,
        Ok(lock) => lock,
        // One that is marked had a lock before; the run of another may be
        // about to make it.
        Err(error)
            if error.kind() == io::ErrorKind::NotFound
                && (old || path.join(MOVING).exists()) =>
        {
            Lock::Free
        }
        Err(_) => Lock::Unknown,
    })
}

/// Unfinished folders in `folder` whose files are being put into place, or
/// were when their run ended.
pub(super) fn moving(folder: &Path) -> impl Iterator<Item = PathBuf> {
    let parts = unfinished(folder).into_iter();
    parts.filter(|part| part.join(MOVING).exists())
}

/// Unfinished files and folders in `folder`.
pub(super) fn unfinished(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .filter(|entry| is_unfinished(&entry.file_name()))
        .map(|entry| entry.path())
        .collect()
}

/// Whether this is the name of an unfinished file or folder.
pub(super) fn is_unfinished(name: &OsStr) -> bool {
    name.to_str()
        .is_some_and(|name| name.starts_with(PART.0) && name.ends_with(PART.1))
}
