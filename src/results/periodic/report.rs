//! `report.html` of the limit cycles of a body without symmetry.

use super::figures::{PeriodicFigures, draw_cycles};
use crate::results::cycle_table::{CycleColumn, branch_sentence, cycle_results, cycle_table};
use crate::results::drawing::{DrawingError, DrawingOptions, write_report};
use crate::results::extent::Extent;
use crate::results::folder::OutputFolder;
use crate::results::manifest::Manifest;
use crate::results::report::{Report, ReportSection, entries};
use serde::Deserialize;
use serde_json::Value;

/// Draws every figure of the cycles into `figures/` and writes `report.html`.
///
/// # Errors
/// Those of the folder; a figure that cannot be drawn although there is something to draw.
pub fn draw(
    folder: &OutputFolder,
    data: &PeriodicFigures<'_>,
    summary: &Value,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let mut report = html_report(summary, folder.manifest());
    report.sections[1].figures = draw_cycles(data, options)?;
    write_report(folder, &report, options)
}

/// The report without figures.
fn html_report(summary: &Value, manifest: &Manifest) -> Report {
    let cycles = entries(summary, "cycles");
    let extent = Extent::deserialize(&summary["extent"]).unwrap_or_default();
    let first = match summary["steady_sliding_stable"].as_bool() {
        Some(true) if !cycles.is_empty() => {
            "Steady sliding is stable; beside it live motions of the whole body that repeat themselves, each from a mode that grows \
             at another value of the parameter."
        }
        Some(true) => "Steady sliding is stable: no limit cycle is born from it.",
        _ => "Motions of the whole body that repeat themselves, each born from a mode that grows.",
    };
    let mut paragraphs = vec![first.to_owned()];
    paragraphs.extend(extent.note().map(|note| format!("{note}.")));
    let rows = cycles.iter().flat_map(|cycle| results(cycle, extent));
    let rows = rows.collect();
    let figures = ReportSection::new("Limit cycles")
        .with_paragraphs(cycles.iter().filter_map(branch_sentence))
        .with_tables([cycle_table(cycles, extent, &COLUMNS, &absence)]);
    Report {
        title: summary["title"].as_str().unwrap_or_default().to_owned(),
        sections: vec![ReportSection::results(paragraphs, rows), figures],
        manifest: manifest.clone(),
    }
}

/// What decides of one cycle.
fn results(cycle: &Value, extent: Extent) -> Vec<(String, String)> {
    let name = format!("mode {}", cycle["mode"]);
    match absence(cycle) {
        reason if reason.is_empty() => cycle_results(&name, cycle, extent),
        reason => vec![(name, reason)],
    }
}

/// Columns of a periodic motion.
const COLUMNS: [CycleColumn; 4] = [
    ("mode", "/mode", 1.0, 0),
    ("its frequency (Hz)", "/mode_frequency_hz", 1.0, 2),
    ("its growth rate (1/s)", "/growth_rate_per_s", 1.0, 1),
    ("amplitude (µm)", "/amplitude_m", 1e6, 3),
];

/// Why there is no cycle of its own; empty where there is one.
fn absence(cycle: &Value) -> String {
    match (cycle["error"].as_str(), cycle["same_as"].as_u64()) {
        (Some(error), _) => error.to_owned(),
        (None, Some(other)) => format!("the cycle of mode {other}"),
        (None, None) => String::new(),
    }
}
