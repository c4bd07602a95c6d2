//! Terminal output: results on stdout, log and progress on stderr.

use super::{Failure, PANICKED, embedded, log::Line};
use crate::case::{find_key, shown, shown_json};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::io::{self, IsTerminal, Write};

pub use super::embedded::NOTHING_KEPT;

/// Writes a result to stdout, control characters in it escaped.
///
/// # Errors
/// [`Failure::BrokenPipe`] if nobody reads it any more.
pub fn print(text: &str) -> Result<(), Failure> {
    print_bytes(shown(text).as_bytes())
}

fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    stdout.write_all(bytes)?;
    Ok(stdout.flush()?)
}

/// Writes one JSON object to stdout.
pub fn print_json(value: &serde_json::Value) -> Result<(), Failure> {
    print_bytes(shown_json(&format!("{value:#}\n")).as_bytes())
}

/// Says on stderr what went wrong (every error names its cause itself), and gives the exit code.
pub fn report(failure: &Failure) -> u8 {
    let word = error_word();
    let (text, code) = match failure {
        Failure::Case(errors) => (errors.render(is_coloured()), 2),
        Failure::Usage(error) => (format!("{word} {}", shown(&error.to_string())), 2),
        Failure::Run(error) => (format!("{word} {}", shown(&error.to_string())), 1),
        Failure::Interrupted(message) => (format!("{word} {}", shown(message)), INTERRUPTED),
        Failure::Panic(message) => (format!("{word} {}", shown(message)), PANICKED),
        Failure::BrokenPipe | Failure::DryRun => return 0,
    };
    // Nobody is left to tell if stderr is closed.
    let _ = writeln!(io::stderr().lock(), "{text}");
    code
}

/// Says a warning on stderr, for commands that keep no log.
pub fn warn(warning: &impl std::fmt::Display) {
    // Nobody is left to tell if stderr is closed.
    let _ = writeln!(io::stderr().lock(), "warning: {}", shown(&warning.to_string()));
}

/// Commands with what they are called in other programs.
const OTHER_NAMES: &str = "cea: eigen eigenvalues modal modes; check: validate; frf: harmonic response; \
    identify: damping; init: new template; plot: report; signal: spectrum; transient: dynamic run";

/// What is said of a command of another program, and of an assignment to a case key that no command takes.
fn meant(error: &clap::Error) -> Option<String> {
    let given = |context| match error.get(context) {
        Some(ContextValue::String(given)) => Some(given.as_str()),
        _ => None,
    };
    match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let given = given(ContextKind::InvalidSubcommand)?;
            let mut names = OTHER_NAMES.split("; ").filter_map(|own| own.split_once(": "));
            let (meant, _) = names.find(|own| own.1.split(' ').any(|name| name == given))?;
            Some(format!("no such command; `frictionsim {meant}` does that"))
        }
        ErrorKind::UnknownArgument => {
            let given = given(ContextKind::InvalidArg)?;
            let (text, is_near) = (shown(given), error.get(ContextKind::SuggestedArg).is_some());
            let said = match given.split_once('=') {
                Some((key, _)) => {
                    find_key(key)?;
                    format!("a key of the case is changed by --set '{text}'")
                }
                None if given.parse::<f64>().is_ok() => format!("write --set KEY={text}, in one"),
                None if given.starts_with("--") && !is_near => {
                    "no option of this command; a key of the case is changed by --set KEY=VALUE"
                        .to_owned()
                }
                None => return None,
            };
            Some(format!("unexpected argument '{text}': {said}"))
        }
        _ => None,
    }
}

/// Prints what the command line's parser says (help and version too), and gives the exit code.
pub fn report_usage(error: &clap::Error) -> u8 {
    if let Some(meant) = meant(error) {
        let word = error_word();
        let help = "For more information, try '--help'.";
        let _ = writeln!(io::stderr().lock(), "{word} {meant}\n\n{help}");
        return 2;
    }
    let plain = error.render().to_string();
    let safe = shown(&plain);
    let printed = match safe == plain {
        true => error.print(),
        // Arguments with control characters are quoted without colours.
        false => write!(io::stderr().lock(), "{safe}"),
    };
    // Nobody is left to tell if the stream is closed.
    drop(printed);
    u8::try_from(error.exit_code()).unwrap_or(1)
}

/// Exit code of a process that Ctrl-C or SIGTERM ended.
pub const INTERRUPTED: u8 = 130;

/// Makes Ctrl-C and SIGTERM end the process with exit code 130 and a word on what is kept and how to go on. Inside
/// another program, whose signals are its own, the word is kept for it.
pub fn catch_signals(advice: &'static str) {
    if let Some(run) = embedded::current() {
        return run.advise(advice);
    }
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
    if is_coloured() { "\x1b[1m\x1b[91merror\x1b[0m\x1b[1m:\x1b[0m" } else { "error:" }
}

/// Sends the log to stderr: information and warnings; with one `quiet` warnings, with two errors only. An embedded run
/// has a log of its own.
pub fn start_log(quiet: u8, verbose: u8) {
    if embedded::current().is_some() {
        return;
    }
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
        .event_format(Line);
    // A second call, as tests make, finds the log started.
    let _ = subscriber.try_init();
}

/// Width of a progress bar.
const BAR: u64 = 40;

/// A progress bar on a terminal, nothing in a pipe or with `quiet`. `length` is 0 while it is not known.
pub fn progress(quiet: bool, length: u64, message: &'static str) -> ProgressBar {
    let bar = progress_in(quiet, length, "{msg} {track}{count}  {elapsed_precise}{left}");
    bar.set_message(message);
    bar
}

/// How far `done` of `length` pieces are, as a bar; nothing of a single piece, which would be empty to its end.
fn track(done: u64, length: Option<u64>) -> String {
    let Some(length) = length.filter(|length| *length > 1) else { return String::new() };
    let filled = (BAR * done.min(length) / length) as usize;
    let head = if filled < BAR as usize { ">" } else { "" };
    format!("[{:<1$}] ", "=".repeat(filled) + head, BAR as usize)
}

/// A progress bar with a template of its own, in which `{track}` is the bar, `{count}` how many are done of how many,
/// and `{left}` the time left; none says anything before there is something to say.
pub fn progress_in(quiet: bool, length: u64, template: &str) -> ProgressBar {
    if let Some(run) = embedded::current() {
        return run.bar(length);
    }
    if quiet || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let target = ProgressDrawTarget::stderr_with_hz(10);
    let bar = ProgressBar::with_draw_target((length > 0).then_some(length), target);
    if let Ok(style) = ProgressStyle::with_template(template) {
        let shown = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
            let _ = out.write_str(&track(state.pos(), state.len()));
        };
        let count = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
            if let Some(length) = state.len().filter(|length| *length > 1) {
                let _ = write!(out, "{}/{length}", state.pos());
            }
        };
        let left = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
            if state.pos() > 0 && state.len().is_some_and(|length| length > 0) {
                let _ = write!(out, ", {} left", HumanDuration(state.eta()));
            }
        };
        bar.set_style(
            style.with_key("track", shown).with_key("count", count).with_key("left", left),
        );
    }
    // The clock goes on while a long piece of work says nothing.
    bar.enable_steady_tick(std::time::Duration::from_millis(500));
    bar
}

#[cfg(test)]
mod tests {
    use super::track;

    #[test]
    fn a_single_piece_of_work_has_no_bar_that_stays_empty() {
        assert_eq!(track(0, None), "");
        assert_eq!(track(0, Some(1)), "");
        assert_eq!(track(1, Some(2)).matches('=').count(), 20);
        assert_eq!(track(2, Some(2)).matches('=').count(), 40);
    }
}
