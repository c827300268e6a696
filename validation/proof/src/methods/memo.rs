//! What is found once and asked for again.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use anyhow::Result;

/// Lists by key: a wrong model that reads them otherwise needs no run of its
/// own.
pub struct Memo<K, T>(Mutex<BTreeMap<K, Arc<Vec<T>>>>);

impl<K: Ord, T> Memo<K, T> {
    /// With nothing in it.
    pub const fn new() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }

    /// The list of a key, from memory where it was made before. Nothing is
    /// locked while it is made: a thread that waits there may take up another
    /// case.
    pub fn get(
        &self,
        key: K,
        make: impl FnOnce(&K) -> Result<Vec<T>>,
    ) -> Result<Arc<Vec<T>>> {
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = lock().get(&key) {
            return Ok(Arc::clone(found));
        }
        let found = Arc::new(make(&key)?);
        lock().insert(key, Arc::clone(&found));
        Ok(found)
    }
}
