//! `frictionsim signal`: what vibrates in a measured or computed time signal.

use super::measurement::{Measurement, SideFile, chosen};
use super::prelude::*;
use super::session::read_case;
use crate::cea::{CeaError, ModeLimit};
use crate::results::signal::{
    ChannelSummary, MODE_TOLERANCE, ModeSummary, SignalDrawing, SignalSummary, document,
    draw as draw_figures, write_spectra,
};
use crate::signal::reader::{
    Channel, SignalFile, SignalOptions, read_signal, slowdown, write_signal, write_wav,
};
use crate::signal::{
    AmplitudeSpectrum, ExponentialStage, SignalError, SpectralResolution, Window,
    averaged_spectrum, exponential_stage, spectral_lines,
};
use crate::study::{modes_at_own_friction, tangent_options};
use crate::{fem::MassKind, results::charts::ModeLine};

/// Lines reported for each channel.
const MOST_LINES: usize = 12;
/// Share of a growing record, at its end, from which the lines are taken: the limit cycle.
const LAST_SHARE: f64 = 0.2;

/// Spectrum of a sound or vibration beside the modes of a case
///
/// Reads one or more channels from a text table, a universal file (UFF 58), a WAV or a MATLAB file. Lists the peaks
/// that stand out of the noise, their superharmonics, the growth rate, and the modes of a case beside them.
#[derive(Args)]
pub struct Arguments {
    /// Table of the signal, UFF, WAV or MATLAB file
    #[arg(value_name = "SIGNAL.csv", value_hint = ValueHint::FilePath)]
    signal: PathBuf,
    /// Case whose modes are named beside the peaks
    #[arg(long, value_name = "CASE.toml", value_hint = ValueHint::FilePath)]
    case: Option<PathBuf>,
    /// Override a key of that case (repeatable)
    #[arg(long = "set", value_name = "KEY=VALUE", requires = "case")]
    set: Vec<String>,
    /// Sampling rate, if the table has no time column or a rounded one
    #[arg(long, value_name = "HZ")]
    rate: Option<f64>,
    /// Channels by name or number [default: all]
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    channel: Vec<String>,
    /// Column names, if the header is missing or misread: t, t_ms, t_us, a channel's name, - to skip
    #[arg(long, value_name = "NAMES", value_delimiter = ',', allow_hyphen_values = true)]
    columns: Vec<String>,
    /// Start of the interval for the peaks, s after the first sample [default: 0]. The growth rate is sought there
    /// first. Without --from and --to, a record that grows has its last fifth, or a squeal that is over by then
    #[arg(long, value_name = "S")]
    from: Option<f64>,
    /// End of that interval [default: that of the record, or of a squeal that is over]
    #[arg(long, value_name = "S")]
    to: Option<f64>,
    /// Smallest spacing between two peaks: the spectrum is averaged over blocks of 4/HZ seconds [default: 2 Hz, or more
    /// where the interval is short]
    #[arg(long, value_name = "HZ")]
    resolution: Option<f64>,
    /// Window of the spectrogram, s [default: 0.0005, or 1/400 of a record longer than 0.2 s]
    #[arg(long, value_name = "S")]
    window: Option<f64>,
    /// Highest frequency drawn
    #[arg(long, value_name = "HZ", default_value_t = 40_000.0)]
    max_frequency: f64,
    /// Write the channels as sound, played slower where the rate is above 96 kHz: 500 kHz by 10
    #[arg(long, value_name = "OUT.wav", value_hint = ValueHint::FilePath)]
    wav: Option<PathBuf>,
    /// How many times slower the sound is played [default: the least of 1, 2, 5, 10, 20, ... that gives 96 kHz]
    #[arg(long, value_name = "FACTOR", requires = "wav", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    slower: Option<u32>,
    /// Write the channels as a universal file (dataset 58)
    #[arg(long, value_name = "OUT.uff", value_hint = ValueHint::FilePath)]
    uff: Option<PathBuf>,
    #[command(flatten)]
    output: OutputOptions,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    let (signal, force) = (&asked.signal, asked.output.force);
    let wav = SideFile::prepare("--wav", asked.wav.as_deref(), signal, force)?;
    let uff = SideFile::prepare("--uff", asked.uff.as_deref(), signal, force)?;
    let case = asked.case.as_ref().map(|path| read_case(path, &asked.set)).transpose()?;
    let mut measurement =
        Measurement::start("signal", &asked.signal, &asked.output, choices(asked))?;
    if let (Some(path), Some(case)) = (&asked.case, &case) {
        let argument = format!("--case {}", path.display());
        depend_on(&mut measurement.manifest, argument, Some(case.raw.hash().as_bytes()));
        measurement.manifest.overrides.clone_from(&asked.set);
    }
    let reading = SignalOptions {
        rate: asked.rate,
        columns: asked.columns.clone(),
        channels: asked.channel.clone(),
    };
    let file = read_signal(&measurement.bytes, &measurement.source, &reading)?;
    for note in &file.notes {
        tracing::warn!("{}: {note}", measurement.source);
    }
    check_drawing(asked, &file)?;
    let bar = terminal::progress(asked.output.is_quiet(), file.channels.len() as u64, "channels");
    let analysed =
        crate::parallel::map::<_, _, Result<Vec<_>, Failure>>(&file.channels, |channel| {
            let found = analyse(asked, &file, channel);
            bar.inc(1);
            found
        })?;
    bar.finish_and_clear();
    let (mut channels, spectra): (Vec<ChannelSummary>, Vec<AmplitudeSpectrum>) =
        analysed.into_iter().unzip();
    let highest = channels.iter().filter_map(|c| c.main_frequency_hz).fold(0.0, f64::max);
    let mut notes = file.notes.clone();
    let modes = match &case {
        Some(case) if highest > 0.0 => {
            let mass = case.cea.as_ref().map_or(MassKind::Consistent, |cea| cea.mass);
            let options = tangent_options(case, mass);
            match modes_at_own_friction(case, &options, ModeLimit::MaxFrequency(1.3 * highest)) {
                Ok(modes) => ModeSummary::all(&modes, case.body.has_sectors()),
                Err(CeaError::NoModes { lowest_hz, .. }) => {
                    let lowest = "the lowest mode of the case lies far above every line, at";
                    notes.push(format!("{lowest} {lowest_hz:.1} Hz"));
                    Vec::new()
                }
                Err(error) => return Err(Failure::run(format!("modes of the case: {error}"))),
            }
        }
        _ => Vec::new(),
    };
    for channel in &mut channels {
        channel.name_modes(&modes);
    }
    let folder = asked.output.open_folder(&measurement.manifest, false)?;
    let summary = SignalSummary {
        source: measurement.source.clone(),
        sampling_rate_hz: file.sampling_rate,
        samples: file.channels[0].samples.len(),
        friction_coefficient: case.as_ref().map(|own| own.contact.sliding.friction_coefficient),
        mode_tolerance: MODE_TOLERANCE,
        channels,
        notes,
    };
    write_spectra(&folder, &spectra)?;
    let aside = write_copies(asked, [wav, uff], &file)?;
    let mut told = Told::of(measurement.head(), document(&summary));
    told.text += &aside;
    asked.output.finish_result(folder, told, &summary, || {
        let line =
            |mode: &ModeSummary| ModeLine { frequency_hz: mode.frequency_hz, label: mode.label() };
        let drawing = SignalDrawing {
            file: &file,
            spectra,
            window: window_length(asked, &file),
            max_frequency_hz: asked.max_frequency,
            modes: modes.iter().filter(|mode| mode.unstable).map(line).collect(),
        };
        let (figures, left_out) = draw_figures(&drawing, &summary);
        left_out.iter().for_each(|reason| tracing::warn!("{reason}"));
        figures
    })
}

/// Length of the spectrogram's window, s.
fn window_length(arguments: &Arguments, file: &SignalFile) -> f64 {
    let duration = file.channels[0].samples.len() as f64 / file.sampling_rate;
    let samples = 16.0 / file.sampling_rate;
    arguments.window.unwrap_or(5e-4f64.max(duration / 400.0).max(samples).min(duration))
}

/// Refuses a window or a frequency with which nothing can be drawn.
fn check_drawing(arguments: &Arguments, file: &SignalFile) -> Result<(), Failure> {
    let window = window_length(arguments, file);
    let (shortest, longest) =
        (4.0 / file.sampling_rate, file.channels[0].samples.len() as f64 / file.sampling_rate);
    if !(window >= shortest && window <= longest) {
        return Err(Failure::usage(format!(
            "--window {window}: the window of the spectrogram must be {shortest} (4 samples) to {longest} s \
             (the record)"
        )));
    }
    let highest = arguments.max_frequency;
    if !(highest > 0.0 && highest.is_finite()) {
        return Err(Failure::usage(format!(
            "--max-frequency {highest}: the highest frequency drawn must be positive and finite (Hz)"
        )));
    }
    Ok(())
}

/// Writes the channels as sound and as universal file, where asked for; what was written, in words.
fn write_copies(
    arguments: &Arguments,
    [wav, uff]: [Option<SideFile<'_>>; 2],
    file: &SignalFile,
) -> Result<String, Failure> {
    let mut text = String::new();
    if let (Some(path), Some(copy)) = (&arguments.wav, wav) {
        let slower = arguments.slower.unwrap_or(slowdown(file.sampling_rate));
        copy.write(&write_wav(file, slower).map_err(Failure::usage)?)?;
        let factor = f64::from(slower);
        let seconds = file.channels[0].samples.len() as f64 / file.sampling_rate * factor;
        let speed = match slower {
            1 => "at its own speed".to_owned(),
            _ => format!("{slower} times slower, 10 kHz is heard as {} kHz", 10.0 / factor),
        };
        text = format!("sound in {}: played {speed}; {seconds:.2} s\n", path.display());
    }
    if let (Some(path), Some(copy)) = (&arguments.uff, uff) {
        copy.write(write_signal(file).as_bytes())?;
        text += &format!("universal file in {}\n", path.display());
    }
    Ok(text)
}

/// Lines, stage and spectrum of one channel.
fn analyse(
    arguments: &Arguments,
    file: &SignalFile,
    channel: &Channel,
) -> Result<(ChannelSummary, AmplitudeSpectrum), Failure> {
    let (rate, samples) = (file.sampling_rate, &channel.samples);
    let end = samples.len() as f64 / rate;
    let from = arguments.from.unwrap_or(0.0);
    let to = arguments.to.unwrap_or(end).min(end);
    if !(from >= 0.0 && from < to) {
        return Err(Failure::usage(format!(
            "--from {from} --to {to}: the interval must lie within the record, 0 to {end:.6} s"
        )));
    }
    let index = |t: f64| ((t * rate).round() as usize).min(samples.len());
    let part = |[from, to]: [f64; 2]| &samples[index(from)..index(to)];
    // An interval that is asked for may have a stage of its own beside that of the record.
    let is_asked = arguments.from.or(arguments.to).is_some();
    let own = exponential_stage(part([from, to]), rate);
    let stage = match own {
        Ok(stage) => Ok(stage.later(index(from) as f64 / rate)),
        Err(_) if is_asked => exponential_stage(samples, rate),
        none => none,
    };
    let found_in = |interval| -> Result<_, SignalError> {
        let part = part(interval);
        let resolution = SpectralResolution::of(part.len(), rate, arguments.resolution)?;
        Ok((resolution, spectral_lines(part, rate, resolution, MOST_LINES)?))
    };
    let fail = |error: SignalError| {
        let message = format!("channel {}: {error}", channel.name);
        match error {
            SignalError::Asked(_) => Failure::usage(message),
            _ => Failure::run(message),
        }
    };
    let vibrates = stage.as_ref().ok().filter(|_| !is_asked);
    let mut interval = vibrates.map_or([from, to], |stage| grown(stage, samples, rate));
    let mut found = found_in(interval).map_err(fail)?;
    // A burst may have no line in the mean over the whole record.
    if let Some(stage) = vibrates.filter(|_| found.1.is_empty()) {
        let burst = [stage.start_s, stage.end_s];
        if let Some(own) = found_in(burst).ok().filter(|own| !own.1.is_empty()) {
            (interval, found) = (burst, own);
        }
    }
    let (resolution, lines) = found;
    let spectrum = averaged_spectrum(part(interval), rate, Window::Hann, resolution.block, 1);
    let spectrum = spectrum.map_err(fail)?;
    let summary = ChannelSummary::new(
        &channel.name,
        interval.map(|t| file.start + t),
        (resolution, spectrum.averages),
        &lines,
        stage,
    );
    Ok((summary, spectrum))
}

/// Where a record that has such a stage vibrates as it has grown, s: over its last fifth where it lasts until then,
/// else from the end of the stage, or over its later half, until it is over. The whole of one that does not settle.
fn grown(stage: &ExponentialStage, samples: &[f64], rate: f64) -> [f64; 2] {
    let end = samples.len() as f64 / rate;
    let late = (1.0 - LAST_SHARE) * end;
    if !stage.is_growing() || stage.end_s >= late {
        return [0.0, end];
    }
    let until = stage.lasts_until(samples, rate);
    if until >= 0.5 * (late + end) {
        return [late, end];
    }
    [stage.end_s.min(0.5 * (stage.start_s + until)), until]
}

/// Options that change the result.
fn choices(arguments: &Arguments) -> Vec<String> {
    chosen("rate", arguments.rate)
        .chain(chosen("from", arguments.from))
        .chain(chosen("to", arguments.to))
        .chain(chosen("resolution", arguments.resolution))
        .chain(chosen("channel", &arguments.channel))
        .chain(chosen("columns", &arguments.columns))
        .collect()
}
