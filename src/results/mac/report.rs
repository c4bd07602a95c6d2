//! `report.html` of `mac`, and its figure.

use super::{MacPair, MacSummary};
use crate::chart::{Axis, ChartError, ColourMap, Figure, Heat, INK, Marker, Panel, Points, Side};
use crate::results::drawing::{DrawingError, DrawingOptions, draw_all, write_report};
use crate::results::folder::OutputFolder;
use crate::results::quantity::significant;
use crate::results::report::{Report, ReportSection, ReportTable};
use std::f64::consts::TAU;

/// Draws the matrix into `figures/` and writes `report.html`.
///
/// # Errors
/// Those of the drawing and of the folder.
pub fn draw_mac(
    folder: &OutputFolder,
    summary: &MacSummary,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let figures = draw_all(vec![Box::new(|| matrix(summary))], options)?;
    let paragraphs = std::iter::once(summary.answer()).chain(summary.notes.iter().cloned());
    let results = vec![
        ("shapes".to_owned(), summary.shapes.len().to_string()),
        ("modes".to_owned(), summary.modes.len().to_string()),
        ("friction coefficient".to_owned(), summary.friction_coefficient.to_string()),
    ];
    let report = Report {
        title: summary.title.clone(),
        sections: vec![
            ReportSection::results(paragraphs.collect(), results)
                .with_tables([pairs_table(summary)]),
            ReportSection::new("Modal assurance").with_figures(figures),
        ],
        manifest: folder.manifest().clone(),
    };
    write_report(folder, &report, options)
}

/// The criterion over modes and shapes, pairs marked.
fn matrix(summary: &MacSummary) -> Result<Figure, ChartError> {
    let (shapes, modes) = (summary.shapes.len(), summary.modes.len());
    let span = |count: usize| ((0.5, count as f64 + 0.5), count);
    let axis = Axis::new("modal assurance criterion", "").between(0.0, 1.0);
    let heat =
        Heat::of_values(span(modes), span(shapes), (axis, ColourMap::Viridis), |mode, shape| {
            summary.mac[shape][mode]
        });
    let pairs = summary.pairs.iter();
    let places = pairs.map(|pair: &MacPair| (pair.mode as f64, pair.shape as f64));
    let between = |count: usize| (0.5, count as f64 + 0.5);
    let ((x0, x1), (y0, y1)) = (between(modes), between(shapes));
    let panel = Panel::new(
        Axis::new("mode of the model", "").between(x0, x1),
        Axis::new("measured shape", "").between(y0, y1),
    )
    .height(150.0)
    .layer(heat)
    .layer(Points::new(places).marker(Marker::Circle, 2.6, INK))
    .colour_bar(Side::Right);
    Ok(Figure::new(
        "mac",
        "Modal assurance criterion of each measured shape with each mode; circles are the pairs.",
    )
    .panel(panel))
}

fn pairs_table(summary: &MacSummary) -> ReportTable {
    let row = |pair: &MacPair| {
        let (shape, mode) = summary.pair(pair);
        vec![
            shape.name.clone(),
            shape.frequency_hz.map_or(String::new(), |hz| significant(hz, 6)),
            mode.mode.to_string(),
            significant(mode.frequency_hz, 6),
            significant(TAU * mode.real_hz, 4),
            format!("{:.4}", pair.mac),
            shape.off_body.to_string(),
        ]
    };
    ReportTable::new(
        "The mode of each shape",
        [
            "shape",
            "measured (Hz)",
            "mode",
            "frequency (Hz)",
            "growth rate (1/s)",
            "MAC",
            "points off the body",
        ],
        summary.pairs.iter().map(row),
    )
}
