//! `frictionsim completions`: a shell's completion script.

use super::CommandLine;
use super::prelude::*;
use clap::CommandFactory;
use clap_complete::Shell;

/// Print a shell completion script
#[derive(Args)]
pub struct Arguments {
    /// Shell
    shell: Shell,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    let mut script = Vec::new();
    let mut command = CommandLine::command();
    clap_complete::generate(asked.shell, &mut command, "frictionsim", &mut script);
    terminal::print(&String::from_utf8_lossy(&script))
}
