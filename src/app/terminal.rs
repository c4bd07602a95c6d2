//! Terminal output: results on stdout, log and progress on stderr.

use super::Failure;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

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

/// Says on stderr what went wrong (every error names its cause itself), and gives the exit code.
pub fn report(failure: &Failure) -> ExitCode {
    let word = error_word();
    let (text, code) = match failure {
        Failure::Case(errors) => (errors.render(is_coloured()), 2),
        Failure::Usage(error) => (format!("{word} {error}"), 2),
        Failure::Run(error) => (format!("{word} {error}"), 1),
        Failure::Interrupted(message) => (format!("{word} {message}"), INTERRUPTED),
        Failure::BrokenPipe | Failure::DryRun => return ExitCode::SUCCESS,
    };
    // Nobody is left to tell if stderr is closed.
    let _ = writeln!(io::stderr().lock(), "{text}");
    ExitCode::from(code)
}

/// Advice for a run that keeps nothing before its end.
pub const NOTHING_KEPT: &str = "nothing of this run is kept: the same command starts it again";

/// Exit code of a process that Ctrl-C or SIGTERM ended.
pub const INTERRUPTED: u8 = 130;

/// Makes Ctrl-C and SIGTERM end the process with exit code 130 and a word on what is kept and how to go on.
pub fn catch_signals(advice: &'static str) {
    let stop = move || {
        // Nobody is left to tell if stderr is closed.
        let _ = writeln!(io::stderr(), "\n{} interrupted; {advice}", error_word());
        std::process::exit(i32::from(INTERRUPTED));
    };
    // A second run of the same process finds the handler in place.
    let _ = ctrlc::set_handler(stop);
}

/// Whether stderr takes colours.
pub fn is_coloured() -> bool {
    io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|text| text.is_empty())
}

/// `error:`, red and bold where stderr takes colours, as in front of the errors of a case.
pub fn error_word() -> &'static str {
    match is_coloured() {
        true => "\x1b[1m\x1b[91merror\x1b[0m\x1b[1m:\x1b[0m",
        false => "error:",
    }
}

/// Sends the log to stderr: information and warnings; with one `quiet` warnings, with two errors only.
pub fn start_log(quiet: u8, verbose: u8) {
    let level = match (quiet, verbose) {
        (0, 0) => tracing::Level::INFO,
        (0, _) => tracing::Level::DEBUG,
        (1, _) => tracing::Level::WARN,
        _ => tracing::Level::ERROR,
    };
    let subscriber = tracing_subscriber::fmt()
        .with_writer(io::stderr)
        .with_ansi(is_coloured())
        .with_max_level(level)
        .without_time()
        .with_target(false);
    // A second call, as tests make, finds the log started.
    let _ = subscriber.try_init();
}

/// A progress bar on a terminal, nothing in a pipe or with `quiet`. `length` is 0 while it is not known.
pub fn progress(quiet: bool, length: u64, message: &'static str) -> ProgressBar {
    let bar = progress_in(
        quiet,
        length,
        "{msg} [{bar:40}] {count}  {elapsed_precise}{left}",
    );
    bar.set_message(message);
    bar
}

/// A progress bar with a template of its own, in which `{count}` is how many are done of how many, and `{left}` the time
/// left; neither says anything before there is something to say.
pub fn progress_in(quiet: bool, length: u64, template: &str) -> ProgressBar {
    if quiet || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let target = ProgressDrawTarget::stderr_with_hz(10);
    let bar = ProgressBar::with_draw_target((length > 0).then_some(length), target);
    if let Ok(style) = ProgressStyle::with_template(template) {
        let count = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
            let _ = match state.len() {
                Some(length) if length > 0 => write!(out, "{}/{length}", state.pos()),
                _ => Ok(()),
            };
        };
        let left = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
            let is_known = state.pos() > 0 && state.len().is_some_and(|length| length > 0);
            let _ = match is_known {
                true => write!(out, ", {} left", HumanDuration(state.eta())),
                false => Ok(()),
            };
        };
        let style = style.with_key("count", count).with_key("left", left);
        bar.set_style(style.progress_chars("=> "));
    }
    // The clock goes on while a long piece of work says nothing.
    bar.enable_steady_tick(std::time::Duration::from_millis(500));
    bar
}
