//! `report.html` of an identified damping.

use super::figures::{IdentificationRecord, identification};
use super::summary::{IdentificationSummary, ModeSummary};
use crate::results::OutputFolder;
use crate::results::drawing::{DrawingError, DrawingOptions, draw_all, write_report};
use crate::results::report::{Report, ReportSection, ReportTable};

/// Draws the figure into `figures/` and writes `report.html`.
///
/// # Errors
/// Those of the folder and of the drawing.
pub fn draw_report(
    folder: &OutputFolder,
    record: &IdentificationRecord,
    summary: &IdentificationSummary,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let mut report = html_report(summary);
    report.sections[0].figures = draw_all(vec![Box::new(|| Ok(identification(record)))], options)?;
    write_report(folder, &report, options)
}

fn html_report(summary: &IdentificationSummary) -> Report {
    let [low, high] = summary.fit.range_hz;
    let mut paragraphs = vec![format!(
        "{}, {} lines; the response is fitted from {low:.1} to {high:.1} Hz. The damping factors scatter {:.2} \
         times as much about (alpha_R / omega + beta_R omega) / 2 as their errors say.",
        summary.quantity,
        summary.lines,
        summary.reduced_chi_square.sqrt(),
    )];
    if summary.responses.len() > 1 {
        let names: Vec<&str> = summary.responses.iter().map(|r| r.name.as_str()).collect();
        let names = names.join(", ");
        paragraphs.push(format!("Responses fitted with common modes: {names}."));
    }
    paragraphs.extend(summary.notes.iter().cloned());
    paragraphs.push(summary.damping_block());
    Report {
        title: "Identified damping".into(),
        sections: vec![
            ReportSection::new("Rayleigh coefficients")
                .with_paragraphs(paragraphs)
                .with_tables([coefficient_table(summary)]),
            ReportSection::new("Modes").with_tables([mode_table(&summary.modes)]),
        ],
        manifest: summary.manifest.clone(),
    }
}

/// Both estimators side by side.
fn coefficient_table(summary: &IdentificationSummary) -> ReportTable {
    let half = summary.half_power;
    let estimators = [
        ("fit of the response", Some([summary.mass_coefficient, summary.stiffness_coefficient])),
        ("half-power alone", half.map(|h| [h.mass_coefficient, h.stiffness_coefficient])),
    ];
    let rows = estimators.iter().map(|(name, coefficients)| {
        let numbers = coefficients.iter().flatten().flat_map(|e| [e.value, e.low, e.high]);
        let mut row = vec![(*name).to_owned()];
        row.extend(numbers.map(|value| format!("{value:.4e}")));
        row.resize(7, String::new());
        row
    });
    ReportTable::new(
        "Rayleigh coefficients with their 95 % intervals",
        ["estimator", "alpha_R (1/s)", "from", "to", "beta_R (s)", "from", "to"],
        rows,
    )
}

fn mode_table(modes: &[ModeSummary]) -> ReportTable {
    let rows = modes.iter().enumerate().map(|(k, mode)| {
        let percent = |value: f64| format!("{:.4}", 100.0 * value);
        let half = mode.half_power.as_ref().and_then(|b| b.damping_factor);
        vec![
            (k + 1).to_string(),
            format!("{:.2}", mode.frequency_hz),
            percent(mode.damping_factor),
            percent(mode.damping_factor_interval[0]),
            percent(mode.damping_factor_interval[1]),
            half.map_or_else(String::new, percent),
            if mode.used { "yes" } else { "no" }.to_owned(),
            mode.flag.clone().unwrap_or_default(),
        ]
    });
    ReportTable::new(
        "Modes of the response",
        [
            "mode",
            "frequency (Hz)",
            "damping factor (%)",
            "from",
            "to",
            "by half-power (%)",
            "used",
            "remark",
        ],
        rows,
    )
}
