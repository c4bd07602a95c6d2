//! `report.html` of a transient: figures, limit cycle, growth.

use crate::results::drawing::{DrawingError, DrawingOptions, write_report};
use crate::results::folder::OutputFolder;
use crate::results::manifest::Manifest;
use crate::results::report::{Report, ReportSection, ReportTable, entries, number};
use crate::results::run_figures::{RunFigures, draw_run};
use serde_json::Value;

/// Draws every figure that the run has data for into `figures/`, each as SVG and PNG, and writes
/// `report.html`.
///
/// # Errors
/// Those of the folder; a figure that cannot be drawn although there is something to draw.
pub fn draw(
    folder: &OutputFolder,
    run: &RunFigures<'_>,
    summary: &Value,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let mut report = html_report(summary, run.growth_rates.as_slice(), folder.manifest());
    report.sections[0].figures = draw_run(run)?;
    write_report(folder, &report, options)
}

/// The report without figures, from the summary of the run; `predicted` are harmonics and growth rates
/// (1/s) of the eigenvalue analysis.
pub fn html_report(summary: &Value, predicted: &[(usize, f64)], manifest: &Manifest) -> Report {
    let title = summary["title"].as_str().unwrap_or_default();
    Report {
        title: title.to_owned(),
        sections: vec![
            ReportSection {
                heading: "Course of the run".into(),
                paragraphs: vec![course(summary)],
                tables: Vec::new(),
                figures: Vec::new(),
            },
            ReportSection {
                heading: "Limit cycle".into(),
                paragraphs: vec!["Means over the last fifth of the run.".into()],
                tables: vec![cycle_table(summary), growth_table(summary, predicted)],
                figures: Vec::new(),
            },
        ],
        manifest: manifest.clone(),
    }
}

fn course(summary: &Value) -> String {
    let text = |key: &str| summary[key].as_str().unwrap_or("?").to_owned();
    let scaled = |pointer: &str, factor: f64| number(summary, pointer).unwrap_or(f64::NAN) * factor;
    let end = match summary["finished"].as_bool() {
        Some(false) => "stopped before its end",
        _ => "complete",
    };
    let first = match number(summary, "/first_nonlinearity_s") {
        Some(time) => format!(
            "the first contact node sticks or opens at {:.3} ms",
            1e3 * time
        ),
        None => "there is no linear stage that ends in stick or separation".into(),
    };
    format!(
        "{:.3} ms in {} steps of {:.4} µs ({end}), from {}, {} operator, {:.1} s; {first}; the energy \
         balance closes to {:.1e}.",
        scaled("/end_time_s", 1e3),
        summary["steps"],
        scaled("/time_step_s", 1e6),
        text("initial"),
        text("operator"),
        scaled("/wall_s", 1.0),
        scaled("/max_balance_residual", 1.0),
    )
}

fn cycle_table(summary: &Value) -> ReportTable {
    let mut rows = Vec::new();
    let mut add = |name: &str, pointer: &str, factor: f64, decimals: usize| {
        if let Some(value) = number(summary, pointer) {
            rows.push(vec![
                name.to_owned(),
                format!("{:.decimals$}", value * factor),
            ]);
        }
    };
    add("main frequency (Hz)", "/main_frequency_hz", 1.0, 1);
    add("its harmonic n", "/main_harmonic", 1.0, 0);
    add("contact nodes that stick (%)", "/status/stick", 100.0, 2);
    add("contact nodes that slip (%)", "/status/slip", 100.0, 2);
    add("contact nodes that are open (%)", "/status/open", 100.0, 2);
    add("power of the rotor (W)", "/power_w/external", 1.0, 2);
    add("  of it while sticking (W)", "/power_w/stick", 1.0, 2);
    add("  of it while sliding (W)", "/power_w/slide", 1.0, 2);
    let dissipated = "/power_w/contact_dissipated";
    add("  of it dissipated in the contact (W)", dissipated, 1.0, 2);
    let damping = "/power_w/material_damping";
    add("material damping (W)", damping, 1.0, 2);
    ReportTable {
        caption: "Limit cycle".into(),
        columns: ["quantity", "value"].map(String::from).to_vec(),
        rows,
    }
}

fn growth_table(summary: &Value, predicted: &[(usize, f64)]) -> ReportTable {
    let rows = entries(summary, "growth").iter().map(|growth| {
        let harmonic = growth["harmonic"].as_u64();
        let own = predicted.iter().find(|(n, _)| Some(*n as u64) == harmonic);
        let measured = number(growth, "/rate_per_s").unwrap_or(f64::NAN);
        vec![
            harmonic.map_or(String::new(), |n| n.to_string()),
            format!("{measured:.2}"),
            own.map_or(String::new(), |(_, rate)| format!("{rate:.2}")),
            format!("{:.1}", number(growth, "/frequency_hz").unwrap_or(f64::NAN)),
        ]
    });
    ReportTable {
        caption: "Growth of the perturbed harmonics in the linear stage".into(),
        columns: [
            "harmonic n",
            "rate (1/s)",
            "rate of the eigenvalue analysis (1/s)",
            "frequency (Hz)",
        ]
        .map(String::from)
        .to_vec(),
        rows: rows.collect(),
    }
}
