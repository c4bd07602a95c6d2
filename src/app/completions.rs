//! `frictionsim completions`: a shell's completion script.

use super::{CommandLine, Failure, Run, terminal};
use clap::{Args, CommandFactory};
use clap_complete::Shell;

/// Print a shell completion script
#[derive(Args)]
pub struct Arguments {
    /// Shell
    shell: Shell,
}

impl Run for Arguments {
    fn run(&self) -> Result<(), Failure> {
        let mut script = Vec::new();
        let mut command = CommandLine::command();
        clap_complete::generate(self.shell, &mut command, "frictionsim", &mut script);
        terminal::print(&String::from_utf8_lossy(&script))
    }
}
