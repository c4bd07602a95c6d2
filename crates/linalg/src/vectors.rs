//! Sums over short complex vectors.

use crate::c64;

/// Zero.
pub const ZERO: c64 = c64::new(0.0, 0.0);

/// `y^H x`.
pub fn dot(y: &[c64], x: &[c64]) -> c64 {
    y.iter().zip(x).map(|(y, x)| y.conj() * x).sum()
}

/// `a^T x` in four fixed sums, which do not wait for one another.
pub fn product(a: &[c64], x: &[c64]) -> c64 {
    let mut sums = [ZERO; 4];
    let (a_chunks, x_chunks) = (a.chunks_exact(4), x.chunks_exact(4));
    let rest = a_chunks.remainder().iter().zip(x_chunks.remainder());
    let tail: c64 = rest.map(|(a, x)| a * x).sum();
    for (a, x) in a_chunks.zip(x_chunks) {
        for lane in 0..4 {
            sums[lane] += a[lane] * x[lane];
        }
    }
    sums.iter().sum::<c64>() + tail
}

/// Adds a vector to another.
pub fn add(sum: &mut [c64], term: &[c64]) {
    for (s, t) in sum.iter_mut().zip(term) {
        *s += t;
    }
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
