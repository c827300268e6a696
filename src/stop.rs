//! Long work that is stopped before its end.
//!
//! [`Stop::run`] does work on new threads. Long work in this crate calls
//! [`point`] every few milliseconds. Once a stop is requested, the next such
//! call ends the work of its thread by unwinding the stack, silently. A
//! parallel iterator of rayon whose items call it has a `panic_fuse`; without
//! one, each of its items would unwind. A program compiled to abort at a panic
//! can stop no work.

use std::cell::OnceCell;
#[cfg(feature = "threads")]
use std::num::NonZeroUsize;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use thiserror::Error;

/// Most useful threads per processor.
#[cfg(feature = "threads")]
pub const MOST_THREADS_A_PROCESSOR: usize = 8;

/// The most threads that [`Stop::run`] starts on this machine.
#[cfg(feature = "threads")]
pub fn most_threads() -> usize {
    let processors = std::thread::available_parallelism();
    MOST_THREADS_A_PROCESSOR * processors.map_or(1, NonZeroUsize::get)
}

/// A stop that any thread may request, once for all.
///
/// ```
/// use rocking::stop::{Stop, StopError, point};
/// let stop = Stop::default();
/// let work = || (0..1000_u32).inspect(|_| point()).sum::<u32>();
/// assert_eq!(stop.run(2, work)?, 499_500);
/// stop.request();
/// assert!(matches!(stop.run(2, work), Err(StopError::Stopped)));
/// # Ok::<(), StopError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicBool>);

/// Why work has no result.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StopError {
    /// A stop was requested before the work had ended.
    #[error("the work was stopped")]
    Stopped,
    /// The threads could not be started.
    #[error("{threads} threads cannot be started: {reason}")]
    Threads {
        /// How many.
        threads: usize,
        /// The reason that the system gave.
        reason: String,
    },
}

/// Payload of the unwinding.
struct StopSignal;

thread_local! {
    /// The stop that this thread heeds.
    static HEEDED: OnceCell<Stop> = const { OnceCell::new() };
}

impl Stop {
    /// Requests the stop.
    pub fn request(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// True if the stop was requested.
    pub fn is_requested(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Does `work` on `threads` new threads, which heed this stop. 0 means one
    /// per processor; at most [`most_threads`] are started.
    ///
    /// Results have the same bits for any number of threads, and whether or
    /// not there is a stop to heed.
    ///
    /// # Errors
    /// [`StopError`] if the work was stopped or the threads could not be
    /// started.
    #[cfg(feature = "threads")]
    pub fn run<T: Send>(
        &self,
        threads: usize,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, StopError> {
        use std::panic::{AssertUnwindSafe, catch_unwind};

        let threads = match threads {
            0 => most_threads() / MOST_THREADS_A_PROCESSOR,
            some => some.min(most_threads()),
        };
        let own = self.clone();
        let heed = move |_| {
            // A new thread heeds nothing yet.
            let _ = HEEDED.with(|heeded| heeded.set(own.clone()));
        };
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .start_handler(heed)
            .build()
            .map_err(|error| StopError::Threads {
                threads,
                reason: error.to_string(),
            })?;
        // Unfinished work is dropped with the stack.
        let done = catch_unwind(AssertUnwindSafe(|| pool.install(work)));
        done.map_err(|cause| match cause.is::<StopSignal>() {
            true => StopError::Stopped,
            false => resume_unwind(cause),
        })
    }
}

/// The flag that a signal handler sets.
impl From<Arc<AtomicBool>> for Stop {
    fn from(flag: Arc<AtomicBool>) -> Self {
        Self(flag)
    }
}

/// Ends the work of this thread here if it heeds a stop that was requested.
///
/// For the long loops of work in [`Stop::run`]: a call takes some nanoseconds.
#[inline]
pub fn point() {
    if HEEDED.with(|heeded| heeded.get().is_some_and(Stop::is_requested)) {
        unwind();
    }
}

#[cold]
fn unwind() -> ! {
    resume_unwind(Box::new(StopSignal))
}
