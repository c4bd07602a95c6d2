//! Table, figure and report of a computed frequency response.

use super::Manifest;
use super::drawing::{DrawingError, DrawingOptions, draw_all, write_report};
use super::folder::{FolderError, OutputFolder};
use super::identification::unit_of;
use super::reopening::read_own;
use super::report::{Report, ReportSection};
use super::summary::{Entry, Summary, present};
use super::table::Table;
use crate::chart::{Axis, Figure, INK, Line, Marker, Panel, Points, SERIES};
use crate::linalg::c64;
use crate::signal::{FrequencyResponse, ResponseQuantity};
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
    let report = Report {
        title: summary.title.clone(),
        sections: vec![ReportSection {
            heading: "Frequency response".into(),
            paragraphs: vec![summary.description.clone()],
            tables: Vec::new(),
            figures: draw_all(vec![Box::new(|| Ok(response_figure(response)))], options)?,
        }],
        manifest: folder.manifest().clone(),
    };
    write_report(folder, &report, options)
}

/// Magnitude and phase of a response over the frequency.
fn response_figure(response: &FrequencyResponse) -> Figure {
    let (frequencies, values) = (response.frequencies_hz(), response.values());
    let magnitude: Vec<f64> = values.iter().map(|h| h.norm()).collect();
    let turns: Vec<f64> = values.iter().map(|h| h.arg().to_degrees()).collect();
    // Where the phase jumps by a turn the line breaks; a sample between two jumps would be a speck.
    let jumps = |i: usize| {
        turns
            .get(i + 1)
            .is_some_and(|next| (next - turns[i]).abs() > 180.0)
    };
    let pieces = (0..turns.len()).collect::<Vec<_>>();
    let pieces = pieces.chunk_by(|&i, _| !jumps(i));
    let kept = pieces.filter(|piece| piece.len() > 2).flat_map(|piece| {
        let points = piece.iter().map(|&i| (frequencies[i], turns[i]));
        points.chain([(f64::NAN, f64::NAN)]).collect::<Vec<_>>()
    });
    let phase = Line::through(kept).solid(SERIES[0], 0.8);
    let quarters =
        [-180, -90, 0, 90, 180].map(|d: i32| (f64::from(d), d.to_string().replace('-', "−")));
    let over = |y: Axis, height: f64, line: Line| {
        Panel::new(Axis::kilohertz().tight(), y)
            .height(height)
            .layer(line)
    };
    let size = Line::new(frequencies, &magnitude).solid(SERIES[0], 0.8);
    let peaks = (1..magnitude.len().saturating_sub(1))
        .filter(|&i| magnitude[i] > magnitude[i - 1] && magnitude[i] >= magnitude[i + 1]);
    let peaks =
        Points::new(peaks.map(|i| (frequencies[i], magnitude[i]))).marker(Marker::Disc, 1.2, INK);
    Figure::new(
        "response",
        "Frequency response of the model: magnitude (a), its maxima marked, and phase (b).",
    )
    .shared_x()
    .panel(
        over(
            Axis::new("|*H*|", unit_of(response.quantity())).logarithmic(),
            150.0,
            size,
        )
        .layer(peaks.name("maximum")),
    )
    .panel(over(
        Axis::new("phase", "°")
            .between(-190.0, 190.0)
            .ticks(quarters),
        72.0,
        phase,
    ))
}
