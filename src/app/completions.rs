//! `frictionsim completions`: a shell's completion script.

use super::profile::Profile;
use super::{CommandLine, Failure, terminal};
use clap::{Args, CommandFactory};
use clap_complete::Shell;

/// Print a shell completion script
#[derive(Args)]
pub struct Arguments {
    /// Shell
    shell: Shell,
}

/// What the rest of the program asks of this command.
pub const PROFILE: Profile = Profile::NONE;

/// Runs the subcommand.
///
/// # Errors
/// Those of stdout.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut script = Vec::new();
    let mut command = CommandLine::command();
    clap_complete::generate(arguments.shell, &mut command, "frictionsim", &mut script);
    terminal::print(&String::from_utf8_lossy(&script))
}
