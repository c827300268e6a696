//! On how many threads a command works.

use rocking::stop::{MOST_THREADS_A_PROCESSOR, Stop, StopError, most_threads};

use crate::failure::Failure;
use crate::terminal::note;

/// Runs `work` on `threads` threads (default: all processors), with a note
/// where [`Stop::run`] starts fewer.
///
/// # Errors
/// [`Failure`] for zero threads, or threads that cannot be started.
pub fn with_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> Result<T, Failure> {
    let done = until(&Stop::default(), threads, work)?;
    done.ok_or_else(|| Failure::gate("the work was stopped"))
}

/// [`with_threads`], unless a stop ends the work before.
///
/// # Errors
/// As [`with_threads`].
pub fn until<T: Send>(
    stop: &Stop,
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> Result<Option<T>, Failure> {
    if threads == Some(0) {
        return Err(Failure::input("--threads 0: expected at least 1"));
    }
    let most = most_threads();
    if let Some(asked) = threads.filter(|asked| *asked > most) {
        let processors = most / MOST_THREADS_A_PROCESSOR;
        note(&format!(
            "--threads {asked}: {most} are used, \
             {MOST_THREADS_A_PROCESSOR} for each of {processors} processors"
        ));
    }
    match stop.run(threads.unwrap_or(0), work) {
        Ok(result) => Ok(Some(result)),
        Err(StopError::Stopped) => Ok(None),
        Err(error) => Err(Failure::input(error)),
    }
}
