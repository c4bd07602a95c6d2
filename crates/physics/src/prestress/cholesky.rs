//! Sparse Cholesky factorization of a stiffness over some unknowns.

use super::PrestressError;
use crate::fem::{DofMap, Triplets};
use crate::linalg::SparseCholesky;

/// Factors of a stiffness over the unknowns.
///
/// # Errors
/// [`PrestressError::Singular`] unless it is positive definite.
pub(super) fn factorized(
    stiffness: &Triplets,
    unknowns: &DofMap,
) -> Result<SparseCholesky, PrestressError> {
    let place = |dof: usize| unknowns.unknown_of[dof];
    let entries = stiffness.entries.iter();
    let kept =
        entries.filter_map(|&(row, column, value)| Some((place(row)?, place(column)?, value)));
    SparseCholesky::factorize(unknowns.len(), kept).map_err(|_| PrestressError::Singular)
}
