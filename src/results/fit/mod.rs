//! Results of a fit to measured modes: tables, figure, report.

mod figures;
mod report;
mod summary;

pub use report::draw_report;
pub use summary::{FitSummary, FittedParameter, LineSummary, ModeSummary, SearchSummary};

use super::summary::write_summary;
use super::table::{Column, write_rows};
use super::{FolderError, OutputFolder};
use serde_json::Value;

/// Name of the block of fitted values in its folder.
const BLOCK: &str = "fitted.toml";

/// Writes `fit.csv` (one row for each measured line), `modes.csv` (every mode of the fitted model), `fitted.toml` and
/// `summary.json`; returns the object of the summary.
///
/// # Errors
/// Those of the folder.
pub fn write(folder: &OutputFolder, summary: &FitSummary) -> Result<Value, FolderError> {
    let lines: &[Column<'_, &LineSummary>] = &[
        ("line", &|line| line.line.into()),
        ("frequency_hz", &|line| line.frequency_hz.into()),
        ("real_hz", &|line| line.real_hz.into()),
        ("harmonic", &|line| line.harmonic.into()),
        ("model_harmonic", &|line| line.mode.harmonic.into()),
        ("model_branch", &|line| line.mode.branch.into()),
        ("model_direction", &|line| line.mode.direction.into()),
        ("model_frequency_hz", &|line| line.mode.frequency_hz.into()),
        ("model_real_hz", &|line| line.mode.real_hz.into()),
        ("difference_hz", &|line| line.difference_hz.into()),
        ("difference_percent", &|line| line.difference_percent.into()),
        ("real_difference_hz", &|line| line.real_difference_hz.into()),
        ("mac", &|line| line.mac.into()),
    ];
    // The last where shapes were measured.
    let has_shapes = summary.residuals.iter().any(|line| line.mac.is_some());
    let lines = &lines[..lines.len() - usize::from(!has_shapes)];
    folder.write("fit.csv", |out| write_rows(out, lines, &summary.residuals))?;
    let modes: &[Column<'_, &ModeSummary>] = &[
        ("harmonic", &|mode| mode.harmonic.into()),
        ("branch", &|mode| mode.branch.into()),
        ("direction", &|mode| mode.direction.into()),
        ("frequency_hz", &|mode| mode.frequency_hz.into()),
        ("real_hz", &|mode| mode.real_hz.into()),
        ("unstable", &|mode| mode.is_unstable().into()),
    ];
    folder.write("modes.csv", |out| write_rows(out, modes, &summary.modes))?;
    folder.write(BLOCK, |out| out.write_all(summary.block().as_bytes()))?;
    write_summary(folder, summary)
}
