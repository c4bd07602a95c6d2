//! The command line: one file for each subcommand.

pub mod cea;
mod check;
mod collect;
mod completions;
mod convergence;
pub mod cycle;
mod failure;
mod figure_options;
mod frf;
mod identify;
mod init;
mod keys;
mod linear_stage;
mod man;
mod measurement;
mod mesh;
mod options;
mod plot;
mod session;
mod signal;
pub mod sweep;
pub mod terminal;
pub mod transient;

pub use failure::Failure;
pub use options::{RunOptions, SimdChoice};
pub use session::Session;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Stability and transient analysis of frictional contact by finite elements.
///
/// A deformable disc, clamped at its outer edge, is pressed from inside by a rotating rigid
/// cylinder. `frictionsim init` writes a case to start from.
#[derive(Parser)]
#[command(
    name = "frictionsim",
    version,
    max_term_width = 100,
    arg_required_else_help = true
)]
#[command(after_help = "Exit codes: 0 done, 1 the run failed, 2 bad usage or case.")]
pub struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Cea(cea::Arguments),
    Transient(transient::Arguments),
    Sweep(sweep::Arguments),
    Collect(collect::Arguments),
    Plot(plot::Arguments),
    Cycle(cycle::Arguments),
    Convergence(convergence::Arguments),
    Mesh(mesh::Arguments),
    Check(check::Arguments),
    Init(init::Arguments),
    Keys(keys::Arguments),
    Frf(frf::Arguments),
    Identify(identify::Arguments),
    Signal(signal::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

/// Parses the command line, runs the subcommand and turns its outcome into an exit code: 0 done,
/// 1 the run failed, 2 bad usage or case.
pub fn main() -> ExitCode {
    let outcome = match CommandLine::parse().command {
        Command::Cea(arguments) => cea::run(&arguments),
        Command::Transient(arguments) => transient::run(&arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::Collect(arguments) => collect::run(&arguments),
        Command::Plot(arguments) => plot::run(&arguments),
        Command::Cycle(arguments) => cycle::run(&arguments),
        Command::Convergence(arguments) => convergence::run(&arguments),
        Command::Mesh(arguments) => mesh::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Init(arguments) => init::run(&arguments),
        Command::Keys(arguments) => keys::run(&arguments),
        Command::Frf(arguments) => frf::run(&arguments),
        Command::Identify(arguments) => identify::run(&arguments),
        Command::Signal(arguments) => signal::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments),
        Command::Man(arguments) => man::run(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
