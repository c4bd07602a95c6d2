//! Vibrations of the harmonics that a record follows.

use super::Recorder;
use crate::linalg::c64;
use crate::signal::{centred, strongest_vibration};
use std::ops::Range;

/// Fewest samples that a vibration is read from.
const FEWEST: usize = 64;

/// Share of the deformation below which a vibration is a remnant.
const REMNANT: f64 = 1e-6;

/// Share of its size that a vibration that dies out loses at least from each quarter of the last fifth to the next, and what these
/// shares differ by at most: a cycle that is approached from above lets them fall.
const LOSS: f64 = 0.05;
const SAME_LOSS: f64 = 0.1;

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
) -> Option<Vec<c64>> {
    let parts = range.map(|sample| record.amplitude(sample, harmonic));
    parts.map(|parts| parts.map(|[re, im]| c64::new(re, im))).collect()
}

/// A followed harmonic about its mean, m.
pub(super) fn series(record: &Recorder, range: Range<usize>, harmonic: usize) -> Option<Vec<c64>> {
    Some(centred(&amplitudes(record, range, harmonic)?))
}

/// Root mean square of a series.
pub(super) fn rms(series: &[c64]) -> f64 {
    let sum: f64 = series.iter().map(c64::norm_sqr).sum();
    (sum / series.len().max(1) as f64).sqrt()
}

/// Root mean square of a harmonic about its mean in each quarter of a stretch, m.
pub(super) fn quarters(record: &Recorder, stretch: &Range<usize>, harmonic: usize) -> [f64; 4] {
    let quarter = stretch.len() / 4;
    std::array::from_fn(|k| {
        let start = stretch.start + k * quarter;
        rms(&series(record, start..start + quarter, harmonic).unwrap_or_default())
    })
}

/// Whether the strongest vibration is below a `share` of the deformation and falls off as a mode does that decays.
pub(super) fn dies_out(record: &Recorder, fifth: &Range<usize>, share: f64) -> bool {
    let sizes = record.followed_harmonics().map(|harmonic| quarters(record, fifth, harmonic));
    let Some(sizes) = sizes.max_by(|a, b| a[0].total_cmp(&b[0])) else {
        return false;
    };
    let losses: [f64; 3] = std::array::from_fn(|k| 1.0 - sizes[k + 1] / sizes[k]);
    let [least, most] = crate::order::range(losses);
    sizes[0] < share * record.largest_motion(fifth.clone())
        && least >= LOSS
        && most - least <= SAME_LOSS * most
}
