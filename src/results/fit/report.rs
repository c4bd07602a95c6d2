//! `report.html` of a fit.

use super::figures::fit;
use super::summary::FitSummary;
use crate::results::OutputFolder;
use crate::results::drawing::{DrawingError, DrawingOptions, draw_all, write_report};
use crate::results::quantity::significant;
use crate::results::report::{Report, ReportSection, ReportTable};

/// Draws the figure into `figures/` and writes `report.html`.
///
/// # Errors
/// Those of the folder and of the drawing.
pub fn draw_report(
    folder: &OutputFolder,
    summary: &FitSummary,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let figures = draw_all(vec![Box::new(|| Ok(fit(summary)))], options)?;
    let title = match summary.title.as_str() {
        "" => "Fit to measured modes".to_owned(),
        title => title.to_owned(),
    };
    let report = Report {
        title,
        sections: vec![
            ReportSection::new("Fitted parameters")
                .with_paragraphs(paragraphs(summary))
                .with_tables([parameters(summary)])
                .with_figures(figures),
            ReportSection::new("Lines and modes").with_tables([lines(summary)]),
        ],
        manifest: summary.manifest.clone(),
    };
    write_report(folder, &report, options)
}

fn paragraphs(summary: &FitSummary) -> Vec<String> {
    let mut all = vec![format!(
        "Fitted to {} lines of {} at friction coefficient {}; the worst frequency differs by {:.3} %. {} of {} \
         searches, from the best of {} points, ended here.",
        summary.residuals.len(),
        summary.measurement,
        summary.friction_coefficient,
        summary.worst_percent,
        summary.search.arrived,
        summary.search.searches,
        summary.search.starts,
    )];
    for (a, row) in &summary.correlations {
        for (b, value) in row.iter().filter(|(b, _)| a < *b) {
            all.push(format!("Correlation of {a} and {b}: {value:+.3}."));
        }
    }
    all.extend(summary.notes.iter().cloned());
    all.push(summary.block());
    all
}

fn parameters(summary: &FitSummary) -> ReportTable {
    let rows = summary.parameters.iter().map(|(key, fitted)| {
        let number = |value: f64| significant(value, 6);
        let end = |value: Option<f64>| value.map_or("-".to_owned(), number);
        let [from, to] = fitted.bounds.map(number);
        vec![
            key.clone(),
            number(fitted.value),
            end(fitted.low),
            end(fitted.high),
            format!("{from} to {to}"),
            fitted.unit.clone(),
        ]
    });
    ReportTable::new(
        "Parameters with their 95 % intervals",
        ["parameter", "value", "from", "to", "sought in", "unit"],
        rows,
    )
}

fn lines(summary: &FitSummary) -> ReportTable {
    let rows = summary.residuals.iter().map(|line| {
        vec![
            format!("{:.1}", line.frequency_hz),
            line.real_hz.map_or(String::new(), |real| format!("{real:.1}")),
            format!("{:.1}", line.mode.frequency_hz),
            format!("{:.1}", line.mode.real_hz),
            format!("{:+.3}", line.difference_percent),
            match line.mac {
                Some(mac) => format!("{}, MAC {mac:.3}", line.mode.name()),
                None => line.mode.name(),
            },
        ]
    });
    ReportTable::new(
        "Measured lines and their modes",
        [
            "measured (Hz)",
            "real part (Hz)",
            "model (Hz)",
            "real part (Hz)",
            "difference (%)",
            "mode",
        ],
        rows,
    )
}
