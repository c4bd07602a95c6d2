//! Time signals.

use super::super::error::check_finite;
use super::error::{NO_RATE, ReadError};
use super::units::{sampling_rate, seconds};
use super::{Format, selected, table::Table, uff, wav};

/// Largest deviation of a time from the regular grid, in steps: rounding in the export.
const JITTER: f64 = 0.3;
/// Fewest samples of a signal.
const FEWEST: usize = 16;

/// One column of a signal table.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Name as written, or `channel k`.
    pub name: String,
    /// Samples, in the unit of the file.
    pub samples: Vec<f64>,
}

/// Equidistant samples of one or more channels.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalFile {
    /// Sampling rate, Hz.
    pub sampling_rate: f64,
    /// Time of the first sample, s.
    pub start: f64,
    /// Channels in the order of their columns, of one length, at least one.
    pub channels: Vec<Channel>,
    /// Decisions a user should know of.
    pub notes: Vec<String>,
}

/// What the header of a signal does not say, or says wrongly.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SignalOptions {
    /// Sampling rate, Hz; overrules a time column that is only rounded.
    pub rate: Option<f64>,
    /// Names that take the place of the table's own, one for each column: `t` (`t_ms`, `t_us`), a channel's
    /// name, `-` to skip.
    pub columns: Vec<String>,
    /// The channels to use, by name or number; empty: all.
    pub channels: Vec<String>,
}

/// Reads time signals: a time column with any number of channels, or channels with a sampling rate
/// from the option or a comment (`sampling rate: 51200 Hz`); a universal file of datasets 58; a WAV file
/// (full scale 1); a MATLAB file of such columns.
///
/// The time column is the one named time or t (`time_ms`, `t [us]` are scaled to seconds) or one of time
/// stamps; without names, the first of several columns if it advances in equal steps. Times may deviate from
/// the regular grid by 0.3 steps, which is the rounding of an export; the rate is that of the first to
/// last sample. A column rounded more coarsely needs the rate, and must agree with it within its rounding.
///
/// # Errors
/// [`ReadError`] with source name, line and column: gaps, times out of order, no rate.
pub fn read_signal(
    bytes: &[u8],
    source: &str,
    options: &SignalOptions,
) -> Result<SignalFile, ReadError> {
    signals(bytes, options).map_err(|error| error.of(source))
}

fn signals(bytes: &[u8], options: &SignalOptions) -> Result<SignalFile, ReadError> {
    if let Some(value) = options.rate.filter(|rate| !(*rate > 0.0 && rate.is_finite())) {
        let problem = format!("sampling rate {value} Hz must be positive and finite");
        return Err(ReadError::whole(problem));
    }
    let mut file = match Format::of(bytes) {
        Format::Universal => uff::read_signals(bytes)?,
        Format::Wave => wav::read_wav(bytes)?,
        other => from_table(&other.table(bytes, &options.columns)?, options)?,
    };
    for channel in &file.channels {
        check_finite("sample", &channel.samples).map_err(ReadError::whole)?;
    }
    // A file that states its rate is overruled aloud.
    if let Some(rate) = options.rate.filter(|rate| *rate != file.sampling_rate) {
        let stated = file.sampling_rate;
        file.notes
            .push(format!("the file states {stated} Hz; {rate} Hz, from the option, is used"));
        file.sampling_rate = rate;
    }
    file.channels = selected(file.channels, |one| &one.name, &options.channels)?;
    let count = file.channels.first().map_or(0, |c| c.samples.len());
    if count < FEWEST {
        return Err(too_short(count));
    }
    Ok(file)
}

fn too_short(count: usize) -> ReadError {
    let (what, remedy) = ("the signal", "give a longer record");
    ReadError::whole(crate::error::too_short(what, count, FEWEST, remedy))
}

fn from_table(table: &Table, options: &SignalOptions) -> Result<SignalFile, ReadError> {
    let time = time_column(table);
    if table.rows() < FEWEST {
        return Err(too_short(table.rows()));
    }
    let mut notes = Vec::new();
    let (rate, start) = match time {
        Some((column, factor)) => {
            let times: Vec<f64> = table.columns[column].real.iter().map(|t| t * factor).collect();
            let rate = match options.rate {
                Some(rate) => agreed_rate(table, column, &times, rate, &mut notes)?,
                None => 1.0 / regular_step(table, column, &times)?,
            };
            (rate, times[0])
        }
        None => {
            let stated = sampling_rate(&table.remarks).or(options.rate);
            (stated.ok_or_else(|| ReadError::whole(NO_RATE))?, 0.0)
        }
    };
    let is_skipped = |k: usize| {
        let name = table.names.get(k).map_or("", |n| n.trim());
        name == "-" || table.columns[k].is_time || time.is_some_and(|(t, _)| t == k)
    };
    let kept = (0..table.columns.len()).filter(|k| !is_skipped(*k));
    let channels: Vec<Channel> = kept
        .map(|k| Channel {
            name: match table.titles.get(k).map(|t| t.trim()) {
                Some(title) if !title.is_empty() => title.to_string(),
                _ => format!("channel {}", k + usize::from(time.is_none())),
            },
            samples: table.columns[k].real.clone(),
        })
        .collect();
    if channels.is_empty() {
        let remedy = "only times were found; export the samples too";
        return Err(table.missing("signal", remedy));
    }
    if table.columns.iter().any(|column| column.imaginary.is_some()) {
        notes.push("complex numbers: the real part is used".to_string());
    }
    Ok(SignalFile { sampling_rate: rate, start, channels, notes })
}

/// The time column and its factor to seconds.
fn time_column(table: &Table) -> Option<(usize, f64)> {
    if let Some(stamps) = table.columns.iter().position(|column| column.is_time) {
        return Some((stamps, 1.0));
    }
    if !table.names.is_empty() {
        return (0..table.names.len()).find_map(|k| Some((k, seconds(&table.names[k])?)));
    }
    if table.columns.len() < 2 || table.rows() < 3 {
        return None;
    }
    let t = &table.columns[0].real;
    let step = (t[t.len() - 1] - t[0]) / (t.len() - 1) as f64;
    let is_near = |i: usize| (t[i] - t[0] - i as f64 * step).abs() <= JITTER * step;
    (step > 0.0 && (0..t.len()).all(is_near)).then_some((0, 1.0))
}

/// The step of a regular time column with the times `t`, s.
fn regular_step(table: &Table, column: usize, t: &[f64]) -> Result<f64, ReadError> {
    let step = (t[t.len() - 1] - t[0]) / (t.len() - 1) as f64;
    // Times that stand still now and then, and never go back, are rounded.
    let falls = t.windows(2).any(|w| w[1] < w[0]);
    let stands = t.windows(2).any(|w| w[1] == w[0]);
    if stands && !falls && step > 0.0 {
        let (step, rate) = (rounding(t), 1.0 / step);
        let problem = format!(
            "the time column is rounded to {step} s, which hides the sampling rate (about \
             {rate:.1} Hz); give it with --rate HZ"
        );
        return Err(ReadError::whole(problem));
    }
    if let Some(i) = (1..t.len()).find(|&i| t[i] <= t[i - 1]) {
        let (value, previous) = (t[i], t[i - 1]);
        let problem = format!(
            "time {value} s does not follow the {previous} s before it; sort the rows by time"
        );
        return Err(table.error(i, column, problem));
    }
    let off = |i: usize| (t[i] - t[0] - i as f64 * step).abs() > JITTER * step;
    if (0..t.len()).any(off) || !(step.is_finite() && (1.0 / step).is_finite()) {
        // The mean step is spoiled by a gap; the usual one finds the row at which it is.
        let steps: Vec<f64> = t.windows(2).map(|w| w[1] - w[0]).collect();
        let usual = super::super::statistics::median(&steps);
        let i = (1..t.len())
            .find(|&i| (t[i] - t[i - 1] - usual).abs() > 0.5 * usual)
            .or_else(|| (1..t.len()).find(|&i| off(i)))
            .unwrap_or(1);
        let problem = format!(
            "time {} s is not on the grid of {usual} s that the other rows have. Resample to \
             equal steps, or cut the record at the gap",
            t[i]
        );
        return Err(table.error(i, column, problem));
    }
    Ok(step)
}

/// Smallest step above zero: the unit to which times are rounded.
fn rounding(t: &[f64]) -> f64 {
    let steps = t.windows(2).map(|w| w[1] - w[0]);
    let least = steps.filter(|s| *s > 0.0).fold(f64::INFINITY, f64::min);
    // Differences of decimal numbers have digits of their own.
    let rounded = (least * 1e9).round() / 1e9;
    if rounded > 0.0 { rounded } else { least }
}

/// The rate of the option, if the time column agrees with it to 1 % or within its rounding.
fn agreed_rate(
    table: &Table,
    column: usize,
    t: &[f64],
    option: f64,
    notes: &mut Vec<String>,
) -> Result<f64, ReadError> {
    let found = (t.len() - 1) as f64 / (t[t.len() - 1] - t[0]);
    let room = 1.01 * rounding(t) + JITTER / option;
    let is_near = |i: usize| (t[i] - t[0] - i as f64 / option).abs() <= room;
    if (0..t.len()).all(is_near) {
        notes.push(format!("the rate of {option} Hz replaces the time column"));
        return Ok(option);
    }
    if (option / found - 1.0).abs() > 1e-2 || !found.is_finite() {
        let problem =
            format!("the time column says {found} Hz, the option {option} Hz; leave --rate out");
        return Err(ReadError::whole(problem));
    }
    // Within 1 % the column knows better, if it is regular.
    Ok(1.0 / regular_step(table, column, t)?)
}
