//! Sparse Cholesky factorization.

use super::LinalgError;
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
        let failure = |reason: String| LinalgError::Factorization { dimension, reason };
        let triplets: Vec<_> = entries
            .map(|(row, column, value)| Triplet::new(row, column, value))
            .collect();
        let matrix = SparseColMat::try_new_from_triplets(dimension, dimension, &triplets)
            .map_err(|error| failure(format!("{error:?}")))?;
        let factor = matrix
            .sp_cholesky(Side::Lower)
            .map_err(|error| failure(format!("{error:?}")))?;
        Ok(Self { factor })
    }

    /// Solves `A x = b` for each column of `right_sides`, in place.
    pub fn solve_in_place(&self, right_sides: MatMut<'_, f64>) {
        self.factor.solve_in_place(right_sides);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_places_are_summed_and_an_indefinite_matrix_is_refused() {
        let entries = [(0, 0, 2.0), (0, 0, 2.0), (1, 0, 1.0), (1, 1, 3.0)];
        let factors = SparseCholesky::factorize(2, entries.into_iter()).unwrap();
        let mut x = [6.0, 7.0];
        factors.solve_in_place(MatMut::from_column_major_slice_mut(&mut x, 2, 1));
        // [[4, 1], [1, 3]] x = (6, 7): condition 2.6.
        assert!((x[0] - 1.0).abs() < 1e-15 && (x[1] - 2.0).abs() < 1e-15);
        let indefinite = [(0, 0, 1.0), (1, 0, 2.0), (1, 1, 1.0)];
        assert!(SparseCholesky::factorize(2, indefinite.into_iter()).is_err());
    }
}
