//! Tables, figures and page of an analysed time signal.

mod figures;
mod summary;

pub use figures::{SignalDrawing, draw};
pub use summary::{
    ChannelSummary, MODE_TOLERANCE, ModeSummary, NearestMode, PeakSummary, SignalSummary,
};

use super::cea::{BRANCH, DIRECTION};
use super::{FolderError, OutputFolder};
use frictionsim_output::{Document, Section, Table, columns, fixed, significant, write_rows};
use frictionsim_signal::AmplitudeSpectrum;

/// A peak of a channel, numbered from 1, and what it is.
type Row = (String, usize, PeakSummary, String);

columns! {
    /// A peak.
    pub(super) PEAKS: row as Row;
    channel: "name of the channel" = row.0.clone();
    peak: "number of the peak, the strongest first, from 1" = row.1, Always "peak" Count;
    frequency_hz: "frequency of the peak" = row.2.line.frequency_hz, Always "frequency" Fixed(2);
    amplitude: "amplitude, in the unit of the signal"
        = row.2.line.amplitude, Always "amplitude" Scientific(4);
    superharmonic_of_peak: "peak of which it is a multiple"
        = row.2.line.superharmonic.map(|own| own.of_peak);
    order: "which multiple" = row.2.line.superharmonic.map(|own| own.order);
    nearest_mode: "number of the mode beside it, from 1"
        = row.2.nearest_mode.as_ref().map(|mode| mode.mode);
    mode_frequency_hz: "frequency of that mode"
        = row.2.nearest_mode.as_ref().map(|mode| mode.frequency_hz);
    harmonic: "its nodal diameters; none without symmetry"
        = row.2.nearest_mode.as_ref().and_then(|mode| mode.harmonic);
    branch: BRANCH = row.2.nearest_mode.as_ref().map(|mode| mode.branch);
    direction: DIRECTION = row.2.nearest_mode.as_ref().and_then(|mode| mode.direction);
}

columns! {
    /// What a peak is, in words.
    WORDS: row as Row;
    what = row.3.clone(), IfAny "what it is" Plain;
}

columns! {
    /// A line of a spectrum.
    pub(super) SPECTRUM: line as (f64, f64);
    frequency_hz: "frequency" = line.0;
    amplitude: "amplitude, in the unit of the signal" = line.1;
}

/// The peaks of a channel.
fn rows(channel: &ChannelSummary) -> impl Iterator<Item = Row> {
    let peaks = channel.peaks.iter().enumerate();
    peaks.map(|(k, peak)| (channel.name.clone(), k + 1, peak.clone(), channel.peak_text(peak)))
}

/// Tables and sentences.
pub fn document(summary: &SignalSummary) -> Document {
    let of_channel = |channel: &ChannelSummary| {
        let [from, to] = channel.interval_s;
        let caption = format!(
            "{}: peaks between {from:.4} and {to:.4} s, resolution {:.4} Hz ({})",
            channel.name,
            channel.resolution_hz,
            match channel.averages {
                1 => "one block".to_owned(),
                count => format!("mean of {count} blocks"),
            }
        );
        let table = Table::new("", caption);
        table.columns(PEAKS, rows(channel)).columns(WORDS, rows(channel))
    };
    let said = |channel: &ChannelSummary| {
        let none = channel.peaks.is_empty().then(|| "no peak stands out from the noise".to_owned());
        let texts =
            [none, Some(channel.growth_text()), channel.mode_text(summary.friction_coefficient)];
        let name = channel.name.clone();
        texts.into_iter().flatten().map(move |text| format!("{name}: {text}."))
    };
    let sampled = format!(
        "{}: {} samples at {} Hz ({} s).",
        summary.source,
        summary.samples,
        // A rate from the rounded times of a table has a few true digits.
        significant(summary.sampling_rate_hz, 9),
        fixed(summary.samples as f64 / summary.sampling_rate_hz, 4)
    );
    Document::new("Lines of a signal")
        .section(
            Section::new("Signal")
                .text(std::iter::once(sampled).chain(summary.channels.iter().flat_map(said)))
                .tables(summary.channels.iter().map(of_channel))
                .figures([""]),
        )
        .file(Table::new("peaks.csv", "").columns(PEAKS, summary.channels.iter().flat_map(rows)))
        .notes(&summary.notes)
}

/// Writes a spectrum for each channel.
pub fn write_spectra(
    folder: &OutputFolder,
    spectra: &[AmplitudeSpectrum],
) -> Result<(), FolderError> {
    for (k, spectrum) in spectra.iter().enumerate() {
        let lines = spectrum.frequencies_hz.iter().copied().zip(spectrum.amplitudes.clone());
        folder.write(&format!("spectrum-{}.csv", k + 1), |out| write_rows(out, SPECTRUM, lines))?;
    }
    Ok(())
}
