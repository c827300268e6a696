//! Standard output, and whether anybody can have what is written to it.

use std::io;

/// Standard output.
///
/// # Errors
/// An error where it is closed: what is written would be lost. The runtime
/// opens /dev/null there, for reading and writing, before the program begins,
/// so that this is what a closed one looks like. A caller that silences
/// standard error in the same way wants the exit status alone.
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

/// Whether it is /dev/null, opened for reading and writing; a shell's
/// `> /dev/null` opens it for writing alone.
#[cfg(unix)]
fn is_void(stream: &impl std::os::fd::AsFd) -> bool {
    use rustix::fs::{OFlags, fcntl_getfl, fstat, stat};
    let same = fstat(stream)
        .and_then(|own| Ok(own.st_rdev == stat("/dev/null")?.st_rdev));
    let both = fcntl_getfl(stream)
        .is_ok_and(|flags| flags & OFlags::ACCMODE == OFlags::RDWR);
    both && same == Ok(true)
}

#[cfg(not(unix))]
fn is_void<T>(_: &T) -> bool {
    false
}
