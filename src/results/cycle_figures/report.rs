//! `report.html` of limit cycles: figures, cycles, branches.

use super::{CycleFigures, NamedFamily, draw_branches, draw_cycles};
use crate::results::cycle_table::{CycleColumn, branch_sentence, cycle_results, cycle_table};
use crate::results::drawing::{DrawingError, DrawingOptions, write_report};
use crate::results::extent::Extent;
use crate::results::folder::OutputFolder;
use crate::results::manifest::Manifest;
use crate::results::quantity::significant;
use crate::results::report::{Report, ReportSection, ReportTable, cell, entries};
use serde::Deserialize;
use serde_json::Value;

/// Draws every figure of the cycles into `figures/`, each as SVG and PNG, and writes `report.html`.
///
/// # Errors
/// Those of the folder; a figure that cannot be drawn although there is something to draw.
pub fn draw(
    folder: &OutputFolder,
    data: &CycleFigures<'_>,
    summary: &Value,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let mut report = html_report(summary, folder.manifest());
    report.sections[1].figures = draw_cycles(data, options)?;
    if let Some(branches) = report.sections.get_mut(2) {
        let families = data.record.families.iter();
        let families: Vec<NamedFamily<'_>> = families.map(|f| (String::new(), f)).collect();
        branches.figures = draw_branches(&families, &data.record.two_waves, options)?;
    }
    write_report(folder, &report, options)
}

/// The report without figures: the cycles, and the branches where the summary has any.
fn html_report(summary: &Value, manifest: &Manifest) -> Report {
    let cycles = entries(summary, "cycles");
    let extent = Extent::deserialize(&summary["extent"]).unwrap_or_default();
    let mut paragraphs =
        vec!["Waves that turn against the rotor without changing their shape.".to_owned()];
    paragraphs.extend(extent.note().map(|note| format!("{note}.")));
    let pairs = entries(summary, "two_waves");
    let together = (!pairs.is_empty()).then(|| two_wave_table(pairs));
    let figures = ReportSection::new("Limit cycles").with_tables(
        std::iter::once(cycle_table(cycles, extent, &COLUMNS, &absence)).chain(together),
    );
    let rows = cycles.iter().flat_map(|cycle| results(cycle, extent));
    let rows = rows.collect();
    let mut sections = vec![ReportSection::results(paragraphs, rows), figures];
    let branches: Vec<String> = cycles.iter().filter_map(branch_sentence).collect();
    if !branches.is_empty() {
        sections.push(ReportSection::new("Branches").with_paragraphs(branches));
    }
    Report {
        title: summary["title"].as_str().unwrap_or_default().to_owned(),
        sections,
        manifest: manifest.clone(),
    }
}

/// What decides of one cycle.
fn results(cycle: &Value, extent: Extent) -> Vec<(String, String)> {
    let name = format!("n = {}, onset {}", cycle["harmonic"], cycle["onset"]);
    match cycle["error"].as_str() {
        Some(error) => vec![(name, error.to_owned())],
        None => cycle_results(&name, cycle, extent),
    }
}

/// Columns of a rotating wave.
const COLUMNS: [CycleColumn; 4] = [
    ("harmonic n", "/harmonic", 1.0, 0),
    ("phases", "/phases", 1.0, 0),
    ("onset", "/onset", 1.0, 0),
    ("critical friction", "/critical_friction", 1.0, 5),
];

/// Why there is no cycle.
fn absence(cycle: &Value) -> String {
    cycle["error"].as_str().unwrap_or_default().to_owned()
}

/// Motions of two waves that live together, one row each.
fn two_wave_table(pairs: &[Value]) -> ReportTable {
    let columns = [
        ("first frequency (Hz)", "/frequencies_hz/0", 1.0, 2),
        ("second frequency (Hz)", "/frequencies_hz/1", 1.0, 2),
        ("first amplitude (µm)", "/amplitudes_m/0", 1e6, 3),
        ("second amplitude (µm)", "/amplitudes_m/1", 1e6, 3),
        ("stick (%)", "/status/0", 100.0, 1),
        ("slip (%)", "/status/1", 100.0, 1),
        ("open (%)", "/status/2", 100.0, 1),
        ("power of the rotor", "/external_w", 1.0, 2),
        ("transient from it, first (Hz)", "/transient_frequencies_hz/0", 1.0, 2),
        ("second (Hz)", "/transient_frequencies_hz/1", 1.0, 2),
    ];
    let rows = pairs.iter().map(|pair| {
        let name = format!("n = {} and {} together", pair["harmonics"][0], pair["harmonics"][1]);
        let cells = columns.iter();
        let cells = cells.map(|(_, place, factor, digits)| cell(pair, place, *factor, *digits));
        let births = entries(pair, "births").iter().filter_map(Value::as_f64);
        let births: Vec<String> = births.map(|value| significant(value, 5)).collect();
        let reason = pair["error"].as_str().unwrap_or_default().to_owned();
        std::iter::once(name).chain(cells).chain([births.join(", "), reason]).collect()
    });
    let names = columns.iter().map(|column| column.0);
    ReportTable::new(
        "Motions of two frequencies",
        std::iter::once("waves").chain(names).chain(["one wave alone at", "why there is none"]),
        rows,
    )
}
