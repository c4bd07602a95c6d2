//! The figures of an analysed time signal, and what is kept to draw them again.

use crate::results::Record;
use crate::results::figures::text::literal;
use crate::results::figures::{
    FigureError, ReferenceFrequency, SpectrogramMap, SpectrumPlot, TransientOverview,
    draw_spectrum, draw_transient_overview,
};
use crate::results::report::NamedFigure;
use crate::signal::{SpectrogramOptions, spectrogram};
use serde::{Deserialize, Serialize};

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
            let rises = channel
                .frequencies_hz
                .windows(2)
                .all(|pair| pair[0] < pair[1]);
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

/// Figures, and why others were left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SignalFigures {
    /// The figures.
    pub figures: Vec<NamedFigure>,
    /// What could not be drawn.
    pub left_out: Vec<String>,
}

impl SignalFigures {
    fn add(&mut self, name: String, caption: String, drawing: Result<String, String>) {
        match drawing {
            Ok(svg) => self.figures.push(NamedFigure { name, caption, svg }),
            Err(reason) => self.left_out.push(reason),
        }
    }
}

/// Draws each channel over its spectrograms, then the spectra.
pub fn draw(record: &SignalRecord) -> SignalFigures {
    let mut drawn = SignalFigures::default();
    for (k, channel) in record.channels.iter().enumerate() {
        let name = format!("signal-{}", k + 1);
        let caption = format!("Signal and spectrograms of {}.", channel.name);
        drawn.add(name, caption, overview(record, channel));
    }
    for (k, channel) in record.channels.iter().enumerate() {
        let (from, to) = channel.interval_s;
        let name = format!("spectrum-{}", k + 1);
        let caption = format!("Spectrum of {} from {from:.4} to {to:.4} s.", channel.name);
        drawn.add(name, caption, spectrum(record, channel));
    }
    drawn
}

/// Signal over its spectrogram, with the frequencies of the modes named.
fn overview(record: &SignalRecord, channel: &ChannelRecord) -> Result<String, String> {
    let options = SpectrogramOptions {
        window_length: record.window,
        hop: 0.25 * record.window,
        max_frequency_hz: record.max_frequency_hz,
        ..SpectrogramOptions::default()
    };
    let map = spectrogram(&channel.samples, record.sampling_rate, &options)
        .map_err(|error| format!("no spectrogram of {}: {error}; try --window", channel.name))?;
    let times: Vec<f64> = (0..channel.samples.len())
        .map(|j| record.start + j as f64 / record.sampling_rate)
        .collect();
    let centres: Vec<f64> = map.times.iter().map(|t| record.start + t).collect();
    let drawing = draw_transient_overview(&TransientOverview {
        signal_name: literal(&channel.name),
        signal_unit: String::new(),
        times: &times,
        signal: &channel.samples,
        spectrogram: Some(SpectrogramMap {
            times: &centres,
            frequencies_hz: &map.frequencies_hz,
            amplitude: &map.magnitudes,
        }),
        max_frequency_hz: highest(record),
        references: references(record),
        status: None,
        stages: Vec::new(),
        enlarged: 0.0,
    });
    drawing.map_err(|error| left_out(channel, &error))
}

/// The spectrum that the peaks are taken from.
fn spectrum(record: &SignalRecord, channel: &ChannelRecord) -> Result<String, String> {
    let drawing = draw_spectrum(&SpectrumPlot {
        signal_name: literal(&channel.name),
        unit: String::new(),
        frequencies_hz: &channel.frequencies_hz,
        amplitude: &channel.amplitudes,
        max_frequency_hz: highest(record),
        references: references(record),
    });
    drawing.map_err(|error| left_out(channel, &error))
}

fn left_out(channel: &ChannelRecord, error: &FigureError) -> String {
    format!("figure of {} left out: {error}", channel.name)
}

fn highest(record: &SignalRecord) -> f64 {
    record.max_frequency_hz.min(0.5 * record.sampling_rate)
}

fn references(record: &SignalRecord) -> Vec<ReferenceFrequency> {
    let lines = record.references.iter();
    lines
        .map(|(frequency_hz, label)| ReferenceFrequency {
            frequency_hz: *frequency_hz,
            label: label.clone(),
        })
        .collect()
}
