//! Output of a command: its result on standard output, notes and progress on
//! standard error.

use std::io::{self, IsTerminal as _, Write as _};
use std::sync::mpsc;
use std::time::Duration;

use crate::failure::Failure;
use rocking_common::files::{Outputs, standard_output};
use rocking_common::words::printable;

/// Name, version and commit of the program, for results that are not
/// committed.
pub const SOFTWARE: &str = concat!(
    "rocking ",
    env!("CARGO_PKG_VERSION"),
    " (commit ",
    env!("ROCKING_COMMIT"),
    ")"
);

/// The commit of the sources; `unknown` outside a repository.
pub const COMMIT: &str = env!("ROCKING_COMMIT");

/// Prints `text`, the result of a command, on standard output; a closed pipe
/// ends the program quietly.
///
/// # Errors
/// [`Failure`] when standard output cannot be written for another reason, and
/// if it is closed.
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

/// Prints a summary beside files: on standard error if an output takes
/// standard output.
///
/// # Errors
/// As [`say`].
pub fn print_beside(outputs: &Outputs, text: &str) -> Result<(), Failure> {
    if outputs.take_standard_output() {
        eprint!("{}", printable(text));
        return Ok(());
    }
    say(text)
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

/// Prints `text`, one line or several, on standard error.
pub fn note(text: &str) {
    eprintln!("rocking: {}", printable(text));
}

/// A progress bar of `length` steps, shown on a terminal only.
pub fn progress(length: u64) -> indicatif::ProgressBar {
    if io::stderr().is_terminal() {
        indicatif::ProgressBar::new(length)
    } else {
        indicatif::ProgressBar::hidden()
    }
}

/// Interval of progress in a log.
const LOG_INTERVAL: Duration = Duration::from_secs(30);

/// Does `work`. Without a terminal for `bar`, notes its progress on standard
/// error after five seconds and then every half minute.
pub fn logged<T>(bar: &indicatif::ProgressBar, work: impl FnOnce() -> T) -> T {
    if io::stderr().is_terminal() {
        return work();
    }
    let say = || {
        let (message, length) = (bar.message(), bar.length().unwrap_or(0));
        let stage = if message.is_empty() { message } else { message + ": " };
        note(&format!("{stage}{} of {length} curves", bar.position()));
    };
    saying([Duration::from_secs(5), LOG_INTERVAL], &say, work)
}

/// Time after which one long analysis says how far it is.
const PATIENCE: Duration = Duration::from_secs(2);

/// Interval at which it says so on a terminal.
const TERMINAL_INTERVAL: Duration = Duration::from_millis(200);

/// Does `work`. After two seconds its progress appears on standard error: on a
/// terminal in one changing line, elsewhere every half minute.
pub fn patiently<T>(
    words: &(dyn Fn() -> String + Sync),
    work: impl FnOnce() -> T,
) -> T {
    if !io::stderr().is_terminal() {
        let say = || note(&words());
        return saying([PATIENCE, LOG_INTERVAL], &say, work);
    }
    let line = indicatif::ProgressBar::new_spinner();
    let say = || line.set_message(words());
    let result = saying([PATIENCE, TERMINAL_INTERVAL], &say, work);
    line.finish_and_clear();
    result
}

/// Does `work`, and calls `say` after a first time and then at intervals until
/// it is done. Without a thread to spare, nothing is said.
fn saying<T>(
    [first, interval]: [Duration; 2],
    say: &(dyn Fn() + Sync),
    work: impl FnOnce() -> T,
) -> T {
    std::thread::scope(|scope| {
        let (done, waits) = mpsc::channel::<()>();
        let says =
            std::thread::Builder::new().spawn_scoped(scope, move || {
                let mut wait = first;
                while let Err(mpsc::RecvTimeoutError::Timeout) =
                    waits.recv_timeout(wait)
                {
                    say();
                    wait = interval;
                }
            });
        let result = work();
        drop((done, says));
        result
    })
}

#[cfg(test)]
mod tests {
    use super::{Duration, mpsc, saying};

    #[test]
    fn long_work_says_so_until_it_is_done() {
        let (says, hears) = mpsc::channel();
        let say = || says.send(()).unwrap();
        let short = Duration::from_millis(1);
        let result = saying([short, short], &say, || {
            // It goes on until it has been spoken of twice.
            hears.recv().unwrap();
            hears.recv().unwrap();
            7
        });
        assert_eq!(result, 7);
        let long = Duration::from_secs(3600);
        saying([long, long], &|| panic!("nothing was long"), || ());
    }
}
