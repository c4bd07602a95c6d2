//! Right and left vectors of modes in the full problem, and what small changes of the matrices do to their eigenvalues.

use super::factors::{FactorCache, StiffnessFactors};
use super::full_problem::FullProblem;
use super::linearization::{Centre, Linearization};
use super::structure::{Companion, StructureMatrices};
use crate::cea::CeaError;
use crate::fem::own_frequency_step;
use crate::linalg::dense::{column, random_columns};
use crate::linalg::{
    Mat, QuadraticKrylovSettings, QuadraticPairs, SparsityPattern, c64, quadratic_krylov,
};
use crate::prestress::SlidingTangent;
use std::f64::consts::TAU;

/// Residual of the iterations, relative to the shift-inverted operator.
const RESIDUAL: f64 = 1e-10;
/// Relative distance within which an eigenvalue is the one looked for, and another one makes it a multiple one.
const SAME: f64 = 1e-6;
/// Modes up to which each has factors of its own, complex ones: more of them cost more than two Krylov iterations.
pub(super) const FEW: usize = 6;
/// Distance of the shift from an eigenvalue, relative to it: far enough for regular factors, near enough for iterations that gain
/// as many digits.
const OFFSET: f64 = 1e-7;
/// Where Krylov iterations are centred, relative to the highest mode.
const BESIDE_ZERO: f64 = 1e-2;
/// Steps of inverse iteration.
const STEPS: usize = 4;
/// What the vectors from two starts may differ by, of length 1, where an eigenvalue is single.
const ALIKE: f64 = 1e-5;

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
    /// `w^T (dK/d omega) x` of stiffness that depends on frequency, at that of the eigenvalue.
    own_slope: c64,
}

impl ModePair {
    /// `d lambda = - w^T (lambda^2 dM + lambda dC + dK) x` for changes `[dK, dC, dM]` given by their nonzero values.
    pub fn response(&self, pattern: &SparsityPattern, changes: [&[f64]; 3]) -> c64 {
        let [stiffness, damping, mass] = changes.map(|values| self.form(pattern, values));
        let lambda = self.eigenvalue;
        self.followed(-(lambda * (lambda * mass + damping) + stiffness))
    }

    /// The change of the eigenvalue where it would be `change` at fixed stiffness: with tables the stiffness follows it.
    fn followed(&self, change: c64) -> c64 {
        match self.own_slope == c64::new(0.0, 0.0) {
            true => change,
            false => own_frequency_step(change, self.own_slope),
        }
    }

    /// [`Self::response`] with a change `dH` of the structural damping, which adds `- i w^T dH x`; an empty one is none.
    pub fn lossy_response(
        &self,
        pattern: &SparsityPattern,
        changes: [&[f64]; 3],
        structural: &[f64],
    ) -> c64 {
        let lost = match structural {
            [] => c64::new(0.0, 0.0),
            values => self.form(pattern, values),
        };
        self.response(pattern, changes) + self.followed(c64::new(0.0, -1.0) * lost)
    }

    /// `w^T P x`.
    fn form(&self, pattern: &SparsityPattern, values: &[f64]) -> c64 {
        let along = |j: usize| -> c64 {
            let nonzeros = pattern.column(j);
            nonzeros.map(|(at, i)| self.left[i] * values[at]).sum()
        };
        (0..pattern.dimension()).map(|j| along(j) * self.right[j]).sum()
    }
}

/// The modes at the friction coefficient `mu` whose eigenvalues are `targets` (rad/s, `Im > 0`), found in the full problem:
/// `None` where there is none, or where it is multiple and no single vector belongs to it.
///
/// A few are found by inverse iteration with factors of `T(lambda)` for each. For more, one factorization of `K(mu)` serves a Krylov
/// iteration on the quadratic problem and one on its transpose, for the `count` modes of lowest `|lambda|`, which the targets must
/// be among.
///
/// # Errors
/// If `K(mu)` is singular or an iteration does not converge.
pub fn mode_pairs(
    tangent: &SlidingTangent,
    mu: f64,
    targets: &[c64],
    count: usize,
) -> Result<Vec<Option<ModePair>>, CeaError> {
    if !tangent.tabled.is_empty() {
        let each = targets.iter();
        let each = each.map(|target| pair_at_own_frequency(tangent, mu, *target, count));
        return each.collect();
    }
    // Krylov iterations are on real matrices.
    let is_lossy = tangent.structural.is_some();
    let few = (targets.len() <= FEW || is_lossy).then(|| inverse_iterations(tangent, mu, targets));
    let vectors = match few {
        Some(Ok(vectors)) => vectors,
        // Factors so near to an eigenvalue may be refused as singular.
        Some(Err(_)) | None => krylov_vectors(tangent, mu, targets, count)?,
    };

    // Nonzero values of K, C, M at mu, and of their derivatives.
    let pattern = tangent.stiffness.pattern();
    let all = [&tangent.stiffness, &tangent.damping, &tangent.mass];
    let [_, damping, mass] = all.map(|p| p.evaluate(mu));
    let rates = all.map(|p| p.derivative(mu));
    let structural = tangent.structural.as_ref();
    let structural_rate = structural.map_or_else(Vec::new, |p| p.derivative(mu));
    let pair = |(target, vectors): (&c64, Option<Vectors>)| {
        let [right, left] = vectors?;
        let mut pair = ModePair {
            friction_coefficient: mu,
            eigenvalue: *target,
            derivative: c64::new(0.0, 0.0),
            right,
            left,
            own_slope: c64::new(0.0, 0.0),
        };
        let scale = pair.form(pattern, &mass) * *target * 2.0 + pair.form(pattern, &damping);
        pair.left.iter_mut().for_each(|v| *v /= scale);
        let rates = rates.each_ref().map(Vec::as_slice);
        pair.derivative = pair.lossy_response(pattern, rates, &structural_rate);
        Some(pair)
    };
    Ok(targets.iter().zip(vectors).map(pair).collect())
}

/// The mode of a target in a problem whose stiffness depends on frequency: that of the problem frozen at the target's.
fn pair_at_own_frequency(
    tangent: &SlidingTangent,
    mu: f64,
    target: c64,
    count: usize,
) -> Result<Option<ModePair>, CeaError> {
    let frozen = tangent.at_frequency(target.im / TAU);
    let mut pairs = mode_pairs(&frozen, mu, &[target], count)?;
    let Some(Some(mut pair)) = pairs.pop() else {
        return Ok(None);
    };
    let pattern = tangent.stiffness.pattern();
    let slopes = tangent
        .tabled
        .iter()
        .map(|part| part.gain.slope(target) * pair.form(pattern, &part.stiffness.evaluate(mu)));
    pair.own_slope = slopes.sum();
    pair.derivative = pair.followed(pair.derivative);
    Ok(Some(pair))
}

/// Right and left vector, of unit length.
type Vectors = [Vec<c64>; 2];

/// The vectors of each target by inverse iteration on `T(lambda)` and its transpose.
fn inverse_iterations(
    tangent: &SlidingTangent,
    mu: f64,
    targets: &[c64],
) -> Result<Vec<Option<Vectors>>, CeaError> {
    let problem = FullProblem::at(tangent, mu)?;
    let unknowns = problem.dimension();
    let start = random_columns(unknowns, 2.min(unknowns), 7);
    let found = targets.iter().map(|target| {
        let factors = problem.factors(*target * (1.0 + OFFSET))?;
        let converged = |is_left: bool| {
            let mut x = Mat::from_fn(unknowns, start.ncols(), |i, j| c64::new(start[(i, j)], 0.0));
            for _ in 0..STEPS {
                match is_left {
                    true => factors.solve_transpose_in_place(x.as_mut()),
                    false => factors.solve_in_place(x.as_mut()),
                }
                for j in 0..x.ncols() {
                    let length = x.col(j).norm_l2();
                    x.col_mut(j).iter_mut().for_each(|v| *v /= length);
                }
            }
            single(&x)
        };
        let both = (converged(false), converged(true));
        Ok(both.0.zip(both.1).map(|(right, left)| [right, left]))
    });
    found.collect()
}

/// The first of two columns of unit length, if the other one is a multiple of it.
fn single(x: &Mat<c64>) -> Option<Vec<c64>> {
    let own: Vec<c64> = x.col(0).iter().copied().collect();
    let other = x.col(x.ncols() - 1);
    let overlap: c64 = own.iter().zip(other.iter()).map(|(a, b)| a.conj() * b).sum();
    let rest = own.iter().zip(other.iter());
    let rest: f64 = rest.map(|(a, b)| (b - a * overlap).norm_sqr()).sum();
    // No number at all is no vector either.
    (rest.sqrt() <= ALIKE).then_some(own)
}

/// The vectors of each target from two Krylov iterations.
fn krylov_vectors(
    tangent: &SlidingTangent,
    mu: f64,
    targets: &[c64],
    count: usize,
) -> Result<Vec<Option<Vectors>>, CeaError> {
    let moduli = targets.iter().map(|lambda| lambda.norm());
    let frequency_scale = moduli.fold(0.0, f64::max);
    // A centre beside zero: the body may be free, or held softly.
    let shift = if tangent.is_gyroscopic { 0.0 } else { BESIDE_ZERO * frequency_scale };
    let centre = Centre { shift, rigid: 0.0 };
    let linearization = Linearization::Companion { frequency_scale, centre };
    let matrices = StructureMatrices::at(tangent, linearization, mu);
    let factors = {
        let stiffness = linearization.centred_stiffness(tangent);
        StiffnessFactors::general(&stiffness, &FactorCache::default(), mu)?
    };
    let operator = Companion::new(&matrices, &factors, frequency_scale);

    // Two start vectors, for modes that come in pairs.
    let unknowns = matrices.dimension();
    let settings = QuadraticKrylovSettings {
        pairs: count.min(unknowns),
        least: count.min(unknowns),
        tolerance: RESIDUAL,
        max_applications: 40 * (count + 10),
        centre: shift / frequency_scale,
    };
    let width = 2.min(unknowns);
    let [x, y] = [5, 6].map(|seed| random_columns(unknowns, width, seed));
    let start = [x.as_ref(), y.as_ref()];
    let right = quadratic_krylov(&operator, start, &settings)?;
    let operator = Companion::transposed(&matrices, &factors, frequency_scale);
    let left = quadratic_krylov(&operator, start, &settings)?;
    let vectors = |target: &c64| {
        let [right, left] = [&right, &left].map(|all| vector_of(all, *target, linearization));
        Some([right?, left?])
    };
    Ok(targets.iter().map(vectors).collect())
}

/// The vector of the only eigenvalue at `target`, of unit length.
fn vector_of(
    found: &QuadraticPairs,
    target: c64,
    linearization: Linearization,
) -> Option<Vec<c64>> {
    let distance = |s: &c64| (linearization.value(*s) - target).norm() / target.norm();
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
