//! `frictionsim plot`: the figures of a results folder once more.

use super::figure_options::FigureOptions;
use super::profile::{Profile, Redraw};
use super::recorded_case::recorded_case;
use super::session::start_threads;
use super::{Failure, profile, terminal};
use crate::results::{
    DrawingOptions, FolderError, Manifest, OutputFolder, read_manifest, read_summary,
};
use clap::{ArgAction, Args, ValueHint};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Draw the figures of a results folder again
///
/// Writes the figures and report.html to the same bytes as the run, and leaves every other file as it is. A sweep is drawn
/// from its points, an frf from its table, all others from their record.bin. A cea is solved again from the case in
/// manifest.json.
#[derive(Args)]
pub struct Arguments {
    /// Results folder
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    folder: PathBuf,
    #[command(flatten)]
    figures: FigureOptions,
    /// Worker threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// No information; twice: errors only
    #[arg(long, short, action = ArgAction::Count)]
    quiet: u8,
}

/// What the rest of the program asks of this command.
pub const PROFILE: Profile = Profile {
    files: &[("figures/*.svg, figures/*.png", "the figures, drawn again")],
    examples: &[("frictionsim plot results/disc/cea --dpi 300", "for print")],
    redraw: Redraw::Nothing,
};

/// Runs the subcommand.
///
/// # Errors
/// A folder that holds no finished run of these commands, or that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    terminal::start_log(arguments.quiet, 0);
    start_threads(arguments.threads);
    let path = &arguments.folder;
    let manifest = read_manifest(path)?;
    if manifest.version != env!("CARGO_PKG_VERSION") {
        tracing::warn!(
            "{} was written by version {}: figures of this version may differ from its tables",
            path.display(),
            manifest.version
        );
    }
    let options = arguments.figures.drawing();
    redraw(path, &manifest, &options)?;
    let figures = path.join("figures");
    match arguments.quiet {
        0 | 1 => terminal::print(&format!("figures in {}\n", figures.display())),
        _ => Ok(()),
    }
}

/// Draws the figures of a folder as its command does.
///
/// # Errors
/// As [`run`].
pub fn redraw(path: &Path, manifest: &Manifest, options: &DrawingOptions) -> Result<(), Failure> {
    let command = manifest.command.as_str();
    let redraw = profile(command).map_or(&Redraw::Nothing, |profile| &profile.redraw);
    match redraw {
        Redraw::Nothing => {
            let reason =
                format!("it belongs to frictionsim {command}, which has no figures to draw again");
            let path = path.to_owned();
            return Err(FolderError::NotResults { path, reason }.into());
        }
        Redraw::OfPoints(redraw) => return redraw(path, options),
        Redraw::OfFolder(_) | Redraw::OfCase(_) => {}
    }
    // A run that is not finished has no summary.
    let _: Value = read_summary(path)?;
    let folder = OutputFolder::reopen(path)?;
    match redraw {
        Redraw::OfFolder(redraw) => redraw(&folder, options)?,
        Redraw::OfCase(redraw) => redraw(&folder, &recorded_case(path, manifest)?, options)?,
        Redraw::Nothing | Redraw::OfPoints(_) => {}
    }
    Ok(folder.finish()?)
}
