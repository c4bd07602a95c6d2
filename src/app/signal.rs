//! `frictionsim signal`: what vibrates in a measured or computed time signal.

use super::Failure;
use super::measurement::{Measurement, OutputOptions};
use super::session::read_case;
use crate::case::Case;
use crate::cea::ComplexMode;
use crate::cea::cyclic::{ModeLimit, SweepRequest, sweep};
use crate::fem::MassKind;
use crate::prestress::{DampingModel, TangentOptions};
use crate::results::signal::{
    ChannelRecord, ChannelReport, SignalRecord, SignalReport, draw_report, print, write,
};
use crate::results::{DOTS_PER_INCH, OutputFolder, read_record, write_record};
use crate::signal::reader::{Channel, SignalFile, read_signal};
use crate::signal::{Window, amplitude_spectrum, exponential_stage, spectral_lines};
use clap::{Args, ValueHint};
use serde_json::Value;
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
    write_record(&folder, &record(arguments, &file, &selected, &report))?;
    if !arguments.output.no_figures {
        redraw(&folder, &summary, DOTS_PER_INCH)?;
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

/// What the figures show.
fn record(
    arguments: &Arguments,
    file: &SignalFile,
    selected: &[&Channel],
    report: &SignalReport,
) -> SignalRecord {
    let channels = selected.iter().zip(&report.channels);
    SignalRecord {
        sampling_rate: file.sampling_rate,
        start: file.start,
        window: arguments.window,
        max_frequency_hz: arguments.max_frequency,
        references: references(report),
        channels: channels
            .map(|(channel, found)| ChannelRecord {
                name: channel.name.clone(),
                samples: channel.samples.clone(),
                interval_s: found.interval_s,
                frequencies_hz: found.spectrum.frequencies_hz.clone(),
                amplitudes: found.spectrum.amplitudes.clone(),
            })
            .collect(),
    }
}

/// Draws the figures and the report of a folder from its `record.bin` and its summary.
///
/// # Errors
/// A folder without a whole record; those of the drawing and of the folder.
pub fn redraw(folder: &OutputFolder, summary: &Value, dots_per_inch: f64) -> Result<(), Failure> {
    let record: SignalRecord = read_record(folder.path())?;
    for reason in draw_report(folder, &record, summary, dots_per_inch)? {
        tracing::warn!("{reason}");
    }
    Ok(())
}

/// The unstable modes of the case: frequency, Hz, and name.
fn references(report: &SignalReport) -> Vec<(f64, String)> {
    let modes = report.modes.iter().enumerate();
    let unstable = modes.filter(|(_, mode)| mode.is_unstable());
    let name = |number: usize, n: usize| format!("mode {}, *n* = {n}", number + 1);
    unstable
        .map(|(number, mode)| (mode.frequency_hz(), name(number, mode.harmonic)))
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
