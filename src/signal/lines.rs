//! Spectral lines with sub-bin frequency, and the superharmonics among them.

use super::Window;
use super::error::SignalError;
use super::spectrum::{amplitude_spectrum, centred, check_signal};
use std::f64::consts::TAU;

/// Weakest line reported, relative to the strongest (-46 dB).
const WEAKEST: f64 = 5e-3;
/// A line must exceed the median of the spectrum by this factor to count as more than noise.
const ABOVE_MEDIAN: f64 = 8.0;
/// Highest order of a superharmonic that is looked for.
const HIGHEST_ORDER: usize = 10;
/// A fundamental is at least this strong relative to the superharmonic it explains.
const FUNDAMENTAL_SHARE: f64 = 0.05;

/// One line of a spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralLine {
    /// Frequency, Hz, located between the bins.
    pub frequency_hz: f64,
    /// Peak amplitude of the sinusoid, unit of the signal.
    pub amplitude: f64,
    /// Position in the returned list of the fundamental of which this line is an integer multiple,
    /// and the multiple; `None` for a line of its own.
    pub superharmonic_of: Option<(usize, usize)>,
}

/// The strongest lines, strongest first, at most `most`, with superharmonics recognised.
///
/// Lines are the maxima of a Blackman-Harris spectrum, each moved to the maximum of the continuous
/// transform `|sum_j w_j x_j e^{-2 pi i f t_j}|`. Line `q` is superharmonic `k` of line `p` when
/// `|f_q - k f_p|` is below half a bin (or 0.2 %) and `p` has at least 5 % of its amplitude. Does
/// not separate lines closer than 8 bins (`8 / duration`), nor sees lines 46 dB below the strongest.
///
/// # Errors
/// [`SignalError`] for fewer than 16 samples, a sample that is not finite, or a rate not positive.
pub fn spectral_lines(
    samples: &[f64],
    sampling_rate: f64,
    most: usize,
) -> Result<Vec<SpectralLine>, SignalError> {
    check_signal(samples, sampling_rate, 16)?;
    let window = Window::BlackmanHarris;
    let mut lines = peaks(samples, sampling_rate, window)?;
    lines.truncate(most);
    name_superharmonics(&mut lines, sampling_rate / samples.len() as f64);
    Ok(lines)
}

/// Frequency and amplitude of the strongest line, by a Hann window.
///
/// For a single tone the frequency error is far below a bin; another tone `d` bins away disturbs it
/// by about `1/d^3` bins. Superharmonics are integer multiples of it, hence far away.
///
/// # Errors
/// As [`spectral_lines`]; a constant signal has no line and is an error too.
pub fn main_frequency(samples: &[f64], sampling_rate: f64) -> Result<SpectralLine, SignalError> {
    check_signal(samples, sampling_rate, 16)?;
    let lines = peaks(samples, sampling_rate, Window::Hann)?;
    lines.into_iter().next().ok_or(SignalError::NoResonance {
        low_hz: 0.0,
        high_hz: 0.5 * sampling_rate,
    })
}

/// Maxima of the windowed spectrum that stand out, refined, strongest first.
fn peaks(
    samples: &[f64],
    sampling_rate: f64,
    window: Window,
) -> Result<Vec<SpectralLine>, SignalError> {
    let padding = 4;
    let spectrum = amplitude_spectrum(samples, sampling_rate, window, padding)?;
    let a = &spectrum.amplitudes;
    let top = a.iter().copied().fold(0.0, f64::max);
    let scale = samples.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    // A constant leaves nothing but the round-off of its mean.
    if top <= 1e-14 * scale || top == 0.0 {
        return Ok(Vec::new());
    }
    let mut sorted = a.clone();
    sorted.sort_by(f64::total_cmp);
    let floor = (WEAKEST * top).max((ABOVE_MEDIAN * sorted[sorted.len() / 2]).min(0.5 * top));
    let reach = (window.half_lobe_bins() * padding as f64) as usize;
    let x = centred(samples);
    let taper = window.coefficients(samples.len());
    let gain = 2.0 / taper.iter().sum::<f64>();
    let weighted: Vec<f64> = x.iter().zip(&taper).map(|(x, w)| gain * x * w).collect();
    let bin = spectrum.frequencies_hz[1];
    let mut lines = Vec::new();
    for k in padding..a.len().saturating_sub(1) {
        let neighbours = &a[k.saturating_sub(reach / 2)..(k + reach / 2 + 1).min(a.len())];
        let is_peak =
            a[k] > a[k - 1] && a[k] >= a[k + 1] && neighbours.iter().all(|other| *other <= a[k]);
        if is_peak && a[k] >= floor {
            let f = spectrum.frequencies_hz[k];
            lines.push(refined(&weighted, sampling_rate, f - bin, f + bin));
        }
    }
    lines.sort_by(|p, q| q.amplitude.total_cmp(&p.amplitude));
    Ok(lines)
}

/// Maximum of the continuous transform between two frequencies, by golden section.
fn refined(weighted: &[f64], sampling_rate: f64, mut low: f64, mut high: f64) -> SpectralLine {
    let amplitude = |f: f64| transform_at(weighted, f / sampling_rate);
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    let (mut p, mut q) = (high - ratio * (high - low), low + ratio * (high - low));
    let (mut ap, mut aq) = (amplitude(p), amplitude(q));
    // 0.618^30 = 5e-7 of a quarter bin: the maximum is flat, more digits would be noise.
    for _ in 0..30 {
        if ap > aq {
            (high, q, aq) = (q, p, ap);
            p = high - ratio * (high - low);
            ap = amplitude(p);
        } else {
            (low, p, ap) = (p, q, aq);
            q = low + ratio * (high - low);
            aq = amplitude(q);
        }
    }
    SpectralLine {
        frequency_hz: 0.5 * (low + high),
        amplitude: ap.max(aq),
        superharmonic_of: None,
    }
}

/// `|sum_j x_j e^{-2 pi i j nu}|` at a frequency `nu` in cycles for each sample (Goertzel's sum by
/// rotation, restarted often enough that its round-off stays small).
fn transform_at(weighted: &[f64], nu: f64) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    let (sin, cos) = (TAU * nu).sin_cos();
    for (block, chunk) in weighted.chunks(256).enumerate() {
        let phase = TAU * (nu * (256 * block) as f64).fract();
        let (mut s, mut c) = phase.sin_cos();
        for x in chunk {
            re += x * c;
            im -= x * s;
            (c, s) = (c * cos - s * sin, s * cos + c * sin);
        }
    }
    re.hypot(im)
}

/// Marks every line that is an integer multiple of a lower one.
fn name_superharmonics(lines: &mut [SpectralLine], resolution: f64) {
    let mut by_frequency: Vec<usize> = (0..lines.len()).collect();
    by_frequency.sort_by(|i, j| lines[*i].frequency_hz.total_cmp(&lines[*j].frequency_hz));
    for (place, &q) in by_frequency.iter().enumerate() {
        let line = lines[q];
        let tolerance = (0.5 * resolution).max(2e-3 * line.frequency_hz);
        lines[q].superharmonic_of = by_frequency[..place].iter().find_map(|&p| {
            let fundamental = lines[p];
            let order = (line.frequency_hz / fundamental.frequency_hz).round();
            let miss = (line.frequency_hz - order * fundamental.frequency_hz).abs();
            // A fundamental of a few tolerances has a multiple near any frequency: no evidence.
            let telling = fundamental.frequency_hz > 10.0 * tolerance;
            (fundamental.superharmonic_of.is_none()
                && fundamental.amplitude >= FUNDAMENTAL_SHARE * line.amplitude
                && (2.0..=HIGHEST_ORDER as f64).contains(&order)
                && miss <= tolerance
                && telling)
                .then_some((p, order as usize))
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn main_frequency_of_a_short_record_is_sub_bin_accurate() {
        // 10 ms of a limit cycle at 2 us: the bin is 100 Hz, the target 0.1 % of 9.4 kHz.
        let rate = 5e5;
        for frequency in [9403.0, 9437.7, 9470.1, 10_651.3] {
            let x: Vec<f64> = (0..5000)
                .map(|j| {
                    let p = TAU * frequency * j as f64 / rate;
                    3.0 * p.sin() + 0.8 * (2.0 * p + 1.0).sin() + 0.4 * (3.0 * p).cos() + 11.0
                })
                .collect();
            let line = main_frequency(&x, rate).unwrap();
            assert!(
                (line.frequency_hz / frequency - 1.0).abs() < 1e-4,
                "{line:?}"
            );
            assert!((line.amplitude - 3.0).abs() < 0.01);
        }
    }

    #[test]
    fn superharmonics_are_named_and_a_strange_line_is_not() {
        let rate = 2e5;
        let x: Vec<f64> = (0..20_000)
            .map(|j| {
                let t = TAU * j as f64 / rate;
                (9437.0 * t).sin()
                    + 1.4 * (2.0 * 9437.0 * t).cos()
                    + 0.2 * (3.0 * 9437.0 * t).sin()
                    + 0.5 * (5856.0 * t).sin()
            })
            .collect();
        let lines = spectral_lines(&x, rate, 10).unwrap();
        assert_eq!(lines.len(), 4);
        // Strongest is the first superharmonic; its fundamental stands second.
        assert_eq!(lines[0].superharmonic_of, Some((1, 2)));
        assert_eq!(lines[1].superharmonic_of, None);
        assert_eq!(lines[2].superharmonic_of, None);
        assert!((lines[2].frequency_hz - 5856.0).abs() < 0.1);
        assert_eq!(lines[3].superharmonic_of, Some((1, 3)));
    }

    #[test]
    fn a_constant_signal_has_no_lines() {
        assert!(spectral_lines(&[0.1; 100], 1.0, 5).unwrap().is_empty());
        assert!(main_frequency(&[0.1; 100], 1.0).is_err());
    }
}
