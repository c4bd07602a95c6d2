//! Figures and `report.html` of a study.

use super::super::charts::ModeLine;
use super::super::quantity::significant;
use super::super::report::{Report, ReportSection, ReportTable};
use super::super::sweep_figures::draw_sweep;
use super::super::{DrawingError, DrawingOptions, Manifest, figure_files};
use super::matrix::OperatingMatrix;
use super::report::rows;
use super::{SweepFolder, SweepReport};
use crate::chart::extremes;
use crate::results::drawing::REPORT;

/// What the figures of a study need besides its points.
#[derive(Clone, Debug)]
pub struct SweepDrawing {
    /// Unstable modes of the case, drawn across its frequencies.
    pub references: Vec<ModeLine>,
    /// Largest friction coefficient of its eigenvalue analyses.
    pub highest_friction: f64,
    /// How they are drawn.
    pub options: DrawingOptions,
}

/// Draws what the study has points for into `figures/`, each as SVG and PNG, and writes `report.html`.
///
/// # Errors
/// Those of the drawing and of the folder.
pub fn draw(
    folder: &SweepFolder,
    report: &SweepReport<'_>,
    manifest: &Manifest,
    drawing: &SweepDrawing,
) -> Result<(), DrawingError> {
    let frictions = (report.friction_coefficient, drawing.highest_friction);
    let figures = draw_sweep(report.records, frictions, &drawing.references, &drawing.options)?;
    for file in figure_files(&figures, &drawing.options)? {
        folder.write(&file.name, |out| out.write_all(&file.bytes))?;
    }
    let mut paragraphs = vec![format!("{} at each point.", report.analyses.join(" and "))];
    let matrix = OperatingMatrix::of(report.records);
    paragraphs.extend(matrix.sentence());
    paragraphs.extend(report.notes());
    let points = [matrix.table(report.keys), Some(points_table(report))];
    let html = Report {
        title: report.title.to_owned(),
        sections: vec![
            ReportSection::results(paragraphs, results(report)),
            ReportSection::new("Study").with_figures(figures),
            ReportSection::new("Points").with_tables(points.into_iter().flatten()),
        ],
        manifest: manifest.clone(),
    }
    .to_html();
    folder.write(REPORT, |out| out.write_all(html.as_bytes()))?;
    Ok(())
}

/// How far the study is, and the range of every quantity that a person wants first.
fn results(report: &SweepReport<'_>) -> Vec<(String, String)> {
    let finished = format!("{} of {}", report.records.len(), report.count);
    let failed = report.failed().count().to_string();
    let mut out = vec![("points".to_owned(), finished), ("failed".to_owned(), failed)];
    let rows = rows(report);
    for column in 1..rows[0].len() {
        let numbers = rows[1..].iter().filter_map(|row| row[column].parse::<f64>().ok());
        let numbers: Vec<f64> = numbers.collect();
        if let (false, (low, high)) = (numbers.is_empty(), extremes(numbers.iter().copied())) {
            let [low, high] = [low, high].map(|value| significant(value, 6));
            let range = if low == high { low } else { format!("{low} to {high}") };
            out.push((rows[0][column].clone(), range));
        }
    }
    out
}

/// What a person wants first of every point; `points.csv` has all.
fn points_table(report: &SweepReport<'_>) -> ReportTable {
    let mut rows = rows(report);
    ReportTable::new("Finished points (every quantity: points.csv)", rows.remove(0), rows)
}
