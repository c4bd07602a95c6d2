//! One-sided amplitude spectrum and power spectral density of a real signal.

use super::Window;
use super::error::{SignalError, check_finite, check_positive};
use faer::c64;
use realfft::RealFftPlanner;

/// One-sided amplitude spectrum: a sinusoid `A cos(2 pi f t + phi)` on a bin reads `A`.
#[derive(Clone, Debug, PartialEq)]
pub struct AmplitudeSpectrum {
    /// Frequencies, Hz, from 0 to half the sampling rate.
    pub frequencies_hz: Vec<f64>,
    /// Peak amplitude, in the unit of the signal.
    pub amplitudes: Vec<f64>,
}

/// One-sided power spectral density: its integral over frequency is the variance.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerSpectrum {
    /// Frequencies, Hz, from 0 to half the sampling rate.
    pub frequencies_hz: Vec<f64>,
    /// Density, unit of the signal squared per Hz.
    pub densities: Vec<f64>,
}

/// Amplitude spectrum of the whole signal, mean removed.
///
/// `A_k = 2 |sum_j w_j (x_j - mean) e^{-2 pi i j k / N}| / sum_j w_j`; the block is zero-padded to
/// `padding >= 1` times its length. Does not detrend: a drift leaks into the lowest lines.
///
/// # Errors
/// [`SignalError`] for fewer than 4 samples, a sample that is not finite, or a rate not positive.
pub fn amplitude_spectrum(
    samples: &[f64],
    sampling_rate: f64,
    window: Window,
    padding: usize,
) -> Result<AmplitudeSpectrum, SignalError> {
    check_signal(samples, sampling_rate, 4)?;
    let (taper, length) = (
        window.coefficients(samples.len()),
        samples.len() * padding.max(1),
    );
    let gain = 2.0 / taper.iter().sum::<f64>();
    let mut fft = RealFftPlanner::<f64>::new();
    let lines = transform(&mut fft, &centred(samples), &taper, length);
    Ok(AmplitudeSpectrum {
        frequencies_hz: frequency_axis(lines.len(), length, sampling_rate),
        amplitudes: lines.iter().map(|z| gain * z.norm()).collect(),
    })
}

/// Power spectral density by Welch's method: mean over blocks of `block` samples, half overlapping.
///
/// `S_k = 2 |X_k|^2 / (f_s sum_j w_j^2)`, half of that at 0 and at half the sampling rate. The mean
/// of the whole signal is removed first; a tail shorter than half a block is not used.
///
/// # Errors
/// [`SignalError`] for a signal shorter than one block, a block under 4 samples, a sample that is
/// not finite, or a rate not positive.
pub fn power_spectral_density(
    samples: &[f64],
    sampling_rate: f64,
    window: Window,
    block: usize,
) -> Result<PowerSpectrum, SignalError> {
    check_signal(samples, sampling_rate, block.max(4))?;
    let block = block.max(4);
    let taper = window.coefficients(block);
    let scale = 1.0 / (sampling_rate * taper.iter().map(|w| w * w).sum::<f64>());
    let x = centred(samples);
    let mut fft = RealFftPlanner::<f64>::new();
    let mut densities = vec![0.0; block / 2 + 1];
    let mut count = 0.0;
    for start in (0..=samples.len() - block).step_by((block / 2).max(1)) {
        let lines = transform(&mut fft, &x[start..start + block], &taper, block);
        for (k, (s, z)) in densities.iter_mut().zip(&lines).enumerate() {
            let sides = if k == 0 || 2 * k == block { 1.0 } else { 2.0 };
            *s += sides * scale * z.norm_sqr();
        }
        count += 1.0;
    }
    densities.iter_mut().for_each(|s| *s /= count);
    Ok(PowerSpectrum {
        frequencies_hz: frequency_axis(densities.len(), block, sampling_rate),
        densities,
    })
}

/// Windowed real transform of one block, zero-padded to `length` samples.
pub(super) fn transform(
    planner: &mut RealFftPlanner<f64>,
    block: &[f64],
    taper: &[f64],
    length: usize,
) -> Vec<c64> {
    let fft = planner.plan_fft_forward(length);
    let mut input = fft.make_input_vec();
    for (slot, (x, w)) in input.iter_mut().zip(block.iter().zip(taper)) {
        *slot = x * w;
    }
    let mut output = fft.make_output_vec();
    fft.process(&mut input, &mut output)
        .expect("buffers come from the plan");
    output
}

/// Frequencies of the first `count` bins of a transform over `length` samples, Hz.
pub(super) fn frequency_axis(count: usize, length: usize, sampling_rate: f64) -> Vec<f64> {
    (0..count)
        .map(|k| k as f64 * sampling_rate / length as f64)
        .collect()
}

/// The signal less its mean.
pub(super) fn centred(samples: &[f64]) -> Vec<f64> {
    let mean = samples.iter().sum::<f64>() / samples.len().max(1) as f64;
    samples.iter().map(|x| x - mean).collect()
}

/// Common checks of a time signal.
pub(super) fn check_signal(
    samples: &[f64],
    sampling_rate: f64,
    needed: usize,
) -> Result<(), SignalError> {
    check_positive("sampling rate", sampling_rate, ": give it with --rate")?;
    check_finite("sample", samples)?;
    if samples.len() < needed {
        return Err(SignalError::TooShort {
            what: "the signal",
            count: samples.len(),
            needed,
            remedy: "give a longer record or a shorter window",
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn tone(count: usize, rate: f64, frequency: f64, amplitude: f64) -> Vec<f64> {
        (0..count)
            .map(|j| amplitude * (TAU * frequency * j as f64 / rate + 0.4).cos())
            .collect()
    }

    #[test]
    fn amplitude_of_a_tone_on_a_bin_is_read_exactly_with_every_window() {
        let x: Vec<f64> = tone(1000, 1e4, 1200.0, 2.5)
            .iter()
            .map(|v| v + 7.0)
            .collect();
        for window in [Window::Rectangular, Window::Hann, Window::BlackmanHarris] {
            let s = amplitude_spectrum(&x, 1e4, window, 1).unwrap();
            assert_eq!(s.frequencies_hz[120], 1200.0);
            // Round-off of a 1000-point transform.
            assert!((s.amplitudes[120] - 2.5).abs() < 1e-12);
        }
    }

    #[test]
    fn integral_of_the_power_spectrum_is_the_variance() {
        let mut state = 1u64;
        let x: Vec<f64> = (0..1 << 15)
            .map(|_| {
                state = state
                    .wrapping_mul(6364136223846793005)
                    .wrapping_add(1442695040888963407);
                (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
            })
            .collect();
        let s = power_spectral_density(&x, 2e3, Window::Hann, 256).unwrap();
        let power: f64 = s.densities.iter().sum::<f64>() * s.frequencies_hz[1];
        // Uniform noise of width 1 has variance 1/12; 32,768 samples know it to about 1 %.
        assert!((power * 12.0 - 1.0).abs() < 0.02, "{power}");
    }

    #[test]
    fn signals_that_are_short_or_not_finite_are_refused() {
        assert!(amplitude_spectrum(&[1.0; 3], 1.0, Window::Hann, 1).is_err());
        assert!(amplitude_spectrum(&[1.0, f64::NAN, 1.0, 1.0], 1.0, Window::Hann, 1).is_err());
        assert!(amplitude_spectrum(&[1.0; 8], 0.0, Window::Hann, 1).is_err());
        assert!(power_spectral_density(&[1.0; 8], 1.0, Window::Hann, 9).is_err());
    }
}
