//! Factors of the stiffness.

use crate::linalg::{
    LdlAnalysis, LinalgError, LuAnalysis, Mat, MatrixPolynomial, SparseLdl, SparseLu,
};

/// Factors of `K(mu)`.
pub enum StiffnessFactors {
    /// Without friction: a factor five cheaper to compute and to solve with.
    Symmetric(Box<SparseLdl>),
    /// With friction.
    General(Box<SparseLu>),
}

impl StiffnessFactors {
    /// Factorizes `K(0)`, which is symmetric.
    pub fn frictionless(stiffness: &MatrixPolynomial) -> Result<Self, LinalgError> {
        let analysis = LdlAnalysis::new(stiffness.pattern())?;
        let ldl = SparseLdl::factorize(&analysis, &stiffness.evaluate(0.0))?;
        Ok(Self::Symmetric(Box::new(ldl)))
    }

    /// Factorizes `K(mu)`, by an analysis of its pattern.
    pub fn general(
        stiffness: &MatrixPolynomial,
        analysis: &LuAnalysis,
        mu: f64,
    ) -> Result<Self, LinalgError> {
        let lu = SparseLu::factorize(analysis, stiffness.evaluate(mu))?;
        Ok(Self::General(Box::new(lu)))
    }

    /// `K^-1 x` for each column, in place.
    pub fn solve_in_place(&self, x: &mut Mat<f64>) {
        match self {
            Self::Symmetric(ldl) => ldl.solve_in_place(x.as_mut()),
            Self::General(lu) => lu.solve_in_place(x.as_mut()),
        }
    }
}
