//! Factors of a stiffness over some unknowns.

use super::{PrestressError, Result};
use crate::fem::{DofMap, Triplets};
use crate::linalg::{LuAnalysis, MatrixPolynomial, SparseLu};

/// Factors of a stiffness over the unknowns.
///
/// # Errors
/// [`PrestressError::Singular`] unless it is positive definite.
pub(super) fn factorized(stiffness: &Triplets, unknowns: &DofMap) -> Result<SparseLu> {
    let place = |dof: usize| unknowns.unknown_of[dof];
    let entries = stiffness.entries.iter();
    let kept =
        entries.filter_map(|&(row, column, value)| Some((place(row)?, place(column)?, value))); // What is held is left out.
    let matrix = MatrixPolynomial::from_triplets(unknowns.len(), &[kept.collect()]);
    let analysis = LuAnalysis::new(matrix.pattern());
    let factors = analysis.and_then(|own| SparseLu::symmetric(&own, matrix.evaluate(0.0)));
    let definite = factors.ok().filter(|own| own.negative_count() == 0); // No negative pivot.
    definite.ok_or(PrestressError::Singular)
}
