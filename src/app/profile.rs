//! Description of a subcommand: what it writes, its examples, how its figures are drawn again.

use super::Failure;
use crate::case::Case;
use crate::results::{DrawingOptions, Finding, OutputFolder, draw_finding, read_summary};
use std::path::Path;

/// What the declarations of a subcommand do not say.
pub struct Profile {
    /// Name and contents of what it writes, relative to its output folder.
    pub files: &'static [(&'static str, &'static str)],
    /// Command lines and what they are for.
    pub examples: &'static [(&'static str, &'static str)],
    /// How its figures are drawn again.
    pub redraw: Redraw,
}

impl Profile {
    /// Of a command that tells everything in its help.
    pub const NONE: Self = Self { files: &[], examples: &[], redraw: Redraw::Nothing };
}

/// How `frictionsim plot` draws a folder of results again.
pub enum Redraw {
    /// The command draws nothing to repeat.
    Nothing,
    /// From the folder alone.
    OfFolder(fn(&OutputFolder, &DrawingOptions) -> Result<(), Failure>),
    /// From the folder and the case that it records.
    OfCase(fn(&OutputFolder, &Case, &DrawingOptions) -> Result<(), Failure>),
    /// From the points of a folder with its own lock and list of files.
    OfPoints(fn(&Path, &DrawingOptions) -> Result<(), Failure>),
}

/// Draws the figures and the page of a folder from its summary.
///
/// # Errors
/// A folder without a whole summary; those of the folder.
pub fn redraw<T: Finding>(folder: &OutputFolder, options: &DrawingOptions) -> Result<(), Failure> {
    let finding: T = read_summary(folder.path())?;
    Ok(draw_finding(folder, &finding, options)?)
}
