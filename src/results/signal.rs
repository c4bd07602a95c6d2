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
use super::table::{Column, Table, write_rows};
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
    type Row<'a> = (&'a str, usize, &'a PeakSummary);
    fn mode<'a>(row: &Row<'a>) -> Option<&'a ModeSummary> {
        row.2.nearest_mode.as_ref()
    }
    let columns: &[Column<'_, Row<'_>>] = &[
        ("channel", &|row| row.0.into()),
        ("peak", &|row| (row.1 + 1).into()),
        ("frequency_hz", &|row| row.2.frequency_hz.into()),
        ("amplitude", &|row| row.2.amplitude.into()),
        ("superharmonic_of_peak", &|row| {
            row.2.superharmonic.as_ref().map(|line| line.of_peak).into()
        }),
        ("order", &|row| row.2.superharmonic.as_ref().map(|line| line.order).into()),
        ("nearest_mode", &|row| mode(row).map(|mode| mode.mode).into()),
        ("mode_frequency_hz", &|row| mode(row).map(|mode| mode.frequency_hz).into()),
        ("harmonic", &|row| mode(row).and_then(|mode| mode.harmonic).into()),
        ("branch", &|row| mode(row).map(|mode| mode.branch).into()),
        ("direction", &|row| mode(row).and_then(|mode| mode.direction).into()),
    ];
    let rows = summary.channels.iter().flat_map(|channel| {
        let peaks = channel.peaks.iter().enumerate();
        peaks.map(|(k, peak)| (&*channel.name, k, peak))
    });
    write_rows(out, columns, rows)
}
