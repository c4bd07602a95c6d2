//! Plans of the discrete Fourier transform `X_k = sum_j x_j exp(-2 pi i j k / n)` and of its
//! inverse, neither with a factor.
//!
//! The transforms of every length are compiled here once, not in each crate that takes one.

use rustfft::FftPlanner;
use std::sync::Arc;

pub use rustfft::Fft;

/// The transform of `length` complex values, with `exp(-2 pi i j k / n)`.
#[inline(never)]
pub fn forward_transform(length: usize) -> Arc<dyn Fft<f64>> {
    FftPlanner::new().plan_fft_forward(length)
}

/// The transform of `length` complex values with `exp(2 pi i j k / n)`; no division by `n`.
#[inline(never)]
pub fn inverse_transform(length: usize) -> Arc<dyn Fft<f64>> {
    FftPlanner::new().plan_fft_inverse(length)
}
