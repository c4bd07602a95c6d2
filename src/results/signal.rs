//! Tables, figures and report of an analysed time signal.

mod figures;
mod report;
mod summary;

pub use figures::{ChannelRecord, SignalRecord, draw};
pub use report::draw_report;
pub use summary::{
    ChannelSummary, GrowthSummary, ModeSummary, NearestMode, PeakSummary, SignalSummary,
    Superharmonic,
};

use super::summary::write_summary;
use super::table::{Table, format_number};
use super::{FolderError, OutputFolder};
use crate::signal::AmplitudeSpectrum;
use serde_json::Value;

/// Writes `peaks.csv`, a spectrum for each channel and `summary.json`; returns the object of the summary.
///
/// # Errors
/// Those of the folder.
pub fn write(
    folder: &OutputFolder,
    summary: &SignalSummary,
    spectra: &[AmplitudeSpectrum],
) -> Result<Value, FolderError> {
    folder.write("peaks.csv", |out| write_peaks(out, summary))?;
    for (k, spectrum) in spectra.iter().enumerate() {
        folder.write(&format!("spectrum-{}.csv", k + 1), |out| {
            let mut table = Table::new(out, &["frequency_hz", "amplitude"])?;
            for (f, a) in spectrum.frequencies_hz.iter().zip(&spectrum.amplitudes) {
                table.numbers(&[*f, *a])?;
            }
            table.finish()
        })?;
    }
    write_summary(folder, summary)
}

fn write_peaks(out: &mut dyn std::io::Write, summary: &SignalSummary) -> std::io::Result<()> {
    let columns = [
        "channel",
        "peak",
        "frequency_hz",
        "amplitude",
        "superharmonic_of_peak",
        "order",
        "nearest_mode",
        "mode_frequency_hz",
        "harmonic",
        "branch",
        "direction",
    ];
    let mut table = Table::new(out, &columns)?;
    for channel in &summary.channels {
        for (k, peak) in channel.peaks.iter().enumerate() {
            let mut cells = vec![
                channel.name.clone(),
                (k + 1).to_string(),
                format_number(peak.frequency_hz),
                format_number(peak.amplitude),
            ];
            cells.extend(match &peak.superharmonic {
                Some(line) => [line.of_peak.to_string(), line.order.to_string()],
                None => [String::new(), String::new()],
            });
            cells.extend(match &peak.nearest_mode {
                Some(mode) => [
                    mode.mode.to_string(),
                    format_number(mode.frequency_hz),
                    mode.harmonic.map_or(String::new(), |n| n.to_string()),
                    mode.branch.to_string(),
                    mode.direction.map_or(String::new(), |d| d.to_string()),
                ],
                None => Default::default(),
            });
            table.row(cells)?;
        }
    }
    table.finish()
}
