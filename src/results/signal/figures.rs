//! The figures of an analysed time signal.

use super::summary::SignalSummary;
use crate::chart::{ChartError, Figure, literal};
use crate::results::charts::{
    ModeLine, run_axis, signal_panel, spectrogram_panels, spectrum_panel,
};
use crate::results::drawing::{Declaration, declared};
use crate::signal::{SpectrogramOptions, spectrogram};
use std::sync::Mutex;

/// Everything that the figures show.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalRecord {
    /// Sampling rate, Hz.
    pub sampling_rate: f64,
    /// Time of the first sample, s.
    pub start: f64,
    /// Window of the spectrogram, s.
    pub window: f64,
    /// Highest frequency drawn, Hz.
    pub max_frequency_hz: f64,
    /// Frequency (Hz) and name, in mark-up, of the modes drawn as lines.
    pub references: Vec<(f64, String)>,
    /// The channels.
    pub channels: Vec<ChannelRecord>,
}

/// One channel.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelRecord {
    /// Name as in the table.
    pub name: String,
    /// Its samples.
    pub samples: Vec<f64>,
    /// Interval of the spectrum, s.
    pub interval_s: (f64, f64),
    /// Frequencies of the spectrum, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Amplitudes of the spectrum.
    pub amplitudes: Vec<f64>,
}

/// Draws each channel over its spectrograms, then the spectra; beside the figures, why a spectrogram was left out.
pub fn draw(
    record: &SignalRecord,
    summary: &SignalSummary,
) -> Result<(Vec<Figure>, Vec<String>), ChartError> {
    let left_out = Mutex::new(Vec::new());
    let left_out = &left_out;
    let mut figures: Vec<Declaration<'_>> = Vec::new();
    for (index, channel) in record.channels.iter().enumerate() {
        figures.push(Box::new(move || {
            let (figure, reason) = course(record, channel, index + 1);
            if let (Some(reason), Ok(mut left_out)) = (reason, left_out.lock()) {
                left_out.push(reason);
            }
            Ok(figure)
        }));
    }
    for (index, channel) in record.channels.iter().enumerate() {
        let found = summary.channels.get(index);
        let main_hz = found.and_then(|channel| channel.main_frequency_hz);
        figures.push(Box::new(move || Ok(spectrum(record, channel, index + 1, main_hz))));
    }
    let figures = declared(figures)?;
    let mut left_out = left_out.lock().map_or(Vec::new(), |reasons| reasons.clone());
    left_out.sort();
    Ok((figures, left_out))
}

/// Signal over its spectrograms, with the frequencies of the modes named, and why there are no spectrograms.
fn course(
    record: &SignalRecord,
    channel: &ChannelRecord,
    number: usize,
) -> (Figure, Option<String>) {
    let time = |j: usize| record.start + j as f64 / record.sampling_rate;
    let times: Vec<f64> = (0..channel.samples.len()).map(time).collect();
    let axis = run_axis(&times);
    let window = SpectrogramOptions {
        window_length: record.window,
        hop: 0.25 * record.window,
        max_frequency_hz: record.max_frequency_hz,
        ..SpectrogramOptions::default()
    };
    let (spectrograms, reason) = match spectrogram(&channel.samples, record.sampling_rate, &window)
    {
        Ok(map) => {
            (spectrogram_panels(&axis, &map, record.start, highest(record), &modes(record)), None)
        }
        Err(error) => {
            (Vec::new(), Some(format!("no spectrogram of {}: {error}; try --window", channel.name)))
        }
    };
    let signal = signal_panel(axis, &times, &channel.samples, ("signal", ""), 0.45);
    let figure = Figure::new(
        format!("signal-{number}"),
        format!("Signal and spectrograms of {}.", channel.name),
    )
    .shared_x()
    .panel(signal.caption(literal(&channel.name)))
    .panels(spectrograms);
    (figure, reason)
}

/// The spectrum that the peaks are taken from.
fn spectrum(
    record: &SignalRecord,
    channel: &ChannelRecord,
    number: usize,
    main_hz: Option<f64>,
) -> Figure {
    let (from, to) = channel.interval_s;
    let name = literal(&channel.name);
    let spectra: [(&str, &[f64], &[f64]); 1] =
        [(&name, &channel.frequencies_hz, &channel.amplitudes)];
    let caption = format!("Spectrum of {} from {from:.4} to {to:.4} s.", channel.name);
    Figure::new(format!("spectrum-{number}"), caption).panel(spectrum_panel(
        &spectra,
        "",
        (highest(record), main_hz),
        &modes(record),
    ))
}

fn highest(record: &SignalRecord) -> f64 {
    record.max_frequency_hz.min(0.5 * record.sampling_rate)
}

fn modes(record: &SignalRecord) -> Vec<ModeLine> {
    let lines = record.references.iter();
    let line = |(frequency_hz, label): &(f64, String)| ModeLine {
        frequency_hz: *frequency_hz,
        label: label.clone(),
    };
    lines.map(line).collect()
}
