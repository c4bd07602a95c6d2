//! Factorizations of symmetric and Hermitian banded matrices.

use super::BandedMatrix;
use crate::interruption;
use faer::c64;

/// `L D L^T` factorization without pivoting of a symmetric banded matrix `A - shift B`.
///
/// The signs of `D` are those of the eigenvalues (Sylvester's law of inertia). Without pivoting the
/// factorization of an indefinite matrix can lose accuracy near a singular leading block; counts are
/// therefore to be confirmed by eigenpairs where they matter.
#[derive(Clone, Debug)]
pub struct BandedLdl {
    dimension: usize,
    half_bandwidth: usize,
    /// Unit lower factor, row by row: columns `i - h .. i`.
    lower: Vec<f64>,
    diagonal: Vec<f64>,
}

impl BandedLdl {
    /// Factorizes `a - shift b`; only lower triangles are read.
    ///
    /// # Panics
    /// If the shapes differ.
    #[inline]
    pub fn new(a: &BandedMatrix, b: &BandedMatrix, shift: f64) -> Self {
        let mut factor = Self {
            dimension: a.dimension,
            half_bandwidth: a.half_bandwidth,
            lower: vec![0.0; a.dimension * a.half_bandwidth],
            diagonal: vec![0.0; a.dimension],
        };
        factor.refactorize(a, b, shift);
        factor
    }

    /// Factorizes another matrix of the same shape in place.
    ///
    /// # Panics
    /// If the shapes differ.
    pub fn refactorize(&mut self, a: &BandedMatrix, b: &BandedMatrix, shift: f64) {
        interruption::check();
        let (n, h) = (self.dimension, self.half_bandwidth);
        assert_eq!((a.dimension, a.half_bandwidth), (n, h));
        assert_eq!((b.dimension, b.half_bandwidth), (n, h));
        let width = 2 * h + 1;
        for i in 0..n {
            let first = i.saturating_sub(h);
            let (done, rest) = self.lower.split_at_mut(i * h);
            let row = &mut rest[..h];
            let offset = i * width;
            let mut pivot = a.values[offset + h] - shift * b.values[offset + h];
            // Left-looking: row[k] first holds l_ij d_j, then l_ij.
            for j in first..i {
                let k = j + h - i;
                let mut sum = a.values[offset + k] - shift * b.values[offset + k];
                let other = &done[j * h..(j + 1) * h];
                for m in first.max(j.saturating_sub(h))..j {
                    sum -= row[m + h - i] * other[m + h - j];
                }
                row[k] = sum;
            }
            for j in first..i {
                let k = j + h - i;
                let scaled = row[k] / self.diagonal[j];
                pivot -= row[k] * scaled;
                row[k] = scaled;
            }
            // A zero pivot is one rounding error away from either sign.
            self.diagonal[i] = if pivot == 0.0 { f64::MIN_POSITIVE } else { pivot };
        }
    }

    /// Number of negative eigenvalues.
    #[inline]
    pub fn negative_count(&self) -> usize {
        self.diagonal.iter().filter(|d| **d < 0.0).count()
    }

    /// Whether no pivot overflowed.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.diagonal.iter().all(|d| d.is_finite())
    }

    /// Solves in place.
    pub fn solve(&self, x: &mut [f64]) {
        let (n, h) = (self.dimension, self.half_bandwidth);
        for i in 0..n {
            for j in i.saturating_sub(h)..i {
                x[i] -= self.lower[i * h + j + h - i] * x[j];
            }
        }
        for (value, d) in x.iter_mut().zip(&self.diagonal) {
            *value /= d;
        }
        for i in (0..n).rev() {
            for j in i.saturating_sub(h)..i {
                x[j] -= self.lower[i * h + j + h - i] * x[i];
            }
        }
    }
}

/// A Hermitian banded matrix, or its lower Cholesky factor.
#[derive(Clone, Debug)]
pub struct BandedHermitian {
    dimension: usize,
    half_bandwidth: usize,
    /// Lower triangle row by row, columns `i - h ..= i`.
    lower: Vec<c64>,
}

impl BandedHermitian {
    /// The zero matrix.
    #[inline]
    pub fn zeros(dimension: usize, half_bandwidth: usize) -> Self {
        Self {
            dimension,
            half_bandwidth,
            lower: vec![c64::new(0.0, 0.0); dimension * (half_bandwidth + 1)],
        }
    }

    /// Adds to an entry of the lower triangle.
    ///
    /// # Panics
    /// If `(row, column)` lies outside the lower band.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: c64) {
        let h = self.half_bandwidth;
        assert!(column <= row && column + h >= row);
        self.lower[row * (h + 1) + column + h - row] += value;
    }

    /// Lower Cholesky factor `L`, `A = L L^H`; `None` unless the matrix is positive definite.
    pub fn cholesky(mut self) -> Option<Self> {
        let h = self.half_bandwidth;
        let width = h + 1;
        for i in 0..self.dimension {
            let first = i.saturating_sub(h);
            let (done, rest) = self.lower.split_at_mut(i * width);
            let row = &mut rest[..width];
            for j in first..i {
                let other = &done[j * width..(j + 1) * width];
                let mut sum = row[j + h - i];
                for m in first.max(j.saturating_sub(h))..j {
                    sum -= row[m + h - i] * other[m + h - j].conj();
                }
                row[j + h - i] = sum * (1.0 / other[h].re);
            }
            let pivot = row[h].re - row[..h].iter().map(|v| v.norm_sqr()).sum::<f64>();
            if pivot.is_nan() || pivot <= 0.0 {
                return None;
            }
            row[h] = c64::new(pivot.sqrt(), 0.0);
        }
        Some(self)
    }

    /// `L^-1 b` where this is the factor `L`.
    pub fn half_solve(&self, b: &[c64]) -> Vec<c64> {
        let h = self.half_bandwidth;
        let mut x = b.to_vec();
        for i in 0..self.dimension {
            let first = i.saturating_sub(h);
            let row = &self.lower[i * (h + 1)..(i + 1) * (h + 1)];
            let known: c64 =
                row[first + h - i..h].iter().zip(&x[first..i]).map(|(l, x)| l * x).sum();
            x[i] = (x[i] - known) * (1.0 / row[h].re);
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inertia_counts_the_eigenvalues_below_a_shift() {
        // Second differences: eigenvalues 2 - 2 cos(k pi / (n + 1)).
        let n = 40;
        let (mut a, mut b) = (BandedMatrix::zeros(n, 2), BandedMatrix::zeros(n, 2));
        for i in 0..n {
            a.add(i, i, 2.0);
            b.add(i, i, 1.0);
            if i > 0 {
                a.add(i, i - 1, -1.0);
                a.add(i - 1, i, -1.0);
            }
        }
        for shift in [0.001, 0.3, 1.7, 3.99] {
            let exact = (1..=n)
                .map(|k| 2.0 - 2.0 * (k as f64 * std::f64::consts::PI / (n as f64 + 1.0)).cos())
                .filter(|value| *value < shift)
                .count();
            let factor = BandedLdl::new(&a, &b, shift);
            assert_eq!(factor.negative_count(), exact);
            let x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
            let mut right = a.multiply(&x);
            for (r, v) in right.iter_mut().zip(&x) {
                *r -= shift * v;
            }
            factor.solve(&mut right);
            assert!(right.iter().zip(&x).all(|(r, v)| (r - v).abs() < 1e-9));
        }
    }
}
