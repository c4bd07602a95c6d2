//! What goes to the terminal: results on stdout, log and progress on stderr.

use super::Failure;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{self, IsTerminal, Write};

/// Writes a result to stdout.
///
/// # Errors
/// [`Failure::BrokenPipe`] if nobody reads it any more.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    stdout.write_all(text.as_bytes())?;
    Ok(stdout.flush()?)
}

/// Writes one JSON object to stdout.
///
/// # Errors
/// As [`print()`].
pub fn print_json(value: &serde_json::Value) -> Result<(), Failure> {
    print(&format!("{value:#}\n"))
}

/// Advice for a run that keeps nothing before its end.
pub const NOTHING_KEPT: &str = "nothing of this run is kept: the same command starts it again";

/// Makes Ctrl-C and SIGTERM end the process with exit code 1 and a word on what is kept and how to go on.
pub fn catch_signals(advice: &'static str) {
    let stop = move || {
        // Nobody is left to tell if stderr is closed.
        let _ = writeln!(io::stderr(), "\nerror: interrupted; {advice}");
        std::process::exit(1);
    };
    // A second run of the same process finds the handler in place.
    let _ = ctrlc::set_handler(stop);
}

/// Sends the log to stderr: warnings, with `quiet` only errors.
pub fn start_log(quiet: bool) {
    let level = if quiet {
        tracing::Level::ERROR
    } else {
        tracing::Level::INFO
    };
    let subscriber = tracing_subscriber::fmt()
        .with_writer(io::stderr)
        .with_ansi(io::stderr().is_terminal())
        .with_max_level(level)
        .without_time()
        .with_target(false);
    // A second call, as tests make, finds the log started.
    let _ = subscriber.try_init();
}

/// A progress bar on a terminal, nothing in a pipe or with `quiet`.
pub fn progress(quiet: bool, length: u64, message: &'static str) -> ProgressBar {
    if quiet || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::stderr_with_hz(10));
    if let Ok(style) = ProgressStyle::with_template(
        "{msg} [{bar:40}] {pos}/{len}  {elapsed_precise}, {eta_precise} left",
    ) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.set_message(message);
    bar
}
