//! The figures of an analysed time signal, and what is kept to draw them again.

use super::summary::SignalSummary;
use crate::chart::{ChartError, Figure, literal};
use crate::results::Record;
use crate::results::charts::{
    ModeLine, run_axis, signal_panel, spectrogram_panels, spectrum_panel,
};
use crate::results::drawing::{Declaration, DrawingOptions, draw_all};
use crate::results::report::NamedFigure;
use crate::signal::{SpectrogramOptions, spectrogram};
use serde::{Deserialize, Serialize};
use std::sync::Mutex;

/// Everything that the figures show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

impl Record for SignalRecord {
    const MAGIC: [u8; 8] = *b"FRICSIMS";
    const VERSION: u32 = 1;

    fn inconsistency(&self) -> Option<&'static str> {
        let is_whole = |channel: &ChannelRecord| {
            let rises = channel.frequencies_hz.windows(2).all(|pair| pair[0] < pair[1]);
            let (from, to) = channel.interval_s;
            rises && from <= to && channel.frequencies_hz.len() == channel.amplitudes.len()
        };
        let is_positive = |value: f64| value > 0.0 && value.is_finite();
        let positive = [self.sampling_rate, self.window, self.max_frequency_hz];
        let is_whole = positive.into_iter().all(is_positive)
            && self.start.is_finite()
            && self.channels.iter().all(is_whole);
        (!is_whole).then_some("its rates, samples and spectra do not fit together")
    }
}

/// One channel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
///
/// # Errors
/// That of a figure that cannot be drawn although there is something to draw.
pub fn draw(
    record: &SignalRecord,
    summary: &SignalSummary,
    options: &DrawingOptions,
) -> Result<(Vec<NamedFigure>, Vec<String>), ChartError> {
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
    let figures = draw_all(figures, options)?;
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
