//! Tables, figure and report of an identified damping.

mod figures;
mod report;
mod summary;

pub use figures::{IdentificationRecord, unit_of};
pub use report::draw_report;
pub use summary::{
    CoefficientSummary, FitSummary, HalfPowerSummary, IdentificationSummary, ModeSummary,
    ResponseSummary,
};

use super::summary::write_summary;
use super::table::{Table, format_number};
use super::{FolderError, OutputFolder};
use crate::signal::reader::NamedResponse;
use crate::signal::{FrequencyResponse, ModalFit};
use serde_json::Value;

/// Name of the `[damping]` section in its folder.
const DAMPING_BLOCK: &str = "damping.toml";

/// Writes `modes.csv`, `fit.csv` (`fit-2.csv` and so on for further responses), `damping.toml` and
/// `summary.json`; returns the object of the summary.
///
/// # Errors
/// Those of the folder.
pub fn write(
    folder: &OutputFolder,
    summary: &IdentificationSummary,
    responses: &[NamedResponse],
    fit: &ModalFit,
) -> Result<Value, FolderError> {
    folder.write("modes.csv", |out| write_modes(out, summary))?;
    for (k, named) in responses.iter().enumerate() {
        let name = match k {
            0 => "fit.csv".to_owned(),
            _ => format!("fit-{}.csv", k + 1),
        };
        folder.write(&name, |out| write_fit(out, &named.response, fit, k))?;
    }
    folder.write(DAMPING_BLOCK, |out| out.write_all(summary.damping_block().as_bytes()))?;
    write_summary(folder, summary)
}

fn write_modes(
    out: &mut dyn std::io::Write,
    summary: &IdentificationSummary,
) -> std::io::Result<()> {
    let columns = [
        "mode",
        "frequency_hz",
        "frequency_low_hz",
        "frequency_high_hz",
        "damping_factor",
        "damping_factor_low",
        "damping_factor_high",
        "half_power_damping_factor",
        "half_power_low_hz",
        "half_power_high_hz",
        "used",
        "flag",
    ];
    let mut table = Table::new(out, &columns)?;
    for (k, mode) in summary.modes.iter().enumerate() {
        let ([f_low, f_high], [low, high]) =
            (mode.frequency_interval_hz, mode.damping_factor_interval);
        let half = mode.half_power.as_ref();
        let band = half.and_then(|b| b.band_hz).unwrap_or([f64::NAN; 2]);
        let half = half.and_then(|b| b.damping_factor).unwrap_or(f64::NAN);
        let (f, zeta) = (mode.frequency_hz, mode.damping_factor);
        let numbers = [f, f_low, f_high, zeta, low, high, half, band[0], band[1]];
        let mut cells = vec![(k + 1).to_string()];
        cells.extend(numbers.iter().map(|v| format_number(*v)));
        cells.push(mode.used.to_string());
        cells.push(mode.flag.clone().unwrap_or_default());
        table.row(cells)?;
    }
    table.finish()
}

fn write_fit(
    out: &mut dyn std::io::Write,
    response: &FrequencyResponse,
    fit: &ModalFit,
    number: usize,
) -> std::io::Result<()> {
    let columns = ["frequency_hz", "real", "imaginary", "fit_real", "fit_imaginary"];
    let mut table = Table::new(out, &columns)?;
    for (f, h) in response.frequencies_hz().iter().zip(response.values()) {
        let model = fit.evaluate(number, *f);
        let part = |v: Option<f64>| v.unwrap_or(f64::NAN);
        let (re, im) = (part(model.map(|m| m.re)), part(model.map(|m| m.im)));
        table.numbers(&[*f, h.re, h.im, re, im])?;
    }
    table.finish()
}
