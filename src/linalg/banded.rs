//! Banded matrices: storage, inertia by `L D L^T`, complex LU with partial pivoting.

use faer::c64;

/// A real square matrix whose entries vanish beyond a fixed distance from the diagonal.
#[derive(Clone, Debug, PartialEq)]
pub struct BandedMatrix {
    dimension: usize,
    half_bandwidth: usize,
    /// Row by row, columns `i - h ..= i + h`, places outside the matrix zero.
    values: Vec<f64>,
}

impl BandedMatrix {
    /// The zero matrix with `half_bandwidth` off-diagonals on either side.
    pub fn zeros(dimension: usize, half_bandwidth: usize) -> Self {
        Self {
            dimension,
            half_bandwidth,
            values: vec![0.0; dimension * (2 * half_bandwidth + 1)],
        }
    }

    /// Number of rows and of columns.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Off-diagonals on either side.
    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// All stored values, row by row, `2 h + 1` for each.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Index into [`Self::values`].
    ///
    /// # Panics
    /// If `(row, column)` lies outside the band.
    fn place(&self, row: usize, column: usize) -> usize {
        let h = self.half_bandwidth;
        assert!(column + h >= row && column <= row + h && column.max(row) < self.dimension);
        row * (2 * h + 1) + column + h - row
    }

    /// Entry `(row, column)`, zero outside the band.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        if row.abs_diff(column) > self.half_bandwidth {
            return 0.0;
        }
        self.values[self.place(row, column)]
    }

    /// Adds to an entry.
    ///
    /// # Panics
    /// If `(row, column)` lies outside the band.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let place = self.place(row, column);
        self.values[place] += value;
    }

    /// Columns of the band in row `row`.
    pub fn columns(&self, row: usize) -> std::ops::Range<usize> {
        let h = self.half_bandwidth;
        row.saturating_sub(h)..(row + h + 1).min(self.dimension)
    }

    /// Stored values of row `row`, columns `row - h ..= row + h`.
    pub fn row(&self, row: usize) -> &[f64] {
        let width = 2 * self.half_bandwidth + 1;
        &self.values[row * width..][..width]
    }

    /// Stored values of row `row`, to be changed; places outside the matrix must stay zero.
    pub fn row_mut(&mut self, row: usize) -> &mut [f64] {
        let width = 2 * self.half_bandwidth + 1;
        &mut self.values[row * width..][..width]
    }

    /// Adds `factor * other`.
    ///
    /// # Panics
    /// If the shapes differ.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        assert_eq!(
            (self.dimension, self.half_bandwidth),
            (other.dimension, other.half_bandwidth)
        );
        for (sum, value) in self.values.iter_mut().zip(&other.values) {
            *sum += factor * value;
        }
    }

    /// Multiplies every entry.
    pub fn scale(&mut self, factor: f64) {
        self.values.iter_mut().for_each(|value| *value *= factor);
    }

    /// Rows and columns `kept` (ascending) alone.
    pub fn restricted_to(&self, kept: &[usize]) -> Self {
        let mut result = Self::zeros(kept.len(), self.half_bandwidth);
        for (row, &old_row) in kept.iter().enumerate() {
            for column in result.columns(row) {
                let value = self.get(old_row, kept[column]);
                let place = result.place(row, column);
                result.values[place] = value;
            }
        }
        result
    }

    /// `A x`.
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        (0..self.dimension)
            .map(|row| {
                self.columns(row)
                    .map(|column| self.values[self.place(row, column)] * x[column])
                    .sum()
            })
            .collect()
    }
}

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
            self.diagonal[i] = if pivot == 0.0 {
                f64::MIN_POSITIVE
            } else {
                pivot
            };
        }
    }

    /// Number of negative eigenvalues.
    pub fn negative_count(&self) -> usize {
        self.diagonal.iter().filter(|d| **d < 0.0).count()
    }

    /// Whether no pivot overflowed.
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
            let known: c64 = row[first + h - i..h]
                .iter()
                .zip(&x[first..i])
                .map(|(l, x)| l * x)
                .sum();
            x[i] = (x[i] - known) * (1.0 / row[h].re);
        }
        x
    }
}

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
        let zero = c64::new(0.0, 0.0);
        Self {
            dimension,
            half_bandwidth,
            upper: vec![zero; dimension * (3 * half_bandwidth + 1)],
            lower: vec![zero; dimension * half_bandwidth],
            pivots: vec![0; dimension],
        }
    }

    /// Factorizes the matrix whose band has `values`, laid out like [`BandedMatrix::values`].
    ///
    /// An exactly singular pivot is replaced by a tiny one: a shift that is an eigenvalue to the last bit
    /// is welcome in inverse iteration.
    pub fn factorize(&mut self, values: &[c64]) {
        let (n, h) = (self.dimension, self.half_bandwidth);
        let (width, stored) = (3 * h + 1, 2 * h + 1);
        let zero = c64::new(0.0, 0.0);
        for (row, band) in self
            .upper
            .chunks_exact_mut(width)
            .zip(values.chunks_exact(stored))
        {
            row[..stored].copy_from_slice(band);
            row[stored..].fill(zero);
        }
        let largest = values
            .iter()
            .fold(0.0_f64, |m, v| m.max(v.re.abs()).max(v.im.abs()));
        for k in 0..n {
            let last = (k + h).min(n - 1);
            let size = |i: usize| {
                let v = self.upper[i * width + k + h - i];
                v.re.abs() + v.im.abs()
            };
            let mut pivot = k;
            for i in k + 1..=last {
                if size(i) > size(pivot) {
                    pivot = i;
                }
            }
            self.pivots[k] = pivot;
            let columns = (k + 2 * h).min(n - 1) - k + 1;
            let (top, below) = self.upper.split_at_mut((k + 1) * width);
            let top = &mut top[k * width + h..][..columns];
            if pivot != k {
                let start = (pivot - k - 1) * width + k + h - pivot;
                top.swap_with_slice(&mut below[start..start + columns]);
            }
            if top[0] == zero {
                top[0] = c64::new(f64::EPSILON * largest, 0.0);
            }
            let inverse = c64::new(1.0, 0.0) / top[0];
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
            x.swap(k, self.pivots[k]);
            let value = x[k];
            let factors = &self.lower[k * h..(k + 1) * h];
            for (unknown, factor) in x[k + 1..].iter_mut().zip(factors) {
                *unknown -= factor * value;
            }
        }
        for k in (0..n).rev() {
            let columns = (k + 2 * h).min(n - 1) - k + 1;
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
            let columns = (k + 2 * h).min(n - 1) - k + 1;
            let row = &self.upper[k * width + h..][..columns];
            let value = x[k] * row[0].conj();
            x[k] = value;
            for (entry, unknown) in row[1..].iter().zip(&mut x[k + 1..]) {
                *unknown -= entry.conj() * value;
            }
        }
        for k in (0..n).rev() {
            let factors = &self.lower[k * h..(k + 1) * h];
            let mut sum = x[k];
            for (known, factor) in x[k + 1..].iter().zip(factors) {
                sum -= factor.conj() * known;
            }
            x[k] = sum;
            x.swap(k, self.pivots[k]);
        }
    }

    /// Argument of the determinant, rad, up to multiples of `2 pi`.
    pub fn determinant_argument(&self) -> f64 {
        let width = 3 * self.half_bandwidth + 1;
        // Unit phasors multiply without overflow.
        let mut phase = c64::new(1.0, 0.0);
        for k in 0..self.dimension {
            let inverse = self.upper[k * width + self.half_bandwidth];
            let sign = if self.pivots[k] == k { 1.0 } else { -1.0 };
            phase *= inverse.conj() * (sign / inverse.norm());
        }
        phase.arg()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Deterministic, far from symmetric, needs pivoting.
    fn example(n: usize, h: usize) -> (Vec<c64>, Vec<Vec<c64>>) {
        let mut band = vec![c64::new(0.0, 0.0); n * (2 * h + 1)];
        let mut dense = vec![vec![c64::new(0.0, 0.0); n]; n];
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
        let argument = matrix.determinant().arg();
        let turns = (lu.determinant_argument() - argument) / std::f64::consts::TAU;
        assert!((turns - turns.round()).abs() < 1e-10);
    }

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
