//! Short-time amplitude spectra.

use super::Window;
use super::error::{SignalError, check_positive};
use super::spectrum::{check_signal, frequency_axis, transform};
use realfft::RealFftPlanner;

/// How a [`spectrogram`] cuts the signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrogramOptions {
    /// Window length, s.
    pub window_length: f64,
    /// Distance of successive windows, s.
    pub hop: f64,
    /// The transform is zero-padded to at least this many window lengths (then to a power of two).
    pub padding: usize,
    /// Taper.
    pub window: Window,
}

impl Default for SpectrogramOptions {
    /// Windows of 0.5 ms, as in figures 8 and 11 of the paper, with three quarters overlap.
    fn default() -> Self {
        Self {
            window_length: 5e-4,
            hop: 1.25e-4,
            padding: 4,
            window: Window::Hann,
        }
    }
}

/// Amplitude over time and frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrogram {
    /// Centre of each window, s from the first sample.
    pub times: Vec<f64>,
    /// Frequencies, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Amplitudes, `times.len()` rows of `frequencies_hz.len()` values, unit of the signal.
    pub magnitudes: Vec<f64>,
}

impl Spectrogram {
    /// Amplitudes of window `index`.
    pub fn row(&self, index: usize) -> &[f64] {
        let n = self.frequencies_hz.len();
        &self.magnitudes[index * n..(index + 1) * n]
    }

    /// The same with every window's largest amplitude set to 1, as the paper draws it, so that the
    /// harmonic content shows whatever the amplitude. Windows of silence stay zero.
    pub fn normalized(&self) -> Self {
        let mut out = self.clone();
        for row in out.magnitudes.chunks_mut(self.frequencies_hz.len().max(1)) {
            let top = row.iter().copied().fold(0.0, f64::max);
            if top > 0.0 {
                row.iter_mut().for_each(|a| *a /= top);
            }
        }
        out
    }

    /// The part at or below `max_frequency_hz`.
    pub fn below(&self, max_frequency_hz: f64) -> Self {
        let keep = self
            .frequencies_hz
            .partition_point(|f| *f <= max_frequency_hz);
        Self {
            times: self.times.clone(),
            frequencies_hz: self.frequencies_hz[..keep].to_vec(),
            magnitudes: (0..self.times.len())
                .flat_map(|i| self.row(i)[..keep].to_vec())
                .collect(),
        }
    }

    /// Frequency of the largest amplitude in each window, Hz.
    pub fn dominant_frequencies(&self) -> Vec<f64> {
        (0..self.times.len())
            .map(|i| {
                let row = self.row(i);
                let best = (0..row.len()).fold(0, |b, k| if row[k] > row[b] { k } else { b });
                self.frequencies_hz[best]
            })
            .collect()
    }
}

/// Amplitude spectra of successive windows, each less its own mean.
///
/// # Errors
/// [`SignalError`] for a signal shorter than one window, a window under 4 samples, a sample that is
/// not finite, or a length not positive.
pub fn spectrogram(
    samples: &[f64],
    sampling_rate: f64,
    options: &SpectrogramOptions,
) -> Result<Spectrogram, SignalError> {
    check_positive("spectrogram window length", options.window_length, " (s)")?;
    check_positive("spectrogram hop", options.hop, " (s)")?;
    check_signal(samples, sampling_rate, 4)?;
    let block = (options.window_length * sampling_rate).round() as usize;
    if block < 4 {
        return Err(SignalError::TooShort {
            what: "the spectrogram window",
            count: block,
            needed: 4,
            remedy: "lengthen the window or sample faster",
        });
    }
    check_signal(samples, sampling_rate, block)?;
    let hop = ((options.hop * sampling_rate).round() as usize).max(1);
    let length = (block * options.padding.max(1)).next_power_of_two();
    let taper = options.window.coefficients(block);
    let weight: f64 = taper.iter().sum();
    let mut fft = RealFftPlanner::<f64>::new();
    let (mut times, mut magnitudes) = (Vec::new(), Vec::new());
    for start in (0..=samples.len() - block).step_by(hop) {
        let x = &samples[start..start + block];
        // The window's own weighted mean leaves no line at zero frequency.
        let mean = x.iter().zip(&taper).map(|(v, w)| v * w).sum::<f64>() / weight;
        let x: Vec<f64> = x.iter().map(|v| v - mean).collect();
        let lines = transform(&mut fft, &x, &taper, length);
        magnitudes.extend(lines.iter().map(|z| 2.0 / weight * z.norm()));
        times.push((start as f64 + 0.5 * block as f64) / sampling_rate);
    }
    Ok(Spectrogram {
        times,
        frequencies_hz: frequency_axis(length / 2 + 1, length, sampling_rate),
        magnitudes,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn half_millisecond_windows_follow_a_frequency_switch() {
        let (rate, switch) = (5e5, 0.01);
        let x: Vec<f64> = (0..10_000)
            .map(|j| {
                let t = j as f64 / rate;
                if t < switch {
                    (TAU * 5800.0 * t).sin()
                } else {
                    1e3 * (TAU * 9900.0 * t).sin()
                }
            })
            .collect();
        let s = spectrogram(&x, rate, &SpectrogramOptions::default()).unwrap();
        for (t, f) in s.times.iter().zip(s.dominant_frequencies()) {
            let want = if *t < switch { 5800.0 } else { 9900.0 };
            if (t - switch).abs() > 5e-4 {
                // Bin of the padded transform: 500 kHz / 1024 = 488 Hz.
                assert!((f - want).abs() < 488.0, "{t} {f}");
            }
        }
        let n = s.normalized();
        assert!((0..n.times.len()).all(|i| n.row(i).iter().copied().fold(0.0, f64::max) == 1.0));
        assert!(
            s.below(2e4)
                .frequencies_hz
                .last()
                .is_some_and(|f| *f <= 2e4)
        );
    }
}
