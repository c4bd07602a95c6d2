//! LU factorization of complex banded matrices.

use crate::interruption;
use faer::c64;

/// LU factorization with partial pivoting of a complex banded matrix.
#[derive(Clone, Debug)]
pub struct BandedLu {
    dimension: usize,
    half_bandwidth: usize,
    /// Row `i`: columns `i - h ..= i + 2 h` while factorizing, `i ..= i + 2 h` of `U` after.
    upper: Vec<c64>,
    /// `h` multipliers of each column.
    lower: Vec<c64>,
    pivots: Vec<usize>,
}

impl BandedLu {
    /// Space for a factorization.
    pub fn new(dimension: usize, half_bandwidth: usize) -> Self {
        Self {
            dimension,
            half_bandwidth,
            upper: vec![c64::ZERO; dimension * (3 * half_bandwidth + 1)],
            lower: vec![c64::ZERO; dimension * half_bandwidth],
            pivots: vec![0; dimension],
        }
    }

    /// Factorizes the matrix whose band has `values`, laid out like [`super::BandedMatrix::values`].
    ///
    /// An exactly singular pivot is replaced by a tiny one: a shift that is an eigenvalue to the last bit is welcome in inverse iteration.
    pub fn factorize(&mut self, values: &[c64]) {
        interruption::check();
        let (n, h) = (self.dimension, self.half_bandwidth);
        let (width, stored) = (3 * h + 1, 2 * h + 1);
        // Rows with space for what exchanges of rows fill in: twice the bandwidth on the right.
        for (row, band) in self.upper.chunks_exact_mut(width).zip(values.chunks_exact(stored)) {
            row[..stored].copy_from_slice(band);
            row[stored..].fill(c64::ZERO);
        }
        let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.re.abs()).max(v.im.abs()));
        let mut reach = 0; // The last column of the rows so far.
        for k in 0..n {
            let last = (k + h).min(n - 1);
            let size = |i: usize| {
                let v = self.upper[i * width + k + h - i];
                v.re.abs() + v.im.abs()
            };
            let mut pivot = k; // Partial pivoting among the h rows below.
            for i in k + 1..=last {
                if size(i) > size(pivot) {
                    pivot = i;
                }
            }
            self.pivots[k] = pivot;
            reach = reach.max((pivot + h).min(n - 1));
            let columns = reach - k + 1;
            let (top, below) = self.upper.split_at_mut((k + 1) * width);
            let top = &mut top[k * width + h..][..columns];
            if pivot != k {
                let start = (pivot - k - 1) * width + k + h - pivot;
                top.swap_with_slice(&mut below[start..start + columns]);
            }
            if top[0] == c64::ZERO {
                top[0] = c64::new(f64::EPSILON * largest, 0.0);
            }
            let inverse = c64::ONE / top[0]; // Below the pivot: row_i -= (a_ik / a_kk) row_k.
            for i in k + 1..=last {
                let start = (i - k - 1) * width + k + h - i;
                let row = &mut below[start..start + columns];
                let factor = row[0] * inverse;
                self.lower[k * h + i - k - 1] = factor;
                for (value, above) in row[1..].iter_mut().zip(&top[1..]) {
                    *value -= factor * above;
                }
            }
            // Solves multiply by the reciprocal.
            top[0] = inverse;
        }
    }

    /// Solves `A x = b` in place.
    pub fn solve(&self, x: &mut [c64]) {
        let (n, h) = (self.dimension, self.half_bandwidth);
        let width = 3 * h + 1;
        for k in 0..n {
            x.swap(k, self.pivots[k]); // L y = P b, one exchange after the other.
            let value = x[k];
            let factors = &self.lower[k * h..(k + 1) * h];
            for (unknown, factor) in x[k + 1..].iter_mut().zip(factors) {
                *unknown -= factor * value;
            }
        }
        for k in (0..n).rev() {
            let columns = (k + 2 * h).min(n - 1) - k + 1; // U x = y; the diagonal of U is inverted.
            let row = &self.upper[k * width + h..][..columns];
            let mut sum = x[k];
            for (value, known) in row[1..].iter().zip(&x[k + 1..]) {
                sum -= value * known;
            }
            x[k] = sum * row[0];
        }
    }

    /// Solves `A^H x = b` in place.
    pub fn solve_adjoint(&self, x: &mut [c64]) {
        let (n, h) = (self.dimension, self.half_bandwidth);
        let width = 3 * h + 1;
        for k in 0..n {
            let columns = (k + 2 * h).min(n - 1) - k + 1; // U^H y = b, by columns of U^H.
            let row = &self.upper[k * width + h..][..columns];
            let value = x[k] * row[0].conj();
            x[k] = value;
            for (entry, unknown) in row[1..].iter().zip(&mut x[k + 1..]) {
                *unknown -= entry.conj() * value;
            }
        }
        for k in (0..n).rev() {
            let factors = &self.lower[k * h..(k + 1) * h]; // L^H P x = y, from the last exchange back.
            let mut sum = x[k];
            for (known, factor) in x[k + 1..].iter().zip(factors) {
                sum -= factor.conj() * known;
            }
            x[k] = sum;
            x.swap(k, self.pivots[k]);
        }
    }

    /// `ln det A`, up to multiples of `2 pi i`.
    pub fn ln_determinant(&self) -> c64 {
        let width = 3 * self.half_bandwidth + 1;
        // Unit phasors multiply without overflow.
        let (mut size, mut phase) = (0.0, c64::ONE);
        for k in 0..self.dimension {
            let inverse = self.upper[k * width + self.half_bandwidth];
            let sign = if self.pivots[k] == k { 1.0 } else { -1.0 }; // Each exchange turns the sign.
            size -= inverse.norm().ln();
            phase *= inverse.conj() * (sign / inverse.norm());
        }
        c64::new(size, phase.arg())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Deterministic, far from symmetric, needs pivoting.
    fn example(n: usize, h: usize) -> (Vec<c64>, Vec<Vec<c64>>) {
        let mut band = vec![c64::ZERO; n * (2 * h + 1)];
        let mut dense = vec![vec![c64::ZERO; n]; n];
        let mut state = 1.0_f64;
        for i in 0..n {
            for j in i.saturating_sub(h)..=(i + h).min(n - 1) {
                state = (state * 997.13).fract() + 0.01;
                let other = (state * 31.7).fract();
                let diagonal = if i == j { 1e-9 } else { 1.0 };
                dense[i][j] = c64::new(state - 0.5, other - 0.5) * diagonal;
                band[i * (2 * h + 1) + j + h - i] = dense[i][j];
            }
        }
        (band, dense)
    }

    #[test]
    fn lu_with_pivoting_solves_direct_and_adjoint_systems() {
        let (n, h) = (23, 3);
        let (band, dense) = example(n, h);
        let mut lu = BandedLu::new(n, h);
        lu.factorize(&band);
        let b: Vec<c64> = (0..n).map(|i| c64::new(1.0, i as f64)).collect();
        let (mut x, mut y) = (b.clone(), b.clone());
        lu.solve(&mut x);
        lu.solve_adjoint(&mut y);
        for i in 0..n {
            let direct: c64 = (0..n).map(|j| dense[i][j] * x[j]).sum();
            let adjoint: c64 = (0..n).map(|j| dense[j][i].conj() * y[j]).sum();
            // Growth and condition of this matrix stay below 1e4.
            assert!((direct - b[i]).norm() < 1e-9 && (adjoint - b[i]).norm() < 1e-9);
        }
        let matrix = faer::Mat::from_fn(n, n, |i, j| dense[i][j]);
        let difference = lu.ln_determinant() - matrix.determinant().ln();
        let turns = difference.im / std::f64::consts::TAU;
        assert!(difference.re.abs() < 1e-10 && (turns - turns.round()).abs() < 1e-10);
    }
}
