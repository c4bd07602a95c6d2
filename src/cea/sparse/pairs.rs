//! Right and left vectors of modes in the full problem, and what small changes of the matrices do to their eigenvalues.

use super::linearization::Linearization;
use super::structure::{Companion, StiffnessFactors, StructureMatrices};
use crate::cea::CeaError;
use crate::linalg::dense::{column, random_columns};
use crate::linalg::{
    QuadraticKrylovSettings, QuadraticPairs, SparsityPattern, c64, quadratic_krylov,
};
use crate::prestress::SlidingTangent;
use std::sync::OnceLock;

/// Residual of the iterations, relative to the shift-inverted operator.
const RESIDUAL: f64 = 1e-10;
/// Relative distance within which an eigenvalue is the one looked for, and another one makes it a multiple one.
const SAME: f64 = 1e-6;

/// An eigenvalue with its vectors over the unknowns of a tangent.
#[derive(Clone, Debug)]
pub struct ModePair {
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Eigenvalue `lambda`, rad/s.
    pub eigenvalue: c64,
    /// `d lambda / d mu`, rad/s, the base state following.
    pub derivative: c64,
    /// Right vector `x`.
    pub right: Vec<c64>,
    /// Left vector `w`, scaled to `w^T (2 lambda M + C) x = 1` (no conjugation).
    pub left: Vec<c64>,
}

impl ModePair {
    /// `d lambda = - w^T (lambda^2 dM + lambda dC + dK) x` for changes `[dK, dC, dM]` given by their nonzero values.
    pub fn response(&self, pattern: &SparsityPattern, changes: [&[f64]; 3]) -> c64 {
        let [stiffness, damping, mass] = changes.map(|values| self.form(pattern, values));
        let lambda = self.eigenvalue;
        -(lambda * (lambda * mass + damping) + stiffness)
    }

    /// `w^T P x`.
    fn form(&self, pattern: &SparsityPattern, values: &[f64]) -> c64 {
        let along = |j: usize| -> c64 {
            let nonzeros = pattern.column(j);
            nonzeros.map(|(at, i)| self.left[i] * values[at]).sum()
        };
        (0..pattern.dimension())
            .map(|j| along(j) * self.right[j])
            .sum()
    }
}

/// The modes at the friction coefficient `mu` whose eigenvalues are `targets` (rad/s, `Im > 0`), found in the full problem among
/// its `count` modes of lowest `|lambda|`: `None` where there is none, or where it is multiple and no single vector belongs to it.
///
/// One factorization of `K(mu)` serves a Krylov iteration on the quadratic problem and one on its transpose.
///
/// # Errors
/// If `K(mu)` is singular or an iteration does not converge.
pub fn mode_pairs(
    tangent: &SlidingTangent,
    mu: f64,
    targets: &[c64],
    count: usize,
) -> Result<Vec<Option<ModePair>>, CeaError> {
    let moduli = targets.iter().map(|lambda| lambda.norm());
    let frequency_scale = moduli.fold(0.0, f64::max);
    let linearization = Linearization::Companion { frequency_scale };
    let matrices = StructureMatrices::at(tangent, linearization, mu);
    let factors = StiffnessFactors::general(tangent, &OnceLock::new(), mu)?;
    let operator = Companion::new(&matrices, &factors, frequency_scale);

    // Two start vectors, for modes that come in pairs.
    let unknowns = matrices.dimension();
    let settings = QuadraticKrylovSettings {
        pairs: count.min(unknowns),
        tolerance: RESIDUAL,
        max_applications: 40 * (count + 10),
    };
    let width = 2.min(unknowns);
    let [x, y] = [5, 6].map(|seed| random_columns(unknowns, width, seed));
    let start = [x.as_ref(), y.as_ref()];
    let right = quadratic_krylov(&operator, start, &settings)?;
    let left = quadratic_krylov(&operator.transposed(), start, &settings)?;

    // Nonzero values of K, C, M at mu, and of their derivatives.
    let pattern = tangent.stiffness.pattern();
    let all = [&tangent.stiffness, &tangent.damping, &tangent.mass];
    let [_, damping, mass] = all.map(|p| p.evaluate(mu));
    let rates = all.map(|p| p.derivative(mu));
    let pair = |target: &c64| {
        let mut pair = ModePair {
            friction_coefficient: mu,
            eigenvalue: *target,
            derivative: c64::new(0.0, 0.0),
            right: vector_of(&right, *target, frequency_scale)?,
            left: vector_of(&left, *target, frequency_scale)?,
        };
        let scale = pair.form(pattern, &mass) * *target * 2.0 + pair.form(pattern, &damping);
        pair.left.iter_mut().for_each(|v| *v /= scale);
        pair.derivative = pair.response(pattern, rates.each_ref().map(Vec::as_slice));
        Some(pair)
    };
    Ok(targets.iter().map(pair).collect())
}

/// The vector of the only eigenvalue at `target`, of unit length.
fn vector_of(found: &QuadraticPairs, target: c64, frequency_scale: f64) -> Option<Vec<c64>> {
    let distance = |s: &c64| (frequency_scale / s - target).norm() / target.norm();
    // Of `s` with `Im > 0` the eigenvalue is the conjugate of the one with `Im(lambda) > 0`.
    let distance = |s: &c64| distance(&s.conj());
    let mut near = (0..found.values.len()).filter(|&k| distance(&found.values[k]) <= SAME);
    let (k, None) = (near.next()?, near.next()) else {
        return None;
    };
    let parts = [0, 1].map(|part| column(found.vectors.as_ref(), 2 * k + part));
    let entries = parts[0].iter().zip(parts[1]);
    let mut vector: Vec<c64> = entries.map(|(re, im)| c64::new(*re, -im)).collect();
    let length = vector.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt();
    vector.iter_mut().for_each(|v| *v /= length);
    Some(vector)
}
