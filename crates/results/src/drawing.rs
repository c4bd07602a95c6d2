//! Figures as files: SVG, PNG and PDF side by side in `figures/`.

use super::folder::FolderError;
use frictionsim_chart::{ChartError, Drawing, Figure};

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

/// Declares a figure, where there is one.
pub type Declaration<'a> = Box<dyn Fn() -> Option<Figure> + Sync + Send + 'a>;

/// Declares the figures side by side and keeps those that have something to draw, in order.
pub fn declared(declarations: Vec<Declaration<'_>>) -> Vec<Figure> {
    let all: Vec<_> = frictionsim_physics::parallel::map(declarations, |declare| declare());
    all.into_iter().flatten().filter(Figure::has_data).collect()
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

/// Name in the results folder, and bytes.
pub(super) type File = (String, Vec<u8>);

/// A drawing in every format asked for.
pub(super) fn files_of(
    name: &str,
    svg: &str,
    options: &DrawingOptions,
) -> Result<Vec<File>, ChartError> {
    let drawing = Drawing::parse(svg)?;
    let file = |format: &Format| {
        let (extension, bytes) = match format {
            Format::Svg => ("svg", svg.as_bytes().to_vec()),
            Format::Png => ("png", drawing.to_png(options.dots_per_inch)?),
            Format::Pdf => ("pdf", drawing.to_pdf()?),
        };
        Ok((format!("{FIGURES}{name}.{extension}"), bytes))
    };
    options.formats.iter().map(file).collect()
}
