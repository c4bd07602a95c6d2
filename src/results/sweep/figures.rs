//! Figures and `report.html` of a study.

use super::super::charts::ModeLine;
use super::super::sweep_figures::draw_sweep;
use super::super::{DrawingError, DrawingOptions, Manifest, Page};
use super::report::document;
use super::{SweepFolder, SweepReport};

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
pub fn draw(
    folder: &SweepFolder,
    report: &SweepReport<'_>,
    manifest: &Manifest,
    drawing: &SweepDrawing,
) -> Result<(), DrawingError> {
    let frictions = (report.friction_coefficient, drawing.highest_friction);
    let figures = draw_sweep(&report.records, frictions, &drawing.references)?;
    let page = Page::new(document(report, true), figures, manifest);
    folder.write_page(&page, &drawing.options)
}
