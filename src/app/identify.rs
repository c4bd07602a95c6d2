//! `frictionsim identify`: Rayleigh coefficients from a measured frequency response.

use super::measurement::{Measurement, SideFile, chosen};
use super::prelude::*;
use super::{one_of, options::Choice};
use crate::results::identification::{
    DAMPING_BLOCK, IdentificationSummary, document, identification, write_fits,
};
use crate::signal::reader::{ResponseOptions, read_response};
use crate::signal::{FrequencyResponse, ResponseQuantity, identify};

/// Find damping from a measured frequency response
///
/// Reads a text table, a universal file (UFF 58) or a MATLAB file with one or several responses. These are real and
/// imaginary part, or magnitude (linear or dB) with or without phase. Finds the resonances and the damping of each by a
/// fit of the whole response. Fits alpha_R and beta_R of C = alpha_R M + beta_R K.
#[derive(Args)]
pub struct Arguments {
    /// Table of one or more frequency responses, UFF or MATLAB file
    #[arg(value_name = "FRF.csv", value_hint = ValueHint::FilePath)]
    response: PathBuf,
    /// Quantity in the table, if its header does not name it [default: accelerance]
    #[arg(long, value_parser = one_of(&QUANTITIES), value_name = "QUANTITY")]
    quantity: Option<ResponseQuantity>,
    /// Column names, if the header is missing or misread: f, f_khz, omega, re, im, mag, db, phase, phase_rad,
    /// coherence, - to skip
    #[arg(long, value_name = "NAMES", value_delimiter = ',', allow_hyphen_values = true)]
    columns: Vec<String>,
    /// Responses by name or number [default: all, fitted with common modes]
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    channel: Vec<String>,
    /// Write the responses as a universal file (dataset 58) too
    #[arg(long, value_name = "FILE.uff", value_hint = ValueHint::FilePath)]
    uff: Option<PathBuf>,
    /// Lowest frequency to use
    #[arg(long, value_name = "HZ")]
    from: Option<f64>,
    /// Highest frequency to use
    #[arg(long, value_name = "HZ")]
    to: Option<f64>,
    #[command(flatten)]
    output: OutputOptions,
}

/// Quantities, each with its word.
const QUANTITIES: [Choice<ResponseQuantity>; 3] = [
    ("accelerance", ResponseQuantity::Accelerance, "Acceleration over force"),
    ("mobility", ResponseQuantity::Mobility, "Velocity over force"),
    ("receptance", ResponseQuantity::Receptance, "Displacement over force"),
];

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    let range @ (low, high) = (asked.from.unwrap_or(0.0), asked.to.unwrap_or(f64::INFINITY));
    if !(low >= 0.0 && low < high) {
        return Err(Failure::usage(format!(
            "--from {low} --to {high}: the range must start at 0 Hz or higher and end above its start"
        )));
    }
    let (uff, force) = (asked.uff.as_deref(), asked.output.force);
    let copy = SideFile::prepare("--uff", uff, &asked.response, force)?;
    let measurement =
        Measurement::start("identify", &asked.response, &asked.output, choices(asked))?;
    let reading = ResponseOptions {
        quantity: asked.quantity,
        columns: asked.columns.clone(),
        channels: asked.channel.clone(),
    };
    let file = read_response(&measurement.bytes, &measurement.source, &reading)?;
    for note in &file.notes {
        tracing::warn!("{}: {note}", measurement.source);
    }
    let responses: Vec<FrequencyResponse> =
        file.responses.iter().map(|named| named.response.clone()).collect();
    let found = identify(&responses, Some(range))
        .map_err(|error| Failure::run(format!("{}: {error}", measurement.source)))?;
    let folder = asked.output.open_folder(&measurement.manifest, false)?;
    let (source, notes) = (&measurement.source, file.notes.clone());
    let summary = IdentificationSummary::new(source, &file.responses, &found, notes);
    write_fits(&folder, &file.responses, &found.fit)?;
    let block = summary.damping_block();
    folder.write(DAMPING_BLOCK, |out| out.write_all(block.as_bytes()))?;
    if let Some(copy) = copy {
        let text: String = file.responses.iter().map(|own| own.written([(0, 0); 2])).collect();
        copy.write(text.as_bytes())?;
    }
    let figures = || vec![identification(&responses[0], &found)];
    let told = Told::of(measurement.head(), document(&summary));
    asked.output.finish_result(folder, told, &summary, figures)
}

/// Options that change the result.
fn choices(arguments: &Arguments) -> Vec<String> {
    chosen("quantity", arguments.quantity.map(|quantity| quantity.name()))
        .chain(chosen("from", arguments.from))
        .chain(chosen("to", arguments.to))
        .chain(chosen("columns", &arguments.columns))
        .chain(chosen("channel", &arguments.channel))
        .collect()
}
