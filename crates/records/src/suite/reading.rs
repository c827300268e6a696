//! Reading many files: their bytes in order, their records on any threads.

use std::convert::identity;

use super::SuiteMember;
use crate::error::RecordError;
use crate::record::ReadOptions;

/// Bytes of the files that are in memory at a time, for each thread.
const CHUNK: usize = 1 << 19;

/// More threads do not take more memory.
const MOST_THREADS: usize = 32;

/// Bytes that a file takes at least.
const LEAST: usize = 1 << 12;

/// Distribution of work over threads; by default the caller's thread does all.
pub trait Spread: Sync {
    /// Number of the threads.
    fn threads(&self) -> usize {
        1
    }
    /// The results of `work` on all items, in the order of the items.
    fn map<A: Send, B: Send>(
        &self,
        items: Vec<A>,
        work: impl Fn(A) -> B + Sync,
    ) -> Vec<B> {
        items.into_iter().map(work).collect()
    }
}

/// All work on the thread of the caller.
#[derive(Clone, Copy, Debug)]
pub struct OneThread;

impl Spread for OneThread {}

/// How the records of a suite are read.
pub struct Reading<'a, S, W> {
    /// Values of the caller.
    pub options: &'a ReadOptions,
    /// Whether the file of a name is read.
    pub chosen: &'a (dyn Fn(&str) -> bool + Sync),
    /// Distribution of the files over threads.
    pub spread: S,
    /// Work on each record, in any order.
    pub work: W,
}

impl<'a, S> Reading<'a, S, fn(SuiteMember) -> SuiteMember> {
    /// Reads all files, without further work.
    pub fn all(options: &'a ReadOptions, spread: S) -> Self {
        Self { options, chosen: &|_| true, spread, work: identity }
    }
}

impl<S: Spread, W> Reading<'_, S, W> {
    /// Passes the bytes of each chosen file to `read`, on any thread, and each
    /// result to `add`, in the order of the files.
    pub(super) fn each<F: Send, R: Send, E>(
        &self,
        files: impl IntoIterator<Item = F>,
        name: impl Fn(&F) -> &str,
        mut file_bytes: impl FnMut(&str) -> Result<Vec<u8>, RecordError>,
        read: impl Fn(&F, Result<Vec<u8>, RecordError>) -> R + Sync,
        mut add: impl FnMut(F, R) -> Result<(), E>,
    ) -> Result<(), E> {
        let most = CHUNK * self.spread.threads().min(MOST_THREADS);
        let chosen = |file: &F| (self.chosen)(name(file));
        let mut files = files.into_iter().filter(chosen).peekable();
        while files.peek().is_some() {
            let (mut chunk, mut size) = (Vec::new(), 0);
            while size < most
                && let Some(file) = files.next()
            {
                let bytes = file_bytes(name(&file));
                size += LEAST + bytes.as_ref().map_or(0, Vec::len);
                chunk.push((file, bytes));
            }
            let read = |(file, bytes)| (read(&file, bytes), file);
            for (found, file) in self.spread.map(chunk, read) {
                add(file, found)?;
            }
        }
        Ok(())
    }
}
