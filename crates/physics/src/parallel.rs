//! Work side by side.

use rayon::prelude::*;
use std::sync::Mutex;

const UNBROKEN: &str = "a panic of the work ends the loop first";

/// What `work` makes of each item, side by side on the threads there are, listed in the order of the items.
///
/// All callers share one loop over threads: compiled for each of them it is 4,000 instructions of the compiler's.
pub fn map<I: Send, T: Send, L: FromIterator<T>>(
    items: impl IntoIterator<Item = I>,
    work: impl Fn(I) -> T + Sync,
) -> L {
    let slot = |item| (Mutex::new(Some(item)), Mutex::new(None::<T>));
    let slots: Vec<_> = items.into_iter().map(slot).collect();
    at_each_place(slots.len(), &|place| {
        let (item, done) = &slots[place];
        *done.lock().expect(UNBROKEN) = item.lock().expect(UNBROKEN).take().map(&work);
    });
    slots.into_iter().filter_map(|(_, done)| done.into_inner().expect(UNBROKEN)).collect()
}

fn at_each_place(count: usize, work: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(work);
}
