//! `frictionsim identify`: Rayleigh coefficients from a measured frequency response.

use super::Failure;
use super::measurement::Measurement;
use super::options::OutputOptions;
use crate::results::identification::{
    IdentificationRecord, IdentificationReport, draw_report, print, write,
};
use crate::results::{DrawingOptions, OutputFolder, read_record, write_record};
use crate::signal::reader::read_response;
use crate::signal::{IdentificationOptions, ResponseQuantity, identify};
use clap::{Args, ValueEnum, ValueHint};
use serde_json::Value;
use std::path::PathBuf;

/// Rayleigh coefficients from a measured frequency response
///
/// Reads a table of frequency with real and imaginary part, magnitude and phase (linear or dB), or
/// magnitude alone; finds the resonances; estimates each damping factor by the half-power method and
/// by a fit of the whole response; fits alpha_R and beta_R of C = alpha_R M + beta_R K.
#[derive(Args)]
pub struct Arguments {
    /// Table of the frequency response
    #[arg(value_name = "FRF.csv", value_hint = ValueHint::FilePath)]
    response: PathBuf,
    /// What the table holds, if its header does not say it (else accelerance)
    #[arg(long, value_enum, value_name = "QUANTITY")]
    quantity: Option<Quantity>,
    /// Lowest frequency to use
    #[arg(long, value_name = "HZ")]
    from: Option<f64>,
    /// Highest frequency to use
    #[arg(long, value_name = "HZ")]
    to: Option<f64>,
    #[command(flatten)]
    output: OutputOptions,
}

/// Quantities as options.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Quantity {
    /// Acceleration over force
    Accelerance,
    /// Velocity over force
    Mobility,
    /// Displacement over force
    Receptance,
}

impl From<Quantity> for ResponseQuantity {
    fn from(quantity: Quantity) -> Self {
        match quantity {
            Quantity::Accelerance => ResponseQuantity::Accelerance,
            Quantity::Mobility => ResponseQuantity::Mobility,
            Quantity::Receptance => ResponseQuantity::Receptance,
        }
    }
}

/// Runs the subcommand.
///
/// # Errors
/// A table that cannot be read (exit code 2), one without usable resonances (1), or an output folder
/// that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let options = identification_options(arguments)?;
    let measurement = Measurement::start(
        "identify",
        &arguments.response,
        &arguments.output,
        choices(arguments),
    )?;
    let quantity = arguments.quantity.map(ResponseQuantity::from);
    let file = read_response(&measurement.bytes, &measurement.source, quantity)?;
    for note in &file.notes {
        tracing::warn!("{}: {note}", measurement.source);
    }
    let found = identify(&file.response, &options)
        .map_err(|error| Failure::run(format!("{}: {error}", measurement.source)))?;
    let folder = measurement.open_folder()?;
    let report = IdentificationReport {
        source: measurement.source.clone(),
        response: &file.response,
        identification: &found,
        notes: file.notes.clone(),
        wall_s: measurement.wall_seconds(),
    };
    let summary = write(&folder, &report)?;
    write_record(&folder, &IdentificationRecord::of(&file.response, &found))?;
    if !arguments.output.no_figures {
        redraw(&folder, &summary, &arguments.output.figures.drawing())?;
    }
    let path = folder.path().to_owned();
    folder.finish()?;
    measurement.print(&print(&report), &summary, &path)
}

/// Draws the figure and the report of a folder from its `record.bin` and its summary.
///
/// # Errors
/// A folder without a whole record; those of the folder.
pub fn redraw(
    folder: &OutputFolder,
    summary: &Value,
    options: &DrawingOptions,
) -> Result<(), Failure> {
    let record: IdentificationRecord = read_record(folder.path())?;
    if let Some(error) = draw_report(folder, &record, summary, options)? {
        tracing::warn!("figure left out: {error}");
    }
    Ok(())
}

/// The frequency range, checked.
fn identification_options(arguments: &Arguments) -> Result<IdentificationOptions, Failure> {
    let low = arguments.from.unwrap_or(0.0);
    let high = arguments.to.unwrap_or(f64::INFINITY);
    if !(low >= 0.0 && low < high) {
        return Err(Failure::usage(format!(
            "--from {low} --to {high}: the range must begin at 0 Hz or above and end above its begin"
        )));
    }
    let is_given = arguments.from.is_some() || arguments.to.is_some();
    Ok(IdentificationOptions {
        range_hz: is_given.then_some((low, high)),
    })
}

/// Options that change the result.
fn choices(arguments: &Arguments) -> Vec<String> {
    let number = |name: &str, value: Option<f64>| value.map(|v| format!("{name}={v}"));
    let quantity = arguments
        .quantity
        .map(|q| format!("quantity={}", ResponseQuantity::from(q).name()));
    [
        quantity,
        number("from", arguments.from),
        number("to", arguments.to),
    ]
    .into_iter()
    .flatten()
    .collect()
}
