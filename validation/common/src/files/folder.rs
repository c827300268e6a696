//! A folder as an output.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use rocking_records::sha256_hex;

use super::sums::{SUMS, listed, sums};
use super::system::{self, Lock};
use super::unfinished::{
    LOCK, MOVING, WriteError, folder_of, is_unfinished, moving,
    remove_left_behind, said, state,
};

/// A writable folder as an output: all files are written, or none. Other files in
/// it stay.
///
/// The files are made in an unfinished folder within it, so that it may be the
/// root of a file system or a link. A mark is set before the first file is put
/// into place ([`is_interrupted`]), and removed when all files are in place. If
/// the run ends in between, the mark stays. The next run replaces the files. It
/// removes files of earlier runs that it does not write, if a manifest or a mark
/// lists them and nobody changed them.
#[derive(Debug)]
pub struct OutputFolder {
    path: PathBuf,
    /// The unfinished folder and its lock, while there is one.
    part: Option<(PathBuf, File)>,
    /// Whether the folder was made here and is empty.
    made: bool,
    /// Whether the folder must contain nothing else.
    new: bool,
    /// Whether files are being put into place.
    moving: bool,
}

impl Drop for OutputFolder {
    /// Removes the unfinished folder unless it is marked, and the folder if it was
    /// made here and is empty.
    fn drop(&mut self) {
        let part = self.part.take();
        if self.moving {
            // The mark stays. Without its lock file it says that its run has
            // ended, even if the file system has no locks.
            let lock = part.map(|(part, _)| part.join(LOCK));
            let _ = lock.map(|lock| system::remove_file(&lock));
            return;
        }
        if let Some((part, lock)) = part {
            // Windows removes no folder with an open file.
            drop(lock);
            // The next run removes what stays.
            let _ = system::remove_dir_all(&part);
        }
        if self.made {
            // It stays if it contains anything.
            let _ = system::remove_dir(&self.path);
        }
    }
}

impl OutputFolder {
    /// Opens the folder `path`, and makes it if it does not exist.
    ///
    /// # Errors
    /// [`WriteError`] naming the folder; also if another run is putting files into
    /// place there.
    pub fn open(path: &Path) -> Result<Self, WriteError> {
        Self::opened(path, false).map_err(WriteError::at(path))
    }

    /// Opens a folder that does not exist, or that contains at most unfinished files
    /// of an earlier run.
    ///
    /// # Errors
    /// As [`OutputFolder::open`], and for a folder that contains anything else.
    pub fn open_new(path: &Path) -> Result<Self, WriteError> {
        Self::opened(path, true).map_err(WriteError::at(path))
    }

    fn opened(path: &Path, new: bool) -> io::Result<Self> {
        let made = !path.try_exists()?;
        system::create_dir_all(path)?;
        let (part, moving) = (None, false);
        let path = path.to_owned();
        let mut folder = Self { path, part, made, new, moving };
        remove_left_behind(&folder.path);
        let earlier = Earlier::of(&folder.path, None)?;
        if new {
            earlier.remove_but(&folder.path, &BTreeMap::new())?;
            folder.refuse_used(None)?;
        }
        let part = system::folder_in(&folder.path)
            .map_err(|error| said(error, &folder.path))?;
        let lock = part.join(LOCK);
        // From here on it is removed if anything fails.
        let (_, lock) = folder.part.insert((part, system::create(&lock)?));
        system::lock(lock)?;
        // A lock file with content had an owner.
        system::add(lock, b"locked\n")?;
        Ok(folder)
    }

    /// Refuses a folder that contains anything but unfinished parts of ended runs
    /// and `own`.
    fn refuse_used(&self, own: Option<&Path>) -> io::Result<()> {
        for entry in fs::read_dir(&self.path)? {
            let entry = entry?;
            if !is_unfinished(&entry.file_name()) {
                return Err(io::ErrorKind::DirectoryNotEmpty.into());
            }
            let path = entry.path();
            if Some(&*path) != own && state(&path) == Some(Lock::Held) {
                return Err(busy(&path));
            }
        }
        Ok(())
    }

    /// Writes `files`, by their paths below the folder. The files named `last`
    /// show that all files are there: they are removed first and put into place
    /// last, in this order.
    ///
    /// # Errors
    /// [`WriteError`] naming the file. Nothing in the folder changes before all
    /// files are complete. If they cannot all be put into place, the folder is
    /// marked ([`is_interrupted`]).
    pub fn write(
        mut self,
        files: &BTreeMap<String, Vec<u8>>,
        last: &[&str],
    ) -> Result<(), WriteError> {
        for (name, content) in files {
            let path = self.unfinished(FILES).join(name);
            system::create_dir_all(folder_of(&path))
                .and_then(|()| system::write(&path, content))
                .map_err(WriteError::at(&self.path.join(name)))?;
        }
        self.put(files, last)
    }

    /// A place in the unfinished folder.
    fn unfinished(&self, name: &str) -> PathBuf {
        let part = self.part.as_ref().map(|(part, _)| part.as_path());
        part.unwrap_or(&self.path).join(name)
    }

    /// Puts all files into place.
    fn put(
        &mut self,
        files: &BTreeMap<String, Vec<u8>>,
        last: &[&str],
    ) -> Result<(), WriteError> {
        let earlier = self.mark(files).map_err(WriteError::at(&self.path))?;
        self.moving = true;
        let unfinished = |path: &Path| {
            let (path, folder) = (path.to_owned(), self.path.display());
            let again = format!(
                "{folder} is unfinished: the same command, run again, \
                 completes it"
            );
            move |error: io::Error| {
                let reason = format!("{error}; {again}");
                let source = io::Error::new(error.kind(), reason);
                WriteError { path, source }
            }
        };
        for name in last {
            let path = self.path.join(name);
            system::remove_file(&path).map_err(unfinished(&path))?;
        }
        earlier
            .remove_but(&self.path, files)
            .map_err(unfinished(&self.path))?;
        let is_last = |name: &&str| last.contains(name);
        let names = files.keys().map(String::as_str);
        let others = names.filter(|name| !is_last(name));
        let ends = last.iter().filter(|name| files.contains_key(**name));
        for name in others.chain(ends.copied()) {
            let path = self.path.join(name);
            system::create_dir_all(folder_of(&path))
                .and_then(|()| {
                    let from = self.unfinished(FILES).join(name);
                    system::rename(&from, &path)
                })
                .map_err(unfinished(&path))?;
        }
        // Marks of earlier runs go before its own.
        for part in &earlier.parts {
            system::remove_file(&part.join(MOVING))
                .and_then(|()| system::remove_dir_all(part))
                .map_err(unfinished(part))?;
        }
        let mark = self.unfinished(MOVING);
        system::remove_file(&mark).map_err(unfinished(&self.path))?;
        self.moving = false;
        Ok(())
    }

    /// Sets the mark, which lists all files that this run and earlier runs may have
    /// put into place. Returns the files that earlier runs left.
    fn mark(&self, files: &BTreeMap<String, Vec<u8>>) -> io::Result<Earlier> {
        let own = self.part.as_ref().map(|(part, _)| part.as_path());
        let mut earlier = Earlier::of(&self.path, own)?;
        // Without a manifest nothing is known.
        let manifest = fs::read_to_string(self.path.join(SUMS));
        earlier.text += &manifest.unwrap_or_default();
        let mut text = sums(files);
        text.extend(earlier.text.as_bytes());
        let (made, mark) =
            (self.unfinished("marking"), self.unfinished(MOVING));
        system::write(&made, &text)?;
        system::rename(&made, &mark)?;
        // Two runs that mark the folder at once see each other.
        let attempt = || {
            Earlier::of(&self.path, own)?;
            if self.new { self.refuse_used(own) } else { Ok(()) }
        };
        match attempt() {
            Ok(()) => Ok(earlier),
            Err(error) => {
                // If the mark stays, the folder is refused until a run ends.
                let _ = system::remove_file(&mark);
                Err(error)
            }
        }
    }
}

/// Name of the place of new files in an unfinished folder.
const FILES: &str = "files";

/// Files that earlier runs put into a folder.
struct Earlier {
    /// Sums of their files.
    text: String,
    /// Unfinished folders with marks, whose runs have ended.
    parts: Vec<PathBuf>,
}

impl Earlier {
    /// Lists of the marks in `folder`, without the mark in `own`, the unfinished
    /// folder of this run. Refuses a folder into which another run is putting
    /// files.
    fn of(folder: &Path, own: Option<&Path>) -> io::Result<Self> {
        let (mut text, mut parts) = (String::new(), Vec::new());
        for part in moving(folder).filter(|part| Some(&**part) != own) {
            match state(&part) {
                // Its run has just ended.
                None => continue,
                Some(Lock::Free) => {}
                Some(_) => return Err(busy(&part)),
            }
            text += &fs::read_to_string(part.join(MOVING))?;
            parts.push(part);
        }
        Ok(Self { text, parts })
    }

    /// Removes unchanged files of earlier runs, except for the names in `files`, and
    /// the folders that this empties.
    fn remove_but(
        &self,
        folder: &Path,
        files: &BTreeMap<String, Vec<u8>>,
    ) -> io::Result<()> {
        let mut emptied = BTreeSet::new();
        for (sum, name) in listed(&self.text) {
            if files.contains_key(name) {
                continue;
            }
            let path = folder.join(name);
            let own = fs::read(&path).is_ok_and(|c| sha256_hex(&c) == sum);
            if own {
                system::remove_file(&path)?;
            }
            let parents = Path::new(name).ancestors().skip(1);
            let inner = parents.filter(|inner| *inner != Path::new(""));
            emptied.extend(inner.map(|inner| folder.join(inner)));
        }
        // Inner folders first. A folder that contains anything stays.
        for path in emptied.iter().rev() {
            let _ = system::remove_dir(path);
        }
        Ok(())
    }
}

/// The error if another run is at work.
fn busy(part: &Path) -> io::Error {
    io::Error::new(
        io::ErrorKind::ResourceBusy,
        format!(
            "another run writes there: expected to be the only one; if none \
             is running, remove {}",
            part.join(LOCK).display()
        ),
    )
}

/// Whether a run ended, or is at work, while it was putting files into `folder`:
/// then they are not the files of one run.
pub fn is_interrupted(folder: &Path) -> bool {
    moving(folder).next().is_some()
}
