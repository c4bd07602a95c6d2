//! Figures and report of a result as files.

use super::figures::{FigureError, render_png};
use super::folder::{FolderError, OutputFolder};
use super::report::{NamedFigure, Report};

/// Resolution of the PNG files, dots per inch: what journals ask of images.
pub const PNG_RESOLUTION: f64 = 300.0;

/// Figures that cannot be drawn or written.
#[derive(Debug, thiserror::Error)]
pub enum GalleryError {
    /// A drawing failed.
    #[error("figure {name}: {source}")]
    Figure {
        /// Which.
        name: String,
        /// Why.
        source: FigureError,
    },
    /// A file failed.
    #[error(transparent)]
    Folder(#[from] FolderError),
}

/// Writes `figures/<name>.svg` and `figures/<name>.png` of each figure.
///
/// # Errors
/// [`GalleryError`] at the first figure that fails.
pub fn write_figures(folder: &OutputFolder, figures: &[NamedFigure]) -> Result<(), GalleryError> {
    for figure in figures {
        let name = format!("figures/{}.svg", figure.name);
        folder.write(&name, |out| out.write_all(figure.svg.as_bytes()))?;
        let png =
            render_png(&figure.svg, PNG_RESOLUTION).map_err(|source| GalleryError::Figure {
                name: figure.name.clone(),
                source,
            })?;
        let name = format!("figures/{}.png", figure.name);
        folder.write(&name, |out| out.write_all(&png))?;
    }
    Ok(())
}

/// Writes `report.html`, and the figures of all its sections beside it.
///
/// # Errors
/// As [`write_figures`].
pub fn write_report(folder: &OutputFolder, report: &Report) -> Result<(), GalleryError> {
    for section in &report.sections {
        write_figures(folder, &section.figures)?;
    }
    let html = report.to_html();
    folder.write("report.html", |out| out.write_all(html.as_bytes()))?;
    Ok(())
}
