//! Figures of the probes' signals and of the harmonics of the contact edge.

use super::{RunFigures, Series};
use crate::results::figures::axis::extremes;
use crate::results::figures::{
    FigureError, HarmonicGrowth, PredictedGrowth, SpectrogramMap, SpectrumPlot, Stage,
    StatusHistory, TransientOverview, draw_harmonic_growth, draw_spectrum, draw_transient_overview,
};
use crate::signal::{SpectrogramOptions, Window, amplitude_spectrum, spectrogram};
use crate::transient::{EndState, Recorder, SampleRow, TransientAnalysis};

/// The stages of a run as figure 8 of the paper letters them: A vibrations of the start die out, B
/// exponential growth, C stick and separation set in, D limit cycle.
///
/// B begins where the strongest harmonic other than zero overtakes the vibration of harmonic zero (half
/// its range over 0.5 ms), D where it stays within 2 % of its last value for good. A run without a
/// linear stage has none.
pub(super) fn stages(record: &Recorder, analysis: &TransientAnalysis) -> Vec<Stage> {
    let rows = &record.rows;
    let (Some(end), Some(last)) = (analysis.first_nonlinearity, rows.last()) else {
        return Vec::new();
    };
    let size = |row: &SampleRow, n: usize| row.harmonics[n][0].hypot(row.harmonics[n][1]);
    let Some(main) = (1..last.harmonics.len()).max_by(|&a, &b| {
        let [a, b] = [a, b].map(|n| size(last, n));
        a.total_cmp(&b)
    }) else {
        return Vec::new();
    };
    let window = rows
        .partition_point(|row| row.time < rows[0].time + 5e-4)
        .max(2);
    let linear = rows.partition_point(|row| row.time < end);
    let overtaken = (0..linear / window)
        .rfind(|&block| {
            let block = &rows[block * window..(block + 1) * window];
            let (low, high) = extremes(block.iter().map(|row| row.harmonics[0][0]));
            let wave = block.iter().map(|row| size(row, main)).sum::<f64>();
            wave / (window as f64) < 0.5 * (high - low)
        })
        .map(|block| (block + 1) * window - 1);
    let settled = rows.iter().rposition(|row| {
        let limit = size(last, main);
        (size(row, main) - limit).abs() > 0.02 * limit
    });
    let time_after = |index: Option<usize>| {
        index
            .and_then(|i| rows.get(i + 1))
            .map_or(0.0, |row| row.time)
    };
    let growth = time_after(overtaken);
    let cycle = time_after(settled);
    let mut stages = Vec::new();
    let mut add = |name: &str, start: f64, end: f64| {
        if end > start {
            stages.push(Stage {
                name: name.into(),
                start,
            });
        }
    };
    add("A", rows[0].time, growth);
    add("B", growth.max(rows[0].time), end);
    add("C", end, cycle.max(end));
    if analysis.settling.state == EndState::LimitCycle {
        add("D", cycle.max(end), last.time);
    }
    stages
}

/// Component of a probe with the larger acceleration over the last fifth: its name and column.
pub(super) fn component(record: &Recorder, probe: usize) -> (&'static str, usize) {
    let rows = &record.probe_rows[probe];
    let end = &rows[rows.len() - rows.len().div_ceil(5)..];
    let square = |column: usize| end.iter().map(|row| row[column] * row[column]).sum::<f64>();
    if square(4) >= square(5) {
        ("radial", 0)
    } else {
        ("tangential", 1)
    }
}

/// Name and values of the acceleration that a probe is shown by.
pub(super) fn acceleration(record: &Recorder, probe: usize) -> (String, Vec<f64>) {
    let (name, offset) = component(record, probe);
    let values = record.probe_rows[probe].iter().map(|row| row[4 + offset]);
    let node = record.probes[probe];
    (
        format!("{name} acceleration, node {node}"),
        values.collect(),
    )
}

/// Highest frequency shown: three superharmonics, or all modes drawn.
fn highest_frequency(data: &RunFigures<'_>, interval: f64) -> f64 {
    let main = data.analysis.last_fifth.main_frequency_hz.unwrap_or(0.0);
    let modes = data.references.iter().map(|mode| mode.frequency_hz);
    let wanted = modes.fold(3.4 * main, |top, f| top.max(1.1 * f));
    let nyquist = 0.5 / interval;
    if wanted > 0.0 {
        wanted.min(nyquist)
    } else {
        nyquist.min(35e3)
    }
}

pub(super) fn overview(
    data: &RunFigures<'_>,
    series: &Series,
    probe: usize,
) -> Result<String, FigureError> {
    let (signal_name, signal) = acceleration(data.record, probe);
    let interval = series.interval();
    let top = highest_frequency(data, interval);
    // A run shorter than a window has no spectrogram, and needs none.
    let options = SpectrogramOptions {
        max_frequency_hz: 1.05 * top,
        ..SpectrogramOptions::default()
    };
    let map = spectrogram(&signal, 1.0 / interval, &options)
        .ok()
        .filter(|map| map.times.len() > 1 && map.frequencies_hz.len() > 1);
    let main = data.analysis.last_fifth.main_frequency_hz;
    draw_transient_overview(&TransientOverview {
        signal_name,
        signal_unit: "m/s²".into(),
        times: &series.times,
        signal: &signal,
        spectrogram: map.as_ref().map(|map| SpectrogramMap {
            times: &map.times,
            frequencies_hz: &map.frequencies_hz,
            amplitude: &map.magnitudes,
        }),
        max_frequency_hz: top,
        references: data.references.clone(),
        status: (series.frame_times.len() > 1).then_some(StatusHistory {
            times: &series.frame_times,
            node_count: data.record.contact_angles.len(),
            status: &series.status,
        }),
        stages: series.stages.clone(),
        enlarged: main.map_or(0.0, |frequency| 4.0 / frequency),
    })
}

pub(super) fn spectrum(
    data: &RunFigures<'_>,
    series: &Series,
    probe: usize,
) -> Result<String, FigureError> {
    let (signal_name, signal) = acceleration(data.record, probe);
    let end = &signal[signal.len() - signal.len().div_ceil(5)..];
    let interval = series.interval();
    let spectrum = amplitude_spectrum(end, 1.0 / interval, Window::Hann, 2).map_err(|error| {
        FigureError::Empty {
            what: error.to_string(),
        }
    })?;
    draw_spectrum(&SpectrumPlot {
        signal_name,
        unit: "m/s²".into(),
        frequencies_hz: &spectrum.frequencies_hz,
        amplitude: &spectrum.amplitudes,
        max_frequency_hz: highest_frequency(data, interval),
        references: data.references.clone(),
    })
}

pub(super) fn growth(data: &RunFigures<'_>, series: &Series) -> Result<String, FigureError> {
    let rows = &data.record.rows;
    let last = series.times.last().copied().unwrap_or(0.0);
    let amplitudes: Vec<Vec<f64>> = (0..=8)
        .map(|n| {
            rows.iter()
                .map(|row| row.harmonics[n][0].hypot(row.harmonics[n][1]))
                .collect()
        })
        .collect();
    let end = data.analysis.first_nonlinearity.unwrap_or(last);
    let predictions = data.growth_rates.iter().map(|&(harmonic, rate_per_s)| {
        // What the start leaves behind has died out by a third of the stage.
        PredictedGrowth {
            harmonic,
            rate_per_s,
            window: (0.35 * end, 0.95 * end),
        }
    });
    draw_harmonic_growth(&HarmonicGrowth {
        times: &series.times,
        amplitudes: amplitudes
            .iter()
            .enumerate()
            .map(|(n, values)| (n, values.as_slice()))
            .collect(),
        predictions: predictions.collect(),
        first_nonlinearity: data.analysis.first_nonlinearity,
    })
}
