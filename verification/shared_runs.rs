//! Runs that several studies read: each is done once.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

type Slots<R> = Mutex<HashMap<String, Arc<OnceLock<R>>>>;

/// What runs have shown, by a key that tells all that makes them different.
pub struct SharedRuns<R>(OnceLock<Slots<R>>);

impl<R: Clone> SharedRuns<R> {
    pub const fn new() -> Self {
        Self(OnceLock::new())
    }

    /// What the run of this key has shown; whoever comes first runs it, others wait.
    pub fn get(&self, key: String, run: impl FnOnce() -> R) -> R {
        let mut slots = self.0.get_or_init(Slots::default).lock().unwrap_or_else(PoisonError::into_inner);
        let slot = Arc::clone(slots.entry(key).or_default());
        drop(slots);
        slot.get_or_init(run).clone()
    }
}
