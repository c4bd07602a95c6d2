//! Stopping a computation that runs inside another program.
//!
//! A command of its own ends with its process. Inside another program it must give its threads back. Those that work for it carry its
//! [`Stop`], and the factorizations and iterations of this floor look at it ([`check`]). They unwind with [`Stopped`] to where the
//! computation was begun, as cancelled queries do in salsa. Results do not depend on it.

use std::cell::RefCell;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    static OWN: RefCell<Option<Stop>> = const { RefCell::new(None) };
}

/// A request to stop, shared by the threads of one computation.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicBool>);

/// What an interrupted computation unwinds with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stopped;

impl Stop {
    /// Asks the computation to stop.
    pub fn ask(&self) {
        self.0.store(true, Ordering::SeqCst);
    }

    /// Makes the work of the calling thread from now on part of the computation.
    pub fn enter(&self) {
        OWN.with_borrow_mut(|own| *own = Some(self.clone()));
    }
}

/// Whether the computation of this thread is asked to stop.
#[inline]
pub fn is_asked() -> bool {
    OWN.with_borrow(|own| {
        let own = own.as_ref();
        own.is_some_and(|stop| stop.0.load(Ordering::Relaxed)) // One look later is soon enough.
    })
}

/// Leaves a computation that is asked to stop, by unwinding with [`Stopped`]; the panic hook is not called.
#[inline]
pub fn check() {
    if is_asked() {
        resume_unwind(Box::new(Stopped));
    }
}

/// Takes the request back where the computation ends in an order of its own, with its results so far.
pub fn acknowledge() {
    OWN.with_borrow(|own| {
        if let Some(stop) = own {
            stop.0.store(false, Ordering::SeqCst);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::catch_unwind;

    #[test]
    fn a_computation_asked_to_stop_unwinds_once_and_others_go_on() {
        let (stop, other) = (Stop::default(), Stop::default());
        stop.ask();
        let run = |stop: Stop| {
            let work = move || {
                stop.enter();
                let first = catch_unwind(check);
                acknowledge();
                (first.is_err_and(|found| found.is::<Stopped>()), is_asked())
            };
            std::thread::spawn(work).join().unwrap()
        };
        assert_eq!(run(stop), (true, false));
        assert_eq!(run(other), (false, false));
        check();
    }
}
