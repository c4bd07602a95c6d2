//! Short-time amplitude spectra.

use super::Window;
use super::error::{SignalError, check_positive, too_short};
use super::spectrum::{BlockTransform, check_signal};

/// The transform is zero-padded to at least this many window lengths (then to a power of two).
const PADDING: usize = 4;

/// Most rows: where there are more windows, each row is the largest of several.
const MOST_ROWS: usize = 4000;
/// Window of figures 8 and 11 of the paper, s.
pub const USUAL_WINDOW: f64 = 5e-4;

/// Amplitude over time and frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrogram {
    /// Centre of each row's windows, s from the first sample.
    pub times: Vec<f64>,
    /// Frequencies, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Amplitudes, `times.len()` rows of `frequencies_hz.len()` values, unit of the signal.
    pub magnitudes: Vec<f64>,
}

/// Amplitude spectra of successive Hann windows of a length, s, with three quarters overlap, each less its own mean,
/// up to a frequency, Hz.
///
/// One scale for the whole record: a quiet window stays quiet beside a loud one.
///
/// # Errors
/// [`SignalError`] for a signal shorter than one window, a window under 4 samples, a sample that is
/// not finite, or a length not positive.
pub fn spectrogram(
    samples: &[f64],
    sampling_rate: f64,
    window_length: f64,
    max_frequency_hz: f64,
) -> Result<Spectrogram, SignalError> {
    check_positive("spectrogram window length", window_length, " (s)")?;
    check_signal(samples, sampling_rate, 4)?;
    let block = (window_length * sampling_rate).round() as usize;
    if block < 4 {
        let remedy = "lengthen the window or sample faster";
        return Err(too_short("the spectrogram window", block, 4, remedy));
    }
    check_signal(samples, sampling_rate, block)?;
    // Windows, and how many of them make a row.
    let hop = ((0.25 * window_length * sampling_rate).round() as usize).max(1);
    let windows = (samples.len() - block) / hop + 1;
    let together = windows.div_ceil(MOST_ROWS);
    let length = (block * PADDING).next_power_of_two();
    let taper = Window::Hann.coefficients(block);
    let weight: f64 = taper.iter().sum();
    let mut transform = BlockTransform::new(taper.clone(), length);
    let mut frequencies_hz = transform.frequencies_hz(sampling_rate);
    frequencies_hz.retain(|f| *f <= max_frequency_hz);
    let (mut times, mut magnitudes) = (Vec::new(), Vec::new());
    for row in 0..windows.div_ceil(together) {
        let range = row * together..((row + 1) * together).min(windows);
        let mut largest = vec![0.0f64; frequencies_hz.len()];
        for start in range.clone().map(|k| k * hop) {
            let x = &samples[start..start + block];
            // The window's own weighted mean leaves no line at zero frequency.
            let mean = x.iter().zip(&taper).map(|(v, w)| v * w).sum::<f64>() / weight;
            for (a, z) in largest.iter_mut().zip(transform.of(x, mean)) {
                *a = a.max(z.norm_sqr());
            }
        }
        magnitudes.extend(largest.iter().map(|power| 2.0 / weight * power.sqrt()));
        let middle = 0.5 * ((range.start + range.end - 1) * hop) as f64 + 0.5 * block as f64;
        times.push(middle / sampling_rate);
    }
    Ok(Spectrogram { times, frequencies_hz, magnitudes })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::sampled;
    use std::f64::consts::TAU;

    /// A faint tone that switches to a loud one.
    fn switching(rate: f64, switch: f64, count: usize) -> Vec<f64> {
        sampled(count, rate, |t| {
            if t < switch { (TAU * 5800.0 * t).sin() } else { 1e3 * (TAU * 9900.0 * t).sin() }
        })
    }

    #[test]
    fn half_millisecond_windows_follow_a_frequency_switch_on_one_scale() {
        let (rate, switch) = (5e5, 0.01);
        let s = spectrogram(&switching(rate, switch, 10_000), rate, USUAL_WINDOW, 2e4).unwrap();
        assert!(s.frequencies_hz.last().is_some_and(|f| *f <= 2e4));
        for (t, row) in s.times.iter().zip(s.magnitudes.chunks(s.frequencies_hz.len())) {
            if (t - switch).abs() < 5e-4 {
                continue;
            }
            let (want, amplitude) = if *t < switch { (5800.0, 1.0) } else { (9900.0, 1e3) };
            let best = (0..row.len()).fold(0, |b, k| if row[k] > row[b] { k } else { b });
            // Bin of the padded transform: 500 kHz / 1024 = 488 Hz; scalloping of a padded Hann: 2 %.
            assert!((s.frequencies_hz[best] - want).abs() < 488.0, "{t}");
            assert!((row[best] / amplitude - 1.0).abs() < 0.03, "{t} {}", row[best]);
        }
    }

    #[test]
    fn a_long_record_keeps_its_shortest_burst_in_few_rows() {
        let mut x = vec![0.0; 2_000_000];
        for (j, v) in switching(5e5, 0.0, 400).into_iter().enumerate() {
            x[300_000 + j] = v;
        }
        let s = spectrogram(&x, 5e5, USUAL_WINDOW, f64::INFINITY).unwrap();
        assert!(s.times.len() <= 4000);
        let top = s.magnitudes.iter().copied().fold(0.0, f64::max);
        assert!(top > 900.0, "{top}");
    }
}
