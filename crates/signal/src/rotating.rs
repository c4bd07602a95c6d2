//! Lines of a complex series, each with the sense in which it turns.

use super::spectrum::{signed_bin, top_of};
use super::{Window, window::HALF_LOBE};
use crate::forward_transform;
use faer::c64;

/// Fewest samples that lines are read from.
const FEWEST: usize = 64;

/// One line of the spectrum of a complex series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotatingLine {
    /// Frequency, Hz, located between the bins; negative for a line that turns the other way.
    pub frequency_hz: f64,
    /// Modulus, unit of the series.
    pub amplitude: f64,
}

/// The lines of a complex series `z(t) = sum_k A_k e^{2 pi i f_k t}` that are not weaker than `weakest`, strongest
/// first.
///
/// Blackman-Harris window over the whole series: lines nearer than four bins to each other count as one, lines nearer
/// than four bins to zero as drift of the mean. The place between the bins is that of a parabola through the logarithms
/// of three. No noise is told from a line: `weakest` has to be above it.
pub fn rotating_lines(series: &[c64], sampling_rate: f64, weakest: f64) -> Vec<RotatingLine> {
    let count = series.len();
    if count < FEWEST {
        return Vec::new();
    }
    let taper = Window::BlackmanHarris.coefficients(count);
    let sum: f64 = taper.iter().sum();
    let mean = series.iter().sum::<c64>() / count as f64;
    let weighted = series.iter().zip(&taper);
    let mut spectrum: Vec<c64> = weighted.map(|(z, w)| (z - mean) * (w / sum)).collect();
    forward_transform(count).process(&mut spectrum);
    let size: Vec<f64> = spectrum.iter().map(|z| z.norm()).collect();

    // A peak is the largest value of a whole lobe to either side; the spectrum closes on itself.
    let around = |bin: usize, offset: isize| {
        size[(bin as isize + offset).rem_euclid(count as isize) as usize]
    };
    let is_peak = |&bin: &usize| {
        let mut lobe = (1..=HALF_LOBE as isize).flat_map(|k| [-k, k]);
        size[bin] >= weakest && size[bin] > 0.0 && lobe.all(|k| around(bin, k) < size[bin])
    };
    let mut lines: Vec<RotatingLine> = (HALF_LOBE..=count - HALF_LOBE)
        .filter(is_peak)
        .map(|bin| {
            let (offset, amplitude) = top_of([-1, 0, 1].map(|k| around(bin, k)));
            let place = signed_bin(bin, count) + offset;
            RotatingLine { frequency_hz: place * sampling_rate / count as f64, amplitude }
        })
        .collect();
    lines.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::sampled;
    use std::f64::consts::TAU;

    #[test]
    fn lines_of_a_complex_series_have_frequency_sense_and_amplitude() {
        let rate = 5e5;
        let turning = |f: f64, a: f64, t: f64| c64::from_polar(a, TAU * f * t + 0.4);
        let series = sampled(5000, rate, |t| {
            c64::new(3.0, 1.0) + turning(-10_343.9, 1.0, t) + turning(9533.2, 0.4, t)
        });
        let lines = rotating_lines(&series, rate, 1e-3);
        assert_eq!(lines.len(), 2, "{lines:?}");
        // A bin is 100 Hz; the parabola leaves a fiftieth of it, and 1 % of the amplitude.
        for (line, (f, a)) in lines.iter().zip([(-10_343.9, 1.0), (9533.2, 0.4)]) {
            assert!((line.frequency_hz - f).abs() < 2.0, "{line:?}");
            assert!((line.amplitude / a - 1.0).abs() < 0.01, "{line:?}");
        }
        assert!(rotating_lines(&series[..10], rate, 1e-3).is_empty());
        assert!(rotating_lines(&[c64::new(0.0, 0.0); 100], rate, 0.0).is_empty());
    }
}
