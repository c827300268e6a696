//! What a command writes: its result on standard output, notes on standard
//! error.

use std::io::{self, Write as _};

use super::Failure;
use rocking_common::files::standard_output;
use rocking_common::words::printable;

/// Name and version of the program, for results.
pub const SOFTWARE: &str = concat!("rocking ", env!("CARGO_PKG_VERSION"));

/// Prints `text`, the result of a command, on standard output; a closed pipe
/// ends the program quietly.
///
/// # Errors
/// [`Failure`] when standard output cannot be written for another reason, and
/// where it is closed.
pub fn print(text: &str) -> Result<(), Failure> {
    write(standard_output(), text)
}

/// Prints what a command says beside its files or its exit status: with a
/// closed standard output nothing of the result is lost.
///
/// # Errors
/// [`Failure`] when standard output cannot be written.
pub fn say(text: &str) -> Result<(), Failure> {
    write(Ok(io::stdout()), text)
}

fn write(out: io::Result<io::Stdout>, text: &str) -> Result<(), Failure> {
    let attempt = |mut out: io::Stdout| {
        out.write_all(printable(text).as_bytes())?;
        out.flush()
    };
    match out.and_then(attempt) {
        Err(e) if e.kind() == io::ErrorKind::BrokenPipe => {
            std::process::exit(0)
        }
        done => {
            done.map_err(|e| Failure::input(format!("standard output: {e}")))
        }
    }
}

/// Tells `text`, one line or several, on standard error.
pub fn note(text: &str) {
    eprintln!("rocking: {}", printable(text));
}
