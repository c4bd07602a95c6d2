//! `frictionsim plot`: the figures of a results folder once more.

use super::options::FigureOptions;
use super::prelude::*;
use crate::results::sweep::SweepFolder;
use crate::results::{DrawingOptions, Page, read_manifest, read_record, read_summary};
use clap::ArgAction;

/// Draw the figures of a results folder again
///
/// Draws figures.bin, which keeps what the run has drawn, to the same bytes or in another size, and report.html. Leaves
/// every other file as it is.
#[derive(Args)]
pub struct Arguments {
    /// Results folder
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    folder: PathBuf,
    #[command(flatten)]
    figures: FigureOptions,
    /// Print the folder as one object on stdout
    #[arg(long)]
    json: bool,
    /// No information messages; twice: errors only
    #[arg(long, short, action = ArgAction::Count)]
    quiet: u8,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    terminal::start_log(asked.quiet, 0);
    let path = &asked.folder;
    let manifest = read_manifest(path)?;
    if manifest.version != env!("CARGO_PKG_VERSION") {
        tracing::warn!(
            "{} was written by version {}: figures of this version may differ from its tables",
            path.display(),
            manifest.version
        );
    }
    redraw(path, &manifest, &asked.figures.drawing())?;
    let figures = path.join("figures");
    match asked.quiet {
        _ if asked.json => terminal::print_json(&json!({ "command": "plot", "figures": figures })),
        0 | 1 => terminal::print(&format!("figures in {}\n", figures.display())),
        _ => Ok(()),
    }
}

/// Draws the page that a folder keeps as data.
///
/// # Errors
/// A folder without figures; those of the drawing and of the folder.
pub fn redraw(path: &Path, manifest: &Manifest, options: &DrawingOptions) -> Result<(), Failure> {
    let page: Page = read_record(path)?;
    if let command @ ("sweep" | "uncertainty") = manifest.command.as_str() {
        return Ok(page.draw(SweepFolder::find(path, command)?.output(), options)?);
    }
    // A run that is not finished has no summary.
    let _: Value = read_summary(path)?;
    let folder = OutputFolder::reopen(path)?;
    page.draw(&folder, options)?;
    Ok(folder.finish()?)
}
