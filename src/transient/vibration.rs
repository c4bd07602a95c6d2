//! Vibrations of the harmonics that a record follows.

use super::Recorder;
use crate::signal::strongest_vibration;
use rustfft::num_complex::Complex64;
use std::ops::Range;

/// Fewest samples that a vibration is read from.
const FEWEST: usize = 64;

/// Share of the deformation below which a vibration is a remnant.
const REMNANT: f64 = 1e-6;

/// Samples of the last fifth of a record.
pub(super) fn last_fifth(record: &Recorder) -> Range<usize> {
    let count = record.rows.len();
    count - count.div_ceil(5)..count
}

/// Harmonic and signed frequency (Hz) of the strongest vibration; `None` where all are remnants.
pub(super) fn main_vibration(record: &Recorder, range: Range<usize>) -> Option<(usize, f64)> {
    if range.len() < FEWEST {
        return None;
    }
    let rate = 1.0 / record.sample_interval;
    let followed = record.followed_harmonics();
    let vibrations = followed.filter_map(|n| {
        let (frequency, amplitude) = strongest_vibration(&series(record, range.clone(), n)?, rate)?;
        Some((n, frequency, amplitude))
    });
    let (harmonic, frequency, amplitude) = vibrations.max_by(|a, b| a.2.total_cmp(&b.2))?;
    (amplitude > REMNANT * record.largest_motion(range)).then_some((harmonic, frequency))
}

/// A followed harmonic, m.
pub(super) fn amplitudes(
    record: &Recorder,
    range: Range<usize>,
    harmonic: usize,
) -> Option<Vec<Complex64>> {
    let parts = range.map(|sample| record.amplitude(sample, harmonic));
    parts.map(|parts| parts.map(|[re, im]| Complex64::new(re, im))).collect()
}

/// A followed harmonic about its mean, m.
pub(super) fn series(
    record: &Recorder,
    range: Range<usize>,
    harmonic: usize,
) -> Option<Vec<Complex64>> {
    let count = range.len() as f64;
    let mut series = amplitudes(record, range, harmonic)?;
    let mean = series.iter().sum::<Complex64>() / count;
    series.iter_mut().for_each(|value| *value -= mean);
    Some(series)
}

/// Root mean square of a series.
pub(super) fn rms(series: &[Complex64]) -> f64 {
    let sum: f64 = series.iter().map(Complex64::norm_sqr).sum();
    (sum / series.len().max(1) as f64).sqrt()
}
