//! On how many threads a command works, and which signals stop it.

use std::fs;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};

use rocking::stop::{MOST_THREADS_A_PROCESSOR, Stop, StopError, most_threads};
#[cfg(unix)]
use signal_hook::consts::SIGHUP;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_default};

use crate::failure::{Failure, ensure};
use crate::terminal::note;

/// Signals that stop long work.
const STOPPING: &[i32] = &[
    #[cfg(unix)]
    SIGHUP,
    SIGINT,
    SIGTERM,
];

/// Effect of signals, from the first long work on.
static SIGNALS: LazyLock<Signals> = LazyLock::new(Signals::handled);

struct Signals {
    /// The stop that they request.
    stop: Stop,
    /// Whether no work is under way that heeds it.
    idle: Arc<AtomicBool>,
}

impl Signals {
    /// A signal stops the work; while no work heeds it, it ends the program
    /// at once, as it does by default. A second one does no more: `timeout`
    /// sends two. One that the program was started to ignore, by `nohup` or
    /// behind `&`, stays ignored.
    fn handled() -> Self {
        let stopped = Arc::new(AtomicBool::new(false));
        let idle = Arc::new(AtomicBool::new(true));
        for &signal in STOPPING.iter().filter(|s| !is_ignored(**s)) {
            // If no handler can be set, the signal keeps its default effect.
            let _ = register_conditional_default(signal, Arc::clone(&idle))
                .and_then(|_| register(signal, Arc::clone(&stopped)));
        }
        Self { stop: Stop::from(stopped), idle }
    }

    /// Does work that heeds the stop.
    fn heeded<T>(&self, work: impl FnOnce(&Stop) -> T) -> T {
        let before = self.idle.swap(false, Ordering::SeqCst);
        let done = work(&self.stop);
        self.idle.store(before, Ordering::SeqCst);
        done
    }
}

/// Whether the program was started to ignore a signal. If the system does not
/// say, SIGHUP counts as ignored, as `nohup` has it.
fn is_ignored(signal: i32) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    match mask {
        Some(mask) => mask >> (signal - 1) & 1 == 1,
        None => signal != SIGINT && signal != SIGTERM,
    }
}

/// Runs `work` on `threads` threads (default: all processors), until SIGINT,
/// SIGTERM or SIGHUP stops it, with a note if [`Stop::run`] starts fewer.
///
/// # Errors
/// [`Failure`] for zero threads, for threads that cannot be started, and for
/// work that was stopped (status 1).
pub fn with_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> Result<T, Failure> {
    let done = until(threads, work)?;
    done.ok_or_else(|| Failure::gate("stopped by a signal"))
}

/// As [`with_threads`]; `None` if the work was stopped.
///
/// # Errors
/// [`Failure`] for zero threads, or threads that cannot be started.
pub fn until<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> Result<Option<T>, Failure> {
    ensure!(threads != Some(0), "--threads 0: expected at least 1");
    let most = most_threads();
    if let Some(asked) = threads.filter(|asked| *asked > most) {
        let processors = most / MOST_THREADS_A_PROCESSOR;
        note(&format!(
            "--threads {asked}: {most} are used, \
             {MOST_THREADS_A_PROCESSOR} for each of {processors} processors"
        ));
    }
    match SIGNALS.heeded(|stop| stop.run(threads.unwrap_or(0), work)) {
        Ok(result) => Ok(Some(result)),
        Err(StopError::Stopped) => Ok(None),
        Err(error) => Err(Failure::input(error)),
    }
}
