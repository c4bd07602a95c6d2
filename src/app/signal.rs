//! `frictionsim signal`: what vibrates in a measured or computed time signal.

use super::Failure;
use super::measurement::{Measurement, OutputOptions};
use super::session::read_case;
use crate::case::Case;
use crate::cea::ComplexMode;
use crate::cea::cyclic::{ModeLimit, SweepRequest, sweep};
use crate::fem::MassKind;
use crate::prestress::{DampingModel, TangentOptions};
use crate::results::figures::{
    FigureError, ReferenceFrequency, SpectrogramMap, SpectrumPlot, TransientOverview,
    draw_spectrum, draw_transient_overview,
};
use crate::results::report::NamedFigure;
use crate::results::signal::{ChannelReport, SignalReport, print, write};
use crate::results::{DOTS_PER_INCH, write_figures};
use crate::signal::reader::{Channel, SignalFile, read_signal};
use crate::signal::{
    SpectrogramOptions, Window, amplitude_spectrum, exponential_stage, spectral_lines, spectrogram,
};
use clap::{Args, ValueHint};
use std::path::PathBuf;

/// Lines reported for each channel.
const MOST_LINES: usize = 12;
/// Share of a growing record, at its end, from which the lines are taken: the limit cycle.
const LAST_SHARE: f64 = 0.2;

/// Spectrum and spectrogram of a measured or computed signal, beside CEA frequencies
///
/// Reads a time column with one or more channels, or channels with a sampling rate; lists the main
/// peaks with their superharmonics, the rate of the exponential stage, and the nearest modes of a case.
#[derive(Args)]
pub struct Arguments {
    /// Table of the signal
    #[arg(value_name = "SIGNAL.csv", value_hint = ValueHint::FilePath)]
    signal: PathBuf,
    /// Case whose modes are named beside the peaks
    #[arg(long, value_name = "CASE.toml", value_hint = ValueHint::FilePath)]
    case: Option<PathBuf>,
    /// Override a key of that case (repeatable)
    #[arg(long = "set", value_name = "KEY=VALUE", requires = "case")]
    set: Vec<String>,
    /// Sampling rate, where the table has no time column
    #[arg(long, value_name = "HZ")]
    rate: Option<f64>,
    /// Channels by name or number [default: all]
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    channel: Vec<String>,
    /// Begin of the interval for the peaks, s after the first sample
    #[arg(long, value_name = "S")]
    from: Option<f64>,
    /// End of the interval for the peaks, s after the first sample
    #[arg(long, value_name = "S")]
    to: Option<f64>,
    /// Window of the spectrogram, s
    #[arg(long, value_name = "S", default_value_t = 5e-4)]
    window: f64,
    /// Highest frequency drawn
    #[arg(long, value_name = "HZ", default_value_t = 40_000.0)]
    max_frequency: f64,
    #[command(flatten)]
    output: OutputOptions,
}

/// Runs the subcommand.
///
/// # Errors
/// A table or case that cannot be read (exit code 2), or an analysis that fails (1).
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let case = match &arguments.case {
        Some(path) => Some(read_case(path, &arguments.set)?),
        None => None,
    };
    let measurement = Measurement::start(
        "signal",
        &arguments.signal,
        &arguments.output,
        choices(arguments, case.as_ref()),
    )?;
    let file = read_signal(&measurement.bytes, &measurement.source, arguments.rate)?;
    for note in &file.notes {
        tracing::warn!("{}: {note}", measurement.source);
    }
    let selected = selected(arguments, &file)?;
    let channels = selected
        .iter()
        .map(|channel| analyse(arguments, &file, channel))
        .collect::<Result<Vec<ChannelReport>, Failure>>()?;
    let highest = channels
        .iter()
        .flat_map(|c| c.lines.iter().filter(|l| l.superharmonic_of.is_none()))
        .map(|l| l.frequency_hz)
        .fold(0.0, f64::max);
    let modes = match &case {
        Some(case) if highest > 0.0 => modes_below(case, 1.3 * highest)?,
        _ => Vec::new(),
    };
    let folder = measurement.open_folder()?;
    let report = SignalReport {
        source: measurement.source.clone(),
        sampling_rate: file.sampling_rate,
        samples: selected.first().map_or(0, |c| c.samples.len()),
        channels,
        modes,
        friction_coefficient: case
            .as_ref()
            .map(|c| c.contact.sliding.friction_coefficient),
        notes: file.notes.clone(),
        wall_s: measurement.wall_seconds(),
    };
    let summary = write(&folder, &report)?;
    if !arguments.output.no_figures {
        let drawn = selected.iter().enumerate().filter_map(|(k, channel)| {
            Some(NamedFigure {
                name: format!("signal-{}", k + 1),
                caption: format!("Signal and spectrograms of {}.", channel.name),
                svg: figure(arguments, &file, channel, &report)?,
            })
        });
        let spectra = (0..selected.len()).filter_map(|k| spectrum_figure(arguments, &report, k));
        let figures: Vec<NamedFigure> = drawn.chain(spectra).collect();
        write_figures(&folder, &figures, DOTS_PER_INCH)?;
    }
    folder.finish()?;
    measurement.print(&print(&report), &summary)
}

/// The channels asked for.
fn selected<'a>(arguments: &Arguments, file: &'a SignalFile) -> Result<Vec<&'a Channel>, Failure> {
    if arguments.channel.is_empty() {
        return Ok(file.channels.iter().collect());
    }
    arguments
        .channel
        .iter()
        .map(|wanted| {
            let number = wanted.parse::<usize>().ok();
            let by_name = file.channels.iter().find(|c| c.name == *wanted);
            by_name
                .or_else(|| file.channels.get(number?.checked_sub(1)?))
                .ok_or_else(|| {
                    let names: Vec<&str> = file.channels.iter().map(|c| c.name.as_str()).collect();
                    Failure::usage(format!(
                        "--channel {wanted}: the table has {}",
                        names.join(", ")
                    ))
                })
        })
        .collect()
}

/// Lines, stage and spectrum of one channel.
fn analyse(
    arguments: &Arguments,
    file: &SignalFile,
    channel: &Channel,
) -> Result<ChannelReport, Failure> {
    let rate = file.sampling_rate;
    let stage = exponential_stage(&channel.samples, rate, None).ok();
    let end = channel.samples.len() as f64 / rate;
    let grows = stage.is_some_and(|s| s.rate_per_s.value > 0.0 && s.end < (1.0 - LAST_SHARE) * end);
    let begin = if grows { (1.0 - LAST_SHARE) * end } else { 0.0 };
    let from = arguments.from.unwrap_or(begin);
    let to = arguments.to.unwrap_or(end).min(end);
    if !(from >= 0.0 && from < to) {
        return Err(Failure::usage(format!(
            "--from {from} --to {to}: the interval must lie within the record, 0 to {end} s"
        )));
    }
    let index = |t: f64| ((t * rate).round() as usize).min(channel.samples.len());
    let part = &channel.samples[index(from)..index(to)];
    let fail = |error| Failure::run(format!("channel {}: {error}", channel.name));
    Ok(ChannelReport {
        name: channel.name.clone(),
        interval_s: (file.start + from, file.start + to),
        lines: spectral_lines(part, rate, MOST_LINES).map_err(fail)?,
        stage,
        spectrum: amplitude_spectrum(part, rate, Window::Hann, 1).map_err(fail)?,
    })
}

/// Modes of the case at its friction coefficient.
fn modes_below(case: &Case, frequency_hz: f64) -> Result<Vec<ComplexMode>, Failure> {
    let options = TangentOptions {
        mass: case
            .cea
            .as_ref()
            .map_or(MassKind::Consistent, |cea| cea.mass),
        geometric_stiffness: case.cea.as_ref().is_none_or(|cea| cea.geometric_stiffness),
        damping: case.damping.rayleigh,
        damping_model: if case.damping.include_contact {
            DampingModel::WholeTangent
        } else {
            DampingModel::BodyOnly
        },
        contact: case.contact.stiffness,
    };
    let request = SweepRequest {
        friction_coefficients: &[case.contact.sliding.friction_coefficient],
        limit: ModeLimit::MaxFrequency(frequency_hz),
        shapes_at: &[],
    };
    let found = sweep(
        &case.annulus,
        &case.material,
        &options,
        &case.contact.sliding,
        &request,
    )
    .map_err(|error| Failure::run(format!("modes of the case: {error}")))?;
    let mut points = found.sweep.points.into_iter();
    Ok(points.next().map_or_else(Vec::new, |point| point.modes))
}

/// Signal over its spectrogram, with the frequencies of the modes named.
fn figure(
    arguments: &Arguments,
    file: &SignalFile,
    channel: &Channel,
    report: &SignalReport,
) -> Option<String> {
    let options = SpectrogramOptions {
        window_length: arguments.window,
        hop: 0.25 * arguments.window,
        ..SpectrogramOptions::default()
    };
    let map = match spectrogram(&channel.samples, file.sampling_rate, &options) {
        Ok(map) => map.below(arguments.max_frequency).normalized(),
        Err(error) => {
            tracing::warn!("no spectrogram of {}: {error}; try --window", channel.name);
            return None;
        }
    };
    let times: Vec<f64> = (0..channel.samples.len())
        .map(|j| file.start + j as f64 / file.sampling_rate)
        .collect();
    let centres: Vec<f64> = map.times.iter().map(|t| file.start + t).collect();
    let data = TransientOverview {
        signal_name: channel.name.clone(),
        signal_unit: String::new(),
        times: &times,
        signal: &channel.samples,
        spectrogram: Some(SpectrogramMap {
            times: &centres,
            frequencies_hz: &map.frequencies_hz,
            amplitude: &map.magnitudes,
        }),
        max_frequency_hz: arguments.max_frequency.min(0.5 * file.sampling_rate),
        references: references(report),
        status: None,
        stages: Vec::new(),
        enlarged: 0.0,
    };
    drawn(draw_transient_overview(&data), &channel.name)
}

/// The spectrum that the peaks are taken from.
fn spectrum_figure(
    arguments: &Arguments,
    report: &SignalReport,
    index: usize,
) -> Option<NamedFigure> {
    let channel = &report.channels[index];
    let (from, to) = channel.interval_s;
    let data = SpectrumPlot {
        signal_name: channel.name.clone(),
        unit: String::new(),
        frequencies_hz: &channel.spectrum.frequencies_hz,
        amplitude: &channel.spectrum.amplitudes,
        max_frequency_hz: arguments.max_frequency.min(0.5 * report.sampling_rate),
        references: references(report),
    };
    Some(NamedFigure {
        name: format!("spectrum-{}", index + 1),
        caption: format!("Spectrum of {} from {from:.4} to {to:.4} s.", channel.name),
        svg: drawn(draw_spectrum(&data), &channel.name)?,
    })
}

/// A drawing, or a warning why there is none.
fn drawn(drawing: Result<String, FigureError>, channel: &str) -> Option<String> {
    let warn = |error: &FigureError| tracing::warn!("figure of {channel} left out: {error}");
    drawing.inspect_err(warn).ok()
}

/// The unstable modes of the case.
fn references(report: &SignalReport) -> Vec<ReferenceFrequency> {
    let unstable = report.modes.iter().enumerate();
    unstable
        .filter(|(_, mode)| mode.is_unstable())
        .map(|(number, mode)| ReferenceFrequency {
            frequency_hz: mode.frequency_hz(),
            label: format!("mode {}, *n* = {}", number + 1, mode.harmonic),
        })
        .collect()
}

/// Options that change the result.
fn choices(arguments: &Arguments, case: Option<&Case>) -> Vec<String> {
    let number = |name: &str, value: Option<f64>| value.map(|v| format!("{name}={v}"));
    let mut out: Vec<String> = [
        number("rate", arguments.rate),
        number("from", arguments.from),
        number("to", arguments.to),
        case.map(|c| format!("case={}", c.raw.hash())),
    ]
    .into_iter()
    .flatten()
    .collect();
    out.extend(arguments.channel.iter().map(|c| format!("channel={c}")));
    out
}
