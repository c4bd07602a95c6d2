//! Figures as files: SVG and PNG side by side in `figures/`, and the report that holds them all.

use super::folder::{FolderError, OutputFolder};
use super::manifest::Manifest;
use super::record::Record;
use super::report::{NamedFigure, Report};
use frictionsim_chart::{ChartError, Drawing, Figure};
use frictionsim_output::Document;
use serde::{Deserialize, Serialize};

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

/// A page as data, `figures.bin`: what was drawn, to be drawn again at any size.
#[derive(Serialize, Deserialize)]
pub struct Page {
    /// Tables and sentences.
    document: Document,
    /// Its figures.
    pub figures: Vec<Figure>,
    /// What the result was made from.
    manifest: Manifest,
}

impl Record for Page {
    const FILE: &str = "figures.bin";
    const MAGIC: [u8; 8] = *b"FRICSIMF";
    const VERSION: u32 = 1;

    fn inconsistency(&self) -> Option<&'static str> {
        let is_whole = self.document.is_whole() && self.figures.iter().all(Figure::is_whole);
        (!is_whole).then_some("its numbers do not fit together")
    }
}

impl Page {
    /// The page of a document and its figures, of which it keeps what a drawing shows.
    pub fn new(document: Document, figures: Vec<Figure>, manifest: &Manifest) -> Self {
        let figures = figures.into_iter().map(Figure::thinned).collect();
        Self { document, figures, manifest: manifest.clone() }
    }

    /// Draws every figure in every format asked for, `figures/NAME.svg` and so on, and `report.html`.
    pub fn draw(
        &self,
        folder: &OutputFolder,
        options: &DrawingOptions,
    ) -> Result<(), DrawingError> {
        let write = |name: &str, bytes: &[u8]| folder.write_bulk(name, |out| out.write_all(bytes));
        let drawn = |figure: &Figure| {
            let svg = figure.to_svg(options.width_mm)?;
            let (name, caption) = (figure.name.clone(), figure.caption.clone());
            let figure = NamedFigure { name, caption, svg, data: figure.data() };
            Ok((files_of(&figure, options)?, figure))
        };
        let drawn: Result<Vec<_>, ChartError> =
            frictionsim_physics::parallel::map(&self.figures, drawn);
        let (files, figures): (Vec<Vec<File>>, Vec<NamedFigure>) = drawn?.into_iter().unzip();
        files.iter().flatten().try_for_each(|(name, bytes)| write(name, bytes))?;
        let report = Report::of(self.document.clone(), figures, &self.manifest).to_html();
        Ok(write(REPORT, report.as_bytes())?)
    }
}

/// Name in the results folder, and bytes.
type File = (String, Vec<u8>);

/// A figure in every format asked for.
fn files_of(figure: &NamedFigure, options: &DrawingOptions) -> Result<Vec<File>, ChartError> {
    let drawing = Drawing::parse(&figure.svg)?;
    let file = |format: &Format| {
        let (extension, bytes) = match format {
            Format::Svg => ("svg", figure.svg.clone().into_bytes()),
            Format::Png => ("png", drawing.to_png(options.dots_per_inch)?),
            Format::Pdf => ("pdf", drawing.to_pdf()?),
        };
        Ok((format!("{FIGURES}{}.{extension}", figure.name), bytes))
    };
    options.formats.iter().map(file).collect()
}
