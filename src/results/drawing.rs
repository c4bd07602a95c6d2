//! Figures as files: SVG and PNG side by side in `figures/`, and the report that holds them all.

use super::figures::{FigureError, render_png};
use super::folder::{FolderError, OutputFolder};
use super::report::{NamedFigure, Report};
use rayon::prelude::*;

/// Resolution of the PNG files, dots per inch.
const DOTS_PER_INCH: f64 = 200.0;

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

/// A figure ready to be written.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The drawing.
    pub svg: String,
    /// The same as pixels.
    pub png: Vec<u8>,
}

/// Renders a drawing as SVG and PNG; `None` where there was nothing to draw.
///
/// # Errors
/// Those of the drawing but [`FigureError::Empty`], and those of the raster image.
pub fn render(drawing: Result<String, FigureError>) -> Result<Option<Figure>, FigureError> {
    match drawing {
        Ok(svg) => {
            let png = render_png(&svg, DOTS_PER_INCH)?;
            Ok(Some(Figure { svg, png }))
        }
        Err(FigureError::Empty { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}

/// Writes `figures/NAME.svg` and `figures/NAME.png`.
///
/// # Errors
/// Those of the folder.
pub fn write_figure(folder: &OutputFolder, name: &str, figure: &Figure) -> Result<(), FolderError> {
    folder.write_bulk(&format!("figures/{name}.svg"), |out| {
        out.write_all(figure.svg.as_bytes())
    })?;
    folder.write_bulk(&format!("figures/{name}.png"), |out| {
        out.write_all(&figure.png)
    })?;
    Ok(())
}

/// Writes SVG and PNG of each figure.
///
/// # Errors
/// Those of the raster image and of the folder.
pub fn write_figures(folder: &OutputFolder, figures: &[NamedFigure]) -> Result<(), DrawingError> {
    // Rendering is pure: side by side here, written in order below.
    let rendered: Vec<_> = figures
        .par_iter()
        .map(|figure| render(Ok(figure.svg.clone())))
        .collect();
    for (figure, image) in figures.iter().zip(rendered) {
        if let Some(image) = image? {
            write_figure(folder, &figure.name, &image)?;
        }
    }
    Ok(())
}

/// Writes `report.html` and the figures of all its sections.
///
/// # Errors
/// As [`write_figures`].
pub fn write_report(folder: &OutputFolder, report: &Report) -> Result<(), DrawingError> {
    for section in &report.sections {
        write_figures(folder, &section.figures)?;
    }
    let html = report.to_html();
    folder.write("report.html", |out| out.write_all(html.as_bytes()))?;
    Ok(())
}
