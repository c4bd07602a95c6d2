//! Runs of commands: on threads of their own, while the calling thread looks after signals and progress.

use crate::failure;
use frictionsim::app::Failure;
use frictionsim::app::embedded::EmbeddedRun;
use pyo3::prelude::*;
use std::ffi::OsString;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Time between two looks at signals and progress.
const LOOK: Duration = Duration::from_millis(50);
/// How long a call waits for a run that it has asked to stop, so that it returns within a second.
const GRACE: Duration = Duration::from_millis(700);
/// How long the interpreter waits at its end for runs that write what they have.
const LONGEST_END: Duration = Duration::from_secs(60);

/// Threads of runs that were asked to stop and have not ended yet.
static STOPPED: Mutex<Vec<JoinHandle<()>>> = Mutex::new(Vec::new());

/// What a run on its way gives back at its end.
type Outcome<T> = Mutex<Receiver<Result<T, Failure>>>;

/// Runs a command of the command line without its program name, and gives the warnings of its log.
///
/// `progress(message, done, total)` is called on this thread while it goes on. An exception there, or of a signal, stops
/// the run.
#[pyfunction]
#[pyo3(signature = (arguments, threads=0, progress=None))]
pub fn run(
    py: Python<'_>,
    arguments: Vec<OsString>,
    threads: u16,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    wait_for_stopped(py)?;
    let run = EmbeddedRun::default();
    let own = run.clone();
    start(py, &run, progress, move || own.run(arguments, usize::from(threads)))?;
    Ok(run.take_log())
}

/// Starts work on a thread and looks after it until its end.
pub fn start<T: Send + 'static>(
    py: Python<'_>,
    run: &EmbeddedRun,
    progress: Option<Bound<'_, PyAny>>,
    work: impl FnOnce() -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    let (sender, receiver) = channel();
    let thread = std::thread::Builder::new().spawn(move || {
        // Nobody waits any more for a run that was stopped.
        let _ = sender.send(work());
    })?;
    let outcome: Outcome<T> = Mutex::new(receiver);
    let mut told = Instant::now();
    loop {
        match wait(py, &outcome, LOOK) {
            Ok(result) => return result.map_err(|failed| failure::exception(&failed)),
            Err(RecvTimeoutError::Disconnected) => {
                let lost = Failure::Panic("the run ended without a word".to_owned());
                return Err(failure::exception(&lost));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        let mut looked = py.check_signals();
        if let (Ok(()), Some(tell)) = (&looked, &progress)
            && told.elapsed() >= 2 * LOOK
        {
            told = Instant::now();
            looked = tell_progress(run, tell);
        }
        if let Err(signal) = looked {
            run.stop();
            let ended = wait(py, &outcome, GRACE);
            if ended.is_err() {
                stopped().push(thread);
            }
            let said = match ended {
                Ok(Err(failed)) => failure::description(&failed)["text"].clone(),
                _ => serde_json::Value::Null,
            };
            signal.value(py).setattr("frictionsim_message", said.as_str())?;
            return Err(signal);
        }
    }
}

/// Waits for the outcome without holding the interpreter.
fn wait<T: Send>(
    py: Python<'_>,
    outcome: &Outcome<T>,
    time: Duration,
) -> Result<Result<T, Failure>, RecvTimeoutError> {
    py.detach(|| {
        let receiver = outcome.lock().unwrap_or_else(PoisonError::into_inner);
        receiver.recv_timeout(time)
    })
}

fn tell_progress(run: &EmbeddedRun, tell: &Bound<'_, PyAny>) -> PyResult<()> {
    if let Some(progress) = run.progress() {
        tell.call1((progress.message, progress.done, progress.total))?;
    }
    Ok(())
}

fn stopped() -> std::sync::MutexGuard<'static, Vec<JoinHandle<()>>> {
    STOPPED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Waits for runs that were asked to stop, a minute at most.
#[pyfunction]
pub fn wait_for_stopped(py: Python<'_>) -> PyResult<()> {
    let begin = Instant::now();
    while begin.elapsed() < LONGEST_END {
        stopped().retain(|thread| !thread.is_finished());
        if stopped().is_empty() {
            break;
        }
        py.detach(|| std::thread::sleep(LOOK));
        py.check_signals()?;
    }
    Ok(())
}

/// The command line: takes `sys.argv`, gives the exit code.
#[pyfunction]
pub fn command_line(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| frictionsim::app::run_arguments(arguments))
}
