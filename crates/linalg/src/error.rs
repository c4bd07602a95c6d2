//! Errors of the linear algebra.

use std::fmt::Debug;
use thiserror::Error;

/// Failure of a factorization or of an eigenvalue iteration.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum LinalgError {
    /// The symbolic or numeric factorization could not be carried out.
    #[error("factorization of a sparse matrix of {dimension} unknowns failed: {reason}")]
    Factorization {
        /// Number of unknowns.
        dimension: usize,
        /// What the factorization reported.
        reason: String,
    },
    /// The factors do not solve with the matrix they came from.
    #[error(
        "a sparse matrix of {dimension} unknowns is singular to working precision: {measure} {value:.1e}, \
         the bound is {bound:.0e}"
    )]
    Singular {
        /// Number of unknowns.
        dimension: usize,
        /// What exceeds its bound, with its verb.
        measure: &'static str,
        /// Its value (NaN where the factors are not finite).
        value: f64,
        /// Largest value accepted.
        bound: f64,
    },
    /// A dense eigenvalue decomposition did not converge.
    #[error(
        "the dense eigenvalue decomposition of a {dimension} x {dimension} matrix did not converge, or it is not finite"
    )]
    DenseEigen {
        /// Size of the matrix.
        dimension: usize,
    },
    /// An iteration reached its limit before all wanted pairs converged.
    #[error(
        "eigenvalue iteration: only {converged} of {wanted} eigenpairs converged to \
         {tolerance:.0e} after {applications} operator applications"
    )]
    NotConverged {
        /// Pairs that converged.
        converged: usize,
        /// Pairs that were wanted.
        wanted: usize,
        /// Relative residual asked for.
        tolerance: f64,
        /// Operator applications spent, in vectors.
        applications: usize,
    },
}

impl LinalgError {
    /// A factorization that could not be carried out, with what it reported.
    pub(super) fn factorization(dimension: usize, error: impl Debug) -> Self {
        Self::Factorization { dimension, reason: format!("{error:?}") }
    }

    /// Refuses factors that are not to be trusted, by the backward error of a solution (or the growth of the entries times the rounding
    /// error) and the condition number.
    pub(super) fn check(dimension: usize, error: f64, condition: f64) -> Result<(), Self> {
        let backward = ("the backward error of its factors is", error, 1e-9);
        let known = [backward, ("its condition number is at least", condition, 1e15)];
        let exceeded = known.into_iter().find(|(_, value, bound)| !(value <= bound)); // Not a number exceeds it, too.
        exceeded.filter(|_| dimension > 0).map_or(Ok(()), |(measure, value, bound)| {
            Err(Self::Singular { dimension, measure, value, bound })
        })
    }
}
