//! Spectral lines that stand out of the noise, and the superharmonics among them.

use super::spectrum::{AmplitudeSpectrum, averaged_spectrum, check_signal, top_of};
use super::statistics::{mean_power_exceeded, median, normal_exceeded};
use super::{Window, error::SignalError, window::HALF_LOBE};
use frictionsim_output::Described;
use serde::Serialize;
use std::{iter::successors, ops::Range};

/// Weakest line reported, relative to the strongest (-46 dB).
const WEAKEST: f64 = 5e-3;
/// Probability that noise alone shows a line anywhere in a spectrum.
const FALSE_ALARM: f64 = 1e-3;
/// The noise beside a line is the median over a band of this ratio of frequencies ...
const NOISE_BAND: f64 = 1.15;
/// ... that holds this many half lobes of the window at least.
const NOISE_LOBES: usize = 8;
/// Highest order of a superharmonic that is looked for.
const HIGHEST_ORDER: usize = 10;
/// A fundamental is at least this strong relative to the superharmonic it explains.
const FUNDAMENTAL_SHARE: f64 = 0.05;
/// Longest block that is transformed at once where no resolution is asked for, s.
const LONGEST_BLOCK: f64 = 2.0;
/// Zero-padding, in block lengths: lines are located between its bins by a parabola.
const PADDING: usize = 4;
/// Fewest periods of a line in the block of the loudest part: those that a growth rate needs.
const FEWEST_PERIODS: f64 = 36.0;
const WINDOW: Window = Window::BlackmanHarris;
/// Half the width of a line in such a spectrum, padded bins.
const REACH: usize = HALF_LOBE * PADDING;

/// One line of a spectrum: a sinusoid, located between the bins.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
pub struct SpectralLine {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Amplitude, unit of the signal.
    pub amplitude: f64,
    /// Of which other peak it is a multiple.
    pub superharmonic: Option<Superharmonic>,
}

/// An integer multiple of a fundamental.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Described, Serialize)]
pub struct Superharmonic {
    /// Number of the fundamental's peak, from 1.
    pub of_peak: usize,
    /// The multiple.
    pub order: usize,
}

/// How finely a spectrum tells lines apart, and over how many blocks it is a mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralResolution {
    /// Smallest distance of two lines that are told apart, Hz: 4 over the length of a block.
    pub resolution_hz: f64,
    /// Samples of a block.
    pub block: usize,
}

impl SpectralResolution {
    /// Blocks for a resolution asked for, or of at most 2 s.
    ///
    /// # Errors
    /// [`SignalError::Asked`] for one that the signal is too short or too coarsely sampled for.
    pub fn of(
        count: usize,
        sampling_rate: f64,
        asked_hz: Option<f64>,
    ) -> Result<Self, SignalError> {
        let lobe = HALF_LOBE as f64;
        let block = match asked_hz {
            Some(asked) => {
                super::error::check_positive("resolution", asked, " (Hz): change --resolution")?;
                let block = (lobe * sampling_rate / asked).round();
                if !(block <= count as f64 && block >= 16.0) {
                    let [finest, coarsest] = [count as f64, 16.0]
                        .map(|block| (1e6 * lobe * sampling_rate / block).round() / 1e6);
                    return Err(SignalError::Asked(format!(
                        "a resolution of {asked} Hz is out of reach: an interval of {:.4} s gives \
                         {finest} to {coarsest} Hz; change --resolution, or the interval",
                        count as f64 / sampling_rate
                    )));
                }
                block as usize
            }
            None => count.min((LONGEST_BLOCK * sampling_rate).max(16.0) as usize),
        };
        Ok(Self { resolution_hz: lobe * sampling_rate / block as f64, block })
    }
}

/// The strongest lines, strongest first, at most `most`, with superharmonics recognised.
///
/// Lines are the maxima of a Blackman-Harris spectrum averaged over blocks, each the largest within one
/// resolution to either side and located by a parabola through the logarithms of the padded spectrum. A
/// line must be so far above the noise beside it that noise alone shows one in a spectrum out of 1000:
/// its power exceeds the local median by the quantile of a mean of as many exponential variables as there
/// are blocks. Line `q` is superharmonic `k` of line `p` when `|f_q - k f_p|` is below half a bin (or
/// 0.2 %) and `p` has at least 5 % of its amplitude. Does not see lines 46 dB below the strongest.
///
/// # Errors
/// [`SignalError`] for fewer than 16 samples, a sample that is not finite, or a rate not positive.
pub fn spectral_lines(
    samples: &[f64],
    sampling_rate: f64,
    resolution: SpectralResolution,
    most: usize,
) -> Result<Vec<SpectralLine>, SignalError> {
    check_signal(samples, sampling_rate, 16)?;
    let spectrum = averaged_spectrum(samples, sampling_rate, WINDOW, resolution.block, PADDING)?;
    let mut lines = peaks(&spectrum, largest(samples), 1, &[]);
    lines.truncate(most);
    name_superharmonics(&mut lines, sampling_rate / resolution.block as f64);
    Ok(lines)
}

/// Frequency and amplitude of the strongest line.
///
/// # Errors
/// As [`spectral_lines`]; a signal of which no line stands out is an error too.
pub fn main_frequency(samples: &[f64], sampling_rate: f64) -> Result<SpectralLine, SignalError> {
    let resolution = SpectralResolution::of(samples.len(), sampling_rate, None)?;
    let lines = spectral_lines(samples, sampling_rate, resolution, 1)?;
    let none = SignalError::NoResonance { low_hz: 0.0, high_hz: 0.5 * sampling_rate };
    lines.first().copied().ok_or(none)
}

/// Frequency, Hz, of the line of the loudest part of a signal, and that part, in ever shorter blocks.
///
/// Blocks are quartered; of those of one length the line of the loudest counts: 36 periods of it in the block, and so
/// strong that noise alone shows one in a record out of 1000. The part reaches a block to either side.
pub(super) fn loudest_parts(
    samples: &[f64],
    sampling_rate: f64,
) -> impl Iterator<Item = (f64, Range<usize>)> {
    let longest = SpectralResolution::of(samples.len(), sampling_rate, None);
    let longest = longest.map_or(0, |resolution| resolution.block);
    let blocks = successors(Some(longest), |block| Some(block / 4));
    let blocks = blocks.take_while(|block| *block as f64 > 2.0 * FEWEST_PERIODS);
    blocks.filter_map(move |block| {
        let (frequency_hz, start) = loudest_block(samples, sampling_rate, block)?;
        Some((frequency_hz, start.saturating_sub(block)..(start + 2 * block).min(samples.len())))
    })
}

/// Frequency, Hz, of the loudest line of any block of a length, and the first sample of that block.
fn loudest_block(samples: &[f64], sampling_rate: f64, block: usize) -> Option<(f64, usize)> {
    let (scale, last) = (largest(samples), samples.len() - block);
    let lowest_hz = FEWEST_PERIODS * sampling_rate / block as f64;
    // The noise of one block is known from few values, that of their mean from many.
    let mean = averaged_spectrum(samples, sampling_rate, WINDOW, block, PADDING).ok()?;
    let noise = local_noise(&mean.amplitudes);
    let mut loudest = (0.0, None);
    for start in (0..last).step_by(block / 2).chain([last]) {
        let part = &samples[start..start + block];
        let spectrum = averaged_spectrum(part, sampling_rate, WINDOW, block, PADDING).ok()?;
        let lines = peaks(&spectrum, scale, samples.len(), &noise);
        let line = lines.iter().find(|line| line.frequency_hz >= lowest_hz);
        if let Some(line) = line.filter(|line| line.amplitude > loudest.0) {
            loudest = (line.amplitude, Some((line.frequency_hz, start)));
        }
    }
    loudest.1
}

/// Largest magnitude of a sample.
pub(super) fn largest(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |most, x| x.abs().max(most))
}

/// Maxima of one of so many spectra that stand out, of the noise that they share too if it is known, strongest first.
fn peaks(own: &AmplitudeSpectrum, scale: f64, spectra: usize, shared: &[f64]) -> Vec<SpectralLine> {
    let a = &own.amplitudes;
    let top = a.iter().copied().fold(0.0, f64::max);
    // A constant leaves nothing but the round-off of its mean.
    if top <= 1e-14 * scale || top == 0.0 {
        return Vec::new();
    }
    // Noise powers are exponential; a padded bin in four is independent of its neighbours.
    let count = own.averages as f64;
    let exceeded = normal_exceeded(FALSE_ALARM / (a.len() * spectra) as f64);
    let ratio = mean_power_exceeded(count, exceeded) / mean_power_exceeded(count, 0.0);
    let mut noise = local_noise(a);
    noise.iter_mut().zip(shared).for_each(|(one, shared)| *one = one.max(*shared));
    let stands_out = |&k: &usize| {
        let neighbours = &a[k.saturating_sub(REACH)..(k + REACH + 1).min(a.len())];
        let is_peak = a[k] > a[k - 1] && a[k] >= a[k + 1] && a[k] >= WEAKEST * top;
        let is_largest = || neighbours.iter().all(|other| *other <= a[k]);
        is_peak && a[k] > noise[k] * ratio.sqrt() && is_largest()
    };
    let tops = (PADDING..a.len() - 1).filter(stands_out);
    let mut lines: Vec<SpectralLine> = tops.map(|k| located(own, k)).collect();
    lines.sort_by(|p, q| q.amplitude.total_cmp(&p.amplitude));
    lines
}

/// Median amplitude beside each bin of a spectrum, over bands that are narrow at low frequencies.
fn local_noise(amplitudes: &[f64]) -> Vec<f64> {
    let count = amplitudes.len();
    let mut noise = Vec::with_capacity(count);
    while noise.len() < count {
        let first = noise.len();
        let width = ((NOISE_BAND - 1.0) * first as f64) as usize;
        let mut end = first + width.max(NOISE_LOBES * REACH);
        // A remnant at the end belongs to the band before it.
        if end + NOISE_LOBES * REACH > count {
            end = count;
        }
        noise.resize(end, median(&amplitudes[first..end]));
    }
    noise
}

/// The line whose largest bin is `k`.
fn located(spectrum: &AmplitudeSpectrum, k: usize) -> SpectralLine {
    let (shift, amplitude) = top_of([k - 1, k, k + 1].map(|i| spectrum.amplitudes[i]));
    let frequency_hz = (k as f64 + shift) * spectrum.frequencies_hz[1];
    SpectralLine { frequency_hz, amplitude, superharmonic: None }
}

/// Marks every line that is an integer multiple of a lower one.
fn name_superharmonics(lines: &mut [SpectralLine], bin: f64) {
    let mut by_frequency: Vec<usize> = (0..lines.len()).collect();
    by_frequency.sort_by(|i, j| lines[*i].frequency_hz.total_cmp(&lines[*j].frequency_hz));
    for (place, &q) in by_frequency.iter().enumerate() {
        let line = lines[q];
        let tolerance = (0.5 * bin).max(2e-3 * line.frequency_hz);
        lines[q].superharmonic = by_frequency[..place].iter().find_map(|&p| {
            let fundamental = lines[p];
            let order = (line.frequency_hz / fundamental.frequency_hz).round();
            let miss = (line.frequency_hz - order * fundamental.frequency_hz).abs();
            // A fundamental of a few tolerances has a multiple near any frequency: no evidence.
            let telling = fundamental.frequency_hz > 10.0 * tolerance;
            (fundamental.superharmonic.is_none()
                && fundamental.amplitude >= FUNDAMENTAL_SHARE * line.amplitude
                && (2.0..=HIGHEST_ORDER as f64).contains(&order)
                && miss <= tolerance
                && telling)
                .then_some(Superharmonic { of_peak: p + 1, order: order as usize })
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{gaussian_sequence, sampled};
    use std::f64::consts::TAU;

    fn lines(samples: &[f64], rate: f64, asked_hz: Option<f64>) -> Vec<SpectralLine> {
        let resolution = SpectralResolution::of(samples.len(), rate, asked_hz).unwrap();
        spectral_lines(samples, rate, resolution, 12).unwrap()
    }

    #[test]
    fn main_frequency_of_a_short_record_is_sub_bin_accurate() {
        // 10 ms of a limit cycle at 2 us: the bin is 100 Hz, the target 0.1 % of 9.4 kHz.
        let rate = 5e5;
        for frequency in [9403.0, 9437.7, 9470.1, 10_651.3] {
            let x = sampled(5000, rate / frequency / TAU, |p| {
                3.0 * p.sin() + 0.8 * (2.0 * p + 1.0).sin() + 0.4 * (3.0 * p).cos() + 11.0
            });
            let line = main_frequency(&x, rate).unwrap();
            assert!((line.frequency_hz / frequency - 1.0).abs() < 1e-4, "{line:?}");
            assert!((line.amplitude - 3.0).abs() < 0.01);
        }
    }

    #[test]
    fn superharmonics_are_named_and_a_strange_line_is_not() {
        let rate = 2e5;
        let x = sampled(20_000, rate / TAU, |t| {
            (9437.0 * t).sin()
                + 1.4 * (2.0 * 9437.0 * t).cos()
                + 0.2 * (3.0 * 9437.0 * t).sin()
                + 0.5 * (5856.0 * t).sin()
        });
        let lines = lines(&x, rate, None);
        assert_eq!(lines.len(), 4);
        // Strongest is the first superharmonic; its fundamental stands second.
        assert_eq!(lines[0].superharmonic, Some(Superharmonic { of_peak: 2, order: 2 }));
        assert_eq!(lines[1].superharmonic, None);
        assert_eq!(lines[2].superharmonic, None);
        assert!((lines[2].frequency_hz - 5856.0).abs() < 0.1);
        assert_eq!(lines[3].superharmonic, Some(Superharmonic { of_peak: 2, order: 3 }));
    }

    #[test]
    fn noise_has_no_lines_and_a_tone_in_it_is_one_line_at_every_resolution() {
        let rate = 51_200.0;
        let mut false_alarms = 0;
        for seed in 1..=40 {
            let mut noise = gaussian_sequence(seed);
            let mut x: Vec<f64> = (0..25_000).map(|_| noise()).collect();
            // A first-order low-pass colours every second record.
            if seed % 2 == 0 {
                for j in 1..x.len() {
                    x[j] += 0.9 * x[j - 1];
                }
            }
            false_alarms += lines(&x, rate, None).len() + lines(&x, rate, Some(40.0)).len();
            false_alarms += usize::from(loudest_parts(&x, rate).next().is_some());
        }
        // 120 spectra and records at one in a thousand each: two would happen once in 150 times.
        assert!(false_alarms <= 1, "{false_alarms}");
        let mut noise = gaussian_sequence(7);
        // The tone sounds a third of the time.
        let x: Vec<f64> = (0..512_000)
            .map(|j| {
                let tone = (TAU * 9433.0 * f64::from(j) / rate).sin();
                0.1 * noise() + if (170_000..340_000).contains(&j) { tone } else { 0.0 }
            })
            .collect();
        for resolution in [None, Some(5.0), Some(50.0)] {
            let found = lines(&x, rate, resolution);
            assert_eq!(found.len(), 1, "{resolution:?}: {found:?}");
            assert!((found[0].frequency_hz - 9433.0).abs() < 1.0, "{found:?}");
        }
    }

    #[test]
    fn a_resolution_that_the_record_cannot_give_is_refused_with_what_it_can() {
        let error = SpectralResolution::of(1000, 1000.0, Some(0.5)).unwrap_err();
        assert!(error.to_string().contains("gives 4 to 250 Hz"), "{error}");
        assert!(SpectralResolution::of(1000, 1000.0, Some(0.0)).is_err());
        assert!(SpectralResolution::of(1000, 1000.0, Some(900.0)).is_err());
    }

    #[test]
    fn a_constant_signal_has_no_lines() {
        assert!(lines(&[0.1; 100], 1.0, None).is_empty());
        assert!(main_frequency(&[0.1; 100], 1.0).is_err());
    }
}
