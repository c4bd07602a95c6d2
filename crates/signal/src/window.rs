//! Window functions.

use std::f64::consts::TAU;

/// Half the width of the main lobe of [`Window::BlackmanHarris`], in bins of an unpadded transform.
pub(crate) const HALF_LOBE: usize = 4;

/// Taper applied to a block of samples before its Fourier transform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Window {
    /// `w_j = (1 - cos(2 pi j / N)) / 2`: sidelobes -31 dB, 18 dB per octave.
    Hann,
    /// Four-term Blackman-Harris: sidelobes below -92 dB, main lobe twice as wide as Hann's.
    BlackmanHarris,
}

impl Window {
    /// The `length` coefficients of the periodic window (period `length`).
    ///
    /// Source: F. J. Harris, "On the use of windows for harmonic analysis with the discrete Fourier
    /// transform", Proc. IEEE 66 (1978).
    pub fn coefficients(self, length: usize) -> Vec<f64> {
        let a: &[f64] = match self {
            Window::Hann => &[0.5, -0.5],
            Window::BlackmanHarris => &[0.35875, -0.48829, 0.14128, -0.01168],
        };
        (0..length)
            .map(|j| {
                let x = TAU * j as f64 / length as f64;
                a.iter().enumerate().map(|(m, c)| c * (m as f64 * x).cos()).sum()
            })
            .collect()
    }
}
