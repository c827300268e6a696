//! CPU time and memory of this process.

use cpu_time::{ProcessTime, ThreadTime};

/// CPU time of this thread, in s.
#[expect(
    clippy::disallowed_methods,
    reason = "measuring time is what `rocking speed` is for"
)]
pub fn thread_s() -> f64 {
    ThreadTime::now().as_duration().as_secs_f64()
}

/// CPU time of all threads of this process, in s.
#[expect(
    clippy::disallowed_methods,
    reason = "measuring time is what `rocking speed` is for"
)]
pub fn process_s() -> f64 {
    ProcessTime::now().as_duration().as_secs_f64()
}

/// Least CPU time (s) of this thread per call of `work`, over `batches`
/// batches of about `batch_s` each; and the result of `work`.
pub fn least_s<T>(
    batches: u32,
    batch_s: f64,
    mut work: impl FnMut() -> T,
) -> (f64, T) {
    let begin = thread_s();
    let mut given = work();
    let once = thread_s() - begin;
    let turns = (batch_s / once.max(1e-9)).clamp(1.0, 1e6) as u32;
    let mut least = once;
    for _ in 0..batches {
        let begin = thread_s();
        for _ in 0..turns {
            given = std::hint::black_box(work());
        }
        let each = (thread_s() - begin) / f64::from(turns);
        least = least.min(each);
    }
    (least, given)
}

/// Peak memory of this process, in MiB; none if the system does not report
/// it.
pub fn peak_memory_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kib: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib / 1024.0)
}
