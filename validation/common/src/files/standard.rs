//! Standard output, and whether anybody can receive what is written to it.

use std::io;

/// Standard output.
///
/// # Errors
/// If it is closed: output would be lost. For a closed stream the runtime opens
/// /dev/null for reading and writing before the program begins, which is how it is
/// recognized. A caller that silences standard error in the same way wants only
/// the exit status.
pub fn standard_output() -> io::Result<io::Stdout> {
    let (out, error) = (io::stdout(), io::stderr());
    match is_void(&out) && !is_void(&error) {
        false => Ok(out),
        true => Err(io::Error::other(
            "it is closed, or /dev/null opened for reading too: expected a \
             place for the result",
        )),
    }
}

/// Whether a stream is /dev/null, opened for reading and writing; a shell's
/// `> /dev/null` opens it only for writing.
#[cfg(unix)]
fn is_void(stream: &impl std::os::fd::AsFd) -> bool {
    use rustix::fs::{OFlags, fcntl_getfl, fstat, stat};
    let same = fstat(stream)
        .and_then(|own| Ok(own.st_rdev == stat("/dev/null")?.st_rdev));
    let both = fcntl_getfl(stream)
        .is_ok_and(|flags| flags & OFlags::ACCMODE == OFlags::RDWR);
    both && same == Ok(true)
}

/// Whether a stream is closed.
#[cfg(windows)]
fn is_void(stream: &impl std::os::windows::io::AsRawHandle) -> bool {
    stream.as_raw_handle().is_null()
}
