//! Right and left vectors of modes in the full problem, and what small changes of the matrices do to their eigenvalues.

use super::full_problem::form;
use crate::cea::sparse::*;
use crate::fem::own_frequency_step;
use crate::linalg::ComplexSparseLu;
use crate::linalg::vectors::dot;

/// Steps of inverse iteration.
const STEPS: usize = 4;

/// An eigenvalue with its vectors over the unknowns of a tangent.
#[derive(Clone, Debug)]
pub struct ModePair {
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
    /// `d lambda = - w^T dT(lambda) x` for changes of the matrices, given by their nonzero values; with tables the stiffness follows
    /// the eigenvalue.
    pub fn response(&self, pattern: &SparsityPattern, changes: &MotionMatrices<Vec<f64>>) -> c64 {
        let terms = changes.terms(self.eigenvalue).into_iter();
        let forms = terms.map(|(factor, own)| factor * form(pattern, own, &self.left, &self.right));
        own_frequency_step(-forms.sum::<c64>(), self.own_slope)
    }
}

/// The modes at the friction coefficient `mu` whose eigenvalues are `targets` (rad/s, `Im > 0`), found in the full problem:
/// `None` where there is none, or where it is multiple and no single vector belongs to it.
///
/// Each is found by inverse iteration: one factorization of `T(lambda)` serves the right vector and, transposed, the left one.
pub fn mode_pairs(tangent: &SlidingTangent, mu: f64, targets: &[c64]) -> Vec<Option<ModePair>> {
    let problem = FullProblem::at(tangent, mu);
    let rates = MotionMatrices::of(tangent, |matrix| matrix.derivative(mu));
    let unknowns = problem.dimension();
    let start = random_columns(unknowns, 2.min(unknowns), 7);
    let start = Mat::from_fn(unknowns, start.ncols(), |i, j| c64::new(start[(i, j)], 0.0));
    let pair = |target: &c64| {
        // Far enough from the eigenvalue for regular factors, near enough for iterations that gain as many digits.
        let factors = problem.factors(target * (1.0 + MULTIPLE)).ok()?;
        let right = single(&iterated(&factors, start.clone(), false))?;
        let mut left = single(&iterated(&factors, start.clone(), true))?;
        let scale = problem.slope(*target, &left, &right);
        left.iter_mut().for_each(|v| *v /= scale);
        let mut pair = ModePair {
            eigenvalue: *target,
            derivative: c64::new(0.0, 0.0),
            own_slope: problem.own_slope(*target, &left, &right),
            right,
            left,
        };
        pair.derivative = pair.response(tangent.stiffness.pattern(), &rates);
        Some(pair)
    };
    crate::parallel::map(targets, pair)
}

/// Columns, of unit length, from a start after [`STEPS`] of inverse iteration on `T(lambda)` or, for left vectors, its transpose.
fn iterated(factors: &ComplexSparseLu, mut x: Mat<c64>, is_left: bool) -> Mat<c64> {
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
    x
}

/// The first of two columns of unit length, if the other one is a multiple of it.
fn single(x: &Mat<c64>) -> Option<Vec<c64>> {
    let [own, other] = [0, x.ncols() - 1].map(|j| x.col(j).iter().copied().collect::<Vec<c64>>());
    let overlap = dot(&own, &other);
    let rest: f64 = own.iter().zip(&other).map(|(a, b)| (b - a * overlap).norm_sqr()).sum(); // What the other has across it.
    // No number at all is no vector either.
    (rest <= SETTLED).then_some(own)
}
