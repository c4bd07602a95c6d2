//! Figures as files: SVG and PNG side by side in `figures/`, and the report that holds them all.

use super::figures::{FigureError, render_png};
use super::folder::{FolderError, OutputFolder};
use super::report::{NamedFigure, Report};
use rayon::prelude::*;

/// Resolution of the PNG files unless asked otherwise, dots per inch.
pub const DOTS_PER_INCH: f64 = 200.0;

/// Name of the report in its folder.
pub const REPORT: &str = "report.html";

/// Folder of the figures in a results folder.
pub const FIGURES: &str = "figures/";

/// A figure that could not be drawn or written.
#[derive(Debug, thiserror::Error)]
pub enum DrawingError {
    /// It could not be drawn.
    #[error("a figure could not be drawn ({0}); --no-figures runs without")]
    Figure(#[from] FigureError),
    /// It could not be written.
    #[error(transparent)]
    Folder(#[from] FolderError),
}

/// A figure as a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FigureFile {
    /// Name in the results folder: `figures/NAME.svg` or `figures/NAME.png`.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// Name and caption of a figure, and what draws it.
pub type FigureJob<'a> = (
    String,
    String,
    Box<dyn Fn() -> Result<String, FigureError> + Sync + Send + 'a>,
);

/// Runs the jobs side by side and keeps what had something to draw, in order.
///
/// # Errors
/// That of a figure that cannot be drawn although there is something to draw.
pub fn draw_figures(jobs: Vec<FigureJob<'_>>) -> Result<Vec<NamedFigure>, FigureError> {
    let drawn: Vec<_> = jobs
        .into_par_iter()
        .map(|(name, caption, job)| (name, caption, job()))
        .collect();
    let mut figures = Vec::new();
    for (name, caption, drawing) in drawn {
        match drawing {
            Ok(svg) => figures.push(NamedFigure { name, caption, svg }),
            Err(FigureError::Empty { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(figures)
}

/// Every figure as SVG and as PNG of `dots_per_inch`, in order.
///
/// # Errors
/// Those of the raster image.
pub fn figure_files(
    figures: &[NamedFigure],
    dots_per_inch: f64,
) -> Result<Vec<FigureFile>, FigureError> {
    let rendered: Result<Vec<_>, FigureError> = figures
        .par_iter()
        .map(|figure| {
            let file = |extension: &str, bytes: Vec<u8>| FigureFile {
                name: format!("{FIGURES}{}.{extension}", figure.name),
                bytes,
            };
            let png = render_png(&figure.svg, dots_per_inch)?;
            Ok([
                file("svg", figure.svg.clone().into_bytes()),
                file("png", png),
            ])
        })
        .collect();
    Ok(rendered?.into_iter().flatten().collect())
}

/// Writes SVG and PNG of each figure.
///
/// # Errors
/// Those of the raster image and of the folder.
pub fn write_figures(
    folder: &OutputFolder,
    figures: &[NamedFigure],
    dots_per_inch: f64,
) -> Result<(), DrawingError> {
    for file in figure_files(figures, dots_per_inch)? {
        folder.write_bulk(&file.name, |out| out.write_all(&file.bytes))?;
    }
    Ok(())
}

/// Writes `report.html` and the figures of all its sections.
///
/// # Errors
/// As [`write_figures`].
pub fn write_report(
    folder: &OutputFolder,
    report: &Report,
    dots_per_inch: f64,
) -> Result<(), DrawingError> {
    for section in &report.sections {
        write_figures(folder, &section.figures, dots_per_inch)?;
    }
    let html = report.to_html();
    folder.write(REPORT, |out| out.write_all(html.as_bytes()))?;
    Ok(())
}
