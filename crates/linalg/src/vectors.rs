//! Sums over short complex vectors.

pub use crate::dense::dot;

use crate::c64;
use crate::dense::product_sum;

/// `a^T x`.
pub fn product(a: &[c64], x: &[c64]) -> c64 {
    product_sum(a, x, |a, x| a * x) // Nothing is conjugated.
}

/// Largest modulus.
pub fn largest(x: &[c64]) -> f64 {
    x.iter().fold(0.0, |m, v| v.norm().max(m))
}

/// Euclidean length.
pub fn length(x: &[c64]) -> f64 {
    x.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt()
}

/// Scales to unit Euclidean length; returns the length before.
pub fn normalize(x: &mut [c64]) -> f64 {
    let norm = length(x);
    x.iter_mut().for_each(|v| *v *= 1.0 / norm);
    norm
}
