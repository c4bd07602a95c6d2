//! Sparse Cholesky factorization of a stiffness over some unknowns.

use super::PrestressError;
use crate::fem::{DofMap, Triplets};
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{MatMut, Side};

pub(super) struct CholeskySolver {
    factor: faer::sparse::linalg::solvers::Llt<usize, f64>,
}

impl CholeskySolver {
    pub fn new(stiffness: &Triplets, unknowns: &DofMap) -> Result<Self, PrestressError> {
        let place = |dof: usize| unknowns.unknown_of[dof];
        let triplets: Vec<_> = stiffness
            .entries
            .iter()
            .filter_map(|&(row, column, value)| {
                Some(Triplet::new(place(row)?, place(column)?, value))
            })
            .collect();
        let matrix = SparseColMat::try_new_from_triplets(unknowns.len(), unknowns.len(), &triplets)
            .map_err(|_| PrestressError::Singular)?;
        let factor = matrix
            .sp_cholesky(Side::Lower)
            .map_err(|_| PrestressError::Singular)?;
        Ok(Self { factor })
    }

    pub fn solve(&self, mut right_side: Vec<f64>) -> Vec<f64> {
        let count = right_side.len();
        self.solve_block(MatMut::from_column_major_slice_mut(
            &mut right_side,
            count,
            1,
        ));
        right_side
    }

    /// Solves for each column, in place.
    pub fn solve_block(&self, right_sides: MatMut<'_, f64>) {
        self.factor.solve_in_place(right_sides);
    }
}
