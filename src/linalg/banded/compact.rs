//! The nonzero entries of a banded matrix alone.

use super::BandedMatrix;
use crate::linalg::dense::{column, column_mut};
use faer::Mat;

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
                    columns.push(i + k - h);
                    values.push(value);
                }
            }
            starts.push(values.len());
        }
        Self {
            starts,
            columns,
            values,
        }
    }

    /// `A x`.
    ///
    /// # Panics
    /// If `x` is shorter than the matrix.
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        let rows = self.starts.windows(2).map(|ends| ends[0]..ends[1]);
        rows.map(|row| {
            let entries = self.columns[row.clone()].iter().zip(&self.values[row]);
            entries.map(|(&column, value)| value * x[column]).sum()
        })
        .collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_the_nonzero_entries_are_those_of_the_band() {
        let (n, h) = (19, 5);
        let mut matrix = BandedMatrix::zeros(n, h);
        for i in 0..n {
            for j in matrix.columns(i).filter(|j| (i + 2 * j) % 3 != 0) {
                matrix.add(i, j, ((7 * i + j) as f64).sin());
            }
        }
        let compact = CompactRows::new(&matrix);
        let x = Mat::from_fn(n, 3, |i, j| ((i + 5 * j) as f64).cos());
        let images = compact.multiply_columns(&x);
        for j in 0..3 {
            let expected = matrix.multiply(column(x.as_ref(), j));
            // Sums of eleven terms of at most one each.
            let pairs = expected.iter().zip(column(images.as_ref(), j));
            assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-14));
        }
    }
}
