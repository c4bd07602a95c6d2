//! The command line: a file for each subcommand that has options of its own.

pub mod cea;
pub mod check;
mod collect;
mod columns;
mod compare;
mod completions;
pub mod cycle;
pub mod embedded;
mod failure;
mod fit;
mod identify;
mod init;
mod keys;
mod limits;
mod log;
mod mac;
mod man;
mod matrices;
mod measurement;
mod mesh;
mod options;
pub mod plot;
mod prelude;
mod session;
mod share;
pub mod shipped;
mod signal;
mod studies;
pub mod sweep;
pub mod terminal;
pub mod transient;
mod uncertainty;

pub use failure::Failure;
pub use options::{OutputOptions, ResumedRun, RunOptions};
pub use session::Session;

use limits::{input_name, read_input};
use options::{LONGEST_NAME, SIMD_LEVELS, Told, one_of};
use session::{depend_on, start_threads};

use clap::{Arg, ArgAction, CommandFactory, FromArgMatches, Parser, Subcommand};
use std::{ffi::OsString, process::ExitCode};

/// Predicts friction-induced vibration, such as brake squeal, by finite elements.
///
/// A case is a text file that describes a body, what presses and drags it, and the analyses wanted.
/// `frictionsim init cea` writes one, `frictionsim cea cea.toml` runs it.
#[derive(Parser)]
#[command(name = "frictionsim", version, max_term_width = 100, arg_required_else_help = true)]
#[command(after_help = "Options may stand before or after the command.\n\
                  Exit codes: 0 done, 1 the run failed, 2 bad usage or case, 130 interrupted.")]
pub struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

/// The table of commands: the arguments of each, and what takes them. It fails on what is asked for in vain:
/// arguments, a case or a folder (exit code 2); or the run fails (1).
macro_rules! commands {
    ($($(#[$help:meta])* $name:ident($arguments:ty): $run:path,)*) => {
        #[derive(Subcommand)]
        enum Command {
            $($(#[$help])* $name($arguments),)*
        }

        impl Command {
            fn run(&self) -> Result<(), Failure> {
                match self {
                    $(Self::$name(arguments) => $run(arguments),)*
                }
            }
        }
    };
}

commands! {
    /// Which modes turn unstable, at which friction and why
    ///
    /// Solves complex eigenvalues over the friction coefficient. For a body that is solved on its whole mesh, Ctrl-C
    /// keeps finished friction values; --resume continues. Needs a section `[cea]`.
    Cea(ResumedRun): cea::run,
    Transient(transient::Arguments): transient::run,
    Sweep(sweep::Arguments): sweep::run,
    Collect(collect::Arguments): collect::run,
    Compare(compare::Arguments): compare::run,
    Plot(plot::Arguments): plot::run,
    /// The vibration that each unstable mode saturates to
    ///
    /// Finds limit cycles without time stepping. On the built-in disc a limit cycle is a rotating wave, solved along
    /// its phase. On any other body it is the periodic motion that a growing mode saturates to, solved over one period
    /// of the transient. cycle.continuation follows it over a parameter. Its stability is computed, and a short
    /// transient confirms it. Ctrl-C keeps finished cycles and branch points; --resume continues. Needs a section
    /// `[cycle]`.
    Cycle(ResumedRun): cycle::run,
    /// Which of two limit cycles wins
    ///
    /// Runs transients with two seeds: two waves on the built-in disc, two modes on any other body. Bisects the ratio
    /// of the seeds above which the second one wins. With one mode it finds the kick that tips stable sliding into its
    /// limit cycle. Needs a [basin] section. A map over speed and friction is a sweep with analyses = ["basin"].
    Basin(RunOptions): studies::basin,
    /// Show that results have converged over mesh and time step
    ///
    /// Runs the analyses of a case on refined meshes, and its transient with shorter time steps. Reads the observed
    /// order off the three finest runs, extrapolates after Richardson, and marks what does not converge. Needs a
    /// section `[convergence]`.
    Convergence(RunOptions): studies::convergence,
    /// Find changes that silence the unstable modes
    ///
    /// Computes the derivatives of growth rates by a mass, spring, dashpot, damping layer or removed patch at every
    /// place. Predicts the best places with all modes together. Runs the best candidates again as cases of their own.
    /// The [improve] section limits what may be changed and by how much.
    Improve(RunOptions): studies::improve,
    Mac(mac::Arguments): mac::run,
    /// Draw and measure the mesh alone
    Mesh(RunOptions): mesh::run,
    Matrices(matrices::Arguments): matrices::run,
    Check(check::Arguments): check::run,
    Init(init::Arguments): init::run,
    Keys(keys::Arguments): keys::run,
    Columns(columns::Arguments): columns::run,
    Fit(fit::Arguments): fit::run,
    /// Frequency response between two nodes
    ///
    /// Writes frf.csv, which `frictionsim identify` reads. Compare it with a hammer test, or check identification
    /// against a known damping. Needs a section `[frf]`.
    Frf(RunOptions): studies::frf,
    Identify(identify::Arguments): identify::run,
    Signal(signal::Arguments): signal::run,
    Uncertainty(uncertainty::Arguments): uncertainty::run,
    Completions(completions::Arguments): completions::run,
    Man(man::Arguments): man::run,
}

/// Commands by what they are for, in the order of the help; all others are under "Help".
const GROUPS: &[(&str, &[&str])] = &[
    ("Analyse", &["cea", "transient", "cycle", "frf"]),
    ("Study", &["sweep", "collect", "convergence", "uncertainty", "basin"]),
    ("Design", &["improve"]),
    ("Measure", &["identify", "fit", "mac", "signal"]),
    ("Inspect", &["check", "mesh", "plot", "compare", "matrices"]),
];

/// The help of the whole program, with the commands in groups.
fn help_template(command: &clap::Command) -> String {
    let named = |name: &str| GROUPS.iter().any(|(_, names)| names.contains(&name));
    let all: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
    let others: Vec<&str> = all.into_iter().filter(|name| !named(name)).collect();
    let mut text = "{before-help}{about-with-newline}\n{usage-heading} {usage}\n".to_owned();
    let groups = GROUPS.iter().map(|&(title, names)| (title, names));
    for (title, names) in groups.chain([("Help", &others[..])]) {
        text.push_str(&format!("\n{title}:\n"));
        for sub in names.iter().filter_map(|name| command.find_subcommand(name)) {
            let about = sub.get_about().map(ToString::to_string).unwrap_or_default();
            text.push_str(&format!("  {:<11}  {about}\n", sub.get_name()));
        }
    }
    text + "  help         Print this message or the help of a command\n\nOptions:\n{options}{after-help}"
}

/// The command line with what its declarations cannot say: its help in groups, each command's own default folder.
pub fn command_line() -> clap::Command {
    let command = CommandLine::command();
    let template = help_template(&command);
    command.help_template(template).mut_subcommands(|sub| {
        let sub = with_common_options(sub);
        let name = sub.get_name().to_owned();
        let positional = sub.get_positionals().next();
        let input = positional.and_then(|arg| arg.get_value_names()?.first().cloned());
        let has_folder = sub.get_arguments().any(|arg| arg.get_id() == "dry_run");
        match input {
            Some(input) if has_folder => sub.mut_arg("out", |arg| {
                let stem = input.split('.').next().unwrap_or_default();
                let own = if name == "compare" { [&name, "DIR-and-DIR"] } else { [stem, &name] };
                arg.help(format!("Output folder [default: results/{}]", own.join("/")))
            }),
            _ => sub,
        }
    })
}

/// A command with the options that every command takes: one that has no use for an option takes it all the same.
fn with_common_options(command: clap::Command) -> clap::Command {
    let count = |name: &'static str, short: char| {
        Arg::new(name).long(name).short(short).action(ArgAction::Count)
    };
    let common = [
        Arg::new("threads")
            .long("threads")
            .value_name("N")
            .value_parser(clap::value_parser!(u16).range(1..))
            .help("Worker threads [default: all cores]"),
        Arg::new("simd")
            .long("simd")
            .value_name("LEVEL")
            .value_parser(one_of(&SIMD_LEVELS))
            .help("SIMD level of the kernels"),
        count("quiet", 'q').help("No progress bar and no information messages"),
        count("verbose", 'v').conflicts_with("quiet").help("Full tables and progress messages"),
    ];
    // What has nothing to do in a command that writes or draws nothing.
    let idle: &[_] = match command.get_name() {
        "check" => &["force", "no-figures", "out"],
        "plot" => &["force"],
        _ => &["force", "no-figures"],
    };
    let idle = idle.iter().map(|name| {
        let action = if *name == "out" { ArgAction::Set } else { ArgAction::SetTrue };
        Arg::new(*name).long(*name).action(action).hide(true)
    });
    let is_missing = |arg: &Arg| command.get_arguments().all(|a| a.get_long() != arg.get_long());
    let common = common.into_iter().map(|arg| arg.hide_short_help(true));
    let missing: Vec<Arg> = common.chain(idle).filter(is_missing).collect();
    command.args(missing)
}

/// Moves options that stand before the subcommand behind it, where they are declared.
fn options_behind_subcommand(command: &clap::Command, mut given: Vec<OsString>) -> Vec<OsString> {
    let takes_value = |option: &str| {
        let all = command.get_subcommands().flat_map(clap::Command::get_arguments);
        all.filter(|arg| arg.get_action().takes_values()).any(|arg| {
            let long = arg.get_long().is_some_and(|long| option == format!("--{long}"));
            long || arg.get_short().is_some_and(|short| option == format!("-{short}"))
        })
    };
    let mut at = 1;
    while let Some(option) = given.get(at).and_then(|text| text.to_str()) {
        if !option.starts_with('-') || option == "-" {
            break;
        }
        if ["-h", "--help", "-V", "--version", "--"].contains(&option) {
            return given;
        }
        at += 1 + usize::from(takes_value(option));
    }
    if at < given.len() {
        let subcommand = given.remove(at);
        given.insert(1, subcommand);
    }
    given
}

/// Stack of the thread that runs a command, bytes.
const STACK: usize = 16 << 20;
/// Exit code of a process that panicked.
const PANICKED: u8 = 101;

/// Parses the command line, runs the subcommand and turns its outcome into an exit code: 0 done,
/// 1 the run failed, 2 bad usage or case, 130 interrupted.
pub fn main() -> ExitCode {
    // A thread of its own, as its stack does not depend on the shell's `ulimit -s`.
    let run = || run_arguments(std::env::args_os().collect());
    let thread = std::thread::Builder::new().name("main".to_owned()).stack_size(STACK);
    let code = match thread.spawn(run) {
        Ok(running) => running.join().unwrap_or(PANICKED),
        Err(_) => run(),
    };
    ExitCode::from(code)
}

/// As [`main`], for arguments given by another program, the name of the program first; gives the exit code.
pub fn run_arguments(given: Vec<OsString>) -> u8 {
    let command = command_line();
    let given = options_behind_subcommand(&command, given);
    let parsed = command.clone().try_get_matches_from(given).and_then(|found| {
        let threads = found.subcommand().and_then(|own| own.1.try_get_one("threads").ok()?);
        if let Some(threads) = threads {
            start_threads(Some(*threads));
        }
        CommandLine::from_arg_matches(&found)
    });
    let parsed = match parsed {
        Ok(parsed) => parsed,
        Err(error) => return terminal::report_usage(&error),
    };
    limits::refuse_writes_beyond_limit();
    parsed.command.run().map_or_else(|failure| terminal::report(&failure), |()| 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_may_stand_before_the_subcommand() {
        let command = command_line();
        command.clone().debug_assert();
        let moved = |line: &str| {
            let given = line.split(' ').map(OsString::from).collect();
            let moved = options_behind_subcommand(&command, given);
            let texts: Vec<_> = moved.iter().map(|text| text.to_string_lossy()).collect();
            texts.join(" ")
        };
        for (given, behind) in [
            ("f -q --set a.b=1 cea x.toml", "f cea -q --set a.b=1 x.toml"),
            ("f -o out --json mesh -", "f mesh -o out --json -"),
            ("f --help", "f --help"),
            ("f cea -q", "f cea -q"),
        ] {
            assert_eq!(moved(given), behind);
        }
    }
}
