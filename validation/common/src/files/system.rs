//! The calls of the file system that write outputs. Only this file makes them, so
//! that a test can make any of them fail.

use std::fs::{self, File, Permissions, TryLockError};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile, PersistError};

/// How the names of unfinished files and folders begin and end.
pub(super) const PART: (&str, &str) = (".rocking-", ".part");

/// Whether another process holds the lock of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lock {
    /// No process does.
    Free,
    /// Another process does.
    Held,
    /// The file system has no locks, or the file cannot be opened.
    Unknown,
}

pub(super) fn create_dir_all(path: &Path) -> io::Result<()> {
    begin("create_dir_all").and_then(|()| fs::create_dir_all(path))
}

/// A new file with these bytes, which have reached the disk.
pub(super) fn write(path: &Path, content: &[u8]) -> io::Result<()> {
    let file = create(path)?;
    add(&file, content)?;
    sync(&file)
}

/// Writes all bytes to an open file.
pub(super) fn add(mut file: &File, content: &[u8]) -> io::Result<()> {
    begin("write").and_then(|()| file.write_all(content))
}

pub(super) fn sync(file: &File) -> io::Result<()> {
    begin("sync").and_then(|()| file.sync_all())
}

pub(super) fn rename(from: &Path, to: &Path) -> io::Result<()> {
    begin("rename").and_then(|()| fs::rename(from, to))
}

/// Removes a file, if it exists.
pub(super) fn remove_file(path: &Path) -> io::Result<()> {
    match begin("remove_file").and_then(|()| fs::remove_file(path)) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        done => done,
    }
}

/// Removes an empty folder.
pub(super) fn remove_dir(path: &Path) -> io::Result<()> {
    begin("remove_dir").and_then(|()| fs::remove_dir(path))
}

pub(super) fn remove_dir_all(path: &Path) -> io::Result<()> {
    begin("remove_dir_all").and_then(|()| fs::remove_dir_all(path))
}

/// Names and rights of unfinished files and folders. The user's mask reduces the
/// rights.
#[cfg_attr(not(unix), expect(unused_variables))]
fn builder(mode: u32) -> Builder<'static, 'static> {
    let mut builder = Builder::new();
    builder.prefix(PART.0).suffix(PART.1);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(Permissions::from_mode(mode));
    }
    builder
}

/// A new folder below `folder`, which is not removed automatically.
pub(super) fn folder_in(folder: &Path) -> io::Result<PathBuf> {
    begin("mkdir")?;
    let made = builder(0o777).tempdir_in(folder)?.keep();
    // Keeps the spelling of `folder`, which the library makes absolute.
    Ok(folder.join(made.file_name().unwrap_or_default()))
}

/// A new file in `folder`, which is removed unless it is put into place.
pub(super) fn file_in(folder: &Path) -> io::Result<NamedTempFile> {
    begin("create")?;
    builder(0o666).tempfile_in(folder)
}

pub(super) fn persist(
    part: NamedTempFile,
    target: &Path,
) -> Result<File, PersistError> {
    match begin("rename") {
        Ok(()) => part.persist(target),
        Err(error) => Err(PersistError { error, file: part }),
    }
}

pub(super) fn set_permissions(file: &File, to: Permissions) -> io::Result<()> {
    begin("chmod").and_then(|()| file.set_permissions(to))
}

/// A new file for a lock.
pub(super) fn create(path: &Path) -> io::Result<File> {
    begin("create").and_then(|()| File::create(path))
}

/// Locks a file, so that other runs leave it alone. If the file system has no
/// locks, work goes on without one.
pub(super) fn lock(file: &File) -> io::Result<()> {
    match begin("lock").and_then(|()| file.lock()) {
        Err(error) if has_no_locks(&error) => Ok(()),
        done => done,
    }
}

/// State of the lock of a file; a free lock stays free.
pub(super) fn tried(path: &Path) -> io::Result<Lock> {
    let file = File::open(path)?;
    Ok(match begin("lock").map(|()| file.try_lock()) {
        Ok(Ok(())) => Lock::Free,
        Ok(Err(TryLockError::WouldBlock)) => Lock::Held,
        Ok(Err(TryLockError::Error(_))) | Err(_) => Lock::Unknown,
    })
}

/// Further errors of a lock on a file system without locks: Lustre without
/// `flock`, NFS without its daemon, some in user space.
#[cfg(unix)]
const NO_LOCKS: &[i32] = &[rustix::io::Errno::NOLCK.raw_os_error()];
/// The same on Windows: ERROR_INVALID_FUNCTION and ERROR_NOT_SUPPORTED.
#[cfg(not(unix))]
const NO_LOCKS: &[i32] = &[1, 50];

/// Whether an error of a lock means that the file system has no locks.
fn has_no_locks(error: &io::Error) -> bool {
    let code = error.raw_os_error();
    error.kind() == io::ErrorKind::Unsupported
        || code.is_some_and(|code| NO_LOCKS.contains(&code))
}

/// Comes before each call; a test makes it fail.
#[cfg(not(test))]
fn begin(_: &str) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
use faults::begin;

/// Errors of calls, for tests.
#[cfg(test)]
pub(super) mod faults {
    use std::cell::{Cell, RefCell};
    use std::io;

    /// Which calls fail, and how.
    #[derive(Clone, Copy, Debug)]
    pub struct CallFault {
        /// Name of the calls; `None` for all calls.
        pub call: Option<&'static str>,
        /// How many such calls are made before.
        pub after: usize,
        /// Whether those after it fail, too.
        pub ongoing: bool,
        /// Error code of the system.
        pub code: i32,
    }

    thread_local! {
        static FAULT: Cell<Option<CallFault>> = const { Cell::new(None) };
        static CALLS: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) };
    }

    /// Does `work` with a fault; also gives the calls that were made.
    pub fn with<T>(
        fault: Option<CallFault>,
        work: impl FnOnce() -> T,
    ) -> (T, Vec<String>) {
        FAULT.set(fault);
        CALLS.take();
        let done = work();
        FAULT.set(None);
        (done, CALLS.take())
    }

    pub(super) fn begin(call: &str) -> io::Result<()> {
        CALLS.with_borrow_mut(|calls| calls.push(call.to_owned()));
        let Some(fault) = FAULT.get() else { return Ok(()) };
        if fault.call.is_some_and(|named| named != call) {
            return Ok(());
        }
        if fault.after > 0 {
            FAULT.set(Some(CallFault { after: fault.after - 1, ..fault }));
            return Ok(());
        }
        if !fault.ongoing {
            FAULT.set(None);
        }
        Err(io::Error::from_raw_os_error(fault.code))
    }
}
