//! Long work: on its own threads, without the interpreter, with progress and
//! an end by Ctrl-C.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::ThreadPoolBuilder;

use crate::given::refuse;

/// How often signals are looked at and progress is told.
const BEAT: Duration = Duration::from_millis(50);

/// How far the work is, and whether it is to end.
#[derive(Default)]
pub struct Watch {
    done: AtomicUsize,
    stopped: AtomicBool,
}

impl Watch {
    /// One more is done; `Break` where the work is to end.
    pub fn tick(&self) -> ControlFlow<()> {
        self.done.fetch_add(1, Ordering::Relaxed);
        if self.stopped.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    /// What `make` makes; nothing where the work is to end.
    pub fn unless_stopped<T>(&self, make: impl FnOnce() -> T) -> Option<T> {
        (!self.stopped.load(Ordering::Relaxed)).then(make)
    }

    /// Whether the work is to end.
    pub fn flag(&self) -> &AtomicBool {
        &self.stopped
    }
}

/// Runs work of `total` parts on threads of its own while this thread, which
/// has let go of the interpreter, looks at signals and calls
/// `progress(done, total)`.
///
/// The threads are made anew for each call: a process that Python forks has
/// none of its parent's.
pub fn run<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
    total: usize,
    work: impl FnOnce(&Watch) -> T + Send,
) -> PyResult<T> {
    if threads == Some(0) {
        return Err(refuse("threads 0: expected a positive number, or None"));
    }
    let pool = ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0))
        .build()
        .map_err(|e| PyRuntimeError::new_err(e.to_string()))?;
    let watch = Watch::default();
    py.detach(|| {
        thread::scope(|scope| {
            let (sender, receiver) = mpsc::channel();
            let watched = &watch;
            scope.spawn(move || {
                let _ = sender.send(pool.install(|| work(watched)));
            });
            let mut told = 0;
            let mut tell = |py: Python<'_>| {
                let done = watch.done.load(Ordering::Relaxed);
                if let Some(progress) = &progress
                    && done > told
                {
                    told = done;
                    progress.call1(py, (done, total))?;
                }
                Ok::<(), PyErr>(())
            };
            let mut refused = None;
            loop {
                let error = match receiver.recv_timeout(BEAT) {
                    Ok(result) => {
                        return match refused {
                            Some(error) => Err(error),
                            None => {
                                Python::attach(&mut tell)?;
                                Ok(result)
                            }
                        };
                    }
                    // The scope hands the panic on.
                    Err(RecvTimeoutError::Disconnected) => {
                        return Err(PyRuntimeError::new_err("work given up"));
                    }
                    Err(RecvTimeoutError::Timeout) if refused.is_some() => {
                        continue;
                    }
                    Err(RecvTimeoutError::Timeout) => Python::attach(|py| {
                        py.check_signals().and_then(|()| tell(py)).err()
                    }),
                };
                if error.is_some() {
                    watch.stopped.store(true, Ordering::Relaxed);
                    refused = error;
                }
            }
        })
    })
}
