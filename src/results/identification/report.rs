//! `report.html` of an identified damping.

use super::DAMPING_BLOCK;
use super::figures::{IdentificationRecord, draw};
use crate::results::drawing::{DrawingError, DrawingOptions, write_report};
use crate::results::figures::FigureError;
use crate::results::folder::OutputFolder;
use crate::results::manifest::Manifest;
use crate::results::report::{Report, ReportSection, ReportTable, cell, entries, number, texts};
use serde_json::Value;

/// Draws the figure into `figures/`, as SVG and PNG, and writes `report.html`; returns why the figure was
/// left out, where nothing can be drawn.
///
/// # Errors
/// Those of the folder and of the raster image.
pub fn draw_report(
    folder: &OutputFolder,
    record: &IdentificationRecord,
    summary: &Value,
    options: &DrawingOptions,
) -> Result<Option<FigureError>, DrawingError> {
    // The block is there after every run; without it there is nothing to paste.
    let block = std::fs::read_to_string(folder.path().join(DAMPING_BLOCK)).unwrap_or_default();
    let mut report = html_report(summary, block, folder.manifest());
    let left_out = match draw(record) {
        Ok(figure) => {
            report.sections[0].figures.push(figure);
            None
        }
        Err(error) => Some(error),
    };
    write_report(folder, &report, options)?;
    Ok(left_out)
}

fn html_report(summary: &Value, block: String, manifest: &Manifest) -> Report {
    let scatter = number(summary, "/reduced_chi_square").unwrap_or(f64::NAN);
    let mut paragraphs = vec![format!(
        "{}, {} lines; the response is fitted from {} to {} Hz. The damping factors scatter {:.2} times as \
         much about (alpha_R / omega + beta_R omega) / 2 as their errors say.",
        summary["quantity"].as_str().unwrap_or("response"),
        summary["lines"],
        cell(summary, "/fit/range_hz/0", 1.0, 1),
        cell(summary, "/fit/range_hz/1", 1.0, 1),
        scatter.sqrt(),
    )];
    paragraphs.extend(texts(summary, "notes"));
    if !block.is_empty() {
        paragraphs.push(block);
    }
    Report {
        title: "Identified damping".into(),
        sections: vec![
            ReportSection {
                heading: "Rayleigh coefficients".into(),
                paragraphs,
                tables: vec![coefficient_table(summary)],
                figures: Vec::new(),
            },
            ReportSection {
                heading: "Modes".into(),
                tables: vec![mode_table(summary)],
                ..ReportSection::default()
            },
        ],
        manifest: manifest.clone(),
    }
}

/// Both estimators side by side.
fn coefficient_table(summary: &Value) -> ReportTable {
    let scientific = |pointer: String| {
        number(summary, &pointer).map_or_else(String::new, |value| format!("{value:.4e}"))
    };
    let estimators = [
        ("fit of the response", ""),
        ("half-power alone", "/half_power"),
    ];
    let rows = estimators.iter().map(|(name, at)| {
        let coefficients = ["mass_coefficient", "stiffness_coefficient"];
        let cells = coefficients.iter().flat_map(|coefficient| {
            ["value", "low", "high"].map(|part| scientific(format!("{at}/{coefficient}/{part}")))
        });
        [(*name).to_owned()].into_iter().chain(cells).collect()
    });
    ReportTable {
        caption: "Rayleigh coefficients with their 95 % intervals".into(),
        columns: [
            "estimator",
            "alpha_R (1/s)",
            "from",
            "to",
            "beta_R (s)",
            "from",
            "to",
        ]
        .map(String::from)
        .to_vec(),
        rows: rows.collect(),
    }
}

fn mode_table(summary: &Value) -> ReportTable {
    let rows = entries(summary, "modes")
        .iter()
        .enumerate()
        .map(|(k, mode)| {
            vec![
                (k + 1).to_string(),
                cell(mode, "/frequency_hz", 1.0, 2),
                cell(mode, "/damping_factor", 100.0, 4),
                cell(mode, "/damping_factor_interval/0", 100.0, 4),
                cell(mode, "/damping_factor_interval/1", 100.0, 4),
                cell(mode, "/half_power/damping_factor", 100.0, 4),
                if mode["used"] == true { "yes" } else { "no" }.to_owned(),
                mode["flag"].as_str().unwrap_or_default().to_owned(),
            ]
        });
    ReportTable {
        caption: "Modes of the response".into(),
        columns: [
            "mode",
            "frequency (Hz)",
            "damping factor (%)",
            "from",
            "to",
            "by half-power (%)",
            "used",
            "remark",
        ]
        .map(String::from)
        .to_vec(),
        rows: rows.collect(),
    }
}
