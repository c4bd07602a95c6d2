//! Sparse Cholesky factorization of a stiffness over some unknowns.

use super::PrestressError;
use crate::fem::{DofMap, Triplets};
use crate::linalg::{MatMut, SparseCholesky};

pub(super) struct CholeskySolver {
    factor: SparseCholesky,
}

impl CholeskySolver {
    pub fn new(stiffness: &Triplets, unknowns: &DofMap) -> Result<Self, PrestressError> {
        let place = |dof: usize| unknowns.unknown_of[dof];
        let entries = stiffness.entries.iter();
        let kept =
            entries.filter_map(|&(row, column, value)| Some((place(row)?, place(column)?, value)));
        let factor = SparseCholesky::factorize(unknowns.len(), kept)
            .map_err(|_| PrestressError::Singular)?;
        Ok(Self { factor })
    }

    pub fn solve(&self, mut right_side: Vec<f64>) -> Vec<f64> {
        let count = right_side.len();
        self.solve_block(MatMut::from_column_major_slice_mut(&mut right_side, count, 1));
        right_side
    }

    /// Solves for each column, in place.
    pub fn solve_block(&self, right_sides: MatMut<'_, f64>) {
        self.factor.solve_in_place(right_sides);
    }
}
