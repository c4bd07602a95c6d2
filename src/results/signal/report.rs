//! `report.html` of an analysed time signal.

use super::figures::{SignalRecord, draw};
use super::summary::{ChannelSummary, SignalSummary};
use crate::results::OutputFolder;
use crate::results::drawing::{DrawingError, DrawingOptions, write_report};
use crate::results::report::{Report, ReportSection, ReportTable};

/// Draws the figures into `figures/`, each as SVG and PNG, and writes `report.html`; returns what could
/// not be drawn, and why.
///
/// # Errors
/// Those of the folder and of the raster image.
pub fn draw_report(
    folder: &OutputFolder,
    record: &SignalRecord,
    summary: &SignalSummary,
    options: &DrawingOptions,
) -> Result<Vec<String>, DrawingError> {
    let (figures, left_out) = draw(record, summary, options)?;
    let mut report = html_report(summary);
    report.sections[0].figures = figures;
    write_report(folder, &report, options)?;
    Ok(left_out)
}

fn html_report(summary: &SignalSummary) -> Report {
    let mut paragraphs =
        vec![format!("{} samples at {} Hz.", summary.samples, summary.sampling_rate_hz)];
    paragraphs.extend(summary.notes.iter().cloned());
    for channel in &summary.channels {
        let texts = [Some(channel.growth_text()), channel.mode_text(summary.friction_coefficient)];
        let texts = texts.into_iter().flatten();
        paragraphs.extend(texts.map(|text| format!("{}: {text}.", channel.name)));
    }
    Report {
        title: "Lines of a signal".into(),
        sections: vec![
            ReportSection::new("Signal")
                .with_paragraphs(paragraphs)
                .with_tables(summary.channels.iter().map(peak_table)),
        ],
        manifest: summary.manifest.clone(),
    }
}

fn peak_table(channel: &ChannelSummary) -> ReportTable {
    let [from, to] = channel.interval_s;
    let rows = channel.peaks.iter().enumerate().map(|(k, peak)| {
        vec![
            (k + 1).to_string(),
            format!("{:.2}", peak.frequency_hz),
            format!("{:.4e}", peak.amplitude),
            channel.peak_text(peak),
        ]
    });
    ReportTable::new(
        format!("Peaks of {} between {from:.4} and {to:.4} s", channel.name),
        ["peak", "frequency (Hz)", "amplitude", "what it is"],
        rows,
    )
}
