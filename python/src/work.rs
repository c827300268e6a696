//! Long work: on its own threads, without the interpreter, with progress and
//! an end by Ctrl-C.

use std::fmt::Display;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use rocking::stop::Stop;

/// The core's error as a `ValueError` with the core's text.
pub fn refuse(error: impl Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// How often signals are examined and progress is reported.
const BEAT: Duration = Duration::from_millis(50);

/// Work on fewer numbers than these takes less time than starting a thread.
const MANY: usize = 1 << 16;

/// Parts of the work that are done.
#[derive(Default)]
pub struct Done(AtomicUsize);

impl Done {
    /// One more is done.
    pub fn tick(&self) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }
}

/// Runs work of `total` parts on separate threads. Meanwhile this thread,
/// detached from the interpreter, checks signals and calls `progress(done,
/// total)`. An exception from either stops the work.
///
/// The threads are created for each call: a process that Python forks has none
/// of the threads of its parent.
pub fn run<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
    total: usize,
    work: impl FnOnce(&Done) -> T + Send,
) -> PyResult<T> {
    if threads == Some(0) {
        return Err(refuse("threads 0: expected a positive number, or None"));
    }
    let stop = Stop::default();
    let done = Done::default();
    py.detach(|| {
        thread::scope(|scope| {
            let (sender, receiver) = mpsc::channel();
            let (heeded, parts) = (&stop, &done);
            scope.spawn(move || {
                let result = heeded.run(threads.unwrap_or(0), || work(parts));
                let _ = sender.send(result);
            });
            let mut reported = 0;
            let mut tell = |py: Python<'_>| {
                let done = done.0.load(Ordering::Relaxed);
                if let Some(progress) = &progress
                    && done > reported
                {
                    reported = done;
                    progress.call1(py, (done, total))?;
                }
                Ok::<(), PyErr>(())
            };
            let mut raised = None;
            loop {
                match receiver.recv_timeout(BEAT) {
                    Ok(_) if raised.is_some() => break,
                    Ok(result) => {
                        let result = result.map_err(|error| {
                            PyRuntimeError::new_err(error.to_string())
                        })?;
                        Python::attach(&mut tell)?;
                        return Ok(result);
                    }
                    // The scope hands the panic on.
                    Err(RecvTimeoutError::Disconnected) => break,
                    Err(RecvTimeoutError::Timeout) if raised.is_some() => {}
                    Err(RecvTimeoutError::Timeout) => {
                        raised = Python::attach(|py| {
                            py.check_signals().and_then(|()| tell(py)).err()
                        });
                        if raised.is_some() {
                            stop.request();
                        }
                    }
                }
            }
            Err(raised
                .unwrap_or_else(|| PyRuntimeError::new_err("work given up")))
        })
    })
}

/// [`run`] on all processors, without progress.
pub fn on_all<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    run(py, None, None, 0, |_| work())
}

/// [`run`] on one thread, without progress.
pub fn alone<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    run(py, Some(1), None, 0, |_| work())
}

/// [`alone`] for work on many numbers; work on few runs on this thread.
pub fn on_numbers<T: Send>(
    py: Python<'_>,
    count: usize,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    if count < MANY { Ok(work()) } else { alone(py, work) }
}
