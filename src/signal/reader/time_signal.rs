//! Tables of time signals.

use super::super::SignalError;
use super::error::{ReadError, ReadProblem};
use super::table::{Table, read_table};
use super::units::{sampling_rate, seconds};

/// Largest deviation of a time from the regular grid, in steps: rounding in the export.
const JITTER: f64 = 0.3;

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
    /// Channels in the order of their columns.
    pub channels: Vec<Channel>,
    /// Decisions a user should know of.
    pub notes: Vec<String>,
}

/// Reads time signals: a time column with any number of channels, or channels with a sampling rate
/// from the option or a comment (`sampling rate: 51200 Hz`).
///
/// The time column is the one named time or t (`time_ms`, `t [us]` are scaled to seconds); without
/// names, the first of several columns if it advances in equal steps. Times may deviate from the
/// regular grid by 0.3 steps, which is the rounding of an export; the rate is that of the first to
/// last sample.
///
/// # Errors
/// [`ReadError`] with source name, line and column: gaps, times out of order, no rate.
pub fn read_signal(bytes: &[u8], source: &str, rate: Option<f64>) -> Result<SignalFile, ReadError> {
    if let Some(value) = rate
        && !(value > 0.0 && value.is_finite())
    {
        return Err(ReadError::whole(source, ReadProblem::Rate { value }));
    }
    let table = read_table(bytes, source)?;
    let time = time_column(&table);
    let rows = table.lines.len();
    if rows < 16 {
        let problem = SignalError::TooShort {
            what: "the signal",
            count: rows,
            needed: 16,
            remedy: "give a longer record",
        };
        return Err(ReadError::whole(source, ReadProblem::Signal(problem)));
    }
    let mut notes = Vec::new();
    let (sampling_rate, start) = match time {
        Some((column, factor)) => {
            let step = regular_step(&table, column, factor, source)?;
            let found = 1.0 / step;
            if let Some(option) = rate.filter(|r| (r / found - 1.0).abs() > 1e-2) {
                let problem = ReadProblem::RateContradiction {
                    column: found,
                    option,
                };
                return Err(ReadError::whole(source, problem));
            }
            (found, table.columns[column][0] * factor)
        }
        None => {
            let stated = sampling_rate(&table.remarks);
            if let (Some(option), Some(stated)) = (rate, stated)
                && option != stated
            {
                notes.push(format!(
                    "the file states {stated} Hz, the option {option} Hz holds"
                ));
            }
            let found = rate
                .or(stated)
                .ok_or_else(|| ReadError::whole(source, ReadProblem::NoRate))?;
            (found, 0.0)
        }
    };
    let channels: Vec<Channel> = (0..table.columns.len())
        .filter(|&k| time.is_none_or(|(column, _)| column != k))
        .map(|k| Channel {
            name: match table.titles.get(k) {
                Some(title) if !title.is_empty() => title.clone(),
                _ => format!("channel {}", k + 1),
            },
            samples: table.columns[k].clone(),
        })
        .collect();
    if channels.is_empty() {
        let problem = ReadProblem::MissingColumn {
            wanted: "signal",
            columns: table.described(),
            remedy: "only times were found; export the samples beside them",
        };
        return Err(ReadError::whole(source, problem));
    }
    Ok(SignalFile {
        sampling_rate,
        start,
        channels,
        notes,
    })
}

/// The time column and its factor to seconds.
fn time_column(table: &Table) -> Option<(usize, f64)> {
    if !table.names.is_empty() {
        return (0..table.names.len()).find_map(|k| Some((k, seconds(&table.names[k])?)));
    }
    if table.columns.len() < 2 || table.lines.len() < 3 {
        return None;
    }
    let t = &table.columns[0];
    let step = (t[t.len() - 1] - t[0]) / (t.len() - 1) as f64;
    let regular = t
        .iter()
        .enumerate()
        .all(|(i, t_i)| (t_i - t[0] - i as f64 * step).abs() <= JITTER * step);
    (step > 0.0 && regular).then_some((0, 1.0))
}

/// The step of a regular time column, s.
fn regular_step(table: &Table, column: usize, factor: f64, source: &str) -> Result<f64, ReadError> {
    let t: Vec<f64> = table.columns[column].iter().map(|t| t * factor).collect();
    let place = |i: usize| (table.lines[i], table.start(i, column));
    if let Some(i) = (1..t.len()).find(|&i| t[i] <= t[i - 1]) {
        let (line, at) = place(i);
        let problem = ReadProblem::TimeOrder {
            value: t[i],
            previous: t[i - 1],
        };
        return Err(ReadError::at(source, line, at, problem));
    }
    let step = (t[t.len() - 1] - t[0]) / (t.len() - 1) as f64;
    let off = |i: usize| (t[i] - t[0] - i as f64 * step).abs() > JITTER * step;
    if (0..t.len()).any(off) || !step.is_finite() {
        // The mean step is spoiled by a gap; the usual one finds the row at which it is.
        let steps: Vec<f64> = t.windows(2).map(|w| w[1] - w[0]).collect();
        let usual = super::super::statistics::median(&steps);
        let i = (1..t.len())
            .find(|&i| (t[i] - t[i - 1] - usual).abs() > 0.5 * usual)
            .or_else(|| (1..t.len()).find(|&i| off(i)))
            .unwrap_or(1);
        let (line, at) = place(i);
        let problem = ReadProblem::TimeGap {
            value: t[i],
            step: usual,
        };
        return Err(ReadError::at(source, line, at, problem));
    }
    Ok(step)
}
