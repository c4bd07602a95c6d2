//! One-sided amplitude spectrum of a real signal, of one block or averaged over many.

use super::Window;
use super::error::{SignalError, check_finite, check_positive, too_short};
use faer::c64;
use realfft::RealFftPlanner;
use std::iter::Sum;
use std::ops::{Div, Sub};

/// One-sided amplitude spectrum: a sinusoid `A cos(2 pi f t + phi)` on a bin reads `A`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AmplitudeSpectrum {
    /// Frequencies, Hz, from 0 to half the sampling rate.
    pub frequencies_hz: Vec<f64>,
    /// Peak amplitude, root mean square over the blocks, in the unit of the signal.
    pub amplitudes: Vec<f64>,
    /// Number of blocks averaged.
    pub averages: usize,
}

/// Amplitude spectrum by Welch's method: root mean square over blocks of `block` samples, half overlapping.
///
/// `A_k = 2 |sum_j w_j (x_j - mean) e^{-2 pi i j k / N}| / sum_j w_j` of a block padded with zeros to `padding >= 1`
/// times its length. The mean is that of the whole signal: a drift leaks into the lowest lines. A tail shorter than
/// half a block is not used. Noise reads `sqrt(4 S / (T s))` for a density `S`, with `T` the length of a block and `s`
/// about 1: longer blocks lower it beside a line.
///
/// # Errors
/// [`SignalError`] for a signal shorter than one block, a block under 4 samples, a sample that is not
/// finite, or a rate not positive.
///
/// Source: P. D. Welch, "The use of fast Fourier transform for the estimation of power spectra", IEEE
/// Trans. Audio Electroacoust. 15 (1967).
pub fn averaged_spectrum(
    samples: &[f64],
    sampling_rate: f64,
    window: Window,
    block: usize,
    padding: usize,
) -> Result<AmplitudeSpectrum, SignalError> {
    let block = block.max(4);
    check_signal(samples, sampling_rate, block)?;
    let taper = window.coefficients(block);
    let gain = 2.0 / taper.iter().sum::<f64>();
    let mut transform = BlockTransform::new(taper, block * padding.max(1));
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    let frequencies_hz = transform.frequencies_hz(sampling_rate);
    let mut powers = vec![0.0; frequencies_hz.len()];
    let mut averages = 0;
    for start in (0..=samples.len() - block).step_by((block / 2).max(1)) {
        let lines = transform.of(&samples[start..start + block], mean);
        for (power, z) in powers.iter_mut().zip(lines) {
            *power += z.norm_sqr();
        }
        averages += 1;
    }
    let scale = gain / f64::sqrt(averages as f64);
    let amplitudes = powers.iter().map(|p| scale * p.sqrt()).collect();
    Ok(AmplitudeSpectrum { frequencies_hz, amplitudes, averages })
}

/// Windowed real transform of blocks of one length, zero-padded.
pub(super) struct BlockTransform {
    fft: std::sync::Arc<dyn realfft::RealToComplex<f64>>,
    taper: Vec<f64>,
    input: Vec<f64>,
    output: Vec<c64>,
    scratch: Vec<c64>,
}

impl BlockTransform {
    pub(super) fn new(taper: Vec<f64>, length: usize) -> Self {
        let fft = RealFftPlanner::<f64>::new().plan_fft_forward(length);
        let (input, output) = (fft.make_input_vec(), fft.make_output_vec());
        Self { scratch: fft.make_scratch_vec(), fft, taper, input, output }
    }

    /// Frequencies of the bins, Hz.
    pub(super) fn frequencies_hz(&self, sampling_rate: f64) -> Vec<f64> {
        let step = sampling_rate / self.input.len() as f64;
        (0..self.output.len()).map(|k| k as f64 * step).collect()
    }

    /// Transform of one block less `mean`.
    pub(super) fn of(&mut self, block: &[f64], mean: f64) -> &[c64] {
        self.input.fill(0.0);
        for (slot, (x, w)) in self.input.iter_mut().zip(block.iter().zip(&self.taper)) {
            *slot = (x - mean) * w;
        }
        self.fft
            .process_with_scratch(&mut self.input, &mut self.output, &mut self.scratch)
            .expect("buffers come from the plan");
        &self.output
    }
}

/// Offset, bins, and height of the top of the parabola through the logarithms of three amplitudes around a
/// maximum: the main lobe of a window is nearly Gaussian.
pub fn top_of(amplitudes: [f64; 3]) -> (f64, f64) {
    let [left, middle, right] = amplitudes.map(|a| a.max(f64::MIN_POSITIVE).ln());
    let bend = left - 2.0 * middle + right;
    let shift = if bend < 0.0 { (0.5 * (left - right) / bend).clamp(-0.5, 0.5) } else { 0.0 };
    (shift, (middle - 0.25 * (left - right) * shift).exp())
}

/// Bin of a complex transform of so many values, those of its upper half negative.
pub(super) fn signed_bin(bin: usize, count: usize) -> f64 {
    if bin > count / 2 { bin as f64 - count as f64 } else { bin as f64 }
}

/// A real or complex signal less its mean.
pub fn centred<T>(samples: &[T]) -> Vec<T>
where
    T: Copy + Sum<T> + Sub<Output = T> + Div<f64, Output = T>,
{
    let mean = samples.iter().copied().sum::<T>() / samples.len().max(1) as f64;
    samples.iter().map(|x| *x - mean).collect()
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
        let remedy = "give a longer record or a shorter window";
        return Err(too_short("the signal", samples.len(), needed, remedy));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::gaussian_sequence;
    use std::f64::consts::TAU;

    fn tone(count: usize, rate: f64, frequency: f64, amplitude: f64) -> Vec<f64> {
        (0..count).map(|j| amplitude * (TAU * frequency * j as f64 / rate + 0.4).cos()).collect()
    }

    #[test]
    fn amplitude_of_a_tone_on_a_bin_is_read_exactly_with_every_window_and_average() {
        let x: Vec<f64> = tone(1000, 1e4, 1200.0, 2.5).iter().map(|v| v + 7.0).collect();
        for window in [Window::Hann, Window::BlackmanHarris] {
            for (block, averages) in [(1000, 1), (250, 7)] {
                let s = averaged_spectrum(&x, 1e4, window, block, 1).unwrap();
                let k = block * 12 / 100;
                assert_eq!((s.frequencies_hz[k], s.averages), (1200.0, averages));
                // Round-off of a 1000-point transform.
                assert!((s.amplitudes[k] - 2.5).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn noise_of_known_variance_reads_its_density_in_every_block_length() {
        let mut noise = gaussian_sequence(1);
        let x: Vec<f64> = (0..1 << 15).map(|_| noise()).collect();
        for block in [128, 256] {
            let s = averaged_spectrum(&x, 2e3, Window::Hann, block, 1).unwrap();
            let inner = &s.amplitudes[2..block / 2 - 2];
            let mean = inner.iter().map(|a| a * a).sum::<f64>() / inner.len() as f64;
            // E|X_k|^2 = variance sum w^2, and sum w = N/2, sum w^2 = 3 N/8 for Hann.
            let expected = 4.0 * 0.375 / 0.25 / block as f64;
            // 32,768 samples know the variance to about 1 %.
            assert!((mean / expected - 1.0).abs() < 0.03, "{mean} {expected}");
        }
    }

    #[test]
    fn signals_that_are_short_or_not_finite_are_refused() {
        assert!(averaged_spectrum(&[1.0; 3], 1.0, Window::Hann, 3, 1).is_err());
        assert!(averaged_spectrum(&[1.0, f64::NAN, 1.0, 1.0], 1.0, Window::Hann, 4, 1).is_err());
        assert!(averaged_spectrum(&[1.0; 8], 0.0, Window::Hann, 8, 1).is_err());
        assert!(averaged_spectrum(&[1.0; 8], 1.0, Window::Hann, 9, 1).is_err());
    }
}
