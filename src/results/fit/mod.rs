//! Results of a fit to measured modes: tables, figure, report.

mod figures;
mod report;
mod summary;

pub use report::draw_report;
pub use summary::{FitSummary, FittedParameter, LineSummary, ModeSummary, SearchSummary};

use super::summary::write_summary;
use super::table::{Table, format_number};
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
    let columns = [
        "line",
        "frequency_hz",
        "real_hz",
        "harmonic",
        "model_harmonic",
        "model_branch",
        "model_direction",
        "model_frequency_hz",
        "model_real_hz",
        "difference_hz",
        "difference_percent",
        "real_difference_hz",
    ];
    let optional = |value: Option<f64>| value.map_or_else(String::new, format_number);
    let count = |value: Option<usize>| value.map_or_else(String::new, |n| n.to_string());
    folder.write("fit.csv", |out| {
        let mut table = Table::new(out, &columns)?;
        for line in &summary.residuals {
            table.row([
                line.line.to_string(),
                format_number(line.frequency_hz),
                optional(line.real_hz),
                count(line.harmonic),
                count(line.mode.harmonic),
                line.mode.branch.to_string(),
                line.mode.direction.to_string(),
                format_number(line.mode.frequency_hz),
                format_number(line.mode.real_hz),
                format_number(line.difference_hz),
                format_number(line.difference_percent),
                optional(line.real_difference_hz),
            ])?;
        }
        table.finish()
    })?;
    let columns = [
        "harmonic",
        "branch",
        "direction",
        "frequency_hz",
        "real_hz",
        "unstable",
    ];
    folder.write("modes.csv", |out| {
        let mut table = Table::new(out, &columns)?;
        for mode in &summary.modes {
            table.row([
                count(mode.harmonic),
                mode.branch.to_string(),
                mode.direction.to_string(),
                format_number(mode.frequency_hz),
                format_number(mode.real_hz),
                u8::from(mode.is_unstable()).to_string(),
            ])?;
        }
        table.finish()
    })?;
    folder.write(BLOCK, |out| out.write_all(summary.block().as_bytes()))?;
    write_summary(folder, summary)
}
