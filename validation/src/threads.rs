//! On how many threads a command works.

use std::num::NonZeroUsize;

use rocking::stop::{Stop, StopError};

use crate::failure::Failure;
use crate::terminal::note;

/// Threads beyond which more only cost.
const MOST_THREADS_A_PROCESSOR: usize = 8;

/// Runs `work` on `threads` threads (default: all processors). Caps the count
/// at eight per processor, with a note.
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
    let processors =
        std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let most = MOST_THREADS_A_PROCESSOR * processors;
    if let Some(asked) = threads.filter(|asked| *asked > most) {
        note(&format!(
            "--threads {asked}: {most} are used, \
             {MOST_THREADS_A_PROCESSOR} for each of {processors} processors"
        ));
    }
    let count = threads.unwrap_or(processors).min(most);
    match stop.run(count, work) {
        Ok(result) => Ok(Some(result)),
        Err(StopError::Stopped) => Ok(None),
        Err(error) => Err(Failure::input(format!("{count} {error}"))),
    }
}
