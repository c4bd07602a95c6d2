//! Sparse Cholesky factorization.

use super::{LinalgError, interruption};
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};
use faer::{MatMut, Side};

/// Factors `P^T L L^T P` of a symmetric positive definite matrix.
#[derive(Clone, Debug)]
pub struct SparseCholesky {
    factor: Llt<usize, f64>,
}

impl SparseCholesky {
    /// Factorizes the matrix with these `(row, column, value)`, repeated places summed; the lower triangle is read.
    ///
    /// # Errors
    /// [`LinalgError::Factorization`] if the matrix is not positive definite, or a place lies outside it.
    pub fn factorize(
        dimension: usize,
        entries: impl Iterator<Item = (usize, usize, f64)>,
    ) -> Result<Self, LinalgError> {
        interruption::check();
        let triplets: Vec<_> =
            entries.map(|(row, column, value)| Triplet::new(row, column, value)).collect();
        let matrix = SparseColMat::try_new_from_triplets(dimension, dimension, &triplets)
            .map_err(|error| LinalgError::factorization(dimension, error))?;
        let factor = matrix.sp_cholesky(Side::Lower);
        let factor = factor.map_err(|error| LinalgError::factorization(dimension, error))?;
        Ok(Self { factor })
    }

    /// Solves `A x = b` for each column of `right_sides`, in place.
    #[inline]
    pub fn solve_in_place(&self, right_sides: MatMut<'_, f64>) {
        self.factor.solve_in_place(right_sides);
    }

    /// Solves `A x = b`.
    pub fn solve(&self, mut right_side: Vec<f64>) -> Vec<f64> {
        let count = right_side.len();
        self.solve_in_place(MatMut::from_column_major_slice_mut(&mut right_side, count, 1));
        right_side
    }
}
