//! Tables of an analysed time signal.

mod figures;
mod report;

pub use figures::{ChannelRecord, SignalFigures, SignalRecord, draw};
pub use report::draw_report;

use super::folder::{FolderError, OutputFolder};
use super::table::{Table, format_number};
use crate::cea::ComplexMode;
use crate::signal::{AmplitudeSpectrum, ExponentialStage, SpectralLine};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// What was found in one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelReport {
    /// Name as in the table.
    pub name: String,
    /// Interval from which the lines are taken, s.
    pub interval_s: (f64, f64),
    /// Lines, strongest first.
    pub lines: Vec<SpectralLine>,
    /// Exponential stage, if there is one.
    pub stage: Option<ExponentialStage>,
    /// Amplitude spectrum over the interval.
    pub spectrum: AmplitudeSpectrum,
}

/// What `signal` found.
#[derive(Clone, Debug)]
pub struct SignalReport {
    /// Name of the table.
    pub source: String,
    /// Sampling rate, Hz.
    pub sampling_rate: f64,
    /// Samples of each channel.
    pub samples: usize,
    /// Channels.
    pub channels: Vec<ChannelReport>,
    /// Modes of the case at its friction coefficient, by frequency; empty without a case.
    pub modes: Vec<ComplexMode>,
    /// Friction coefficient of those modes.
    pub friction_coefficient: Option<f64>,
    /// Decisions of the reader.
    pub notes: Vec<String>,
    /// Wall time, s.
    pub wall_s: f64,
}

impl SignalReport {
    /// The mode nearest in frequency, of all or only of those that grow, with its position among all.
    pub fn nearest(&self, frequency_hz: f64, only_unstable: bool) -> Option<(usize, &ComplexMode)> {
        let miss = |mode: &ComplexMode| (mode.frequency_hz() - frequency_hz).abs();
        self.modes
            .iter()
            .enumerate()
            .filter(|(_, mode)| !only_unstable || mode.is_unstable())
            .min_by(|a, b| miss(a.1).total_cmp(&miss(b.1)))
    }

    /// The mode that a channel vibrates in: the growing mode nearest to the frequency of its growing
    /// stage, where there is one; else the mode nearest to its strongest line that is no superharmonic.
    pub fn vibrating_mode(&self, channel: &ChannelReport) -> Option<(usize, &ComplexMode)> {
        match channel.stage.filter(|s| s.rate_per_s.value > 0.0) {
            Some(stage) => self.nearest(stage.frequency_hz.value, true),
            None => {
                let line = channel
                    .lines
                    .iter()
                    .find(|l| l.superharmonic_of.is_none())?;
                self.nearest(line.frequency_hz, false)
            }
        }
    }
}

/// Writes `peaks.csv`, a spectrum for each channel and `summary.json`; returns the summary.
///
/// # Errors
/// Those of the folder.
pub fn write(folder: &OutputFolder, report: &SignalReport) -> Result<Value, FolderError> {
    folder.write("peaks.csv", |out| write_peaks(out, report))?;
    for (k, channel) in report.channels.iter().enumerate() {
        folder.write(&format!("spectrum-{}.csv", k + 1), |out| {
            let mut table = Table::new(out, &["frequency_hz", "amplitude"])?;
            let spectrum = &channel.spectrum;
            for (f, a) in spectrum.frequencies_hz.iter().zip(&spectrum.amplitudes) {
                table.numbers(&[*f, *a])?;
            }
            table.finish()
        })?;
    }
    let mut summary = summary(report);
    summary["manifest"] = json!(folder.manifest());
    folder.write("summary.json", |out| {
        serde_json::to_writer_pretty(&mut *out, &summary)?;
        out.write_all(b"\n")
    })?;
    Ok(summary)
}

fn write_peaks(out: &mut dyn std::io::Write, report: &SignalReport) -> std::io::Result<()> {
    let mut table = Table::new(
        out,
        &[
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
        ],
    )?;
    for channel in &report.channels {
        for (k, line) in channel.lines.iter().enumerate() {
            let mut cells = vec![
                channel.name.clone(),
                (k + 1).to_string(),
                format_number(line.frequency_hz),
                format_number(line.amplitude),
            ];
            match line.superharmonic_of {
                Some((fundamental, order)) => {
                    cells.extend([(fundamental + 1).to_string(), order.to_string()]);
                }
                None => cells.extend([String::new(), String::new()]),
            }
            match report.nearest(line.frequency_hz, false) {
                Some((number, mode)) if line.superharmonic_of.is_none() => cells.extend([
                    (number + 1).to_string(),
                    format_number(mode.frequency_hz()),
                    mode.harmonic.to_string(),
                    mode.branch.to_string(),
                    mode.direction.to_string(),
                ]),
                _ => cells.extend(std::iter::repeat_n(String::new(), 5)),
            }
            table.row(cells)?;
        }
    }
    table.finish()
}

fn mode_json((number, mode): (usize, &ComplexMode)) -> Value {
    json!({
        "mode": number + 1,
        "frequency_hz": mode.frequency_hz(),
        "growth_rate_per_s": mode.growth_rate(),
        "harmonic": mode.harmonic,
        "branch": mode.branch,
        "direction": mode.direction,
        "unstable": mode.is_unstable(),
    })
}

fn summary(report: &SignalReport) -> Value {
    let channels: Vec<Value> = report
        .channels
        .iter()
        .map(|channel| {
            let lines: Vec<Value> = channel
                .lines
                .iter()
                .map(|line| {
                    json!({
                        "frequency_hz": line.frequency_hz,
                        "amplitude": line.amplitude,
                        "superharmonic": line.superharmonic_of.map(|(fundamental, order)| json!({
                            "of_peak": fundamental + 1,
                            "order": order,
                        })),
                        "nearest_mode": report.nearest(line.frequency_hz, false).map(mode_json),
                    })
                })
                .collect();
            let main = channel.lines.iter().find(|l| l.superharmonic_of.is_none());
            json!({
                "name": channel.name,
                "interval_s": [channel.interval_s.0, channel.interval_s.1],
                "main_frequency_hz": main.map(|l| l.frequency_hz),
                "peaks": lines,
                "growth": channel.stage.map(|stage| json!({
                    "start_s": stage.start,
                    "end_s": stage.end,
                    "rate_per_s": stage.rate_per_s,
                    "frequency_hz": stage.frequency_hz,
                    "deviation": stage.deviation,
                })),
                "mode": report.vibrating_mode(channel).map(mode_json),
            })
        })
        .collect();
    json!({
        "command": "signal",
        "source": report.source,
        "sampling_rate_hz": report.sampling_rate,
        "samples": report.samples,
        "friction_coefficient": report.friction_coefficient,
        "channels": channels,
        "notes": report.notes,
        "wall_s": report.wall_s,
    })
}

/// The findings for a person.
pub fn print(report: &SignalReport) -> String {
    let mut text = format!(
        "{}: {} samples at {} Hz ({:.4} s)\n",
        report.source,
        report.samples,
        report.sampling_rate,
        report.samples as f64 / report.sampling_rate
    );
    for channel in &report.channels {
        let (from, to) = channel.interval_s;
        let _ = writeln!(
            text,
            "\n{}, peaks between {from:.4} and {to:.4} s",
            channel.name
        );
        if channel.lines.is_empty() {
            text.push_str("  no peak stands out of the noise\n");
            continue;
        }
        text.push_str("  peak  frequency_hz     amplitude  \n");
        for (k, line) in channel.lines.iter().enumerate() {
            let what = match line.superharmonic_of {
                Some((fundamental, order)) => format!("{order} x peak {}", fundamental + 1),
                None => report
                    .nearest(line.frequency_hz, false)
                    .map(|found| format!("nearest {}", described(found)))
                    .unwrap_or_default(),
            };
            let (f, a) = (line.frequency_hz, line.amplitude);
            let _ = writeln!(text, "  {:>4}  {f:>12.2}  {a:>12.5e}  {what}", k + 1);
        }
        if let Some(stage) = channel.stage {
            let (rate, f) = (stage.rate_per_s, stage.frequency_hz);
            let _ = writeln!(
                text,
                "  exponential from {:.4} to {:.4} s: rate {:.2} 1/s [{:.2}, {:.2}] at {:.2} Hz \
                 [{:.2}, {:.2}]",
                stage.start, stage.end, rate.value, rate.low, rate.high, f.value, f.low, f.high
            );
        } else {
            text.push_str("  no exponential stage\n");
        }
        if let Some(found) = report.vibrating_mode(channel) {
            let rate = found.1.growth_rate();
            let _ = writeln!(
                text,
                "  vibrates in {}, which the eigenvalue analysis lets grow at {rate:.2} 1/s",
                described(found)
            );
        }
    }
    text
}

fn described((number, mode): (usize, &ComplexMode)) -> String {
    format!(
        "mode {} (n = {}, branch {}, {:.1} Hz{})",
        number + 1,
        mode.harmonic,
        mode.branch,
        mode.frequency_hz(),
        if mode.is_unstable() { ", unstable" } else { "" }
    )
}
