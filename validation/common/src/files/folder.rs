//! A folder as an output.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::unfinished::{
    LOCK, WriteError, builder, folder_of, remove_left_behind, said, unfinished,
};

/// Mark in an unfinished folder whose files are being put into place.
const MOVING: &str = "moving";

/// A folder to write files into, opened and found writable: all files or
/// none; other files in it stay.
///
/// The files are made in an unfinished folder within it, so that it may be
/// the root of a file system or a link. A run that is killed while they are
/// put into place leaves a folder without the last of them
/// ([`is_interrupted`]).
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// The unfinished folder and its lock, as long as there is one.
    pub(super) part: Option<(TempDir, File)>,
    /// Whether the folder was made here and holds nothing yet.
    made: bool,
}

impl Drop for Folder {
    /// Leaves nothing unfinished, and no folder that was made for nothing.
    fn drop(&mut self) {
        drop(self.part.take());
        if self.made {
            // It stays where it holds anything.
            let _ = fs::remove_dir(&self.path);
        }
    }
}

impl Folder {
    /// Opens the folder `path`, and makes it where there is none.
    ///
    /// # Errors
    /// [`WriteError`] naming the folder.
    pub fn open(path: &Path) -> Result<Self, WriteError> {
        let attempt = || {
            let made = !path.try_exists()?;
            fs::create_dir_all(path)?;
            remove_left_behind(path);
            let mut builder = builder();
            #[cfg(unix)]
            {
                use std::os::unix::fs::PermissionsExt as _;
                builder.permissions(fs::Permissions::from_mode(0o777));
            }
            let part = builder.tempdir_in(path).map_err(|e| said(e, path))?;
            let lock = File::create(part.path().join(LOCK))?;
            lock.lock()?;
            let path = path.to_owned();
            Ok(Self { path, part: Some((part, lock)), made })
        };
        attempt().map_err(WriteError::at(path))
    }

    /// As [`Folder::open`], for a folder that is not there or is empty.
    ///
    /// # Errors
    /// As [`Folder::open`], and for a folder that holds anything.
    pub fn open_new(path: &Path) -> Result<Self, WriteError> {
        remove_left_behind(path);
        let holds = fs::read_dir(path).is_ok_and(|e| e.count() > 0);
        if holds {
            let source = io::ErrorKind::DirectoryNotEmpty.into();
            return Err(WriteError { path: path.to_owned(), source });
        }
        Self::open(path)
    }

    /// Writes `files`, by their paths below the folder; the one named `last`
    /// tells that all are there, and comes last.
    ///
    /// # Errors
    /// [`WriteError`] naming the file. Before all files are complete, nothing
    /// in the folder changes.
    pub fn write(
        self,
        files: &BTreeMap<String, Vec<u8>>,
        last: &str,
    ) -> Result<(), WriteError> {
        self.fill(files)?;
        self.put(files, last)
    }

    /// A place in the unfinished folder.
    fn unfinished(&self, name: &str) -> PathBuf {
        let part = self.part.as_ref().map(|(part, _)| part.path());
        part.unwrap_or(&self.path).join(name)
    }

    /// Makes all files in the unfinished folder.
    pub(super) fn fill(
        &self,
        files: &BTreeMap<String, Vec<u8>>,
    ) -> Result<(), WriteError> {
        for (name, content) in files {
            let path = self.unfinished(name);
            let write = || {
                fs::create_dir_all(folder_of(&path))?;
                let mut file = File::create(&path)?;
                file.write_all(content)?;
                file.sync_all()
            };
            write().map_err(WriteError::at(&self.path.join(name)))?;
        }
        Ok(())
    }

    /// Puts all files into place.
    pub(super) fn put(
        &self,
        files: &BTreeMap<String, Vec<u8>>,
        last: &str,
    ) -> Result<(), WriteError> {
        let mark = || File::create(self.unfinished(MOVING))?.sync_all();
        mark().map_err(WriteError::at(&self.path))?;
        let end = self.path.join(last);
        match fs::remove_file(&end) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                return Err(WriteError::at(&end)(error));
            }
            _ => {}
        }
        let others = files.keys().filter(|name| *name != last);
        for name in others.chain(files.keys().filter(|name| *name == last)) {
            let path = self.path.join(name);
            let rename = || {
                fs::create_dir_all(folder_of(&path))?;
                fs::rename(self.unfinished(name), &path)
            };
            rename().map_err(WriteError::at(&path))?;
        }
        Ok(())
    }
}

/// Whether a run was killed while it put files into place in `folder`, so
/// that they are not of one run.
#[must_use]
pub fn is_interrupted(folder: &Path) -> bool {
    let moving = |path: &PathBuf| path.join(MOVING).exists();
    unfinished(folder).iter().any(moving)
}
