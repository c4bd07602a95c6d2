//! Sums over long vectors.

pub use crate::linalg::dense::{dot, norm};

/// `a - b`.
pub fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// `a += factor b`.
pub fn add(a: &mut [f64], factor: f64, b: &[f64]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += factor * b);
}

/// Takes the shares of the orthonormal `basis` out of `vector`, twice, and gives them.
pub fn orthogonalize(vector: &mut [f64], basis: &[Vec<f64>]) -> Vec<f64> {
    let mut shares = vec![0.0; basis.len()];
    for _ in 0..2 {
        for (unit, share) in basis.iter().zip(&mut shares) {
            let part = dot(unit, vector);
            *share += part;
            add(vector, -part, unit);
        }
    }
    shares
}
