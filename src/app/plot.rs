//! `frictionsim plot`: the figures of a results folder once more.

use super::session::start_threads;
use super::{Failure, cea, collect, cycle, terminal, transient};
use crate::case::{Case, RawCase};
use crate::results::{
    DOTS_PER_INCH, FolderError, Manifest, OutputFolder, read_manifest, read_summary,
};
use clap::{Args, ValueHint};
use std::path::PathBuf;

/// Draw the figures of a results folder again: cea, transient, sweep
///
/// Writes figures/*.svg, figures/*.png and report.html, the same bytes that the run itself draws, and
/// leaves every other file as it is. A transient is drawn from its record.bin and a sweep from its
/// points; the eigenvalues of a cea are solved again from the case in manifest.json.
#[derive(Args)]
pub struct Arguments {
    /// Results folder
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    folder: PathBuf,
    /// Resolution of the PNG files, dots per inch
    #[arg(long, value_name = "DPI", default_value_t = DOTS_PER_INCH, value_parser = resolution)]
    dpi: f64,
    /// Worker threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// No progress, no log but errors
    #[arg(long, short)]
    quiet: bool,
}

fn resolution(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(dpi) if (20.0..=1200.0).contains(&dpi) => Ok(dpi),
        _ => Err("20 to 1200 dots per inch".to_owned()),
    }
}

/// Runs the subcommand.
///
/// # Errors
/// A folder that holds no finished run of these commands, or that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    terminal::start_log(arguments.quiet);
    start_threads(arguments.threads);
    let path = &arguments.folder;
    let manifest = read_manifest(path)?;
    let case = recorded_case(&manifest)?;
    if manifest.version != env!("CARGO_PKG_VERSION") {
        tracing::warn!(
            "{} was written by version {}: figures of this version may differ from its tables",
            path.display(),
            manifest.version
        );
    }
    match manifest.command.as_str() {
        "cea" => {
            let summary = read_summary(path)?;
            let folder = OutputFolder::reopen(path)?;
            cea::redraw(&folder, &case, &summary, arguments.dpi)?;
            folder.finish()?;
        }
        "transient" => {
            let summary = read_summary(path)?;
            let folder = OutputFolder::reopen(path)?;
            transient::redraw(&folder, &case, &summary, arguments.dpi)?;
            folder.finish()?;
        }
        "cycle" => {
            let summary = read_summary(path)?;
            let folder = OutputFolder::reopen(path)?;
            cycle::redraw(&folder, &case, &summary, arguments.dpi)?;
            folder.finish()?;
        }
        "sweep" => collect::redraw(path, arguments.dpi)?,
        other => {
            let reason = format!(
                "it belongs to frictionsim {other}, which draws its own when it runs; plot draws those of \
                 cea, transient and sweep"
            );
            let path = path.clone();
            return Err(FolderError::NotResults { path, reason }.into());
        }
    }
    let figures = path.join("figures");
    terminal::print(&format!("figures in {}\n", figures.display()))
}

/// The case that a manifest records, overrides included.
///
/// # Errors
/// Those of the case, if the manifest was edited.
pub fn recorded_case(manifest: &Manifest) -> Result<Case, Failure> {
    let text = manifest.case_text.as_bytes();
    let raw = RawCase::parse(&manifest.case_file, text, &manifest.overrides)?;
    Ok(Case::from_raw(raw)?)
}
