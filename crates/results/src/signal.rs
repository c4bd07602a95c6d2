//! Tables, figures and page of an analysed time signal.

mod summary;

use crate::cea::{BRANCH, DIRECTION};
use crate::charts::{run_axis, signal_panel, spectrogram_panels, spectrum_panel};
use crate::common::*;
use frictionsim_physics::parallel::map;
use frictionsim_signal::reader::{Channel, SignalFile};
pub use summary::{
    ChannelSummary, MODE_TOLERANCE, ModeSummary, NearestMode, PeakSummary, SignalSummary,
};

/// A peak of a channel, numbered from 1.
type Row = (String, usize, PeakSummary);

columns! {
    /// A peak.
    pub(super) PEAKS: row as Row;
    channel: "name of the channel" = row.0.clone();
    peak: "number of the peak, the strongest first, from 1" = row.1, Always "peak" Count;
    frequency_hz: "frequency of the peak" = row.2.line.frequency_hz, Always "frequency" Fixed(2);
    amplitude: "amplitude, in the unit of the signal" = row.2.line.amplitude, Always "amplitude" Scientific(4);
    superharmonic_of_peak: "peak of which it is a multiple" = row.2.line.superharmonic.map(|own| own.of_peak);
    order: "which multiple" = row.2.line.superharmonic.map(|own| own.order);
    nearest_mode: "number of the mode beside it, from 1" = row.2.nearest_mode.as_ref().map(|mode| mode.mode);
    mode_frequency_hz: "frequency of that mode" = row.2.nearest_mode.as_ref().map(|mode| mode.frequency_hz);
    harmonic: "its nodal diameters; none without symmetry" = row.2.nearest_mode.as_ref().and_then(|mode| mode.harmonic);
    branch: BRANCH = row.2.nearest_mode.as_ref().map(|mode| mode.branch);
    direction: DIRECTION = row.2.nearest_mode.as_ref().and_then(|mode| mode.direction);

    /// A line of a spectrum.
    pub(super) SPECTRUM: line as (f64, f64);
    frequency_hz: "frequency" = line.0;
    amplitude: "amplitude, in the unit of the signal" = line.1;
}

/// The peaks of a channel.
fn rows(channel: &ChannelSummary) -> impl Iterator<Item = Row> {
    (1..).zip(&channel.peaks).map(|(number, peak)| (channel.name.clone(), number, peak.clone()))
}

/// Tables and sentences.
pub fn document(summary: &SignalSummary) -> Document {
    let of_channel = |channel: &ChannelSummary| {
        let ChannelSummary { name, interval_s: [from, to], resolution_hz, .. } = channel;
        let blocks = plural(channel.averages, ["block", "blocks"]);
        let caption = format!(
            "{name}: peaks between {from:.4} and {to:.4} s, resolution {resolution_hz:.4} Hz (mean of {blocks})"
        );
        let words = channel.peaks.iter().map(|peak| channel.peak_text(peak));
        Table::new("", caption).columns(PEAKS, rows(channel)).shown_column("what it is", words)
    };
    let said = |channel: &ChannelSummary| {
        let ([from, to], name) = (channel.interval_s, channel.name.clone());
        let none = format!("no peak stands out from the noise between {from:.4} and {to:.4} s");
        let none = channel.peaks.is_empty().then_some(none);
        let texts =
            [none, Some(channel.growth_text()), channel.mode_text(summary.friction_coefficient)];
        texts.into_iter().flatten().map(move |text| format!("{name}: {text}."))
    };
    let SignalSummary { source, samples, sampling_rate_hz: rate, .. } = summary;
    let seconds = fixed(*samples as f64 / rate, 4);
    // A rate from the rounded times of a table has a few true digits.
    let rate = significant(*rate, 9);
    let sampled = format!("{source}: {samples} samples at {rate} Hz ({seconds} s).");
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

/// A signal, and how its figures show it.
#[derive(Clone, Debug)]
pub struct SignalDrawing<'a> {
    /// The signal.
    pub file: &'a SignalFile,
    /// The spectrum of each channel.
    pub spectra: Vec<AmplitudeSpectrum>,
    /// Window of the spectrogram, s.
    pub window: f64,
    /// Highest frequency drawn, Hz.
    pub max_frequency_hz: f64,
    /// Modes drawn as lines.
    pub modes: Vec<ModeLine>,
}

/// Draws each channel over its spectrograms, then the spectra; beside the figures, why a spectrogram was left out.
pub fn draw(drawing: &SignalDrawing<'_>, summary: &SignalSummary) -> (Vec<Figure>, Vec<String>) {
    let channels = drawing.file.channels.iter().enumerate();
    let courses: Vec<(Figure, Option<String>)> =
        map(channels, |(index, channel)| drawing.course(channel, index + 1));
    let (mut figures, left_out): (Vec<Figure>, Vec<Option<String>>) = courses.into_iter().unzip();
    let channels = summary.channels.iter().enumerate();
    figures.extend(map::<_, _, Vec<Figure>>(channels, |(index, channel)| {
        drawing.spectrum(channel, index)
    }));
    figures.retain(Figure::has_data);
    let mut left_out: Vec<String> = left_out.into_iter().flatten().collect();
    left_out.sort();
    (figures, left_out)
}

impl SignalDrawing<'_> {
    /// Signal over its spectrograms, with the frequencies of the modes named, and why there are no spectrograms.
    fn course(&self, channel: &Channel, number: usize) -> (Figure, Option<String>) {
        let (rate, start) = (self.file.sampling_rate, self.file.start);
        let time = |j: usize| start + j as f64 / rate;
        let times: Vec<f64> = (0..channel.samples.len()).map(time).collect();
        let axis = run_axis(&times);
        let map = spectrogram(&channel.samples, rate, self.window, self.max_frequency_hz);
        let (spectrograms, reason) = match map {
            Ok(map) => (spectrogram_panels(&axis, &map, start, self.highest(), &self.modes), None),
            Err(error) => {
                let name = &channel.name;
                (Vec::new(), Some(format!("no spectrogram of {name}: {error}; try --window")))
            }
        };
        let quantity = ("signal", unit_of(&channel.name).1);
        let signal = signal_panel(axis, &times, &channel.samples, quantity, 0.45);
        let caption = format!("Signal and spectrograms of {}.", channel.name);
        let figure = Figure::new(format!("signal-{number}"), caption)
            .shared_x()
            .panel(signal.caption(literal(&channel.name)))
            .panels(spectrograms);
        (figure, reason)
    }

    /// The spectrum that the peaks are taken from.
    fn spectrum(&self, channel: &ChannelSummary, index: usize) -> Figure {
        let [from, to] = channel.interval_s;
        let spectra = [(&literal(&channel.name)[..], &self.spectra[index])];
        let caption = format!("Spectrum of {} from {from:.4} to {to:.4} s.", channel.name);
        let frequencies = (self.highest(), channel.main_frequency_hz);
        let panel = spectrum_panel(&spectra, unit_of(&channel.name).1, frequencies, &self.modes);
        Figure::new(format!("spectrum-{}", index + 1), caption).panel(panel)
    }

    fn highest(&self) -> f64 {
        self.max_frequency_hz.min(0.5 * self.file.sampling_rate)
    }
}
