//! Single modes of the full problem at one friction coefficient, each with complex factors of its own.

use crate::linalg::{ComplexSparseLu, LinalgError, LuAnalysis, Mat, SparsityPattern, c64};
use crate::prestress::SlidingTangent;

/// Steps of inverse iteration after which a mode counts as not found; three or four do.
const STEPS: usize = 8;
/// Relative change of the eigenvalue that ends the iteration: its error is about the square of that.
const SETTLED: f64 = 1e-7;
/// The same below which factors may be singular: the eigenvalue is found.
const NEARLY_SETTLED: f64 = 1e-4;

/// `T(lambda) = lambda^2 M + lambda C + K + i H` at one friction coefficient, without tables.
pub struct FullProblem<'a> {
    pattern: &'a SparsityPattern,
    analysis: LuAnalysis,
    /// Nonzero values of `K`, `C` and `M`.
    pub values: [Vec<f64>; 3],
    /// Those of `H`; empty without structural damping.
    structural: Vec<f64>,
}

impl<'a> FullProblem<'a> {
    /// The problem of `tangent` at friction coefficient `mu`.
    ///
    /// # Errors
    /// If the analysis of the pattern fails.
    pub fn at(tangent: &'a SlidingTangent, mu: f64) -> Result<Self, LinalgError> {
        let all = [&tangent.stiffness, &tangent.damping, &tangent.mass];
        let structural = tangent.structural.as_ref();
        Ok(Self {
            pattern: tangent.stiffness.pattern(),
            analysis: LuAnalysis::new(tangent.stiffness.pattern())?,
            values: all.map(|p| p.evaluate(mu)),
            structural: structural.map_or_else(Vec::new, |p| p.evaluate(mu)),
        })
    }

    /// Number of unknowns.
    pub fn dimension(&self) -> usize {
        self.pattern.dimension()
    }

    /// LU factors of `T(lambda)`.
    ///
    /// # Errors
    /// If it is singular.
    pub fn factors(&self, lambda: c64) -> Result<ComplexSparseLu, LinalgError> {
        let [stiffness, damping, mass] = &self.values;
        let terms = stiffness.iter().zip(damping).zip(mass);
        let pencil = terms.map(|((k, c), m)| lambda * (lambda * *m + *c) + *k);
        let mut pencil: Vec<c64> = pencil.collect();
        for (value, lost) in pencil.iter_mut().zip(&self.structural) {
            *value += c64::new(0.0, *lost);
        }
        ComplexSparseLu::factorize(&self.analysis, pencil)
    }

    /// The eigenvalue near `lambda` and its right vector of unit length, from the vector `x`, by nonlinear inverse iteration; nothing
    /// where that does not settle.
    ///
    /// ```text
    /// u = T(lambda)^-1 T'(lambda) x,    lambda <- lambda - (x^H x) / (x^H u),    x <- u / |u|
    /// ```
    ///
    /// Source: A. Ruhe, Algorithms for the nonlinear eigenvalue problem, SIAM J. Numer. Anal. 10 (1973).
    pub fn mode_near(&self, mut lambda: c64, x: Vec<c64>) -> Option<(c64, Vec<c64>)> {
        let unit = |x: Vec<c64>| -> Vec<c64> {
            let length = x.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt();
            x.into_iter().map(|v| v / length).collect()
        };
        let (mut x, mut change) = (unit(x), f64::INFINITY);
        for _ in 0..STEPS {
            let Ok(factors) = self.factors(lambda) else {
                return (change <= NEARLY_SETTLED).then_some((lambda, x));
            };
            let slope = self.slope_times(lambda, &x);
            let mut image = Mat::from_fn(x.len(), 1, |i, _| slope[i]);
            factors.solve_in_place(image.as_mut());
            let pairs = x.iter().zip(image.col(0).iter());
            let along: c64 = pairs.map(|(x, u)| x.conj() * u).sum();
            let step = along.inv();
            x = unit(image.col(0).iter().copied().collect());
            lambda -= step;
            change = step.norm() / lambda.norm();
            if !change.is_finite() {
                return None;
            }
            if change <= SETTLED {
                return Some((lambda, x));
            }
        }
        None
    }

    /// `T'(lambda) x = (2 lambda M + C) x`.
    fn slope_times(&self, lambda: c64, x: &[c64]) -> Vec<c64> {
        let [_, damping, mass] = &self.values;
        let mut image = vec![c64::new(0.0, 0.0); x.len()];
        for (j, x) in x.iter().enumerate() {
            for (at, i) in self.pattern.column(j) {
                image[i] += (lambda * (2.0 * mass[at]) + damping[at]) * x;
            }
        }
        image
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cea::sparse::fixtures::string_on_belt;
    use crate::linalg::dense::random_columns;

    /// Exact: what the iteration settles at has no residual, from a vector and an eigenvalue that are far from it.
    #[test]
    fn inverse_iteration_ends_at_a_mode_of_the_full_problem() {
        let tangent = string_on_belt(60, 0.4, false);
        let problem = FullProblem::at(&tangent, 0.3).unwrap();
        let start = random_columns(60, 1, 3);
        let start = (0..60).map(|i| c64::new(start[(i, 0)], 0.0)).collect();
        let (lambda, x) = problem.mode_near(c64::new(-0.01, 0.4), start).unwrap();
        let [stiffness, damping, mass] = &problem.values;
        let mut residual = vec![c64::new(0.0, 0.0); 60];
        for (j, x) in x.iter().enumerate() {
            for (at, i) in problem.pattern.column(j) {
                residual[i] += (lambda * (lambda * mass[at] + damping[at]) + stiffness[at]) * x;
            }
        }
        let largest = residual.iter().fold(0.0, |m: f64, v| m.max(v.norm()));
        assert!(largest < 1e-12, "{largest}");
        assert!((lambda - c64::new(-0.01, 0.4)).norm() < 0.2);
    }
}
