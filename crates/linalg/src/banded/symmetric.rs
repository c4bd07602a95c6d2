//! Cholesky factorization of Hermitian banded matrices.

use faer::c64;

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
