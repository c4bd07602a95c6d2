//! Factors of real sparse matrices, symmetric or not.

use super::{LdlAnalysis, LinalgError, LuAnalysis, MatMut, SparseLdl, SparseLu};

/// Factors of a real matrix.
pub enum RealFactors {
    /// Of a symmetric one: a factor five cheaper to compute and to solve with.
    Symmetric(Box<SparseLdl>),
    /// Of any.
    General(Box<SparseLu>),
}

impl RealFactors {
    /// Factorizes a symmetric matrix.
    ///
    /// # Errors
    /// As [`SparseLdl::factorize`].
    pub fn symmetric(analysis: &LdlAnalysis, values: &[f64]) -> Result<Self, LinalgError> {
        SparseLdl::factorize(analysis, values).map(|ldl| Self::Symmetric(Box::new(ldl)))
    }

    /// Factorizes any matrix.
    ///
    /// # Errors
    /// As [`SparseLu::factorize`].
    pub fn general(analysis: &LuAnalysis, values: Vec<f64>) -> Result<Self, LinalgError> {
        SparseLu::factorize(analysis, values).map(|lu| Self::General(Box::new(lu)))
    }

    /// Solves `A x = b`, or `A^T x = b`, for each column, in place.
    pub fn solve(&self, x: MatMut<'_, f64>, is_transposed: bool) {
        match self {
            Self::Symmetric(ldl) => ldl.solve_in_place(x),
            Self::General(lu) if is_transposed => lu.solve_transpose_in_place(x),
            Self::General(lu) => lu.solve_in_place(x),
        }
    }
}
