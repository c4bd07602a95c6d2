//! Table, figure and report of a computed frequency response.

use super::drawing::{DrawingError, DrawingOptions, write_report};
use super::figures::{ResponsePlot, draw_response};
use super::folder::{FolderError, OutputFolder};
use super::identification::unit_of;
use super::report::{NamedFigure, Report, ReportSection};
use super::table::Table;
use crate::signal::{FrequencyResponse, ResponseQuantity};
use faer::c64;
use serde_json::Value;

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
    summary: &Value,
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
    let text = summary["description"].as_str().unwrap_or_default();
    let report = Report {
        title: summary["title"].as_str().unwrap_or_default().to_owned(),
        sections: vec![ReportSection {
            heading: "Frequency response".into(),
            paragraphs: vec![text.to_owned()],
            tables: Vec::new(),
            figures: vec![figure],
        }],
        manifest: folder.manifest().clone(),
    };
    write_report(folder, &report, options)
}
