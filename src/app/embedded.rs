//! Commands inside another program: a run that can be stopped, whose progress and log can be read while it goes on.
//!
//! The threads of a run are its own and carry it with them, so that several runs go on side by side.

use super::{CommandLine, Failure, command_line, log::warnings_into};
use crate::linalg::interruption::{Stop, Stopped, is_asked};
use clap::FromArgMatches;
use indicatif::ProgressBar;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::{any::Any, cell::RefCell, ffi::OsString};
use tracing::Dispatch;

/// Advice for a run that keeps nothing before its end.
pub const NOTHING_KEPT: &str = "nothing of this run is kept: the same command starts it again";

thread_local! {
    static OWN: RefCell<Option<EmbeddedRun>> = const { RefCell::new(None) };
}

/// A run of one command inside another program; clones are the same run.
#[derive(Clone, Debug, Default)]
pub struct EmbeddedRun {
    stop: Stop,
    state: Arc<Mutex<State>>,
}

/// What can be read of a run.
#[derive(Debug, Default)]
struct State {
    bar: Option<ProgressBar>,
    advice: Option<&'static str>,
    log: Vec<u8>,
}

/// How far a run is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Progress {
    /// What is counted, or what the run is at.
    pub message: String,
    /// How many are done.
    pub done: u64,
    /// Of how many, once that is known.
    pub total: Option<u64>,
}

impl EmbeddedRun {
    /// Runs one command on threads of its own, all cores unless `threads` says otherwise, and waits for its end.
    /// `arguments` are those of the command line, the command first.
    ///
    /// # Errors
    /// As the command; [`Failure::Interrupted`] after [`Self::stop`]; [`Failure::Panic`].
    pub fn run(
        &self,
        arguments: impl IntoIterator<Item = OsString>,
        threads: usize,
    ) -> Result<(), Failure> {
        let name = OsString::from("frictionsim");
        let given = std::iter::once(name).chain(arguments);
        let parsed = command_line().try_get_matches_from(given);
        let parsed = parsed.and_then(|found| CommandLine::from_arg_matches(&found));
        let parsed = parsed.map_err(|error| {
            let text = error.render().to_string();
            let text = text.strip_prefix("error: ").unwrap_or(&text);
            Failure::usage(text.trim_end())
        })?;
        self.enclose(threads, || parsed.command.run())
    }

    /// As [`Self::run`] for any work.
    pub fn enclose<T: Send>(
        &self,
        threads: usize,
        work: impl FnOnce() -> Result<T, Failure> + Send,
    ) -> Result<T, Failure> {
        let own = self.clone();
        let log = warnings_into(move || own.clone());
        let pool = build_pool(threads, Some(self.clone()), log).map_err(Failure::run)?;
        catch_unwind(AssertUnwindSafe(|| pool.install(work))).unwrap_or_else(|cause| {
            Err(match cause.is::<Stopped>() {
                true => {
                    let advice = self.state().advice.unwrap_or(NOTHING_KEPT);
                    Failure::Interrupted(format!("interrupted; {advice}"))
                }
                false => Failure::Panic(panic_text(cause.as_ref())),
            })
        })
    }

    /// Asks the run to stop; a transient keeps what it has, for `--resume`.
    pub fn stop(&self) {
        self.stop.ask();
    }

    /// How far the run is, once it counts something.
    pub fn progress(&self) -> Option<Progress> {
        let bar = self.state().bar.clone()?;
        Some(Progress {
            message: bar.message(),
            done: bar.position(),
            total: bar.length().filter(|total| *total > 0),
        })
    }

    /// Takes the lines of the log that have been written since the last call: warnings, each behind `WARN`.
    pub fn take_log(&self) -> String {
        String::from_utf8_lossy(&std::mem::take(&mut self.state().log)).into_owned()
    }

    /// A progress bar that is read by [`Self::progress`] instead of shown.
    pub(super) fn bar(&self, length: u64) -> ProgressBar {
        let bar = ProgressBar::hidden();
        bar.set_length(length);
        self.state().bar = Some(bar.clone());
        bar
    }

    /// Notes what an interruption leaves, and how to go on.
    pub(super) fn advise(&self, advice: &'static str) {
        self.state().advice = Some(advice);
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Write for EmbeddedRun {
    /// Adds to the log.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.state().log.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The embedded run that this thread works for.
pub fn current() -> Option<EmbeddedRun> {
    OWN.with_borrow(Clone::clone)
}

/// A thread pool that works for whatever this thread works for.
///
/// # Errors
/// Threads that the system does not give.
pub fn inherited_pool(threads: usize) -> Result<ThreadPool, ThreadPoolBuildError> {
    let log = tracing::dispatcher::get_default(Clone::clone);
    build_pool(threads, current(), log)
}

fn build_pool(
    threads: usize,
    run: Option<EmbeddedRun>,
    log: Dispatch,
) -> Result<ThreadPool, ThreadPoolBuildError> {
    let builder = ThreadPoolBuilder::new().num_threads(threads).spawn_handler(move |thread| {
        let (run, log) = (run.clone(), log.clone());
        let work = move || {
            if let Some(run) = run {
                run.stop.enter();
                OWN.with_borrow_mut(|own| *own = Some(run));
            }
            let _log = tracing::dispatcher::set_default(&log);
            thread.run();
        };
        std::thread::Builder::new().spawn(work).map(drop)
    });
    builder.build()
}

/// Whether what a panic was caught with is a request to stop.
pub fn is_stopped(cause: &(dyn Any + Send)) -> bool {
    cause.is::<Stopped>() && is_asked()
}

/// What a panic said.
pub fn panic_text(cause: &(dyn Any + Send)) -> String {
    let text = cause.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| cause.downcast_ref::<&str>().copied()).unwrap_or("of unknown cause").to_owned()
}
