//! The nonzero entries of a banded matrix alone.

use super::BandedMatrix;
use crate::dense::{column, column_mut};
use faer::{Mat, c64};
use std::iter::Sum;
use std::ops::Mul;

/// A banded matrix by its nonzero entries, for products where most of the band is empty.
#[derive(Clone, Debug)]
pub struct CompactRows {
    /// Where each row starts in the other two.
    starts: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
}

impl CompactRows {
    /// The nonzero entries of `matrix`.
    pub fn new(matrix: &BandedMatrix) -> Self {
        let (mut starts, mut columns, mut values) = (vec![0], Vec::new(), Vec::new());
        for i in 0..matrix.dimension() {
            let h = matrix.half_bandwidth();
            for (k, &value) in matrix.row(i).iter().enumerate() {
                if value != 0.0 {
                    columns.push(i + k - h); // Entry k of a row of the band stands in column i - h + k.
                    values.push(value);
                }
            }
            starts.push(values.len());
        }
        Self { starts, columns, values }
    }

    /// The entries of `A x`, one after the other.
    fn images<T>(&self, x: &[T]) -> impl Iterator<Item = T>
    where
        T: Copy + Mul<f64, Output = T> + Sum,
    {
        let rows = self.starts.windows(2).map(|ends| ends[0]..ends[1]);
        rows.map(|row| {
            let entries = self.columns[row.clone()].iter().zip(&self.values[row]);
            entries.map(|(&column, value)| x[column] * *value).sum()
        })
    }

    /// `A x`.
    ///
    /// # Panics
    /// If `x` is shorter than the matrix.
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        self.images(x).collect()
    }

    /// `y^H A x`.
    ///
    /// # Panics
    /// If a vector is shorter than the matrix.
    pub fn form(&self, y: &[c64], x: &[c64]) -> c64 {
        self.images(x).zip(y).map(|(image, y)| y.conj() * image).sum()
    }

    /// Adds `factor A x` to a sum.
    ///
    /// # Panics
    /// If `x` is shorter than the matrix.
    pub fn add_product(&self, factor: c64, x: &[c64], sum: &mut [c64]) {
        self.images(x).zip(sum).for_each(|(image, sum)| *sum += factor * image);
    }

    /// `A X`.
    ///
    /// # Panics
    /// If the shapes do not fit.
    pub fn multiply_columns(&self, x: &Mat<f64>) -> Mat<f64> {
        let mut image = Mat::zeros(self.starts.len() - 1, x.ncols());
        for j in 0..x.ncols() {
            column_mut(&mut image, j).copy_from_slice(&self.multiply(column(x.as_ref(), j)));
        }
        image
    }
}
