//! The full problem at one friction coefficient, with complex factors of its own.

use crate::linalg::{ComplexSparseLu, LinalgError, LuAnalysis, Mat, MatRef, SparsityPattern, c64};
use crate::prestress::{SlidingTangent, TabledGain};
use std::sync::{Arc, OnceLock};

/// Order of elimination of all matrices of one tangent, made for the first factors.
#[derive(Clone, Default)]
pub struct SharedAnalysis(Arc<OnceLock<Result<LuAnalysis, LinalgError>>>);

impl SharedAnalysis {
    /// The analysis of `pattern`, the same each time.
    pub fn of(&self, pattern: &Arc<SparsityPattern>) -> Result<&LuAnalysis, LinalgError> {
        self.0.get_or_init(|| LuAnalysis::new(pattern)).as_ref().map_err(Clone::clone)
    }
}

/// `T(lambda) = lambda^2 M + lambda C + K + i H + sum_p g_p K_p` at one friction coefficient, `g_p` at the frequency of `lambda`.
pub struct FullProblem<'a> {
    pattern: &'a Arc<SparsityPattern>,
    analysis: SharedAnalysis,
    /// Nonzero values of `K`, `C` and `M`.
    values: [Vec<f64>; 3],
    /// Those of `H`; empty without structural damping.
    structural: Vec<f64>,
    /// Those of parts whose stiffness depends on frequency.
    tabled: Vec<(&'a TabledGain, Vec<f64>)>,
}

impl<'a> FullProblem<'a> {
    /// The problem of `tangent` at friction coefficient `mu`.
    pub fn at(tangent: &'a SlidingTangent, mu: f64) -> Self {
        Self::analysed(tangent, mu, SharedAnalysis::default())
    }

    /// [`Self::at`] with an analysis that serves other friction coefficients too.
    pub fn analysed(tangent: &'a SlidingTangent, mu: f64, analysis: SharedAnalysis) -> Self {
        let all = [&tangent.stiffness, &tangent.damping, &tangent.mass];
        let structural = tangent.structural.as_ref();
        let tabled = tangent.tabled.iter();
        Self {
            pattern: tangent.stiffness.pattern(),
            analysis,
            values: all.map(|p| p.evaluate(mu)),
            structural: structural.map_or_else(Vec::new, |p| p.evaluate(mu)),
            tabled: tabled.map(|part| (&part.gain, part.stiffness.evaluate(mu))).collect(),
        }
    }

    /// Number of unknowns.
    pub fn dimension(&self) -> usize {
        self.pattern.dimension()
    }

    /// Nonzero values of `T(lambda)`.
    fn pencil(&self, lambda: c64) -> Vec<c64> {
        let [stiffness, damping, mass] = &self.values;
        let terms = stiffness.iter().zip(damping).zip(mass);
        let pencil = terms.map(|((k, c), m)| lambda * (lambda * *m + *c) + *k);
        let mut pencil: Vec<c64> = pencil.collect();
        let lost = (c64::new(0.0, 1.0), &self.structural);
        let tabled = self.tabled.iter().map(|(gain, own)| (gain.at(lambda), own));
        for (factor, own) in tabled.chain([lost]) {
            pencil.iter_mut().zip(own).for_each(|(value, own)| *value += factor * *own);
        }
        pencil
    }

    /// LU factors of `T(lambda)`.
    pub fn factors(&self, lambda: c64) -> Result<ComplexSparseLu, LinalgError> {
        ComplexSparseLu::factorize(self.analysis.of(self.pattern)?, self.pencil(lambda))
    }

    /// `T(lambda)^T w` of each of `values` with its two columns of `w`, real and imaginary part.
    pub fn transposed_times(&self, values: &[c64], w: MatRef<'_, f64>) -> Mat<f64> {
        let times = |matrix: &[f64]| self.pattern.multiply_transpose(matrix, w);
        let matrices = self.values.each_ref().map(Vec::as_slice);
        let [mut sum, damped, inert] = self.pattern.multiply_transpose_each(matrices, w);
        let mut add = |factor: &dyn Fn(c64) -> c64, image: Mat<f64>| {
            for (k, own) in values.iter().enumerate() {
                let factor = factor(*own);
                for i in 0..image.nrows() {
                    let value = factor * c64::new(image[(i, 2 * k)], image[(i, 2 * k + 1)]);
                    sum[(i, 2 * k)] += value.re;
                    sum[(i, 2 * k + 1)] += value.im;
                }
            }
        };
        add(&|lambda| lambda, damped);
        add(&|lambda| lambda * lambda, inert);
        if !self.structural.is_empty() {
            add(&|_| c64::new(0.0, 1.0), times(&self.structural));
        }
        for (gain, own) in &self.tabled {
            add(&|lambda| gain.at(lambda), times(own));
        }
        sum
    }

    /// `w^T (2 lambda M + C) x`.
    pub fn slope(&self, lambda: c64, w: &[c64], x: &[c64]) -> c64 {
        let [_, damping, mass] = &self.values;
        let along = |j: usize| -> c64 {
            let nonzeros = self.pattern.column(j);
            nonzeros.map(|(at, i)| w[i] * (2.0 * lambda * mass[at] + damping[at])).sum()
        };
        (0..self.dimension()).map(|j| along(j) * x[j]).sum()
    }
}
