//! `report.html` of an analysed time signal.

use super::figures::{SignalRecord, draw};
use crate::results::drawing::{DrawingError, write_report};
use crate::results::folder::OutputFolder;
use crate::results::manifest::Manifest;
use crate::results::report::{Report, ReportSection, ReportTable, cell, entries, number, texts};
use serde_json::Value;

/// Draws the figures into `figures/`, each as SVG and PNG, and writes `report.html`; returns what could
/// not be drawn, and why.
///
/// # Errors
/// Those of the folder and of the raster image.
pub fn draw_report(
    folder: &OutputFolder,
    record: &SignalRecord,
    summary: &Value,
    dots_per_inch: f64,
) -> Result<Vec<String>, DrawingError> {
    let drawn = draw(record);
    let mut report = html_report(summary, folder.manifest());
    report.sections[0].figures = drawn.figures;
    write_report(folder, &report, dots_per_inch)?;
    Ok(drawn.left_out)
}

fn html_report(summary: &Value, manifest: &Manifest) -> Report {
    let mut paragraphs = vec![format!(
        "{} samples at {} Hz.",
        summary["samples"], summary["sampling_rate_hz"]
    )];
    paragraphs.extend(texts(summary, "notes"));
    let channels = entries(summary, "channels");
    paragraphs.extend(channels.iter().filter_map(growth));
    paragraphs.extend(channels.iter().filter_map(vibrating_mode));
    Report {
        title: "Lines of a signal".into(),
        sections: vec![ReportSection {
            heading: "Signal".into(),
            paragraphs,
            tables: channels.iter().map(peak_table).collect(),
            figures: Vec::new(),
        }],
        manifest: manifest.clone(),
    }
}

fn name(channel: &Value) -> &str {
    channel["name"].as_str().unwrap_or("channel")
}

fn growth(channel: &Value) -> Option<String> {
    let rate = number(channel, "/growth/rate_per_s/value")?;
    let part = |pointer: &str, factor, decimals| cell(channel, pointer, factor, decimals);
    Some(format!(
        "{}: {} at {:.2} 1/s ({} to {}) between {} and {} ms, at {} Hz.",
        name(channel),
        if rate > 0.0 { "grows" } else { "decays" },
        rate.abs(),
        part("/growth/rate_per_s/low", rate.signum(), 2),
        part("/growth/rate_per_s/high", rate.signum(), 2),
        part("/growth/start_s", 1e3, 2),
        part("/growth/end_s", 1e3, 2),
        part("/growth/frequency_hz/value", 1.0, 2),
    ))
}

fn vibrating_mode(channel: &Value) -> Option<String> {
    let mode = channel.get("mode").filter(|mode| mode.is_object())?;
    Some(format!(
        "{} vibrates in {}, which the eigenvalue analysis lets grow at {} 1/s.",
        name(channel),
        mode_text(mode),
        cell(mode, "/growth_rate_per_s", 1.0, 2),
    ))
}

fn mode_text(mode: &Value) -> String {
    format!(
        "mode {} (n = {}, branch {}, {} Hz{})",
        mode["mode"],
        mode["harmonic"],
        mode["branch"],
        cell(mode, "/frequency_hz", 1.0, 1),
        if mode["unstable"] == true {
            ", unstable"
        } else {
            ""
        },
    )
}

fn peak_table(channel: &Value) -> ReportTable {
    let rows = entries(channel, "peaks")
        .iter()
        .enumerate()
        .map(|(k, peak)| {
            let superharmonic = peak.get("superharmonic").filter(|value| value.is_object());
            let nearest = peak.get("nearest_mode").filter(|value| value.is_object());
            let amplitude = number(peak, "/amplitude").unwrap_or(f64::NAN);
            vec![
                (k + 1).to_string(),
                cell(peak, "/frequency_hz", 1.0, 2),
                format!("{amplitude:.4e}"),
                match (superharmonic, nearest) {
                    (Some(line), _) => format!("{} times peak {}", line["order"], line["of_peak"]),
                    (None, Some(mode)) => format!("near {}", mode_text(mode)),
                    (None, None) => String::new(),
                },
            ]
        });
    ReportTable {
        caption: format!(
            "Peaks of {} between {} and {} s",
            name(channel),
            cell(channel, "/interval_s/0", 1.0, 4),
            cell(channel, "/interval_s/1", 1.0, 4),
        ),
        columns: ["peak", "frequency (Hz)", "amplitude", "what it is"]
            .map(String::from)
            .to_vec(),
        rows: rows.collect(),
    }
}
