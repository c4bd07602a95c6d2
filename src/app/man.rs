//! `frictionsim man`: manual pages.

use super::{CommandLine, Failure, terminal};
use clap::{Args, CommandFactory, ValueHint};
use std::path::PathBuf;

/// Print the manual page, or write those of all subcommands
#[derive(Args)]
pub struct Arguments {
    /// Write frictionsim.1 and one page for each subcommand there
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    out: Option<PathBuf>,
}

/// Runs the subcommand.
///
/// # Errors
/// Those of stdout, or of the folder.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let command = CommandLine::command();
    let Some(folder) = &arguments.out else {
        let mut page = Vec::new();
        clap_mangen::Man::new(command).render(&mut page)?;
        return terminal::print(&String::from_utf8_lossy(&page));
    };
    std::fs::create_dir_all(folder)
        .and_then(|()| clap_mangen::generate_to(command, folder))
        .map_err(|error| Failure::run(format!("cannot write {}: {error}", folder.display())))
}
