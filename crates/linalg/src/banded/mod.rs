//! Banded matrices: storage, inertia by `L D L^H`, complex LU with partial pivoting, several complex systems at a time.

mod batch;
mod definite;
mod lu;

pub use batch::{BandedBatch, LANES, Lanes, Quality};
pub use definite::BandedFactor;
pub use lu::BandedLu;

use crate::dense::{column, column_mut};
use faer::{Mat, MatRef, c64};
use std::iter::Sum;
use std::ops::Mul;

/// `A x`, or `A^H x`, of a complex band with `h` off-diagonals on either side, laid out like [`BandedMatrix::values`].
pub fn multiply_band(values: &[c64], h: usize, x: &[c64], adjoint: bool) -> Vec<c64> {
    let n = x.len();
    let mut result = vec![c64::ZERO; n];
    for (row, band) in values.chunks_exact(2 * h + 1).enumerate() {
        let (first, last) = (row.saturating_sub(h), (row + h + 1).min(n));
        let band = &band[first + h - row..last + h - row]; // Row i begins at column i - h.
        if adjoint {
            for (value, sum) in band.iter().zip(&mut result[first..last]) {
                *sum += value.conj() * x[row]; // conj(a_ij) x_i goes to entry j.
            }
        } else {
            let products = band.iter().zip(&x[first..last]);
            result[row] = products.map(|(v, x)| v * x).sum();
        }
    }
    result
}

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
        Self { dimension, half_bandwidth, values: vec![0.0; dimension * (2 * half_bandwidth + 1)] }
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
        row * (2 * h + 1) + column + h - row // Column row - h comes first.
    }

    /// Entry `(row, column)`, zero outside the band.
    #[inline]
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
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let place = self.place(row, column);
        self.values[place] += value;
    }

    /// Columns of the band in row `row`.
    #[inline]
    pub fn columns(&self, row: usize) -> std::ops::Range<usize> {
        let h = self.half_bandwidth;
        row.saturating_sub(h)..(row + h + 1).min(self.dimension)
    }

    /// Stored values of row `row`, columns `row - h ..= row + h`.
    #[inline]
    pub fn row(&self, row: usize) -> &[f64] {
        let width = 2 * self.half_bandwidth + 1;
        &self.values[row * width..][..width]
    }

    /// Stored values of row `row`, to be changed; places outside the matrix must stay zero.
    #[inline]
    pub fn row_mut(&mut self, row: usize) -> &mut [f64] {
        let width = 2 * self.half_bandwidth + 1;
        &mut self.values[row * width..][..width]
    }

    /// Adds `factor * other`.
    ///
    /// # Panics
    /// If the shapes differ.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        assert_eq!((self.dimension, self.half_bandwidth), (other.dimension, other.half_bandwidth));
        for (sum, value) in self.values.iter_mut().zip(&other.values) {
            *sum += factor * value;
        }
    }

    /// Whether all entries vanish.
    pub fn is_zero(&self) -> bool {
        self.values.iter().all(|value| *value == 0.0)
    }

    /// The entries of `A x`, one after the other.
    fn images<T: Copy + Mul<f64, Output = T> + Sum>(&self, x: &[T]) -> impl Iterator<Item = T> {
        (0..self.dimension).map(move |row| {
            let columns = self.columns(row);
            let values = &self.row(row)[columns.start + self.half_bandwidth - row..];
            x[columns].iter().zip(values).map(|(x, value)| *x * *value).sum()
        })
    }

    /// `A x`.
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        self.images(x).collect()
    }

    /// `A X`.
    pub fn multiply_columns(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        let mut image = Mat::zeros(self.dimension, x.ncols());
        for j in 0..x.ncols() {
            let values = self.images(column(x, j));
            column_mut(&mut image, j).iter_mut().zip(values).for_each(|(sum, own)| *sum = own);
        }
        image
    }

    /// `y^H A x`.
    pub fn form(&self, y: &[c64], x: &[c64]) -> c64 {
        self.images(x).zip(y).map(|(image, y)| y.conj() * image).sum()
    }

    /// Adds `factor A x` to a sum.
    pub fn add_product(&self, factor: c64, x: &[c64], sum: &mut [c64]) {
        self.images(x).zip(sum).for_each(|(image, sum)| *sum += factor * image);
    }
}
