//! Left vectors that a basis of right ones does not hold.

use super::StiffnessFactors;
use super::full_problem::FullProblem;
use super::packed::{inner, joined, side_by_side};
use super::pairs::{factors_beside, iterated};
use crate::linalg::{Mat, c64};
use crate::prestress::SlidingTangent;
use rayon::prelude::*;

/// Corrections of a left vector, at most: as many cost what factors of the full problem do.
const CORRECTIONS: usize = 24;
/// Energy of a correction, relative to that of the vector, below which no more are made; a hundred times as much is left where they end.
const NEGLIGIBLE: f64 = 1e-8;
/// Modes that are corrected together.
const PAIRS_AT_A_TIME: usize = 6;

/// A mode over the unknowns.
pub struct OpenPair {
    /// Eigenvalue, rad/s.
    pub eigenvalue: c64,
    /// Right vector `x`.
    pub right: Vec<c64>,
    /// Left vector `w`.
    pub left: Vec<c64>,
}

impl OpenPair {
    /// About twice the elastic energy of the left vector: `w^T (2 lambda M + C) x` is 1.
    fn left_energy(&self) -> f64 {
        let square: f64 = self.left.iter().map(|v| v.norm_sqr()).sum();
        let product: c64 = self.left.iter().zip(&self.right).map(|(w, x)| w * x).sum();
        0.5 * self.eigenvalue.norm() * square / product.norm()
    }
}

/// Corrects left vectors by the stiffness without friction, `P`: the least `P^-1 T(lambda)^T w` over
///
/// ```text
/// w = w_0 + span { t, A t, A^2 t, .. },    A = P^-1 T(lambda)^T,    t = A w_0
/// ```
///
/// until the energy of what a further correction would be is negligible, and by inverse iteration those that this does not mend; scales
/// them to `w^T (2 lambda M + C) x = 1`. Right vectors at several friction coefficients span what is global in a left one; what is
/// missing is near the contact, where the normal force works on its slip, and follows the load as in statics. `A` is near the identity
/// but for some modes that lie below the shift of `P`: as many corrections take these out.
///
/// Source: S. C. Eisenstat, H. C. Elman and M. H. Schultz, SIAM J. Numer. Anal. 20 (1983), the generalized conjugate residual method.
pub fn correct_lefts(
    tangent: &SlidingTangent,
    factors: &StiffnessFactors,
    mu: f64,
    pairs: &mut [OpenPair],
) {
    let problem = FullProblem::at(tangent, mu);
    let groups = pairs.par_chunks_mut(PAIRS_AT_A_TIME);
    groups.for_each(|group| {
        correct_group(&problem, factors, group);
    });
    pairs.par_iter_mut().for_each(|OpenPair { eigenvalue, right, left }| {
        let scale = problem.slope(*eigenvalue, left, right);
        left.iter_mut().for_each(|w| *w /= scale);
    });
}

/// A left vector, or a correction of one, and what the problem makes of it: `w`, `T(lambda)^T w` and `P^-1 T(lambda)^T w`.
type Mapped = [Vec<c64>; 3];

/// Corrects some modes together; how many needed factors of their own.
fn correct_group(
    problem: &FullProblem<'_>,
    factors: &StiffnessFactors,
    pairs: &mut [OpenPair],
) -> usize {
    let eigenvalues: Vec<c64> = pairs.iter().map(|pair| pair.eigenvalue).collect();
    let mapped = |of: &[usize], vectors: &[&[c64]]| -> Vec<Mapped> {
        let values: Vec<c64> = of.iter().map(|&k| eigenvalues[k]).collect();
        let w = side_by_side(problem.dimension(), vectors);
        let residuals = problem.transposed_times(&values, w.as_ref());
        let mut corrections = residuals.clone();
        factors.solve_in_place(&mut corrections);
        let each = 0..vectors.len();
        each.map(|k| [&w, &residuals, &corrections].map(|of| joined(of, k))).collect()
    };
    let goals: Vec<f64> = pairs.iter().map(OpenPair::left_energy).collect();
    let mut open: Vec<usize> = (0..pairs.len()).collect();
    let mut lefts = mapped(&open, &pairs.iter().map(|pair| &pair.left[..]).collect::<Vec<_>>());
    let energy = |[_, residual, correction]: &Mapped| inner(correction, residual).re.abs();
    let mut directions: Vec<Vec<Mapped>> = vec![Vec::new(); pairs.len()];
    for _ in 0..CORRECTIONS {
        open.retain(|&k| energy(&lefts[k]) > NEGLIGIBLE * goals[k]);
        if open.is_empty() {
            break;
        }
        let corrections: Vec<&[c64]> = open.iter().map(|&k| lefts[k][2].as_slice()).collect();
        for (&k, mut own) in open.iter().zip(mapped(&open, &corrections)) {
            for other in &directions[k] {
                let share = inner(&other[2], &own[2]);
                subtract(&mut own, share, other);
            }
            let length = inner(&own[2], &own[2]).re.sqrt();
            own.iter_mut().flatten().for_each(|v| *v /= length);
            let share = inner(&own[2], &lefts[k][2]);
            subtract(&mut lefts[k], share, &own);
            directions[k].push(own);
        }
    }
    let mut iterations = 0;
    for ((pair, left), goal) in pairs.iter_mut().zip(lefts).zip(goals) {
        let is_mended = energy(&left) <= 100.0 * NEGLIGIBLE * goal;
        let [mut left, ..] = left;
        if !is_mended {
            left = iterate(problem, pair).unwrap_or(left);
            iterations += 1;
        }
        if left.iter().all(|v| v.is_finite()) {
            pair.left = left;
        }
    }
    iterations
}

/// `from -= share other`.
fn subtract(from: &mut Mapped, share: c64, other: &Mapped) {
    for (own, other) in from.iter_mut().zip(other) {
        own.iter_mut().zip(other).for_each(|(v, o)| *v -= share * o);
    }
}

/// A left vector by inverse iteration beside its eigenvalue, where corrections do not lead to it.
fn iterate(problem: &FullProblem<'_>, pair: &OpenPair) -> Option<Vec<c64>> {
    let factors = factors_beside(problem, pair.eigenvalue)?;
    let start = Mat::from_fn(pair.left.len(), 1, |i, _| pair.left[i]);
    Some(iterated(&factors, start, true).col(0).iter().copied().collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cea::sparse::fixtures::string_on_belt;
    use crate::cea::sparse::{FrictionlessModes, ModePair, mode_pairs, sweep};
    use crate::cea::{ModeLimit, SweepRequest, Unwatched};

    /// Independent check: inverse iteration in the full problem. The factors have their shift amid the modes, so that plain corrections of
    /// those below it grow, and the start, the right vectors, is far off.
    #[test]
    fn corrections_from_right_vectors_lead_to_left_ones_without_factors_for_each() {
        let (tangent, mu) = (string_on_belt(60, 0.4, false), [0.3]);
        let rest = FrictionlessModes::compute(&tangent, ModeLimit::Lowest(12)).unwrap();
        let request = SweepRequest::new(&mu, ModeLimit::Lowest(12));
        let found = sweep(&tangent, &request, &Unwatched).unwrap();
        let values: Vec<c64> = found.points[0].modes.iter().map(|mode| mode.eigenvalue).collect();
        let exact: Vec<ModePair> =
            mode_pairs(&tangent, mu[0], &values).into_iter().flatten().collect();
        assert_eq!(exact.len(), values.len());
        let open = |own: &ModePair| OpenPair {
            eigenvalue: own.eigenvalue,
            right: own.right.clone(),
            left: own.right.clone(),
        };
        let mut pairs: Vec<OpenPair> = exact.iter().map(open).collect();
        let problem = FullProblem::at(&tangent, mu[0]);
        let groups = pairs.chunks_mut(PAIRS_AT_A_TIME);
        let iterations: usize =
            groups.map(|group| correct_group(&problem, &rest.factors, group)).sum();
        assert_eq!(iterations, 0);
        for (own, other) in pairs.iter().zip(&exact) {
            let length = |w: &[c64]| inner(w, w).re.sqrt();
            let [w, exact] = [&own.left, &other.left].map(|w| w.as_slice());
            let cosine = inner(w, exact).norm() / (length(w) * length(exact));
            assert!(1.0 - cosine * cosine < 1e-6, "{}: {}", own.eigenvalue, 1.0 - cosine * cosine);
        }
    }
}
