//! Frequencies, growth rates and mean powers of a recorded run.

use super::recorder::HARMONIC_COUNT;
use super::{ContactPowers, Recorder, SampleRow, StatusCounts};
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;
use std::ops::Range;

/// Fewest samples that a frequency is read from.
const FEWEST: usize = 64;

/// Lines next to zero that hold the mean and slow drifts, not a vibration (a Hann window is four wide).
const LOWEST_LINE: usize = 4;

/// Exponential growth of one harmonic of the contact edge in the linear stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// Circumferential harmonic.
    pub harmonic: usize,
    /// Growth rate, 1/s.
    pub rate: f64,
    /// Frequency, Hz, positive.
    pub frequency_hz: f64,
    /// +1 travels with the rotor, -1 against it.
    pub direction: i8,
}

/// Means over the last fifth of a run, for each metre of thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitCycle {
    /// Frequency of the strongest harmonic of the contact edge's tangential displacement, Hz; `None` if it does
    /// not vibrate.
    pub main_frequency_hz: Option<f64>,
    /// Circumferential harmonic of that vibration.
    pub main_harmonic: Option<usize>,
    /// Fractions of contact nodes `[stick, slip, open]`.
    pub status: [f64; 3],
    /// Mean contact powers, W/m.
    pub powers: ContactPowers,
    /// Mean power of material damping, W/m.
    pub material_damping: f64,
    /// Mean amplitude of harmonic `n` of the tangential displacement of the contact edge, m; for `n = 0` the mean
    /// twist.
    pub harmonics: [f64; HARMONIC_COUNT],
}

/// What a run did.
#[derive(Clone, Debug, PartialEq)]
pub struct TransientAnalysis {
    /// Its last fifth.
    pub limit_cycle: LimitCycle,
    /// Growth of each perturbed harmonic in the linear stage, where that is long enough to tell.
    pub growth: Vec<Growth>,
    /// End of the linear stage, the longest time with every contact node slipping: when the first node sticks or
    /// opens, s. `None` if there is no linear stage or it lasts to the end of the run.
    pub first_nonlinearity: Option<f64>,
    /// Largest balance residual.
    pub largest_residual: f64,
}

impl TransientAnalysis {
    /// Reads `record`; growth is fitted for those of `harmonics` that it follows.
    pub fn of(record: &Recorder, harmonics: &[usize]) -> Self {
        let rows = &record.rows;
        let stage = linear_stage(rows);
        let ended = stage.end < rows.len() && !stage.is_empty();
        let residuals = rows.iter().map(|row| row.balance_residual);
        Self {
            limit_cycle: limit_cycle(record, rows.len() - rows.len().div_ceil(5)..rows.len()),
            growth: harmonics
                .iter()
                .filter_map(|&n| growth(record, stage.clone(), n))
                .collect(),
            first_nonlinearity: ended.then(|| rows[stage.end].time),
            largest_residual: residuals.fold(0.0, f64::max),
        }
    }
}

/// Longest range of samples over which every contact node slipped all the time.
fn linear_stage(rows: &[SampleRow]) -> Range<usize> {
    let (mut best, mut start) = (0..0, 0);
    for (i, row) in rows.iter().enumerate() {
        if row.counts.stick + row.counts.open > 0 {
            start = i + 1;
        } else if i + 1 - start > best.len() {
            best = start..i + 1;
        }
    }
    best
}

fn limit_cycle(record: &Recorder, range: Range<usize>) -> LimitCycle {
    let rows = &record.rows[range.clone()];
    let mut counts = StatusCounts::default();
    let mut powers = ContactPowers::default();
    let (mut material_damping, mut harmonics) = (0.0, [0.0; HARMONIC_COUNT]);
    let share = 1.0 / rows.len() as f64;
    for row in rows {
        counts += row.counts;
        powers += row.powers.scaled(share);
        material_damping += share * row.material_damping;
        for (sum, [re, im]) in harmonics.iter_mut().zip(row.harmonics) {
            *sum += share * re.hypot(im);
        }
    }
    let main = main_vibration(record, range);
    LimitCycle {
        main_frequency_hz: main.map(|(_, frequency)| frequency),
        main_harmonic: main.map(|(harmonic, _)| harmonic),
        status: counts.fractions(),
        powers,
        material_damping,
        harmonics,
    }
}

/// Harmonic and frequency of the strongest vibration.
fn main_vibration(record: &Recorder, range: Range<usize>) -> Option<(usize, f64)> {
    let rows = &record.rows[range.clone()];
    if rows.len() < FEWEST {
        return None;
    }
    let series: Vec<(usize, Vec<Complex64>)> = record
        .followed_harmonics()
        .filter_map(|n| Some((n, series(record, range.clone(), n)?)))
        .collect();
    let peaks = series.iter().map(|(n, series)| (n, strongest_line(series)));
    let (harmonic, (line, amplitude)) = peaks.max_by(|a, b| a.1.1.total_cmp(&b.1.1))?;
    let scale = rows
        .iter()
        .flat_map(|row| row.harmonics)
        .fold(0.0_f64, |m, [re, im]| m.max(re.hypot(im)));
    // What is a millionth of the deformation is a remnant, not a vibration.
    if !(amplitude > 1e-6 * scale) {
        return None;
    }
    let (_, main) = series.iter().find(|(n, _)| n == harmonic)?;
    let fit = fit_exponential(main, line, interval(rows));
    Some((*harmonic, (fit.im / TAU).abs()))
}

fn growth(record: &Recorder, stage: Range<usize>, harmonic: usize) -> Option<Growth> {
    // The first third still holds what decays; the last two thirds belong to what grows.
    let range = stage.start + stage.len() / 3..stage.end;
    if range.len() < FEWEST {
        return None;
    }
    let series = series(record, range.clone(), harmonic)?;
    let (line, amplitude) = strongest_line(&series);
    if amplitude == 0.0 {
        return None;
    }
    let fit = fit_exponential(&series, line, interval(&record.rows[range]));
    Some(Growth {
        harmonic,
        rate: fit.re,
        frequency_hz: fit.im.abs() / TAU,
        // exp(i (n theta + omega t)) travels towards negative angles.
        direction: if fit.im * record.rotation_direction > 0.0 {
            -1
        } else {
            1
        },
    })
}

fn interval(rows: &[SampleRow]) -> f64 {
    (rows[rows.len() - 1].time - rows[0].time) / (rows.len() - 1) as f64
}

/// A followed harmonic about its mean.
fn series(record: &Recorder, range: Range<usize>, harmonic: usize) -> Option<Vec<Complex64>> {
    let count = range.len() as f64;
    let mut series = range
        .map(|sample| record.amplitude(sample, harmonic))
        .map(|parts| parts.map(|[re, im]| Complex64::new(re, im)))
        .collect::<Option<Vec<Complex64>>>()?;
    let mean = series.iter().sum::<Complex64>() / count;
    series.iter_mut().for_each(|value| *value -= mean);
    Some(series)
}

fn hann(index: usize, count: usize) -> f64 {
    let sin = (0.5 * TAU * (index as f64 + 0.5) / count as f64).sin();
    sin * sin
}

/// Signed frequency in cycles per sample, and amplitude, of the strongest line of a windowed complex series.
fn strongest_line(series: &[Complex64]) -> (f64, f64) {
    let count = series.len();
    let windowed = series.iter().enumerate();
    let mut spectrum: Vec<Complex64> = windowed.map(|(k, v)| v * hann(k, count)).collect();
    FftPlanner::new()
        .plan_fft_forward(count)
        .process(&mut spectrum);
    let lines = LOWEST_LINE..count + 1 - LOWEST_LINE;
    let best = lines.max_by(|&a, &b| spectrum[a].norm_sqr().total_cmp(&spectrum[b].norm_sqr()));
    let best = best.unwrap_or(0);
    let signed = if best > count / 2 {
        best as f64 - count as f64
    } else {
        best as f64
    };
    (
        signed / count as f64,
        2.0 * spectrum[best].norm() / count as f64,
    )
}

/// `sigma + i omega` of the part of `series` near `line` (cycles per sample) that goes like
/// `exp((sigma + i omega) t)`.
///
/// The series is demodulated by `line` in overlapping Hann windows a quarter of it long; the logarithm of their
/// sums goes linearly in time. Other frequencies are rejected by the window, whatever their growth.
fn fit_exponential(series: &[Complex64], line: f64, interval: f64) -> Complex64 {
    let length = (series.len() / 4).max(FEWEST / 2);
    let hop = (length / 8).max(1);
    let mut points = Vec::new();
    let mut phase = 0.0;
    let mut previous: Option<Complex64> = None;
    let mut start = 0;
    while start + length <= series.len() {
        let window = series[start..start + length].iter().enumerate();
        let sum: Complex64 = window
            .map(|(k, value)| {
                let turn = Complex64::from_polar(hann(k, length), -TAU * line * (start + k) as f64);
                value * turn
            })
            .sum();
        if let Some(previous) = previous {
            phase += (sum / previous).arg();
        }
        previous = Some(sum);
        points.push((start as f64 * interval, sum.norm().ln(), phase));
        start += hop;
    }
    let slope = |value: fn(&(f64, f64, f64)) -> f64| {
        let count = points.len() as f64;
        let mean_t = points.iter().map(|p| p.0).sum::<f64>() / count;
        let mean_y = points.iter().map(value).sum::<f64>() / count;
        let products = points.iter().map(|p| (p.0 - mean_t) * (value(p) - mean_y));
        let squares = points.iter().map(|p| (p.0 - mean_t) * (p.0 - mean_t));
        products.sum::<f64>() / squares.sum::<f64>()
    };
    Complex64::new(slope(|p| p.1), slope(|p| p.2) + TAU * line / interval)
}
