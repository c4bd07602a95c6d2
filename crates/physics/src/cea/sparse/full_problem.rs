//! The full problem at one friction coefficient, with complex factors of its own.

use crate::cea::sparse::*;
use crate::linalg::ComplexSparseLu;
use std::sync::OnceLock;

/// `T(lambda) = K + lambda C + lambda^2 M + i H + sum_p g_p K_p` at one friction coefficient, `g_p` at the frequency of `lambda`.
pub struct FullProblem<'a> {
    pattern: &'a Arc<SparsityPattern>,
    /// Made for the first factors.
    analysis: OnceLock<Result<LuAnalysis, LinalgError>>,
    /// Nonzero values of the matrices.
    values: MotionMatrices<Vec<f64>>,
}

impl<'a> FullProblem<'a> {
    /// The problem of `tangent` at friction coefficient `mu`.
    pub fn at(tangent: &'a SlidingTangent, mu: f64) -> Self {
        Self {
            pattern: tangent.stiffness.pattern(),
            analysis: OnceLock::new(),
            values: MotionMatrices::of(tangent, |matrix| matrix.evaluate(mu)),
        }
    }

    /// The same with an analysis that serves other friction coefficients too.
    pub fn sharing(self, analysis: &LuAnalysis) -> Self {
        Self { analysis: Ok(analysis.clone()).into(), ..self }
    }

    /// Number of unknowns.
    pub fn dimension(&self) -> usize {
        self.pattern.dimension()
    }

    fn analysis(&self) -> Result<&LuAnalysis, LinalgError> {
        let analyse = || LuAnalysis::new(self.pattern);
        self.analysis.get_or_init(analyse).as_ref().map_err(Clone::clone)
    }

    /// LU factors of `T(lambda)`.
    pub fn factors(&self, lambda: c64) -> Result<ComplexSparseLu, LinalgError> {
        ComplexSparseLu::factorize(self.analysis()?, self.values.at(lambda))
    }

    /// `ln det T(lambda)`, up to multiples of `2 pi i`; an error at an eigenvalue.
    pub fn ln_determinant(&self, lambda: c64) -> Result<c64, LinalgError> {
        ComplexSparseLu::ln_determinant(self.analysis()?, &self.values.at(lambda))
    }

    /// `w^T (2 lambda M + C) x`.
    pub fn slope(&self, lambda: c64, w: &[c64], x: &[c64]) -> c64 {
        let viscous = [&self.values.damping, &self.values.mass];
        let [damped, inert] = viscous.map(|values| form(self.pattern, values, w, x));
        2.0 * lambda * inert + damped
    }

    /// `w^T (dK/d omega) x` of stiffness that depends on frequency, at that of `lambda`.
    pub fn own_slope(&self, lambda: c64, w: &[c64], x: &[c64]) -> c64 {
        self.values.own_rates(lambda).map(|(rate, k)| rate * form(self.pattern, k, w, x)).sum()
    }
}

/// `w^T P x` of a matrix with these nonzero `values`.
pub fn form(pattern: &SparsityPattern, values: &[f64], w: &[c64], x: &[c64]) -> c64 {
    let along = |j: usize| -> c64 { pattern.column(j).map(|(at, i)| w[i] * values[at]).sum() }; // sum_i w_i P_ij.
    (0..pattern.dimension()).map(|j| along(j) * x[j]).sum()
}
