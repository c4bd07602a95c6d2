//! `report.html` of limit cycles: figures, cycles, branches.

use super::{CycleFigures, NamedFamily, draw_branches, draw_cycles};
use crate::chart::extremes;
use crate::results::cycle_table::{CycleColumn, cycle_results, cycle_table};
use crate::results::drawing::{DrawingError, DrawingOptions, write_report};
use crate::results::extent::Extent;
use crate::results::folder::OutputFolder;
use crate::results::manifest::Manifest;
use crate::results::report::{Report, ReportSection, entries, number};
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
    let figures = ReportSection::new("Limit cycles")
        .with_tables([cycle_table(cycles, extent, &COLUMNS, &absence)]);
    let rows = cycles.iter().flat_map(|cycle| results(cycle, extent));
    let rows = rows.collect();
    let mut sections = vec![ReportSection::results(paragraphs, rows), figures];
    let branches: Vec<String> = cycles.iter().filter_map(branch_text).collect();
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

fn branch_text(cycle: &Value) -> Option<String> {
    let branch = cycle.get("branch")?;
    let text = |pointer: &str| branch.pointer(pointer).and_then(Value::as_str).unwrap_or("?");
    let folds = entries(branch, "folds").iter();
    let folds: Vec<f64> = folds.filter_map(Value::as_f64).collect();
    // Any parameter, of any size.
    let text_of = |value: f64| {
        format!("{value:.6e}").parse::<f64>().map_or_else(|_| String::new(), |v| format!("{v:?}"))
    };
    let (low, high) = extremes(folds.iter().copied());
    let folds = match folds.len() {
        0 => "no fold".to_owned(),
        1 => format!("a fold at {}", text_of(low)),
        count => format!("{count} folds between {} and {}", text_of(low), text_of(high)),
    };
    let saturation = match branch["saturation_speed_rpm"].as_f64() {
        Some(speed) => format!("; no point sticks above {speed:.1} rpm"),
        None => String::new(),
    };
    let changes = branch["stability_changes"].as_array();
    let changes: Vec<String> = changes
        .into_iter()
        .flatten()
        .map(|change| {
            let at = text_of(number(change, "/at").unwrap_or(f64::NAN));
            format!("{at} ({} nodal diameters)", change["harmonic"])
        })
        .collect();
    let changes = match changes.is_empty() {
        true => String::new(),
        false => format!("; stability changes at {}", changes.join(", ")),
    };
    Some(format!(
        "n = {}, onset {}: {} cycles over {}, at the one end until {}, at the other until {}; {folds}{saturation}{changes}.",
        cycle["harmonic"],
        cycle["onset"],
        branch["cycles"],
        text("/key"),
        text("/ends/0"),
        text("/ends/1"),
    ))
}
