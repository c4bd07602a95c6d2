//! What a search or a sweep keeps of itself, to go on with after an interruption.

use super::prelude::*;
use std::sync::Mutex;

/// Keeps every step of a search, and gives back those of an earlier one.
#[derive(Default)]
pub struct Kept {
    /// What an earlier search has left.
    pub earlier: BTreeMap<String, Vec<u8>>,
    /// Every step kept, in its order.
    pub steps: Mutex<Vec<(String, Vec<u8>)>>,
}

impl Kept {
    /// What a search leaves that stops after so many of its steps.
    pub fn after(&self, count: usize) -> Self {
        let steps = self.steps.lock().unwrap();
        Self { earlier: steps.iter().take(count).cloned().collect(), ..Self::default() }
    }

    pub fn count(&self) -> usize {
        self.steps.lock().unwrap().len()
    }
}

impl SweepWatch for Kept {
    fn reached(&self, _progress: SweepProgress) {}

    fn recall(&self, name: &str) -> Option<Vec<u8>> {
        self.earlier.get(name).cloned()
    }

    fn keep(&self, name: &str, bytes: Vec<u8>) {
        self.steps.lock().unwrap().push((name.to_owned(), bytes));
    }
}
