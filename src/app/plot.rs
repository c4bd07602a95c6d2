//! `frictionsim plot`: the figures of a results folder once more.

use super::options::FigureOptions;
use super::{Failure, start_threads, terminal};
use crate::results::sweep::SweepFolder;
use crate::results::{
    DrawingOptions, FolderError, Manifest, OutputFolder, Page, Record, read_manifest, read_record,
    read_summary,
};
use clap::{ArgAction, Args, ValueHint};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

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
    /// Print the folder and the names of its figures as one object on stdout
    #[arg(long)]
    json: bool,
    /// Worker threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// No information; twice: errors only
    #[arg(long, short, action = ArgAction::Count)]
    quiet: u8,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    terminal::start_log(asked.quiet, 0);
    start_threads(asked.threads);
    let path = &asked.folder;
    let manifest = read_manifest(path)?;
    if manifest.version != env!("CARGO_PKG_VERSION") {
        tracing::warn!(
            "{} was written by version {}: figures of this version may differ from its tables",
            path.display(),
            manifest.version
        );
    }
    let options = asked.figures.drawing();
    let names = redraw(path, &manifest, &options)?;
    if asked.json {
        return terminal::print_json(
            &json!({ "command": "plot", "folder": path, "figures": names }),
        );
    }
    let figures = path.join("figures");
    match asked.quiet {
        0 | 1 => terminal::print(&format!("figures in {}\n", figures.display())),
        _ => Ok(()),
    }
}

/// Draws the page that a folder keeps as data; gives the names of its figures.
///
/// # Errors
/// A folder without figures; those of the drawing and of the folder.
pub fn redraw(
    path: &Path,
    manifest: &Manifest,
    options: &DrawingOptions,
) -> Result<Vec<String>, Failure> {
    if !path.join(Page::FILE).exists() {
        let reason = format!("it has no {}: run it again, with figures", Page::FILE);
        return Err(FolderError::no_results(path, reason).into());
    }
    let page: Page = read_record(path)?;
    let names = page.figures.iter().map(|figure| figure.name.clone()).collect();
    if let command @ ("sweep" | "uncertainty") = manifest.command.as_str() {
        page.draw(SweepFolder::find(path, command)?.output(), options)?;
        return Ok(names);
    }
    // A run that is not finished has no summary.
    let _: Value = read_summary(path)?;
    let folder = OutputFolder::reopen(path)?;
    page.draw(&folder, options)?;
    folder.finish()?;
    Ok(names)
}
