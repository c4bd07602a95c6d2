//! Table, figure and report of a computed frequency response.

use super::Manifest;
use super::drawing::{DrawingError, DrawingOptions, write_report};
use super::figures::{ResponsePlot, draw_response};
use super::folder::{FolderError, OutputFolder};
use super::identification::unit_of;
use super::reopening::read_own;
use super::report::{NamedFigure, Report, ReportSection};
use super::summary::{Entry, Summary, present};
use super::table::Table;
use crate::signal::{FrequencyResponse, ResponseQuantity};
use faer::c64;
use serde::{Deserialize, Serialize};

/// `summary.json` of `frictionsim frf`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResponseSummary {
    /// `frf`.
    pub command: String,
    /// Title of the case.
    pub title: String,
    /// What was computed, in a sentence.
    pub description: String,
    /// Unknowns.
    pub dofs: usize,
    /// Frequencies.
    pub lines: usize,
    /// Method: `cyclic`, `direct` or `reduced`.
    pub method: String,
    /// Largest relative error at the check lines of a reduction.
    pub largest_error: Option<f64>,
    /// Vectors of a reduction.
    pub basis_vectors: Option<usize>,
    /// Largest backward error of a cyclic solution.
    pub backward_error: Option<f64>,
    /// Accelerance, mobility or receptance.
    pub quantity: String,
    /// Relative standard deviation of the noise added.
    pub noise: f64,
    /// Wall time, s.
    pub wall_s: f64,
    /// What it was made from.
    pub manifest: Manifest,
}

impl Summary for ResponseSummary {
    fn headline(&self) -> Vec<Entry> {
        let error = self.largest_error.or(self.backward_error).and_then(present);
        vec![
            Entry::new("lines", self.lines),
            Entry::new("largest_error", error),
        ]
    }
}

/// The table of a results folder, as it was written.
///
/// # Errors
/// [`FolderError::NotResults`] if it is missing or damaged; those of the file system.
pub fn read_response_table(folder: &OutputFolder) -> Result<Vec<u8>, FolderError> {
    read_own(folder.path(), RESPONSE_TABLE)
}

/// Name of the table of a response in its folder; `frictionsim identify` reads it.
pub const RESPONSE_TABLE: &str = "frf.csv";

/// Writes frequency, real and imaginary part.
///
/// # Errors
/// Those of the folder.
pub fn write_response(
    folder: &OutputFolder,
    quantity: ResponseQuantity,
    frequencies_hz: &[f64],
    values: &[c64],
) -> Result<(), FolderError> {
    let name = quantity.name();
    let columns = [
        "frequency_hz",
        &format!("{name}_real"),
        &format!("{name}_imaginary"),
    ];
    folder.write(RESPONSE_TABLE, |out| {
        let mut table = Table::new(out, &columns)?;
        for (f, h) in frequencies_hz.iter().zip(values) {
            table.numbers(&[*f, h.re, h.im])?;
        }
        table.finish()
    })?;
    Ok(())
}

/// Draws magnitude and phase into `figures/`, as SVG and PNG, and writes `report.html`.
///
/// # Errors
/// Those of the drawing and of the folder.
pub fn draw_response_report(
    folder: &OutputFolder,
    response: &FrequencyResponse,
    summary: &ResponseSummary,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let figure = NamedFigure {
        name: "response".into(),
        caption: "Frequency response of the model: magnitude and phase.".into(),
        svg: draw_response(&ResponsePlot {
            frequencies_hz: response.frequencies_hz(),
            values: response.values(),
            unit: unit_of(response.quantity()).to_owned(),
        })?,
    };
    let report = Report {
        title: summary.title.clone(),
        sections: vec![ReportSection {
            heading: "Frequency response".into(),
            paragraphs: vec![summary.description.clone()],
            tables: Vec::new(),
            figures: vec![figure],
        }],
        manifest: folder.manifest().clone(),
    };
    write_report(folder, &report, options)
}
