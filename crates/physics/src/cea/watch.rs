//! Whoever watches a sweep: hears how far it has come, and keeps what took long to find.

use super::SweepProgress;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Hears of the progress of a sweep, and may keep its steps for a run that goes on after an interruption.
///
/// A closure that takes a [`SweepProgress`] only hears. Steps have names, the same ones whenever the same sweep runs: what
/// [`Self::recall`] gives under a name must be what [`Self::keep`] was given, bit by bit; the sweep then takes the same course
/// as one that was never interrupted.
pub trait SweepWatch: Sync {
    /// The sweep has come so far. Called from several threads.
    fn reached(&self, progress: SweepProgress);

    /// The bytes that an earlier run of the same sweep kept under a name.
    fn recall(&self, _name: &str) -> Option<Vec<u8>> {
        None
    }

    /// Keeps bytes under a name. Called from several threads.
    fn keep(&self, _name: &str, _bytes: Vec<u8>) {}
}

impl dyn SweepWatch + '_ {
    /// The value that an earlier run of the same sweep kept under a name, bit by bit; none where it is of another kind.
    pub fn recalled<T: DeserializeOwned>(&self, name: &str) -> Option<T> {
        postcard::from_bytes(&self.recall(name)?).ok()
    }

    /// Keeps a value under a name.
    pub fn keep_value(&self, name: &str, value: &impl Serialize) {
        if let Ok(bytes) = postcard::to_stdvec(value) {
            self.keep(name, bytes); // What was not kept is found anew.
        }
    }
}

impl<F: Fn(SweepProgress) + Sync> SweepWatch for F {
    fn reached(&self, progress: SweepProgress) {
        self(progress);
    }
}

/// Nobody watches.
pub struct Unwatched;

impl SweepWatch for Unwatched {
    fn reached(&self, _progress: SweepProgress) {}
}

/// The watch over one of several sweeps, whose steps it tells apart by a prefix of their names.
pub struct PartWatch<'a> {
    /// The watch over all.
    pub whole: &'a dyn SweepWatch,
    /// What the names of this part begin with.
    pub prefix: String,
    /// Whether the whole hears how far this part has come.
    pub is_heard: bool,
}

impl SweepWatch for PartWatch<'_> {
    fn reached(&self, progress: SweepProgress) {
        if self.is_heard {
            self.whole.reached(progress);
        }
    }

    fn recall(&self, name: &str) -> Option<Vec<u8>> {
        self.whole.recall(&format!("{}{name}", self.prefix))
    }

    fn keep(&self, name: &str, bytes: Vec<u8>) {
        self.whole.keep(&format!("{}{name}", self.prefix), bytes);
    }
}
