//! Left vectors that a basis of right ones does not hold.

use super::StiffnessFactors;
use super::full_problem::FullProblem;
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
/// as long as the energy of the correction falls, those that it does not lead to by inverse iteration, and scales them to `w^T (2 lambda M + C) x = 1`. Right vectors at several friction
/// coefficients span what is global in a left one; what is missing is near the contact, where the normal force works on its slip, and
/// follows the load as in statics.
pub fn correct_lefts(
    tangent: &SlidingTangent,
    factors: &StiffnessFactors,
    mu: f64,
    pairs: &mut [OpenPair],
) {
    let problem = FullProblem::at(tangent, mu);
    for group in pairs.chunks_mut(PAIRS_AT_A_TIME) {
        correct_group(&problem, factors, group);
    }
    for OpenPair { eigenvalue, right, left } in pairs {
        let scale = problem.slope(*eigenvalue, left, right);
        left.iter_mut().for_each(|w| *w /= scale);
    }
}

fn correct_group(problem: &FullProblem<'_>, factors: &StiffnessFactors, pairs: &mut [OpenPair]) {
    let scales: Vec<f64> = pairs.iter().map(OpenPair::left_energy).collect();
    let mut energies = vec![f64::INFINITY; pairs.len()];
    let (mut open, mut stalled): (Vec<usize>, Vec<usize>) =
        ((0..pairs.len()).collect(), Vec::new());
    for _ in 0..CORRECTIONS {
        // The corrections of those that are open, real and imaginary parts side by side.
        let own = open.par_iter().map(|&k| &pairs[k]);
        let residuals = own.map(|pair| problem.transposed_times(pair.eigenvalue, &pair.left));
        let residuals: Vec<Vec<c64>> = residuals.collect();
        let mut corrections = Mat::from_fn(problem.dimension(), 2 * open.len(), |i, column| {
            let value = residuals[column / 2][i];
            if column % 2 == 0 { value.re } else { value.im }
        });
        factors.solve_in_place(&mut corrections);
        // Each is taken as long as corrections become smaller and still matter.
        let mut still_open = Vec::new();
        for (at, (&k, residual)) in open.iter().zip(&residuals).enumerate() {
            let [re, im] = [2 * at, 2 * at + 1].map(|column| corrections.col(column));
            let parts = || re.iter().zip(im.iter()).zip(residual);
            let energy: f64 = parts().map(|((re, im), r)| re * r.re + im * r.im).sum();
            let energy = energy.abs();
            if energy >= energies[k] {
                stalled.push(k);
                continue;
            }
            energies[k] = energy;
            let entries = pairs[k].left.iter_mut().zip(parts());
            entries.for_each(|(w, ((re, im), _))| *w -= c64::new(*re, *im));
            if energy > NEGLIGIBLE * scales[k] {
                still_open.push(k);
            }
        }
        open = still_open;
        if open.is_empty() {
            break;
        }
    }
    open.extend(stalled);
    open.retain(|&k| energies[k] > COARSE * scales[k]);
    for k in open {
        iterate(problem, &mut pairs[k]);
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
