//! The full problem at one friction coefficient, with complex factors of its own.

use crate::linalg::{ComplexSparseLu, LinalgError, LuAnalysis, c64};
use crate::prestress::{SlidingTangent, TabledGain};

/// `T(lambda) = lambda^2 M + lambda C + K + i H + sum_p g_p K_p` at one friction coefficient, `g_p` at the frequency of `lambda`.
pub struct FullProblem<'a> {
    analysis: LuAnalysis,
    /// Nonzero values of `K`, `C` and `M`.
    values: [Vec<f64>; 3],
    /// Those of `H`; empty without structural damping.
    structural: Vec<f64>,
    /// Those of parts whose stiffness depends on frequency.
    tabled: Vec<(&'a TabledGain, Vec<f64>)>,
}

impl<'a> FullProblem<'a> {
    /// The problem of `tangent` at friction coefficient `mu`.
    ///
    /// # Errors
    /// If the analysis of the pattern fails.
    pub fn at(tangent: &'a SlidingTangent, mu: f64) -> Result<Self, LinalgError> {
        let all = [&tangent.stiffness, &tangent.damping, &tangent.mass];
        let structural = tangent.structural.as_ref();
        let tabled = tangent.tabled.iter();
        Ok(Self {
            analysis: LuAnalysis::new(tangent.stiffness.pattern())?,
            values: all.map(|p| p.evaluate(mu)),
            structural: structural.map_or_else(Vec::new, |p| p.evaluate(mu)),
            tabled: tabled.map(|part| (&part.gain, part.stiffness.evaluate(mu))).collect(),
        })
    }

    /// Number of unknowns.
    pub fn dimension(&self) -> usize {
        self.analysis.pattern().dimension()
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
        let lost = (c64::new(0.0, 1.0), &self.structural);
        let tabled = self.tabled.iter().map(|(gain, own)| (gain.at(lambda), own));
        for (factor, own) in tabled.chain([lost]) {
            pencil.iter_mut().zip(own).for_each(|(value, own)| *value += factor * *own);
        }
        ComplexSparseLu::factorize(&self.analysis, pencil)
    }
}
