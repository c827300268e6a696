//! Files and folders as outputs. They are opened before the work, so that a bad
//! place is reported at once, and written whole or not at all.

use std::fs::{self, File};
use std::io::{self, Seek as _, Write as _};
use std::mem::replace;
use std::path::{Path, PathBuf};

use tempfile::{NamedTempFile, SpooledTempFile};

pub use folder::{OutputFolder, is_interrupted};
pub use standard::standard_output;
pub use sums::{FolderError, SUMS, is_whole, sums};
pub use unfinished::WriteError;
use unfinished::{folder_of, remove_left_behind, said};

mod folder;
mod standard;
mod sums;
mod system;
mod unfinished;

/// Bytes of an unfinished output that are held in memory, at most.
const HELD_BYTES: usize = 64 << 20;

/// A writable place, opened. Pieces that are written get there only when the
/// output is finished.
///
/// A regular file is replaced at once and keeps its mode; through a link the
/// linked file is. A device or a named pipe is written to. `-` is standard
/// output. A file that is mounted by itself is overwritten in place.
#[derive(Debug)]
pub struct Output {
    path: PathBuf,
    sink: OutputSink,
}

#[derive(Debug)]
enum OutputSink {
    /// A device or a named pipe (standard output if `None`), and what is held
    /// for it.
    Stream(Option<PathBuf>, SpooledTempFile),
    /// Place of the file, and its unfinished part.
    File(PathBuf, NamedTempFile),
}

/// The outputs of one command. No output is a file that the command reads, and no
/// two of them go to one place.
///
/// ```
/// use std::path::Path;
/// use rocking_common::files::Outputs;
/// let mut outputs = Outputs::default();
/// let output = outputs.open(Path::new("-"))?;
/// assert!(outputs.take_standard_output());
/// let twice = outputs.open(Path::new("-")).unwrap_err().to_string();
/// assert!(twice.contains("another output goes there"));
/// # Ok::<(), rocking_common::files::WriteError>(())
/// ```
#[derive(Debug, Default)]
pub struct Outputs {
    inputs: Vec<PathBuf>,
    /// Files of the outputs opened so far. A device or a pipe keeps nothing that
    /// could be lost.
    files: Vec<PathBuf>,
    /// Whether an output goes to standard output.
    standard: bool,
}

impl Outputs {
    /// Outputs of a command that reads the files `inputs`.
    pub fn of(inputs: Vec<PathBuf>) -> Self {
        Self { inputs, ..Self::default() }
    }

    /// Opens `path`.
    ///
    /// # Errors
    /// [`WriteError`] for a folder, a place that is not writable, an input file, and
    /// the place of another output.
    pub fn open(&mut self, path: &Path) -> Result<Output, WriteError> {
        let sink = self.sink(path).map_err(WriteError::at(path))?;
        Ok(Output { path: path.to_owned(), sink })
    }

    /// Opens `path`, if there is one.
    ///
    /// # Errors
    /// As [`Outputs::open`].
    pub fn open_some(
        &mut self,
        path: Option<&PathBuf>,
    ) -> Result<Option<Output>, WriteError> {
        path.map(|path| self.open(path)).transpose()
    }

    /// Whether an output goes to standard output, so that nothing else may be
    /// printed there.
    pub fn take_standard_output(&self) -> bool {
        self.standard
    }

    fn sink(&mut self, path: &Path) -> io::Result<OutputSink> {
        let sink = OutputSink::open(path, &self.inputs)?;
        let is_taken = match &sink {
            OutputSink::Stream(None, _) => replace(&mut self.standard, true),
            OutputSink::Stream(..) => false,
            OutputSink::File(target, _) => {
                let folder = fs::canonicalize(folder_of(target))?;
                let file = folder.join(target.file_name().unwrap_or_default());
                let is_it = |a: &PathBuf| *a == file || is_same_file(a, &file);
                let is_taken = self.files.iter().any(is_it);
                self.files.push(file);
                is_taken
            }
        };
        if is_taken {
            return Err(io::Error::other(
                "another output goes there: expected a file of its own",
            ));
        }
        Ok(sink)
    }
}

impl Output {
    /// Writes all of it.
    ///
    /// # Errors
    /// [`WriteError`]; a regular file is as it was before then.
    pub fn write(
        mut self,
        content: impl AsRef<[u8]>,
    ) -> Result<(), WriteError> {
        self.add(content)?;
        self.finish()
    }

    /// Writes the next piece.
    ///
    /// # Errors
    /// [`WriteError`]; a regular file is as it was before then.
    pub fn add(&mut self, piece: impl AsRef<[u8]>) -> Result<(), WriteError> {
        let piece = piece.as_ref();
        match &mut self.sink {
            OutputSink::Stream(_, held) => held.write_all(piece),
            OutputSink::File(_, part) => system::add(part.as_file(), piece),
        }
        .map_err(WriteError::at(&self.path))
    }

    /// Puts what was written in its place.
    ///
    /// # Errors
    /// [`WriteError`]; a regular file is as it was before then.
    pub fn finish(self) -> Result<(), WriteError> {
        self.sink.finish().map_err(WriteError::at(&self.path))
    }
}

impl OutputSink {
    fn open(path: &Path, inputs: &[PathBuf]) -> io::Result<Self> {
        let held = SpooledTempFile::new(HELD_BYTES);
        if path == Path::new("-") {
            standard_output()?;
            return Ok(Self::Stream(None, held));
        }
        let target = match fs::metadata(path) {
            Ok(found) if found.is_dir() => {
                return Err(io::ErrorKind::IsADirectory.into());
            }
            Ok(found) if !found.is_file() => {
                return Ok(Self::Stream(Some(path.to_owned()), held));
            }
            Ok(_) => {
                refuse_input(path, inputs)?;
                // Refused before the work, not after it.
                File::options().append(true).open(path)?;
                fs::canonicalize(path)?
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                // A link to a file that is not there yet makes that file.
                let linked = |to| folder_of(path).join(to);
                fs::read_link(path).map_or(path.to_owned(), linked)
            }
            Err(error) => return Err(error),
        };
        let folder = folder_of(&target);
        remove_left_behind(folder);
        let part =
            system::file_in(folder).map_err(|error| said(error, folder))?;
        // Other runs ignore a locked file.
        system::lock(part.as_file())?;
        if let Ok(found) = fs::metadata(&target) {
            system::set_permissions(part.as_file(), found.permissions())?;
        }
        Ok(Self::File(target, part))
    }

    fn finish(self) -> io::Result<()> {
        match self {
            Self::Stream(None, mut part) => {
                part.rewind()?;
                let mut out = io::stdout();
                let done = io::copy(&mut part, &mut out);
                match done.and_then(|_| out.flush()) {
                    Err(e) if e.kind() == io::ErrorKind::BrokenPipe => Ok(()),
                    done => done,
                }
            }
            Self::Stream(Some(path), mut part) => {
                part.rewind()?;
                let mut device = File::options().write(true).open(path)?;
                io::copy(&mut part, &mut device).map(drop)
            }
            Self::File(target, part) => {
                system::sync(part.as_file())?;
                let (error, mut part) = match system::persist(part, &target) {
                    Ok(_) => return Ok(()),
                    Err(unfinished) => (unfinished.error, unfinished.file),
                };
                if error.kind() != io::ErrorKind::ResourceBusy {
                    return Err(beside(part, &target, error));
                }
                // The file is mounted by itself.
                let mut options = File::options();
                let mut file =
                    options.write(true).truncate(true).open(&target)?;
                part.rewind()?;
                io::copy(&mut part, &mut file)?;
                system::sync(&file)
            }
        }
    }
}

/// Keeps a file that cannot replace another, as on Windows if a program has that
/// one open: under its name and `.new`, which the error names.
fn beside(part: NamedTempFile, target: &Path, error: io::Error) -> io::Error {
    let mut name = target.file_name().unwrap_or_default().to_owned();
    name.push(".new");
    let place = target.with_file_name(&name);
    if place.exists() || system::persist(part, &place).is_err() {
        return error;
    }
    let kept = format!("{error}; beside it is the new {}", name.display());
    io::Error::new(error.kind(), kept)
}

/// Refuses to overwrite an input.
fn refuse_input(path: &Path, inputs: &[PathBuf]) -> io::Result<()> {
    let path = fs::canonicalize(path)?;
    let is_read = |input: &&PathBuf| {
        fs::canonicalize(input).is_ok_and(|input| path == input)
            || is_same_file(&path, input)
    };
    match inputs.iter().find(is_read) {
        None => Ok(()),
        Some(input) => Err(io::Error::other(format!(
            "{} is read: expected another file",
            input.display()
        ))),
    }
}

/// Whether two names are links to one file.
#[cfg(unix)]
fn is_same_file(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let id = |path| fs::metadata(path).map(|m| (m.dev(), m.ino()));
    matches!((id(a), id(b)), (Ok(a), Ok(b)) if a == b)
}

/// Elsewhere a file is replaced, and its other names keep the old one.
#[cfg(not(unix))]
fn is_same_file(_: &Path, _: &Path) -> bool {
    false
}

/// Writes one file whole or not at all, without reading it.
///
/// # Errors
/// As [`Outputs::open`] and [`Output::write`].
pub fn write_atomically(
    path: &Path,
    content: impl AsRef<[u8]>,
) -> Result<(), WriteError> {
    Outputs::default().open(path)?.write(content)
}

#[cfg(test)]
mod tests;
