//! Vibrations of the harmonics that a record follows, and whether they are of one frequency or of two.

use super::Recorder;
use crate::linalg::c64;
use crate::order::range as range_of;
use crate::signal::{RotatingLine, centred, rotating_lines, strongest_vibration};
use std::f64::consts::TAU;
use std::ops::Range;

/// Fewest samples that a vibration is read from.
const FEWEST: usize = 64;

/// Share of the deformation below which a vibration is a remnant.
const REMNANT: f64 = 1e-6;

/// Share of its size that a vibration that dies out loses at least from each quarter of the last fifth to the next, and what these
/// shares differ by at most: a cycle that is approached from above lets them fall.
const LOSS: f64 = 0.05;
const SAME_LOSS: f64 = 0.1;

/// A line weaker than this share of the strongest makes no motion of two frequencies.
const SECOND: f64 = 0.05;

/// Lines weaker than this share of the vibration are not looked at.
pub const WEAKEST_LINE: f64 = 0.02;

/// Periods after which a periodic motion repeats itself at the latest: subharmonics of that order are of one frequency.
const LONGEST_REPETITION: usize = 3;

/// Multiples of a frequency that a periodic motion is taken to have, and sweeps over them.
const MULTIPLES: f64 = 12.0;
const SWEEPS: usize = 3;

/// Distance of two frequencies that are one and the same, in lines of the spectrum and relative.
const LINES_APART: f64 = 0.3;
const RELATIVELY_APART: f64 = 1e-3;

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
    let vibrations = record.followed_harmonics().filter_map(|n| {
        let (frequency, amplitude) = strongest_vibration(&series(record, range.clone(), n)?, rate)?;
        Some((n, frequency, amplitude))
    });
    let (harmonic, frequency, amplitude) = vibrations.max_by(|a, b| a.2.total_cmp(&b.2))?;
    (amplitude > REMNANT * record.largest_motion(range)).then_some((harmonic, frequency))
}

/// Whether a series goes one way all over, in the means of its eighths.
pub(super) fn creeps(series: &[c64]) -> bool {
    let parts = series.chunks_exact((series.len() / 8).max(1));
    let sums: Vec<c64> = parts.map(|own| own.iter().sum()).collect();
    let way = (sums[sums.len() - 1] - sums[0]).conj();
    sums.windows(2).all(|pair| ((pair[1] - pair[0]) * way).re > 0.0)
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
pub fn rms(series: &[c64]) -> f64 {
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

/// A series without what repeats itself with a frequency (periods a sample). Waves of its multiples, which are nearly orthogonal over many
/// periods, are taken out one by one.
pub(super) fn without_multiples(mut series: Vec<c64>, frequency: f64) -> Vec<c64> {
    let count = (0.5 / frequency.abs()).min(MULTIPLES) as i32;
    let share = 1.0 / series.len() as f64;
    for multiple in (0..SWEEPS).flat_map(|_| -count..=count) {
        let turn = c64::from_polar(1.0, TAU * f64::from(multiple) * frequency);
        let wave = || std::iter::successors(Some(c64::new(1.0, 0.0)), |last| Some(last * turn));
        let sum: c64 = series.iter().zip(wave()).map(|(value, own)| value * own.conj()).sum();
        series.iter_mut().zip(wave()).for_each(|(value, own)| *value -= own * sum * share);
    }
    series
}

/// Whether the strongest vibration is below a `share` of the deformation and falls off as a mode does that decays.
pub(super) fn dies_out(record: &Recorder, fifth: &Range<usize>, share: f64) -> bool {
    let sizes = record.followed_harmonics().map(|harmonic| quarters(record, fifth, harmonic));
    let Some(sizes) = sizes.max_by(|a, b| a[0].total_cmp(&b[0])) else { return false };
    let losses: [f64; 3] = std::array::from_fn(|k| 1.0 - sizes[k + 1] / sizes[k]);
    let [least, most] = range_of(losses);
    sizes[0] < share * record.largest_motion(fifth.clone())
        && least >= LOSS
        && most - least <= SAME_LOSS * most
}

/// A stationary motion of two frequencies that no common fundamental has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoFrequencies {
    /// That of the strongest line and that of the strongest one that is neither a multiple of it nor a harmonic of its wave, Hz.
    pub frequencies_hz: [f64; 2],
    /// Largest over smallest envelope: half the range of the tangential displacement of the first contact node over a period
    /// of the first frequency.
    pub envelope_ratio: f64,
}

impl TwoFrequencies {
    /// Frequency at which the envelope swings: distance of the second frequency from the nearest multiple of the first, Hz.
    pub(super) fn beat_hz(&self) -> f64 {
        let [first, second] = self.frequencies_hz;
        (second - (second / first).round() * first).abs()
    }

    /// The two frequencies of a motion whose strongest vibration is `main` (harmonic, signed frequency in Hz); `None` for one
    /// that is periodic.
    ///
    /// A periodic motion has lines at multiples of its frequency `f` alone (or of `f/2`, `f/3`), and a wave of `n_0` periods
    /// around the contact that turns as a whole moves harmonic `n` at `f n / n_0`. Any other line above a twentieth of the
    /// strongest is the second frequency. Lines nearer to each other than four over the length of `range` are not told apart.
    pub(super) fn of(record: &Recorder, range: &Range<usize>, main: (usize, f64)) -> Option<Self> {
        let rate = 1.0 / record.sample_interval;
        let (wave, _) = main;
        let largest = rms(&series(record, range.clone(), wave)?);
        let lines: Vec<(usize, RotatingLine)> = record
            .followed_harmonics()
            .filter_map(|n| Some((n, series(record, range.clone(), n)?)))
            .flat_map(|(n, series)| {
                let lines = rotating_lines(&series, rate, WEAKEST_LINE * largest);
                lines.into_iter().map(move |line| (n, line))
            })
            .collect();
        let (first, second) = strongest_two(&lines, wave, rate / range.len() as f64)?;
        let frequencies_hz = [first, second?].map(|line| line.frequency_hz.abs());
        let envelope_ratio = envelope_ratio(record, range, frequencies_hz[0]);
        Some(Self { frequencies_hz, envelope_ratio })
    }
}

/// The strongest of the lines of harmonic `wave`, and the strongest of all that is foreign to it, as [`TwoFrequencies`] has them;
/// `lines` come with their harmonics, `width` is that of a line of the spectrum, Hz.
pub fn strongest_two(
    lines: &[(usize, RotatingLine)],
    wave: usize,
    width: f64,
) -> Option<(RotatingLine, Option<RotatingLine>)> {
    let strongest = |lines: &mut dyn Iterator<Item = &(usize, RotatingLine)>| {
        lines.max_by(|a, b| a.1.amplitude.total_cmp(&b.1.amplitude)).map(|line| line.1)
    };
    let first = strongest(&mut lines.iter().filter(|(n, _)| *n == wave))?;
    let frequency = first.frequency_hz;
    let is_at = |line: f64, expected: f64| {
        (line - expected).abs() < LINES_APART * width + RELATIVELY_APART * expected.abs()
    };

    // What neither repeats itself with the strongest line nor turns with its wave.
    let is_foreign = |(n, line): &&(usize, RotatingLine), repetition: usize| {
        let fundamental = frequency / repetition as f64;
        let multiple = (line.frequency_hz / fundamental).round();
        let turning = frequency * *n as f64 / wave as f64;
        line.amplitude >= SECOND * first.amplitude
            && !is_at(line.frequency_hz, multiple * fundamental)
            && !(wave > 0 && is_at(line.frequency_hz, turning))
    };
    let foreign = |repetition: usize| {
        strongest(&mut lines.iter().filter(|line| is_foreign(line, repetition)))
    };
    let found: Option<Vec<_>> = (1..=LONGEST_REPETITION).map(foreign).collect();
    Some((first, found.and_then(|lines| lines.first().copied())))
}

/// Largest over smallest half range over a period of the tangential displacement of the first contact node.
fn envelope_ratio(record: &Recorder, range: &Range<usize>, frequency: f64) -> f64 {
    let angle = record.contact_angles.first().copied().unwrap_or(0.0);
    let displacement: Vec<f64> = range
        .clone()
        .map(|sample| {
            let parts = record.followed_harmonics().map(|n| {
                let amplitude = record.amplitude(sample, n).unwrap_or_default();
                let turned = c64::from_polar(1.0, n as f64 * angle);
                (c64::new(amplitude[0], amplitude[1]) * turned).re
            });
            parts.sum()
        })
        .collect();
    let period = ((1.0 / (frequency * record.sample_interval)).round() as usize).max(2);
    let sizes = displacement.windows(period + 1).map(|window| {
        let [low, high] = range_of(window.iter().copied());
        0.5 * (high - low)
    });
    let [smallest, largest] = range_of(sizes);
    largest / smallest
}
