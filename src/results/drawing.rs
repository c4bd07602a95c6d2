//! Figures as files: SVG and PNG side by side in `figures/`, and the report that holds them all.

use super::folder::{FolderError, OutputFolder};
use super::report::{NamedFigure, Report};
use crate::chart::{ChartError, Drawing, Figure};
use rayon::prelude::*;

/// Resolution of the PNG files unless asked otherwise, dots per inch.
pub const DOTS_PER_INCH: f64 = 200.0;

/// Name of the report in its folder.
pub const REPORT: &str = "report.html";

/// Folder of the figures in a results folder.
pub const FIGURES: &str = "figures/";

/// A format of figure files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Lines, text as text.
    Svg,
    /// Pixels.
    Png,
    /// Lines, text as outlines.
    Pdf,
}

/// How figures become files.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawingOptions {
    /// Resolution of the PNG files.
    pub dots_per_inch: f64,
    /// Width of all figures, mm; `None` is each figure's own, one or two columns of a page.
    pub width_mm: Option<f64>,
    /// What is written of each figure.
    pub formats: Vec<Format>,
}

impl Default for DrawingOptions {
    fn default() -> Self {
        Self {
            dots_per_inch: DOTS_PER_INCH,
            width_mm: None,
            formats: vec![Format::Svg, Format::Png, Format::Pdf],
        }
    }
}

/// Declares a figure.
pub type Declaration<'a> = Box<dyn Fn() -> Result<Figure, ChartError> + Sync + Send + 'a>;

/// Draws the figures side by side and keeps what had something to draw, in order.
///
/// # Errors
/// That of a figure that cannot be drawn although there is something to draw.
pub fn draw_all(
    declarations: Vec<Declaration<'_>>,
    options: &DrawingOptions,
) -> Result<Vec<NamedFigure>, ChartError> {
    let draw = |declare: Declaration<'_>| {
        let figure = declare()?;
        let svg = figure.to_svg(options.width_mm)?;
        let data = figure.data();
        let (name, caption) = (figure.name, figure.caption);
        Ok(NamedFigure { name, caption, svg, data })
    };
    let drawn: Vec<_> = declarations.into_par_iter().map(draw).collect();
    let is_drawn = |drawing: &Result<_, _>| !matches!(drawing, Err(ChartError::Empty { .. }));
    drawn.into_iter().filter(is_drawn).collect()
}

/// A figure that could not be drawn or written.
#[derive(Debug, thiserror::Error)]
pub enum DrawingError {
    /// It could not be drawn.
    #[error("a figure could not be drawn ({0}); --no-figures runs without")]
    Chart(#[from] ChartError),
    /// It could not be written.
    #[error(transparent)]
    Folder(#[from] FolderError),
}

/// A figure as a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FigureFile {
    /// Name in the results folder: `figures/NAME.svg`, `.png` or `.pdf`.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// Every figure in every format asked for, in order.
///
/// # Errors
/// Those of the formats.
pub fn figure_files(
    figures: &[NamedFigure],
    options: &DrawingOptions,
) -> Result<Vec<FigureFile>, ChartError> {
    let rendered: Result<Vec<Vec<FigureFile>>, ChartError> = figures
        .par_iter()
        .map(|figure| {
            let drawing = Drawing::parse(&figure.svg)?;
            let file = |format: &Format| {
                let (extension, bytes) = match format {
                    Format::Svg => ("svg", figure.svg.clone().into_bytes()),
                    Format::Png => ("png", drawing.to_png(options.dots_per_inch)?),
                    Format::Pdf => ("pdf", drawing.to_pdf()?),
                };
                let name = format!("{FIGURES}{}.{extension}", figure.name);
                Ok(FigureFile { name, bytes })
            };
            options.formats.iter().map(file).collect()
        })
        .collect();
    Ok(rendered?.into_iter().flatten().collect())
}

/// Writes the files of each figure.
///
/// # Errors
/// Those of the raster image and of the folder.
pub fn write_figures(
    folder: &OutputFolder,
    figures: &[NamedFigure],
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    for file in figure_files(figures, options)? {
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
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    for section in &report.sections {
        write_figures(folder, &section.1, options)?;
    }
    let html = report.to_html();
    folder.write(REPORT, |out| out.write_all(html.as_bytes()))?;
    Ok(())
}
