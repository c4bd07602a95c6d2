//! The figures of an analysed time signal.

use super::summary::{ChannelSummary, SignalSummary};
use crate::charts::{ModeLine, run_axis, signal_panel, spectrogram_panels, spectrum_panel};
use frictionsim_chart::{Figure, literal};
use frictionsim_output::unit_of;
use frictionsim_physics::parallel::map;
use frictionsim_signal::reader::{Channel, SignalFile};
use frictionsim_signal::{AmplitudeSpectrum, SpectrogramOptions, spectrogram};

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
        let window = SpectrogramOptions {
            window_length: self.window,
            hop: 0.25 * self.window,
            max_frequency_hz: self.max_frequency_hz,
            ..SpectrogramOptions::default()
        };
        let (spectrograms, reason) = match spectrogram(&channel.samples, rate, &window) {
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
