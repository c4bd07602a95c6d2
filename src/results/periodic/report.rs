//! `report.html` of the limit cycles of a body without symmetry.

use super::figures::{PeriodicFigures, draw_cycles};
use crate::results::drawing::{DrawingError, DrawingOptions, write_report};
use crate::results::extent::Extent;
use crate::results::folder::OutputFolder;
use crate::results::manifest::Manifest;
use crate::results::quantity::quantity;
use crate::results::report::{Report, ReportSection, ReportTable, cell, entries, number};
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
        Some(true) => "Steady sliding is stable: no limit cycle is born from it.",
        _ => "Motions of the whole body that repeat themselves, each born from a mode that grows.",
    };
    let mut paragraphs = vec![first.to_owned()];
    paragraphs.extend(extent.note().map(|note| format!("{note}.")));
    let rows = cycles.iter().flat_map(|cycle| results(cycle, extent));
    let rows = rows.collect();
    let figures = ReportSection {
        heading: "Limit cycles".into(),
        tables: vec![cycle_table(cycles, extent)],
        ..ReportSection::default()
    };
    Report {
        title: summary["title"].as_str().unwrap_or_default().to_owned(),
        sections: vec![ReportSection::results(paragraphs, rows), figures],
        manifest: manifest.clone(),
    }
}

/// What decides of one cycle.
fn results(cycle: &Value, extent: Extent) -> Vec<(String, String)> {
    let name = format!("mode {}", cycle["mode"]);
    if let Some(error) = cycle["error"].as_str() {
        return vec![(name, error.to_owned())];
    }
    if let Some(other) = cycle["same_as"].as_u64() {
        return vec![(name, format!("the cycle of mode {other}"))];
    }
    let frequency = number(cycle, "/main_frequency_hz");
    let status = ["stick", "slip", "open"].map(|part| {
        let share = cell(cycle, &format!("/status/{part}"), 100.0, 1);
        format!("{part} {share} %")
    });
    let power = number(cycle, "/power_w/external").map(|power| {
        let number = quantity("power_w.external").number(power);
        format!("{number} {}", extent.unit("W"))
    });
    let verdict = cycle.pointer("/stability/verdict").and_then(Value::as_str);
    let rows = [
        (
            "main frequency",
            frequency.map(|value| quantity("main_frequency_hz").text(value)),
        ),
        ("contact", Some(status.join(", "))),
        ("power of the counterface", power),
        ("stability", verdict.map(str::to_owned)),
    ];
    let rows = rows.into_iter();
    rows.filter_map(|(what, value)| Some((format!("{name}: {what}"), value?)))
        .collect()
}

/// Columns of the table of cycles: name, place in the summary, factor, decimals.
const QUANTITIES: [(&str, &str, f64, usize); 16] = [
    ("mode", "/mode", 1.0, 0),
    ("its frequency (Hz)", "/mode_frequency_hz", 1.0, 2),
    ("its growth rate (1/s)", "/growth_rate_per_s", 1.0, 1),
    ("main frequency (Hz)", "/main_frequency_hz", 1.0, 2),
    ("amplitude (µm)", "/amplitude_m", 1e6, 3),
    ("stick (%)", "/status/stick", 100.0, 1),
    ("slip (%)", "/status/slip", 100.0, 1),
    ("open (%)", "/status/open", 100.0, 1),
    ("power of the counterface (W)", "/power_w/external", 1.0, 2),
    ("of it while sticking (W)", "/power_w/stick", 1.0, 2),
    ("while sliding (W)", "/power_w/slide", 1.0, 2),
    (
        "dissipated in the contact (W)",
        "/power_w/contact_dissipated",
        1.0,
        2,
    ),
    ("material damping (W)", "/power_w/material_damping", 1.0, 2),
    ("normal contact (W)", "/power_w/normal_contact", 1.0, 2),
    (
        "transient from it (Hz)",
        "/confirmation/main_frequency_hz",
        1.0,
        2,
    ),
    (
        "fastest growth of a perturbation (1/s)",
        "/stability/leading/growth_rate_per_s",
        1.0,
        1,
    ),
];

fn cycle_table(cycles: &[Value], extent: Extent) -> ReportTable {
    let rows = cycles.iter().map(|cycle| {
        let cells = QUANTITIES.iter();
        let cells =
            cells.map(|(_, pointer, factor, decimals)| cell(cycle, pointer, *factor, *decimals));
        let answer = |pointer: &str| match cycle.pointer(pointer).and_then(Value::as_bool) {
            Some(true) => "yes".to_owned(),
            Some(false) => "no".to_owned(),
            None => String::new(),
        };
        let answers = ["/stability/is_stable", "/confirmation/agrees"].map(answer);
        let why = match (cycle["error"].as_str(), cycle["same_as"].as_u64()) {
            (Some(error), _) => error.to_owned(),
            (None, Some(other)) => format!("the cycle of mode {other}"),
            (None, None) => String::new(),
        };
        cells.chain(answers).chain([why]).collect()
    });
    let watts = format!("({})", extent.unit("W"));
    let names = QUANTITIES.iter();
    let names = names.map(|quantity| quantity.0.replace("(W)", &watts));
    ReportTable {
        caption: "Limit cycles at the case's own operating point".into(),
        columns: names
            .chain(["stable", "a transient stays on it", "why there is none"].map(String::from))
            .collect(),
        rows: rows.collect(),
    }
}
