//! Errors of the linear algebra.

use std::fmt::Display;
use thiserror::Error;

/// Failure of a factorization or of an eigenvalue iteration: which, and by how much.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{0}")]
pub struct LinalgError(String);

impl LinalgError {
    /// A symbolic or numeric factorization that could not be carried out, with what it reported.
    pub fn factorization(dimension: usize, reason: impl Display) -> Self {
        Self(format!("factorization of a sparse matrix of {dimension} unknowns failed: {reason}"))
    }

    /// A dense eigenvalue decomposition that did not converge.
    pub fn dense_eigen(dimension: usize) -> Self {
        Self(format!(
            "the dense eigenvalue decomposition of a {dimension} x {dimension} matrix did not converge, or it is not finite"
        ))
    }

    /// An iteration that reached its limit, in applications of its operator, before all pairs converged.
    pub fn not_converged([converged, wanted, most]: [usize; 3], tolerance: f64) -> Self {
        Self(format!(
            "eigenvalue iteration: only {converged} of {wanted} eigenpairs converged to {tolerance:.0e} after {most} operator applications"
        ))
    }

    /// Refuses factors that are not to be trusted, by the backward error of a solution (or the growth of the entries times the rounding
    /// error) and the condition number; both are not a number where the factors are not finite.
    pub(super) fn check(dimension: usize, error: f64, condition: f64) -> Result<(), Self> {
        let backward = ("the backward error of its factors is", error, 1e-9);
        let known = [backward, ("its condition number is at least", condition, 1e15)];
        let exceeded = known.into_iter().find(|(_, value, bound)| !(value <= bound)); // Not a number exceeds it, too.
        exceeded.filter(|_| dimension > 0).map_or(Ok(()), |(measure, value, bound)| {
            Err(Self(format!(
                "a sparse matrix of {dimension} unknowns is singular to working precision: {measure} {value:.1e}, the bound is {bound:.0e}"
            )))
        })
    }
}
