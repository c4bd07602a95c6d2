//! Left vectors that a basis of right ones does not hold.

use super::StiffnessFactors;
use super::full_problem::FullProblem;
use crate::linalg::dense::{column, column_mut, dot, pick_columns};
use crate::linalg::{Mat, c64};
use crate::prestress::SlidingTangent;
use rayon::prelude::*;

/// Corrections of a left vector, at most: strong friction leaves a seventh of the error each time, weak friction a hundredth.
const CORRECTIONS: usize = 12;
/// Energy of a correction, relative to that of the vector, below which no more are made.
const NEGLIGIBLE: f64 = 1e-8;
/// Energy, relative to that of the vector, above which a vector that corrections do not mend is iterated: a thousandth of its length.
const COARSE: f64 = 1e-6;
/// Distance of the shift of an inverse iteration from the eigenvalue, relative to it, and its steps.
const BESIDE: f64 = 1e-7;
const ITERATIONS: usize = 2;
/// Modes that are corrected together.
const PAIRS_AT_A_TIME: usize = 12;

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

/// Corrects left vectors by the stiffness without friction, `P`,
///
/// ```text
/// w <- w - P^-1 T(lambda)^T w
/// ```
///
/// as long as the energy of the correction falls, and by inverse iteration those that this does not mend; scales them to
/// `w^T (2 lambda M + C) x = 1`. Right vectors at several friction coefficients span what is global in a left one; what is missing is
/// near the contact, where the normal force works on its slip, and follows the load as in statics.
pub fn correct_lefts(
    tangent: &SlidingTangent,
    factors: &StiffnessFactors,
    mu: f64,
    pairs: &mut [OpenPair],
) {
    let problem = FullProblem::at(tangent, mu);
    let groups = pairs.par_chunks_mut(PAIRS_AT_A_TIME);
    groups.for_each(|group| correct_group(&problem, factors, group));
    pairs.par_iter_mut().for_each(|OpenPair { eigenvalue, right, left }| {
        let scale = problem.slope(*eigenvalue, left, right);
        left.iter_mut().for_each(|w| *w /= scale);
    });
}

fn correct_group(problem: &FullProblem<'_>, factors: &StiffnessFactors, pairs: &mut [OpenPair]) {
    let scales: Vec<f64> = pairs.iter().map(OpenPair::left_energy).collect();
    // Real and imaginary parts side by side.
    let mut lefts = Mat::from_fn(problem.dimension(), 2 * pairs.len(), |i, column| {
        let value = pairs[column / 2].left[i];
        if column % 2 == 0 { value.re } else { value.im }
    });
    let mut energies = vec![f64::INFINITY; pairs.len()];
    let mut open: Vec<usize> = (0..pairs.len()).collect();
    for _ in 0..CORRECTIONS {
        let columns: Vec<usize> = open.iter().flat_map(|k| [2 * k, 2 * k + 1]).collect();
        let values: Vec<c64> = open.iter().map(|&k| pairs[k].eigenvalue).collect();
        let residuals = problem.transposed_times(&values, pick_columns(&lefts, &columns).as_ref());
        let mut corrections = residuals.clone();
        factors.solve_in_place(&mut corrections);
        // Each is taken as long as corrections become smaller and still matter.
        let mut still_open = Vec::new();
        for (at, &k) in open.iter().enumerate() {
            let own = [2 * at, 2 * at + 1]
                .map(|j| [&corrections, &residuals].map(|m| column(m.as_ref(), j)));
            let energy = own.map(|[t, r]| dot(t, r)).iter().sum::<f64>().abs();
            if energy >= energies[k] {
                continue;
            }
            energies[k] = energy;
            for (half, [correction, _]) in own.into_iter().enumerate() {
                let entries = column_mut(&mut lefts, 2 * k + half).iter_mut().zip(correction);
                entries.for_each(|(w, t)| *w -= t);
            }
            if energy > NEGLIGIBLE * scales[k] {
                still_open.push(k);
            }
        }
        open = still_open;
        if open.is_empty() {
            break;
        }
    }
    for (k, pair) in pairs.iter_mut().enumerate() {
        let [re, im] = [2 * k, 2 * k + 1].map(|j| column(lefts.as_ref(), j).iter());
        pair.left = re.zip(im).map(|(re, im)| c64::new(*re, *im)).collect();
        if energies[k] > COARSE * scales[k] {
            iterate(problem, pair);
        }
    }
}

/// A left vector by inverse iteration beside its eigenvalue, where corrections do not lead to it.
fn iterate(problem: &FullProblem<'_>, pair: &mut OpenPair) {
    let Ok(factors) = problem.factors(pair.eigenvalue * (1.0 + BESIDE)) else {
        return;
    };
    let mut w = Mat::from_fn(pair.left.len(), 1, |i, _| pair.left[i]);
    for _ in 0..ITERATIONS {
        factors.solve_transpose_in_place(w.as_mut());
        let length = w.norm_l2();
        w.col_mut(0).iter_mut().for_each(|v| *v /= length);
    }
    if w.col(0).iter().all(|v| v.is_finite()) {
        pair.left = w.col(0).iter().copied().collect();
    }
}
