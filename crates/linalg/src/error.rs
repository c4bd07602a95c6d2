//! Errors of the linear algebra.

use std::fmt::Debug;
use thiserror::Error;

/// Backward error of a trial solve, or growth of the entries times the rounding error, above which factors are not trusted.
pub(super) const BACKWARD_ERROR_BOUND: f64 = 1e-9;

/// Condition number from which on a matrix has no inverse in double precision.
pub(super) const CONDITION_BOUND: f64 = 1e15;

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
        "the dense eigenvalue decomposition of a {dimension} x {dimension} matrix did not converge"
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

    /// Factors that fail a trial solve.
    pub(super) fn inaccurate(dimension: usize, value: f64) -> Self {
        let measure = "the backward error of its factors is";
        Self::Singular { dimension, measure, value, bound: BACKWARD_ERROR_BOUND }
    }

    /// A matrix without an inverse in double precision.
    pub(super) fn ill_conditioned(dimension: usize, value: f64) -> Self {
        let measure = "its condition number is at least";
        Self::Singular { dimension, measure, value, bound: CONDITION_BOUND }
    }
}
